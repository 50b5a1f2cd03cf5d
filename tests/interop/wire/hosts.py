"""Three computers with addresses of their own: network namespaces on one bridge, none of which this machine sees.

Nothing of it has a name, so nothing outlives the processes that hold it, and no test is in another's way. Where the
system refuses namespaces, the hosts are 127.0.0.2, .3 and .4: other addresses, but one network.
"""

from __future__ import annotations

import os
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ...processes import run, start, wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator

NETWORK = "10.77.0"
LOOPBACK = ["ip", "link", "set", "lo"]
HOLD = ["sleep", "infinity"]


class Host(NamedTuple):
    """A computer: its address, and the words before a program that let it run there."""

    address: str
    within: list[str]


class Hosts(NamedTuple):
    """Three computers, and whether each has a network and a localhost of its own."""

    a: Host
    b: Host
    c: Host
    are_apart: bool

    @property
    def wrong(self) -> list[str]:
        """By what a node may call itself so that others do not find it."""
        return ["robot.invalid", "localhost"] if self.are_apart else ["robot.invalid"]


@contextmanager
def three_hosts() -> Iterator[Hosts]:
    """Make the computers, and take them away in the end."""
    with ExitStack() as stack:
        made = _namespaces(stack)
        if made is not None:
            yield made
            return
    yield Hosts(*(Host(f"127.0.0.{number}", []) for number in (2, 3, 4)), are_apart=False)


@contextmanager
def lone_host() -> Iterator[Host | None]:
    """Make one computer with a loopback interface of its own, and nothing else; None where the system refuses that."""
    with ExitStack() as stack:
        within = _first_space(stack)
        is_up = within is not None and run([*within, *LOOPBACK, "up"]).returncode == 0
        yield Host("127.0.0.1", within) if within is not None and is_up else None


def _first_space(stack: ExitStack) -> list[str] | None:
    """Return the words that lead into a new namespace, or None where the system refuses it."""
    if os.environ.get("ROSMINI_TEST_HOSTS") == "loopback":
        return None
    return _space(stack, ["unshare", *([] if os.geteuid() == 0 else ["--map-root-user"]), "--net"])


def _namespaces(stack: ExitStack) -> Hosts | None:
    """Return hosts in namespaces, or None where the system refuses one of the steps."""
    switch = _first_space(stack)
    if switch is None:
        return None
    steps = ["ip link add br0 type bridge", "ip link set br0 up"]
    hosts = []
    for number in (1, 2, 3):
        within = _space(stack, [*switch, "unshare", "--net"])
        if within is None:
            return None
        hosts.append(Host(f"{NETWORK}.{number}", within))
        steps += [
            f"ip link add port{number} type veth peer name eth0 netns {within[2]}",
            f"ip link set port{number} master br0 up",
        ]
    for within, commands in [(switch, steps), *((host.within, _own(host)) for host in hosts)]:
        if run([*within, "sh", "-ec", "\n".join(commands)]).returncode:
            return None
    return Hosts(hosts[0], hosts[1], hosts[2], are_apart=True)


def _own(host: Host) -> list[str]:
    return ["ip link set lo up", f"ip addr add {host.address}/24 dev eth0", "ip link set eth0 up"]


def _space(stack: ExitStack, words: list[str]) -> list[str] | None:
    """Start what holds a new namespace, and return the words that lead there; None if there is none."""
    holder: Any = stack.enter_context(start([*words, *HOLD]))
    name = Path(f"/proc/{holder.pid}/comm")
    wait_until(lambda: holder.poll() is not None or name.read_text(encoding="utf-8") == "sleep\n", "a namespace")
    if holder.poll() is not None:
        return None
    user = [] if os.geteuid() == 0 else ["--user", "--preserve-credentials"]
    return ["nsenter", "--target", str(holder.pid), "--net", *user, "--"]
