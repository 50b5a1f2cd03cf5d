"""Listening and connected sockets, with errors that say what to do."""

from __future__ import annotations

import asyncio
import ipaddress
import os
import socket
import sys
import threading
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

from rosmini.core.errors import TransportException, shown

T = TypeVar("T")

BACKLOG = 128


class Unreached(TransportException):
    """An address cannot be reached; the cause is the system's error."""

    def __init__(self, text: str, host: str) -> None:
        super().__init__(text)
        self.host = host
        """Host in that address."""


Address = tuple[socket.AddressFamily, Any]
"""Address family, and the argument for ``socket.connect``."""


def listen(bind: str, port: int) -> socket.socket:
    """Return a socket that listens at an address of this machine.

    Raises ``OSError``, for instance if the port is in use.
    """
    family = socket.AF_INET6 if ":" in bind else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    try:
        if sys.platform != "win32":  # there it would let a second process listen on the port
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((bind, port))
        listener.listen(BACKLOG)
        listener.setblocking(False)
    except OSError:
        listener.close()
        raise
    return listener


KEEPALIVE = {"TCP_KEEPIDLE": 60, "TCP_KEEPINTVL": 10, "TCP_KEEPCNT": 9}
"""As in rospy and roscpp: after a minute of silence up to nine probes are sent, ten seconds apart."""


def prepare(connection: socket.socket) -> None:
    """Set the options of each connection: data is sent at once, and a dead host is noticed when nothing is sent.

    A publisher sends its data at the end of each event, in one piece: waiting for more would only delay it.
    """
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    if all(hasattr(socket, name) for name in KEEPALIVE):
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        for name, value in KEEPALIVE.items():
            connection.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)


def literal(host: str, port: int) -> Address | None:
    """Return the address if it needs no look-up, or None."""
    try:
        number = ipaddress.ip_address("127.0.0.1" if host == "localhost" else host)
    except ValueError:
        return None
    return (socket.AF_INET if number.version == 4 else socket.AF_INET6, (str(number), port))


async def resolve(host: str, port: int) -> Address:
    """Return the address of a host; names are looked up in a separate thread, which may be slow.

    Raises :class:`Unreached` for a name that does not resolve.
    """
    found = literal(host, port)
    if found is not None:
        return found
    try:
        addresses = await _look_up(partial(socket.getaddrinfo, host, port, type=socket.SOCK_STREAM), host)
    except (OSError, ValueError) as error:
        raise Unreached(
            f"the host name {shown(host)} does not resolve on this machine ({error}): add it to /etc/hosts here, or "
            "set ROS_IP or ROS_HOSTNAME, on the machine that calls itself so, to an address that others reach",
            host,
        ) from error
    family, _, _, _, address = addresses[0]
    return family, address


async def full_name() -> str:
    """Return the fully qualified name of this machine; it is looked up as in :func:`resolve`."""
    return await _look_up(socket.getfqdn, "of this machine")


async def _look_up(look_up: Callable[[], T], what: str) -> T:
    """Return the result of a name service function, called in a thread that the process does not wait for."""
    loop = asyncio.get_running_loop()
    answer: asyncio.Future[T] = loop.create_future()

    def settle(value: Any, error: Exception | None) -> None:
        if answer.done():
            return
        if error is None:
            answer.set_result(value)
        else:
            answer.set_exception(error)

    def work() -> None:
        found: tuple[T | None, Exception | None]
        try:
            found = (look_up(), None)
        except Exception as error:
            found = (None, error)
        if not loop.is_closed():
            loop.call_soon_threadsafe(settle, *found)

    threading.Thread(target=work, name=f"rosmini-resolver {what}", daemon=True).start()
    return await answer


async def connect(host: str, port: int) -> socket.socket:
    """Return a connected, non-blocking socket.

    Raises :class:`Unreached` if no process listens there, or the name or the route is unknown.
    """
    if not 0 < port < 65536:
        raise Unreached(f"nothing can be reached at {shown(host)}, port {port}: ports are 1 to 65535", host)
    family, address = await resolve(host, port)
    made = socket.socket(family, socket.SOCK_STREAM)
    try:
        made.setblocking(False)
        prepare(made)
        await asyncio.get_running_loop().sock_connect(made, address)
    except OSError as error:
        made.close()
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise Unreached(f"nothing can be reached at {host}:{port}: {reason}", host) from error
    except BaseException:
        made.close()
        raise
    return made
