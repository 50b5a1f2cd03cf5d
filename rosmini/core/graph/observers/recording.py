"""A period in which the events of a graph are recorded: the calls and messages between nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import zip_longest
from types import TracebackType
from typing import Any, Self

from rosmini.core.graph.show import show

from .history import MASTER, Event, History

Call = tuple[str, str, str, str | None]
"""(caller, callee, text, response or None): the form that a sequence diagram needs."""

STANDARD_SERVICES = ("/get_loggers", "/set_logger_level")
"""Endings of the names of the services that every node offers."""

STANDARD_NAMES = ("/rosout", "/use_sim_time")
"""The topic and the parameter that every node uses."""


class Recording:
    """The events from now on, until :meth:`stop`; made by ``Graph.record``.

    >>> from rosmini import Graph
    >>> graph = Graph()
    >>> with graph.record() as registration:
    ...     talker = graph.node("talker")
    ...     talker.set_param("/rate", 10)
    >>> registration.calls("/rate")
    [('/talker', 'Master', 'setParam(/rate, 10)', '1')]
    """

    def __init__(self, history: History, end: Callable[[], None], *, from_start: bool = False) -> None:
        self.history = history
        self._start = 0 if from_start else history.next_number
        self._stop: int | None = None
        self._end = end

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def stop(self) -> None:
        """Stop recording. Safe to call again."""
        if self._stop is None:
            self._stop = self.history.next_number
            self._end()

    @property
    def events(self) -> list[Event]:
        """The events, oldest first; the last 20,000 are kept."""
        end = self.history.next_number if self._stop is None else self._stop
        return self.history.between(self._start, end)

    def calls(self, *names: str, everything: bool = False, since: float | None = None) -> list[Call]:
        """Return the calls and messages between nodes, in order: (sender, receiver, text, answer).

        ``names`` are nodes, topics, services and parameters: only events about one of these subjects and between these
        nodes (or with the only one) are returned. The calls that every node makes for its log messages are left out
        unless they are named, or ``everything`` is True. ``since`` is a time of the graph [s].
        """
        found = (event for event in self.events if since is None or event.time >= since)
        return list(_calls(found if everything else _about(found, names)))

    def names(self) -> list[str]:
        """Return the nodes, topics, services and parameters that occur in the recording, sorted."""
        return sorted({one for event in self.events for one in (event.who, event.whom, event.about)} - {""})

    def show(self, *names: str, **options: Any) -> Any:
        """Return a sequence diagram of :meth:`calls`.

        Options, with their defaults:
            everything=False: True to include the calls that every node makes for its log messages
            since=None: only events from this time of the graph on [s]
            limit=40: maximum number of calls that are drawn; the picture says how many more there were
            title=None: a caption under the picture, and the first words of its text form
        """
        return show("recorded_calls", self, names=names, **options)


def _about(events: Iterable[Event], names: tuple[str, ...]) -> list[Event]:
    found = list(events)
    actors = {one for event in found for one in (event.who, event.whom)}
    nodes = {name for name in names if name in actors}
    subjects = set(names) - nodes
    return [event for event in found if _is_wanted(event, nodes, subjects)]


def _is_wanted(event: Event, nodes: set[str], subjects: set[str]) -> bool:
    if subjects and event.about not in subjects:
        return False
    if not subjects and (event.about in STANDARD_NAMES or event.about.endswith(STANDARD_SERVICES)):
        return False
    ends = {event.who, event.whom} - {MASTER, ""}
    return not nodes or (ends <= nodes if len(nodes) > 1 else bool(ends & nodes))


def _calls(events: Iterable[Event]) -> Iterator[Call]:
    """Yield the calls that a sequence diagram draws; an immediate answer is merged with its request.

    Of what a node sends to itself only messages are drawn.
    """
    shown = [
        event for event in events
        if event.kind != "publication" and (event.who != event.whom or event.kind in ("delivery", "loss"))
    ]  # fmt: skip
    joined: set[int] = set()
    for event, following in zip_longest(shown, shown[1:]):
        if event.kind == "answer" and event.cause in joined:
            continue
        answer = event.answer if event.kind == "call" else None
        if event.kind == "request" and following is not None and _answers(following, event):
            joined.add(event.number)
            answer = following.arguments
        yield event.who, event.whom, _label(event), answer


def _answers(event: Event, request: Event) -> bool:
    return event.kind == "answer" and event.cause == request.number


def _label(event: Event) -> str:
    text = event.text
    match event.kind:
        case "call":
            return f"{event.what}({text})"
        case "connection":
            return f"connection header: {event.about}, {text}"
        case "request":
            return f"{event.about}({text})"
        case "answer":
            return f"answer of {event.about}: {text}" if text else f"answer of {event.about}"
        case _:
            fate = " (lost)" if event.kind == "loss" else ""
            return f"{event.about}: {text}{fate}" if text else f"{event.about}{fate}"
