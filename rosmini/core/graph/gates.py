"""What happens on purpose to messages on their way to a subscriber: they are lost, late or doubled."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError

from .connection import Observer
from .event_queue import span_ns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import numpy as np

    from .scheduler import Scheduler


class FaultError(RosminiError):
    """A fault cannot be made as it was asked for."""


@dataclass
class TopicFault:
    """What happens to the messages of a topic on their way to one subscriber, or to all in this process."""

    topic: str
    to: str = ""
    """The subscribing node; empty: every one."""
    lose: float = 0.0
    """With which probability a message is lost."""
    double: float = 0.0
    """With which probability it arrives twice."""
    delay: float = 0.0
    """How late it arrives [s]."""
    jitter: float = 0.0
    """Up to how much later still, evenly spread [s]: messages may overtake one another."""
    seed: int = 0
    messages: int = 0
    """How many messages came this way."""
    lost: int = 0
    doubled: int = 0

    def __post_init__(self) -> None:
        for name in ("lose", "double"):
            if not 0 <= getattr(self, name) <= 1:
                raise FaultError(f"{name} is a probability from 0 to 1, not {getattr(self, name)!r}")
        for name in ("delay", "jitter"):
            span_ns(getattr(self, name), name)
        if not (self.lose or self.double or self.delay or self.jitter):
            raise FaultError(
                f"say what happens to the messages of {self.topic}: lose, double, delay or jitter"
            )

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
        """What it has done so far, in words."""
        return f"{self.messages} messages, {self.lost} lost, {self.doubled} doubled"


class Gate(Observer):
    """A fault of a topic as it acts on one connection, before the subscriber's queue."""

    holds_back = True

    def __init__(self, fault: TopicFault, scheduler: Scheduler, node: str) -> None:
        self._fault = fault
        self._scheduler = scheduler
        self._node = node
        self._rng: np.random.Generator | None = None

    def pass_on(self, messages: Iterable[Any], peer: str, accept: Callable[[Iterable[Any]], None]) -> None:
        """Let ``accept`` have what is not lost of the messages from ``peer``, when it is its time."""
        fault = self._fault
        if self._rng is None:
            self._rng = _rng(fault, self._node, peer)
        for message in messages:
            fault.messages += 1
            lost, doubled, *late = self._rng.random(4)  # as many for each, whatever the fault does
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
        """Return a message of which another callback may become the owner."""
        if not message._plain_numpy:
            return message
        copy = message._thaw_numpy(message)
        if self._scheduler.history is not None:
            self._scheduler.history.same(copy, message)
        return copy


def _rng(fault: TopicFault, node: str, peer: str) -> np.random.Generator:
    import numpy as np

    own = [1] if fault.to else []  # not by the chance of the topic's own fault, which may come before it
    return np.random.default_rng([fault.seed, zlib.crc32(f"{fault.topic} {peer} {node}".encode()), *own])


class Gates:
    """The faults of topics: for one subscriber, and for every one of them; they add up."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.faults: dict[tuple[str, str], TopicFault] = {}
        """By topic and subscriber; the subscriber is empty where it is every one."""

    def of(self, topic: str, node: str) -> list[Gate]:
        """Return the gates on a connection of a node: that for every subscriber of the topic, then its own."""
        faults = [self.faults[key] for key in ((topic, ""), (topic, node)) if key in self.faults]
        return [Gate(fault, self._scheduler, node) for fault in faults]
