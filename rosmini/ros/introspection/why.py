"""Why something happened: the chain of causes that a graph has recorded, told and drawn.

The scheduler runs one thing at a time, so it knows what each acts on: a callback on a message, a handler on a request.
A program's own loop acts on nothing that could be recorded; of it is told what its node had heard by then.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph.show import show

if TYPE_CHECKING:
    from rosmini.core.graph.history import Event, History

DEPTH = 12
"""How many causes are told if nobody says how many."""

HEARD = 3
"""How many topics are named that a node had heard when it acted by itself."""


class NothingRecorded(RosminiError):
    """The graph has recorded nothing of what was asked about."""


@dataclass(frozen=True)
class Step:
    """A link of the chain: what happened, and the line of whose program that was."""

    what: str
    time: float
    """The graph's time [s]."""
    where: str = ""


@dataclass(frozen=True)
class Why:
    """Why something happened: the steps from there back to the first cause that is known.

    ``heard`` are the last messages that the node of the last step had got, if it acted by itself. They may have had a
    part in it, and need not.
    """

    steps: tuple[Step, ...]
    end: str
    """Why the chain ends there."""
    heard: tuple[Step, ...] = ()

    @property
    def text(self) -> str:
        """The chain in words, one step below the other."""
        lines = []
        for index, step in enumerate(self.steps):
            lines.append(f"{'because ' if index else ''}{step.what}, at {step.time:.3f} s")
            lines += [f"    {step.where}"] if step.where else []
        lines.append(self.end)
        lines += [f"    {line}" for line in self.before]
        return "\n".join(lines)

    @property
    def before(self) -> list[str]:
        """What the node had heard, a line for each topic."""
        return [f"before that: {step.what}, at {step.time:.3f} s" for step in self.heard]

    def __str__(self) -> str:
        return self.text

    def show(self, **options: Any) -> Any:
        """Return a picture of the chain, the first cause above.

        Options, with their defaults:
            title=None: a caption under the picture
        """
        return show("why", self, **options)


def explain(history: History, name: str, count: int = 1, depth: int = DEPTH) -> list[Why]:
    """Return why the last messages on a topic were published, or a service called; of a node, what it did last.

    The last one comes last. ``depth`` is how many causes are told. Raises ``NothingRecorded``, with the nearest names.
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
            "(A simulated device makes no message that nobody listens to.)"
        )
    return [_why(history, event, depth) for event in events]


def _why(history: History, event: Event, depth: int) -> Why:
    steps = [_step(event)]
    while event.cause is not None:
        if len(steps) > depth:
            return Why(tuple(steps), "and so on; --depth tells more")
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
    """Return why nothing is known that came before an event."""
    if event.kind == "delivery":
        return f"and {event.who} published that before recording began, or it came over a wire"
    if not event.lane:
        return f"and {event.who} did that because its time had come"
    if event.lane == "main":
        return "and that was asked for here: by a cell, or the main program"
    own = event.lane.removeprefix(event.who).strip()
    if own.startswith("timer "):
        return f"and {event.who} did that because its {own} was due"
    return f"and {event.who} did that in a program of its own, which no message or call had woken"


def _heard(history: History, event: Event) -> tuple[Step, ...]:
    found = [heard for number in event.heard if (heard := history.event(number)) is not None]
    latest = sorted(found, key=lambda heard: heard.number)[-HEARD:]
    return tuple(_step(heard) for heard in latest)
