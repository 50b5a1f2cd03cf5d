"""Network addresses: the Master's, the one under which this process is known, and the one it listens on.

The rules are those of http://wiki.ros.org/ROS/NetworkSetup and http://wiki.ros.org/ROS/EnvironmentVariables, with one
exception: rosmini listens on the network only if ``ROS_IP`` or ``ROS_HOSTNAME`` is set.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from ipaddress import ip_address
from socket import AF_INET, AF_INET6, SOCK_DGRAM, gaierror, socket
from typing import NamedTuple
from urllib.parse import urlsplit

from rosmini.core.errors import ROSInitException, shown

MASTER_URI = "http://localhost:11311"
"""Default address of the Master."""

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
    """Address of the Master, as given: ``http://host:port``."""
    host: str
    """Host name or address that this process advertises."""
    bind: str
    """Address to listen on: a loopback address, or 0.0.0.0 for all networks of the machine."""
    names: tuple[str, ...] = ()
    """Names and addresses that the user gave this machine: ``ROS_HOSTNAME``, ``ROS_IP`` and the like."""

    @property
    def is_open(self) -> bool:
        """True if others on the network can reach this process."""
        return self.bind == EVERYWHERE

    @property
    def master(self) -> tuple[str, int]:
        """Host and port of the Master."""
        return host_and_port(self.master_uri, any_port=True)

    def uri(self, port: int, scheme: str = "http") -> str:
        """Return the URI to advertise for a server of this process: ``http://host:port/``, or ``rosrpc://host:port``."""
        return f"{scheme}://{_in_uri(self.host)}:{port}{'/' if scheme == 'http' else ''}"

    @property
    def is_alone(self) -> bool:
        """True if all nodes of the graph are on this machine, because no other machine can reach its Master."""
        return is_loopback(self.host) and is_loopback(self.master[0])

    def advice(self, host: str, reason: BaseException | None) -> str:
        """Return a hint for a node whose advertised address cannot be reached from here.

        ``host`` is the one in that address; ``reason`` is the system's error: ``socket.gaierror`` for a name that
        does not resolve, ``ConnectionRefusedError`` if no process listens.
        """
        if isinstance(reason, ConnectionRefusedError):
            ended = "it has been shut down, or it was killed (`rosnode cleanup` takes it off the Master's list)"
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
        """Message that says where this process listens, or None if only this machine can reach it."""
        if not self.is_open:
            return None
        return f"listening on every network of this machine, known to others as {self.host}"

    @property
    def notes(self) -> list[str]:
        """Messages that a program prints once at its start: where it listens, and faults of its addresses."""
        return [*filter(None, [self.announcement]), *self.faults]

    @property
    def faults(self) -> list[str]:
        """Faults of these addresses."""
        return [line for line in (self.mistake, self.warning) if line is not None]

    @property
    def mistake(self) -> str | None:
        """Message about an advertised address that is not this machine's, or None. Queries the system."""
        if not is_literal(self.host) or is_own_address(self.host):
            return None
        return (
            f"{self.host} is not an address of this machine, but others are told to look for this process "
            "there. Set ROS_IP to one of those that `hostname -I` prints."
        )

    @property
    def warning(self) -> str | None:
        """Message about a probable fault of these addresses and how to fix it, or None."""
        host, _ = self.master
        if is_loopback(self.host) and not is_loopback(host):
            return (
                f"the Master is at {host}, but other machines cannot reach this process: it listens on {self.bind} "
                "only. Set ROS_IP to the address of this machine that they can reach, or ROS_HOSTNAME to a name that "
                "resolves to it there."
            )
        return None


HERE = Addresses(MASTER_URI, LOCALHOST, LOOPBACK)
"""Addresses of a process without network settings: only this machine can reach it."""


def addresses(
    environ: Mapping[str, str] | None = None, arguments: Mapping[str, str] | None = None, *, any_port: bool = False
) -> Addresses:
    """Return the addresses of a process.

    ``environ`` has ``ROS_MASTER_URI``, ``ROS_HOSTNAME`` and ``ROS_IP`` (``os.environ`` by default); ``arguments`` has
    ``__master``, ``__hostname`` and ``__ip`` by these keys, as :attr:`rosmini.core.names.Remappings.special` does, and
    takes precedence. With ``any_port`` the Master's port may be 0, for a Master to serve at any free port. Raises
    ``ROSInitException`` for an invalid address.
    """
    environ = os.environ if environ is None else environ
    arguments = arguments or {}
    source, uri = _first(
        ("__master:=", arguments.get("__master")),
        ("ROS_MASTER_URI", environ.get("ROS_MASTER_URI")),
        ("the default", MASTER_URI),
    )
    master_host, _ = host_and_port(uri, source, any_port=any_port)
    given = (
        ("__hostname:=", arguments.get("__hostname")),
        ("__ip:=", arguments.get("__ip")),
        ("ROS_HOSTNAME", environ.get("ROS_HOSTNAME")),
        ("ROS_IP", environ.get("ROS_IP")),
    )
    source, host = _first(*given, ("the default", LOCALHOST if master_host == LOCALHOST else LOOPBACK))
    _check_host(host, source)
    return Addresses(uri, host, _bound(host), tuple(name for _, name in given if name))


def host_and_port(uri: str, source: str = "the Master's address", *, any_port: bool = False) -> tuple[str, int]:
    """Return host and port of ``http://host:port``; the default port is 80, as on the Web.

    Raises ``ROSInitException``, naming the ``source``, if the format is different, or if the port is 0 and
    ``any_port`` is not set.
    """
    try:
        parts = urlsplit(uri)
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    is_refused = port == 0 and not any_port
    if not host or parts.scheme not in ("http", "rosrpc") or parts.path not in ("", "/") or is_refused:
        raise ROSInitException(
            f"{source} is {shown(uri)}, which is not the address of a Master. It has the form http://host:port, "
            f"such as {MASTER_URI}."
        )
    return host, 80 if port is None else port


def is_loopback(host: str) -> bool:
    """Return True if a host is this machine by its name or address alone; nothing is resolved."""
    if host == LOCALHOST:
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return False


def is_literal(host: str) -> bool:
    """Return True if a host is an address that need not be resolved."""
    try:
        ip_address(host)
    except ValueError:
        return False
    return True


def is_own_address(address: str) -> bool:
    """Return True if a literal address is one of this machine's; the system answers at once."""
    with socket(AF_INET6 if ":" in address else AF_INET, SOCK_DGRAM) as probe:
        try:
            probe.bind((address, 0))
        except OSError:
            return False
    return True


def _first(*sources: tuple[str, str | None]) -> tuple[str, str]:
    """Return the first source with a value, and the value; the last one always has one."""
    return next((source, text) for source, text in sources if text)


def _check_host(host: str, source: str) -> None:
    if "/" in host or any(letter.isspace() for letter in host) or (":" in host and not is_literal(host)):
        raise ROSInitException(
            f"{source} is {shown(host)}, which is neither an address nor the name of a host: it has no scheme and no "
            "port, such as 192.168.1.5 or robot.local."
        )
    if is_literal(host) and (ip_address(host).is_unspecified or ip_address(host).is_multicast):
        raise ROSInitException(
            f"{source} is {host}, which no other computer can connect to. Give an address of this machine, such as "
            "those that `hostname -I` prints."
        )


def _bound(host: str) -> str:
    """Return the address to listen on for an advertised host."""
    if not is_loopback(host):
        return EVERYWHERE
    return LOOPBACK if host == LOCALHOST else host


def _in_uri(host: str) -> str:
    return f"[{host}]" if ":" in host else host
