"""Injected faults: lost, late and duplicated messages, killed nodes, clock jumps, services that are cut off.

They act between a node and its transport, its Master and its clock, so the code of nodes does not change, and a graph
without faults has no overhead. Random numbers come from a seed, separately for each connection: the same messages are
lost in each run, whichever other nodes listen.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph.clock import GraphClock, TopicClock, WrongClock
from rosmini.core.graph.connection import Observer
from rosmini.core.graph.event_queue import span_ns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    import numpy as np

    from rosmini.core.graph.graph import Graph
    from rosmini.core.graph.scheduler import Scheduler


class FaultError(RosminiError):
    """A requested fault is not possible."""


@dataclass
class TopicFault:
    """A fault in the messages of a topic on their way to one subscriber, or to all in this process."""

    topic: str
    to: str = ""
    """The subscribing node; empty for all of them."""
    lose: float = 0.0
    """Probability that a message is lost."""
    double: float = 0.0
    """Probability that a message arrives twice."""
    delay: float = 0.0
    """Delay of each message [s]."""
    jitter: float = 0.0
    """Maximum additional delay, uniformly distributed [s]; messages may overtake one another."""
    seed: int = 0
    messages: int = 0
    """Number of messages that reached the fault."""
    lost: int = 0
    doubled: int = 0

    def __post_init__(self) -> None:
        for name in ("lose", "double"):
            if not 0 <= getattr(self, name) <= 1:
                raise FaultError(f"{name} is a probability from 0 to 1, not {getattr(self, name)!r}")
        for name in ("delay", "jitter"):
            span_ns(getattr(self, name), name)
        if not (self.lose or self.double or self.delay or self.jitter):
            raise FaultError(f"say what happens to the messages of {self.topic}: lose, double, delay or jitter")

    def __str__(self) -> str:
        parts = []
        if self.lose:
            parts.append(f"{self.lose:.0%} lost")
        if self.double:
            parts.append(f"{self.double:.0%} doubled")
        if self.delay or self.jitter:
            upper = f" to {self.delay + self.jitter:g} s" if self.jitter else " s"
            parts.append(f"{self.delay:g}{upper} late")
        return f"{self.topic} to {self.to or 'every subscriber'}: {', '.join(parts)} (seed {self.seed})"

    @property
    def done(self) -> str:
        """A summary of its effect so far, in words."""
        return f"{self.messages} messages, {self.lost} lost, {self.doubled} doubled"


class Gate(Observer):
    """The fault of a topic on one connection, before the subscriber's queue."""

    holds_back = True

    def __init__(self, fault: TopicFault, scheduler: Scheduler, node: str) -> None:
        self._fault = fault
        self._scheduler = scheduler
        self._node = node
        self._rng: np.random.Generator | None = None

    def pass_on(self, messages: Iterable[Any], peer: str, accept: Callable[[Iterable[Any]], None]) -> None:
        """Pass the messages from ``peer`` that are not lost to ``accept``, each after its delay, and some twice."""
        fault = self._fault
        if self._rng is None:
            self._rng = _rng(fault, self._node, peer)
        for message in messages:
            fault.messages += 1
            lost, doubled, *late = self._rng.random(4)  # the same count for each, whatever the fault does
            if lost < fault.lose:
                fault.lost += 1
                if self._scheduler.history is not None:
                    self._scheduler.history.lost(self._node, peer, fault.topic, message)
                continue
            self._send(message, float(late[0]), accept)
            if doubled < fault.double:
                fault.doubled += 1
                self._send(self._copy(message), float(late[1]), accept)

    def _send(self, message: Any, late: float, accept: Callable[[Iterable[Any]], None]) -> None:
        span = span_ns(self._fault.delay + self._fault.jitter * late, "a delay")
        if span:
            self._scheduler.call_at(self._scheduler.now_ns() + span, partial(accept, [message]))
        else:
            accept([message])

    def _copy(self, message: Any) -> Any:
        """Return a copy of a message that another callback may own."""
        if not message._plain_numpy:
            return message
        copy = message._thaw_numpy(message)
        if self._scheduler.history is not None:
            self._scheduler.history.same(copy, message)
        return copy


def _rng(fault: TopicFault, node: str, peer: str) -> np.random.Generator:
    import numpy as np

    own = [1] if fault.to else []  # independent of the topic's own fault, which may precede it
    return np.random.default_rng([fault.seed, zlib.crc32(f"{fault.topic} {peer} {node}".encode()), *own])


class Gates:
    """The faults of topics, for one subscriber or for all of them; their effects add up."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.faults: dict[tuple[str, str], TopicFault] = {}
        """By topic and subscriber; an empty subscriber means all of them."""

    def of(self, topic: str, node: str) -> list[Gate]:
        """Return the gates on a connection of a node: the one for all subscribers of the topic, then the node's own."""
        faults = [self.faults[key] for key in ((topic, ""), (topic, node)) if key in self.faults]
        return [Gate(fault, self._scheduler, node) for fault in faults]


CALLER_ID = "/fault"


class Faults:
    """The faults of a graph. Names are global; an unknown name raises ``FaultError``, which suggests a similar one."""

    def __init__(self, host: Graph) -> None:
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
        """Disturb the messages of a topic on their way to the node ``to``, or to all subscribers in this process.

        ``lose`` and ``double`` are probabilities, ``delay`` and ``jitter`` seconds; ``seed`` is the graph's by default.
        A topic has one fault for each ``to``: a later one replaces it. A node's fault adds to the one for all. Return
        the fault.
        """
        publishers, subscribers, _ = self._host.ask_as(CALLER_ID).ask("getSystemState")
        nodes_by_topic = dict(subscribers)
        self._check("topic", topic, {**nodes_by_topic, **dict(publishers)})
        if to:
            self._check(f"subscriber of {topic}", to, dict.fromkeys(nodes_by_topic.get(topic, ())))
        fault = TopicFault(topic, to, lose, double, delay, jitter, self._host.seed if seed is None else seed)
        self._topics[topic, to] = fault
        self._host.observers_changed()
        return fault

    def cut(self, service: str) -> None:
        """Cut a service off: new calls fail to connect, and calls that are being answered fail too."""
        services = self._host.ask_as(CALLER_ID).ask("getSystemState")[2]
        self._check("service", service, dict(services))
        self._host.transport.cut |= {service}
        for node in list(self._host.nodes.values()):
            if service in node.services:
                node.services[service].close_sessions("cut off on purpose")

    def kill(self, name: str) -> None:
        """Kill a node of this process like ``kill -9``: no hook runs, and the Master still lists it."""
        self._node(name).kill()

    def jump(self, seconds: float, name: str = "") -> None:
        """Make the clock of a node, or of all nodes of this process, jump by ``seconds``; simulators are not affected.

        Raises ``FaultError`` for a node that uses the topic ``/clock``.
        """
        if not isinstance(seconds, (int, float)) or not abs(seconds) < 1e9:
            raise FaultError(f"a clock jumps by a number of seconds, forwards or back, not {seconds!r}")
        nodes = [self._node(name)] if name else list(self._host.nodes.values())
        for node in nodes:
            if isinstance(node.clock, TopicClock):
                if name:
                    raise FaultError(f"{name} has no clock of its own: it follows /clock, as /use_sim_time says")
                continue
            self._set_jump(node, self._jumps.get(node.name, 0.0) + seconds)

    def _set_jump(self, node: Any, seconds: float) -> None:
        self._jumps[node.name] = seconds
        node.clock = WrongClock(self._host.scheduler, int(seconds * 1e9))

    def clear(self, name: str = "") -> int:
        """End the faults of a topic, service or node, or all faults; return their number. Killed nodes stay dead.

        Raises ``FaultError`` if there is no fault of this name.
        """
        topics = [key for key in self._topics if name in ("", *key)]
        services = {service for service in self._host.transport.cut if name in ("", service)}
        jumps = [node for node in self._jumps if name in ("", node)]
        if name and not (topics or services or jumps):
            known = [*(topic for topic, _ in self._topics), *self._host.transport.cut, *self._jumps]
            raise FaultError(f"{name} has no fault. {nearest(name, known) or '`list` shows all faults.'}")
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
        """Return a line for each active fault."""
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
