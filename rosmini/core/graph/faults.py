"""Faults made on purpose: lost, late and doubled messages, killed nodes, jumping clocks, services that are cut off.

They act where a node meets its transport, its Master and its clock, so no node's code knows of them, and a graph
without faults spends nothing on them. What is random comes from a seed, for each connection by itself: the same
messages are lost on each run, whoever else listens.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import nearest

from .clock import GraphClock, TopicClock, WrongClock
from .gates import FaultError, TopicFault

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .graph_core import GraphCore

CALLER_ID = "/fault"


class Faults:
    """The faults of a graph. Names are global; a name that nobody knows raises ``FaultError`` with the nearest."""

    def __init__(self, host: GraphCore) -> None:
        self._host = host
        self._topics = host.gates.faults
        self._jumps: dict[str, float] = {}

    def disturb(
        self,
        topic: str,
        *,
        to: str = "",
        lose: float = 0.0,
        double: float = 0.0,
        delay: float = 0.0,
        jitter: float = 0.0,
        seed: int | None = None,
    ) -> TopicFault:
        """Disturb the messages of a topic on their way to the node ``to``, or to every subscriber in this process.

        A topic has one fault for each ``to``, and a later one replaces it; one for a node adds to that of all.
        ``lose`` and ``double`` are probabilities, ``delay`` and ``jitter`` seconds; ``seed`` is the graph's by default.
        """
        publishers, subscribers, _ = self._host.ask_as(CALLER_ID).ask("getSystemState")
        heard = dict(subscribers)
        self._check("topic", topic, {**heard, **dict(publishers)})
        if to:
            self._check(f"subscriber of {topic}", to, dict.fromkeys(heard.get(topic, ())))
        fault = TopicFault(topic, to, lose, double, delay, jitter, self._host.seed if seed is None else seed)
        self._topics[topic, to] = fault
        self._host.observers_changed()
        return fault

    def cut(self, service: str) -> None:
        """Cut a service off: who calls it is told that the connection failed; so are those whose call is under way."""
        services = self._host.ask_as(CALLER_ID).ask("getSystemState")[2]
        self._check("service", service, dict(services))
        self._host.transport.cut |= {service}
        for node in list(self._host.nodes.values()):
            if service in node.services:
                node.services[service].close_sessions("cut off on purpose")

    def kill(self, name: str) -> None:
        """Kill a node of this process as ``kill -9`` does: no hook runs, and the Master goes on listing it."""
        self._node(name).vanish()

    def jump(self, seconds: float, name: str = "") -> None:
        """Let the clock of a node, or of every node of this process, jump. Simulators of this process keep theirs.

        Raises ``FaultError`` for a node whose clock is the topic ``/clock``.
        """
        if not isinstance(seconds, (int, float)) or not abs(seconds) < 1e9:
            raise FaultError(f"a clock jumps by a number of seconds, forwards or back, not {seconds!r}")
        nodes = [self._node(name)] if name else list(self._host.nodes.values())
        for node in nodes:
            if isinstance(node.clock, TopicClock):
                if name:
                    raise FaultError(
                        f"{name} has no clock of its own: it follows /clock, as /use_sim_time says"
                    )
                continue
            self._set_jump(node, self._jumps.get(node.name, 0.0) + seconds)

    def _set_jump(self, node: Any, seconds: float) -> None:
        self._jumps[node.name] = seconds
        node.clock = WrongClock(self._host.scheduler, int(seconds * 1e9))

    def clear(self, name: str = "") -> int:
        """End the faults of a topic, service or node, or all, and return how many. Nobody rises from the dead."""
        topics = [key for key in self._topics if name in ("", *key)]
        services = {service for service in self._host.transport.cut if name in ("", service)}
        jumps = [node for node in self._jumps if name in ("", node)]
        if name and not (topics or services or jumps):
            known = [*(topic for topic, _ in self._topics), *self._host.transport.cut, *self._jumps]
            raise FaultError(f"{name} has no fault. {nearest(name, known) or '`list` says which there are.'}")
        for key in topics:
            del self._topics[key]
        self._host.transport.cut -= services
        for node in jumps:
            del self._jumps[node]
            if node in self._host.nodes:
                self._host.nodes[node].clock = GraphClock(self._host.scheduler)
        self._host.observers_changed()
        return len(topics) + len(services) + len(jumps)

    def lines(self) -> list[str]:
        """Return a line for each fault that acts."""
        found = [f"{fault}: {fault.done}" for _, fault in sorted(self._topics.items())]
        found += [f"{service}: cut off" for service in sorted(self._host.transport.cut)]
        found += [f"{node}: its clock is {jump:+g} s off" for node, jump in sorted(self._jumps.items())]
        return found

    def _node(self, name: str) -> Any:
        self._check("node of this process", name, self._host.nodes)
        return self._host.nodes[name]

    @staticmethod
    def _check(kind: str, name: str, known: Mapping[str, object]) -> None:
        if name not in known:
            hint = nearest(name, known) or f"there is {', '.join(sorted(known)) or 'none'}"
            raise FaultError(f"there is no {kind} {name}: {hint}")
