"""Accepts only HTTP requests to an XML-RPC server that no web page can send.

A browser sends a POST request from any page to any server, including those on this machine. The owner of a page who
controls a DNS server can also give its name the address of this machine, and then read the answers (DNS rebinding).
A page cannot make a browser omit the header ``Origin`` from a POST request, send ``Content-Type: text/xml`` to a
server of another origin without asking it first, or send a ``Host`` other than that of the page's address.
"""

from __future__ import annotations

import asyncio
import socket
from http import HTTPStatus
from typing import TYPE_CHECKING

from rosmini.core.errors import TransportException, shown

from .addresses import LOCALHOST, is_literal, is_loopback, is_own_address
from .sockets import full_name

if TYPE_CHECKING:
    from collections.abc import Iterable

    import h11

CONTENT_TYPE = "text/xml"

NAME_S = 5.0
"""Timeout of the name service for the full name of this machine [s]."""


class Refused(TransportException):
    """A request that a web page could have sent, or that no XML-RPC client sends."""

    def __init__(self, status: HTTPStatus, text: str, *, has_body: bool = True) -> None:
        super().__init__(text)
        self.status = status
        self.has_body = has_body
        """False if the answer must not have a body: for the method HEAD."""


class RequestCheck:
    """Refuses requests that a web page can send.

    Args:
        names: names and addresses that the user gave this machine, besides its own name and loopback names.

    """

    def __init__(self, names: Iterable[str] = ()) -> None:
        self._names = frozenset(map(_plain, names))
        self._looking: asyncio.Task[str] | None = None
        """Look-up of the machine's full name, shared by all requests that wait for it."""

    async def check(self, request: h11.Request) -> None:
        """Raise :class:`Refused` unless an XML-RPC client sent this request to a name of this machine."""
        method, headers = request.method.decode("latin-1"), _texts(request)
        if method != "POST":
            raise Refused(
                HTTPStatus.METHOD_NOT_ALLOWED,
                f"{shown(method)} is not answered: this is a server of XML-RPC, whose calls are POST requests. "
                "`rosnode`, `rostopic` and `rosparam` show what it knows",
                has_body=method != "HEAD",
            )
        origin = headers.get("origin")
        if origin is not None:
            raise Refused(
                HTTPStatus.FORBIDDEN,
                f"the request comes from a web page: its header Origin is {shown(', '.join(origin))}. Only ROS's nodes "
                "and tools are answered; a program of your own must not send that header",
            )
        kinds = headers.get("content-type", [])
        if not kinds or any(kind.partition(";")[0].strip().lower() != CONTENT_TYPE for kind in kinds):
            raise Refused(
                HTTPStatus.UNSUPPORTED_MEDIA_TYPE,
                f"the request's Content-Type is {shown(', '.join(kinds)) if kinds else 'missing'}; a call of XML-RPC, "
                f"unlike what any web page can send, has the header `Content-Type: {CONTENT_TYPE}`",
            )
        for field in headers.get("host", []):  # missing in HTTP/1.0, which browsers no longer use
            host = _host(field)
            if not await self._is_own(host):
                raise Refused(
                    HTTPStatus.FORBIDDEN,
                    f"the request is for the host {shown(host)}, which this machine is not known as: it may come from "
                    "a web page that attacks by DNS. Use localhost, the host name or an address of this machine "
                    f"instead; or set ROS_HOSTNAME={shown(host)[1:-1]} where this server runs (for an address, ROS_IP) "
                    "and restart it",
                )

    async def _is_own(self, host: str) -> bool:
        if host == LOCALHOST or host in self._names:
            return True
        if is_literal(host):
            return is_loopback(host) or is_own_address(host)
        name = _plain(socket.gethostname())
        short = name.partition(".")[0]
        if name and host in (name, short, f"{short}.local"):
            return True
        return bool(host) and host == await self._full_name()

    async def _full_name(self) -> str:
        if self._looking is None or self._looking.done():
            self._looking = asyncio.create_task(full_name())
        try:
            async with asyncio.timeout(NAME_S):
                return _plain(await asyncio.shield(self._looking))
        except TimeoutError:
            return ""


def _texts(request: h11.Request) -> dict[str, list[str]]:
    """Return the values of a request's headers by name in lower case."""
    found: dict[str, list[str]] = {}
    for name, value in request.headers:
        found.setdefault(name.decode("latin-1"), []).append(value.decode("latin-1"))
    return found


def _plain(name: str) -> str:
    """Return a host name normalised for comparison: case and a trailing dot do not matter."""
    return name.lower().removesuffix(".")


def _host(field: str) -> str:
    """Return the host of ``Host: host:port``; an IPv6 address has brackets, except from old clients."""
    if field.startswith("["):
        return field[1:].partition("]")[0].lower()
    host, colon, port = field.rpartition(":")
    return _plain(host if colon and port.isdecimal() else field)
