"""Explains why something happened: the recorded chain of causes, as text and as a picture.

The scheduler runs one task at a time, so it knows its cause: a callback has a message, a handler a request.
The loop of a program has no recorded cause; for it the messages that its node had received by then are listed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph.show import show

if TYPE_CHECKING:
    from rosmini.core.graph.observers.history import Event, History

DEPTH = 12
"""Default number of causes shown."""

HEARD = 3
"""Number of topics listed that a node had received when it acted without a cause."""


class NothingRecorded(RosminiError):
    """The graph has no record of the requested name."""


@dataclass(frozen=True)
class Step:
    """A link of the chain: what happened, and the line of the program responsible."""

    what: str
    time: float
    """Graph time [s]."""
    where: str = ""


@dataclass(frozen=True)
class Why:
    """Why something happened: the steps back to the first known cause.

    ``heard`` are the last messages received by the node of the last step, if it acted without a cause. They may or may
    not have influenced it.
    """

    steps: tuple[Step, ...]
    end: str
    """Why the chain ends there."""
    heard: tuple[Step, ...] = ()

    @property
    def text(self) -> str:
        """Return the chain as text, one step below the other."""
        lines = []
        for index, step in enumerate(self.steps):
            lines.append(f"{'because ' if index else ''}{step.what}, at {step.time:.3f} s")
            lines += [f"    {step.where}"] if step.where else []
        lines.append(self.end)
        lines += [f"    {line}" for line in self.before]
        return "\n".join(lines)

    @property
    def before(self) -> list[str]:
        """Return the messages that the node had received, one line per topic."""
        return [f"before that: {step.what}, at {step.time:.3f} s" for step in self.heard]

    def __str__(self) -> str:
        return self.text

    def show(self, **options: Any) -> Any:
        """Return a picture of the chain, the first cause at the top.

        Options, with their defaults:
            title=None: a caption under the picture
        """
        return show("why", self, **options)


def explain(history: History, name: str, count: int = 1, depth: int = DEPTH) -> list[Why]:
    """Return why the last messages on a topic were published, a service was called, or a node last acted.

    The latest one comes last. ``depth`` is the maximum number of causes. Raises ``NothingRecorded`` with similar names.
    """
    events = history.last(name, count)
    if not events:
        did = history.last_of(name)
        events = [] if did is None else [did]
    if not events:
        known = history.subjects()
        hint = nearest(name, known) or f"what was published is on {', '.join(known) or 'no topic yet'}"
        raise NothingRecorded(
            f"nothing was published on {name}, and no such service was called, since recording began: {hint}. "
            "(A simulated device makes no messages while its topic has no subscriber.)"
        )
    return [_why(history, event, depth) for event in events]


def _why(history: History, event: Event, depth: int) -> Why:
    steps = [_step(event)]
    while event.cause is not None:
        if len(steps) > depth:
            return Why(tuple(steps), "and so on; --depth shows more")
        found = history.event(event.cause)
        if found is None:
            return Why(tuple(steps), "what led to that is no longer kept")
        steps.append(_step(found))
        event = found
    return Why(tuple(steps), _end(event), _heard(history, event))


def _step(event: Event) -> Step:
    content = f": {event.text}" if event.text else ""
    match event.kind:
        case "publication":
            what = f"{event.who} published message {event.count} on {event.about}{content}"
        case "request":
            what = f"{event.who} called {event.about} of {event.whom}{content}"
        case "delivery":
            which = f"message {event.count}" if event.count else "a message"
            what = f"{event.whom} got {which} on {event.about} from {event.who}"
        case _:
            what = f"{event.who} called {event.what}({event.text}) of {event.whom}"
    return Step(what, event.time, _where(event))


def _where(event: Event) -> str:
    if event.place is None:
        return ""
    if event.kind == "delivery":
        return f"in its callback {event.place.function} ({event.place.file}, line {event.place.line})"
    return f"{event.place}: {event.place.text}" if event.place.text else str(event.place)


def _end(event: Event) -> str:
    """Return why no cause of an event is known."""
    if event.kind == "delivery":
        return f"and {event.who} published that before recording began, or it came over a wire"
    if not event.lane:
        return f"and {event.who} did that at its scheduled time"
    if event.lane == "main":
        return "and a cell or the main program asked for that"
    own = event.lane.removeprefix(event.who).strip()
    if own.startswith("timer "):
        return f"and {event.who} did that because its {own} was due"
    return f"and {event.who} did that in its own loop, and not because of a message or a call"


def _heard(history: History, event: Event) -> tuple[Step, ...]:
    found = [heard for number in event.heard if (heard := history.event(number)) is not None]
    latest = sorted(found, key=lambda heard: heard.number)[-HEARD:]
    return tuple(_step(heard) for heard in latest)
