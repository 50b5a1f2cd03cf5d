"""XML-RPC server for a Master of this process, compatible with ``rosmaster``."""

from __future__ import annotations

import asyncio
import errno
from functools import partial
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from rosmini.core.errors import RosminiError
from rosmini.core.graph.master_port import METHODS

from .addresses import is_literal, is_loopback
from .sockets import Unreached, resolve
from .xmlrpc_server import EncodedAnswer, XmlRpcServer
from .xmlrpc_text import NOT_XML, XmlRpcFault, encode_answers, encode_value

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.master import Master

    from .addresses import Addresses
    from .io_thread import IoThread

MULTICALL = "system.multicall"
"""Method that makes several calls at once; roslaunch uses it to set its parameters."""

MAX_CALLS = 10_000
"""Maximum number of calls in one ``system.multicall``; with more, none is made."""

MAX_BYTES = 16 * 1024 * 1024
"""Maximum total size of the answers of one ``system.multicall`` [bytes]; it ends at the call that exceeds it."""


MAX_WARNED = 1_000
"""Maximum number of nodes with an unreachable address that are remembered, to warn of each only once."""


class AddressInUse(RosminiError):
    """Another process listens on the Master's port."""


class MasterServer:
    """Serves the Master API at a port of this machine, in the I/O thread: a busy graph does not delay answers.

    Other clients are served between the calls of a ``system.multicall``. It has at most :data:`MAX_CALLS` calls
    and :data:`MAX_BYTES` of answers; beyond that the answer is a fault.

    Args:
        io: the thread that reads and writes.
        master: the Master to serve; its ``uri`` becomes the address of this server.
        where: the advertised address of this machine, and the address to listen on.
        port: 0 for any free port.
        on_shutdown: called in the I/O thread with the reason when a client shuts the Master down.
        on_call: called there with the method's name, the arguments and the answer of each call.
        warn: called there with a message about a node whose advertised address others cannot reach,
            or about a client whose request was refused.

    Raises ``AddressInUse`` if another process listens there, and ``RosminiError`` if the address is not this
    machine's.

    """

    def __init__(
        self,
        io: IoThread,
        master: Master,
        where: Addresses,
        port: int,
        *,
        on_shutdown: Callable[[str], object] | None = None,
        on_call: Callable[[str, tuple[Any, ...], Any], object] | None = None,
        warn: Callable[[str], object] | None = None,
    ) -> None:
        self._master = master
        self._on_shutdown = on_shutdown
        self._on_call = on_call
        names = (*where.names, where.master[0])
        complain = None if warn is None else partial(_complain, warn)
        try:
            self._server = XmlRpcServer(io, self._answer, bind=where.bind, port=port, names=names, warn=complain)
        except OSError as error:
            raise _refusal(where, port, error) from error
        self._advertised = None if warn is None else Advertised(warn)
        self._before, master.uri = master.uri, where.uri(self._server.port)

    @property
    def port(self) -> int:
        """Port on which it listens."""
        return self._server.port

    @property
    def shutdown_reason(self) -> str | None:
        """Reason for which a caller has shut the Master down, or None."""
        return self._master.shutdown_reason

    def close(self) -> None:
        """Stop serving; the Master keeps its state. May be called repeatedly."""
        self._server.close()
        self._master.uri = self._before

    def _answer(self, method: str, arguments: tuple[Any, ...]) -> Any:
        caller = self._server.caller
        if method == MULTICALL:
            return self._answer_all(arguments[0] if arguments else [], caller)
        return self._answer_one(method, arguments, caller)

    async def _answer_all(self, calls: Any, caller: str) -> EncodedAnswer:
        """Answer several calls, and let other tasks of the loop run after each."""
        if len(calls) > MAX_CALLS:
            raise XmlRpcFault(
                1, f"{MULTICALL} has {len(calls)} calls, at most {MAX_CALLS} are made at once: none was made"
            )
        answers: list[bytes] = []
        room = MAX_BYTES
        for number, call in enumerate(calls, 1):
            answer = self._answer_element(call, caller)
            room -= len(answer)
            if room < 0:
                raise XmlRpcFault(
                    1,
                    f"the answers of {MULTICALL} exceed {MAX_BYTES} bytes: of its {len(calls)} calls {number} were "
                    "made. Ask for large parameters one at a time",
                )
            answers.append(answer)
            await asyncio.sleep(0)
        return EncodedAnswer(encode_answers(answers))

    def _answer_element(self, call: Any, caller: str) -> bytes:
        """Return the element that answers one of several calls: a list with the answer, or the struct of a fault."""
        try:
            if call["methodName"] == MULTICALL:
                raise XmlRpcFault(1, "<class 'RuntimeError'>:Recursive system.multicall forbidden")
            return encode_value([self._answer_one(call["methodName"], tuple(call["params"]), caller)])
        except XmlRpcFault as fault:
            code, text = fault.code, fault.text
        except Exception as error:  # the caller may have sent anything
            code, text = 1, f"{type(error)}:{error}"
        return encode_value({"faultCode": code, "faultString": NOT_XML.sub("?", text)})

    def _answer_one(self, method: str, arguments: tuple[Any, ...], caller: str) -> Any:
        if method not in METHODS:
            raise XmlRpcFault(1, f"<class 'Exception'>:method \"{method}\" is not supported")
        answer = getattr(self._master, method)(*arguments)
        if self._advertised is not None and method.startswith("register") and arguments:
            self._advertised.look(caller, str(arguments[0]), str(arguments[-1]))
        if self._on_call is not None:
            self._on_call(method, arguments, answer)
        reason = self._master.shutdown_reason
        if method == "shutdown" and reason is not None and self._on_shutdown is not None:
            self._on_shutdown(reason)
        return answer


class Advertised:
    """Warns once about each node that others cannot reach at its advertised address. I/O thread only.

    The Master passes these addresses on to other nodes. A wrong one is the most frequent fault of ROS on several
    machines: all lists are complete, but no message arrives (http://wiki.ros.org/ROS/NetworkSetup).
    """

    def __init__(self, warn: Callable[[str], object]) -> None:
        self._warn = warn
        self._seen: set[tuple[str, str]] = set()
        self._tasks: set[asyncio.Task[None]] = set()

    def look(self, caller: str, name: str, uri: str) -> None:
        """Check a registration that came from the address ``caller``, of a node that advertises ``uri``."""
        try:
            host = urlsplit(uri).hostname or ""
        except ValueError:
            return
        if is_loopback(caller) or not host or (name, host) in self._seen or len(self._seen) >= MAX_WARNED:
            return
        self._seen.add((name, host))
        if is_loopback(host):
            self._warn_unreachable(caller, name, uri, f"on every machine {host} is that machine itself")
        elif not is_literal(host):
            task = asyncio.get_running_loop().create_task(self._resolve(caller, name, uri, host))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _resolve(self, caller: str, name: str, uri: str, host: str) -> None:
        try:
            await resolve(host, 0)
        except Unreached:
            self._warn_unreachable(caller, name, uri, f"the name {host} does not resolve here")

    def _warn_unreachable(self, caller: str, name: str, uri: str, why: str) -> None:
        self._warn(
            f"{name}, on the machine at {caller}, advertises {uri}, but {why}: other machines list its topics and get "
            f"no message. There, set ROS_IP={caller} and start {name} again."
        )


def _complain(warn: Callable[[str], object], host: str, reason: str) -> None:
    warn(f"the Master refused a request from {host}: {reason}")


def _refusal(where: Addresses, port: int, error: OSError) -> RosminiError:
    if error.errno == errno.EADDRINUSE:
        return AddressInUse(
            f"port {port} of {where.bind} is in use by another process, perhaps by a Master: its address would be "
            f"{where.uri(port)}. End that process, or take another port: `rosmini roscore -p {port + 1}` here and "
            f"ROS_MASTER_URI=http://{where.host}:{port + 1} for all others."
        )
    return RosminiError(
        f"cannot listen at {where.bind}, port {port}: {error.strerror or error}. ROS_IP and ROS_HOSTNAME name an "
        "address of this machine; ports below 1024 need rights that users do not have."
    )
