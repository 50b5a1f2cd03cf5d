"""Where the Master is, under which address this process is known, and where it listens.

The rules are those of http://wiki.ros.org/ROS/NetworkSetup and http://wiki.ros.org/ROS/EnvironmentVariables, but for
one: without ``ROS_IP`` or ``ROS_HOSTNAME`` nothing here listens on the network. Whoever wants to be reached says so.
"""

from __future__ import annotations

import os
from ipaddress import ip_address
from socket import AF_INET, AF_INET6, SOCK_DGRAM, gaierror, socket
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import urlsplit

from rosmini.core.errors import ROSInitException, shown

if TYPE_CHECKING:
    from collections.abc import Mapping

MASTER_URI = "http://localhost:11311"
"""The Master's address where nothing else is said."""

_SET_THERE = (
    "set ROS_IP there to an address of that machine which this one reaches (`hostname -I` prints those it has), and "
    "start the node again"
)

LOOPBACK = "127.0.0.1"
EVERYWHERE = "0.0.0.0"  # noqa: S104 - bound only when an address of the network was given
LOCALHOST = "localhost"


class Addresses(NamedTuple):
    """The addresses of a process."""

    master_uri: str
    """Where the Master is, as it was given: ``http://host:port``."""
    host: str
    """The host name or address that others are told."""
    bind: str
    """The address to listen on: one of loopback, or 0.0.0.0 for every network of the machine."""
    names: tuple[str, ...] = ()
    """The names and addresses that the user gave this machine: ``ROS_HOSTNAME``, ``ROS_IP`` and the like."""

    @property
    def is_open(self) -> bool:
        """True where others on the network can reach this process."""
        return self.bind == EVERYWHERE

    @property
    def master(self) -> tuple[str, int]:
        """The Master's host and port."""
        return host_and_port(self.master_uri)

    def uri(self, port: int, scheme: str = "http") -> str:
        """Return what others are told of a server of this process: ``http://host:port/``, or ``rosrpc://host:port``."""
        return f"{scheme}://{_in_uri(self.host)}:{port}{'/' if scheme == 'http' else ''}"

    @property
    def is_alone(self) -> bool:
        """True where all nodes of the graph are on this machine: nothing of another one finds its Master."""
        return is_loopback(self.host) and is_loopback(self.master[0])

    def advice(self, host: str, reason: BaseException | None) -> str:
        """Return what to do about a node that advertises an address at which it is not reached from here.

        ``host`` is the one in that address; ``reason`` is what the system said: ``socket.gaierror`` for a name that
        does not resolve, ``ConnectionRefusedError`` where nobody listens.
        """
        if isinstance(reason, ConnectionRefusedError):
            ended = (
                "it has been shut down, or it was killed (`rosnode cleanup` takes it off the Master's list)"
            )
            if self.is_alone:
                return f"No node listens there: {ended}"
            if is_loopback(host):
                return (
                    f"{host} always means the machine that asks. If the node runs on another machine, {_SET_THERE}. "
                    f"If it ran on this one, {ended}"
                )
            return f"No node listens there: {ended}. If {host} is not its machine, {_SET_THERE}"
        if isinstance(reason, gaierror):
            return f"On the machine that calls itself {host}, {_SET_THERE}; or add {host} to /etc/hosts here"
        return (
            f"If {host} is not the address by which this machine reaches the node's, {_SET_THERE}; if it is, look for "
            "a firewall, or for a network that is down"
        )

    @property
    def announcement(self) -> str | None:
        """A line that says where this process listens, or None if only this machine can reach it."""
        if not self.is_open:
            return None
        return f"listening on every network of this machine, known to others as {self.host}"

    @property
    def notes(self) -> list[str]:
        """What a program says once when it starts: where it listens, and what is wrong with its addresses."""
        return [*filter(None, [self.announcement]), *self.faults]

    @property
    def faults(self) -> list[str]:
        """What is wrong with its addresses."""
        return [line for line in (self.mistake, self.warning) if line is not None]

    @property
    def mistake(self) -> str | None:
        """A line about an address that others are told and that is not this machine's, or None. Asks the system."""
        if not is_literal(self.host) or is_own_address(self.host):
            return None
        return (
            f"{self.host} is not an address of this machine, but others are told to look for this process "
            "there. Set ROS_IP to one of those that `hostname -I` prints."
        )

    @property
    def warning(self) -> str | None:
        """What is likely to go wrong with these addresses, and what to do; None if nothing is."""
        host, _ = self.master
        if is_loopback(self.host) and not is_loopback(host):
            return (
                f"the Master is at {host}, but other machines cannot reach this process: it listens on {self.bind} "
                "only. Set ROS_IP to the address of this machine that they can reach, or ROS_HOSTNAME to a name that "
                "resolves to it there."
            )
        return None


HERE = Addresses(MASTER_URI, LOCALHOST, LOOPBACK)
"""The addresses of a process of whose network nothing is said: only this machine reaches it."""


def addresses(
    environ: Mapping[str, str] | None = None, arguments: Mapping[str, str] | None = None
) -> Addresses:
    """Return the addresses of a process.

    ``environ`` has ``ROS_MASTER_URI``, ``ROS_HOSTNAME`` and ``ROS_IP`` (``os.environ`` by default); ``arguments`` has
    ``__master``, ``__hostname`` and ``__ip`` by these keys, as :attr:`rosmini.core.names.Remappings.special` does, and
    goes before it. Raises ``ROSInitException`` for an address that is none.
    """
    environ = os.environ if environ is None else environ
    arguments = arguments or {}
    source, uri = _first(
        ("__master:=", arguments.get("__master")),
        ("ROS_MASTER_URI", environ.get("ROS_MASTER_URI")),
        ("the default", MASTER_URI),
    )
    master_host, _ = host_and_port(uri, source)
    given = (
        ("__hostname:=", arguments.get("__hostname")),
        ("__ip:=", arguments.get("__ip")),
        ("ROS_HOSTNAME", environ.get("ROS_HOSTNAME")),
        ("ROS_IP", environ.get("ROS_IP")),
    )
    source, host = _first(*given, ("the default", LOCALHOST if master_host == LOCALHOST else LOOPBACK))
    _check_host(host, source)
    return Addresses(uri, host, _bound(host), tuple(name for _, name in given if name))


def host_and_port(uri: str, source: str = "the Master's address") -> tuple[str, int]:
    """Return host and port of ``http://host:port``; port 80 if there is none, as the Web has it.

    Raises ``ROSInitException``, naming the ``source``, if it has another form.
    """
    try:
        parts = urlsplit(uri)
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if not host or parts.scheme not in ("http", "rosrpc") or parts.path not in ("", "/") or port == 0:
        raise ROSInitException(
            f"{source} is {shown(uri)}, which is no address of a Master. It has the form http://host:port, "
            f"such as {MASTER_URI}."
        )
    return host, 80 if port is None else port


def is_loopback(host: str) -> bool:
    """Tell whether a host is this machine by its name or address alone; nothing is resolved."""
    if host == LOCALHOST:
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return False


def is_literal(host: str) -> bool:
    """Tell whether a host is an address already, so that it need not be resolved."""
    try:
        ip_address(host)
    except ValueError:
        return False
    return True


def is_own_address(address: str) -> bool:
    """Return whether a literal address is one of this machine's. Asks the system, which answers at once."""
    with socket(AF_INET6 if ":" in address else AF_INET, SOCK_DGRAM) as probe:
        try:
            probe.bind((address, 0))
        except OSError:
            return False
    return True


def _first(*sources: tuple[str, str | None]) -> tuple[str, str]:
    """Return the first source that says something, and what it says; the last one always does."""
    return next((source, text) for source, text in sources if text)


def _check_host(host: str, source: str) -> None:
    if "/" in host or any(letter.isspace() for letter in host) or (":" in host and not is_literal(host)):
        raise ROSInitException(
            f"{source} is {shown(host)}, which is neither an address nor the name of a host: it has no scheme and no "
            "port, such as 192.168.1.5 or robot.local."
        )
    if is_literal(host) and (ip_address(host).is_unspecified or ip_address(host).is_multicast):
        raise ROSInitException(
            f"{source} is {host}, which nobody can connect to. Give an address of this machine, such as those that "
            "`hostname -I` prints."
        )


def _bound(host: str) -> str:
    """Return the address to listen on for what others are told."""
    if not is_loopback(host):
        return EVERYWHERE
    return LOOPBACK if host == LOCALHOST else host


def _in_uri(host: str) -> str:
    return f"[{host}]" if ":" in host else host
