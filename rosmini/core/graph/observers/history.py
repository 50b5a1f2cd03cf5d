"""A record of a graph: the calls and messages between nodes, with their times and causes.

A graph that records (:meth:`Graph.record <rosmini.core.graph.graph.Graph.record>`) has one history. The last
:data:`KEPT_EVENTS` events are kept; an event refers to its cause by number, so dropped events can be freed.
A graph that was not asked to record has no history and no overhead.
"""

from __future__ import annotations

import linecache
import os
import re
import sys
from ast import literal_eval
from collections import Counter, deque
from dataclasses import dataclass
from functools import lru_cache, partial
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from rosmini.core.errors import shown
from rosmini.core.graph.connection import Observer
from rosmini.core.graph.rosout import OWN, source_of
from rosmini.msgs.definition import INTEGER_RANGES
from rosmini.msgs.message import Message

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from types import CodeType, FrameType

    from rosmini.core.graph.connection import Connection
    from rosmini.core.graph.lanes import Lane
    from rosmini.core.graph.scheduler import Scheduler

Kind = Literal["call", "connection", "publication", "delivery", "loss", "request", "answer"]

KEPT_EVENTS = 20_000
"""Maximum number of events that are kept."""

KEPT_PUBLICATIONS = 50
"""Number of publications of each topic, and of requests of each service, that are kept, however old they are."""

MAX_FIELDS = 6
"""Maximum number of numbers and texts in a small message."""

MAX_TEXT_LENGTH = 32
"""Maximum number of characters of a text that are shown."""

SCALARS = frozenset(["bool", "float32", "float64", "string", *INTEGER_RANGES])

Values = tuple[tuple[str, ...], tuple[Any, ...]]
"""The names of the fields (``linear.x``) and their values."""

MASTER = "Master"
"""The name of the Master, which is not a node."""

UNRECORDED = frozenset(["/rosout_agg", "/clock"])
"""Topics whose messages are not recorded: they repeat other information, and are many."""

STANDARD_LIBRARY = str(Path(os.__file__).parent) + os.sep
_MAGIC = re.compile(r"get_ipython\(\)\.run_line_magic\(('\w+', (?:'[^'\\\\]*'|\"[^\"\\\\]*\"))\)")

OTHERS = ("site-packages", "dist-packages")

_set_cause: Callable[[Message, int], None] = Message.__dict__["_cause"].__set__


def _cause_of(message: Any) -> int | None:
    found: int | None = getattr(message, "_cause", None)
    return found


class Place(NamedTuple):
    """A line of a user's program."""

    file: str
    line: int
    function: str
    text: str = ""

    def __str__(self) -> str:
        where = f"{self.file}, line {self.line}"
        return where if self.function == "<module>" else f"{where}, in {self.function}"


@dataclass(slots=True, eq=False)
class Event:
    """An event in the graph.

    A ``call`` is one of the Master's API or of a node's slave API; a ``connection`` to a topic is made by a subscriber;
    a ``publication`` leads to a ``delivery`` for each subscriber, or to a ``loss`` if a fault loses the message; an
    ``answer`` has its ``request`` as cause.
    """

    number: int
    kind: Kind
    time_ns: int
    """The graph's time [ns]."""
    who: str
    """The node that acts, or ``"Master"``."""
    whom: str
    """The node that is acted on; empty for a publication."""
    about: str
    """The topic, service or parameter."""
    what: str = ""
    """The method of a call."""
    arguments: str = ""
    """The arguments of a call, abbreviated."""
    answer: str | None = None
    """The response to a call or a request, abbreviated; the reason if a request failed; None if none has arrived."""
    count: int = 0
    """Number of publications on the topic, or requests of the service, since recording began, including this one."""
    message: Values | None = None
    place: Place | None = None
    """The line that published or called; for a delivery, the callback."""
    lane: str = ""
    """Name of the lane that ran; empty if the scheduler itself acted."""
    cause: int | None = None
    """Number of the event that caused this one."""
    heard: tuple[int, ...] = ()
    """Numbers of the latest deliveries to the publishing node, one for each topic."""

    @property
    def time(self) -> float:
        """The graph's time [s]."""
        return self.time_ns / 1e9

    @property
    def text(self) -> str:
        """The arguments, or the message, abbreviated."""
        return self.arguments or brief(self.message)


class History:
    """Records the events of a graph. The parts of the graph call its methods, in the scheduler's thread."""

    def __init__(self, scheduler: Scheduler, nodes: Mapping[str, Any]) -> None:
        self._scheduler = scheduler
        self._nodes = nodes
        self._next = 0
        self._events: deque[Event] = deque(maxlen=KEPT_EVENTS)
        self._last: dict[str, deque[Event]] = {}
        self._counts: Counter[str] = Counter()
        self._heard: dict[str, dict[str, int]] = {}
        self._names: dict[str, str] = {}
        self._lines: dict[tuple[CodeType, int], Place] = {}
        self._callbacks: dict[CodeType, Place] = {}

    # -- queries -------------------------------------------------------------------------------------------------

    @property
    def next_number(self) -> int:
        """The number of the next event."""
        return self._next

    def between(self, start: int, end: int) -> list[Event]:
        """Return the kept events with numbers from ``start`` up to, but excluding, ``end``."""
        return [event for event in self._events if start <= event.number < end]

    def event(self, number: int | None) -> Event | None:
        """Return the event with a number, or None if there is no such event or it was dropped."""
        if number is None or not self._events:
            return None
        index = number - self._events[0].number
        return self._events[index] if 0 <= index < len(self._events) else None

    def last(self, about: str, count: int = 1) -> list[Event]:
        """Return the last publications on a topic, or requests of a service, oldest first."""
        return list(self._last.get(about, ()))[-count:]

    def last_of(self, node: str) -> Event | None:
        """Return a node's last publication (log messages included) or request."""
        return next(
            (
                event
                for event in reversed(self._events)
                if event.who == node and event.kind in ("publication", "request")
            ),
            None,
        )

    def subjects(self) -> list[str]:
        """Return the topics and services for which :meth:`last` has events, sorted."""
        return sorted(self._last)

    # -- recording -----------------------------------------------------------------------------------------------

    def _note(self, kind: Kind, who: str, whom: str, about: str, **more: Any) -> Event:
        event = Event(self._next, kind, self._scheduler.now_ns(), who, whom, about, **more)
        self._next += 1
        self._events.append(event)
        return event

    def _acting(self) -> tuple[Lane | None, int | None]:
        """Return the lane that acts (None if the scheduler itself does), and the event on which it acts."""
        scheduler = self._scheduler
        lane = scheduler.current()
        if lane.waiter is not None or (lane.idle and lane is not scheduler.root):
            return None, None  # the queue is running; this lane only ran before
        woken = lane.woken
        if woken is not None and woken[0] == scheduler.now_ns():
            return lane, woken[1]
        return lane, lane.cause

    def cause(self) -> int | None:
        """Return the number of the event on which the running code acts."""
        return self._acting()[1]

    def called(self, who: str, uri: str, method: str, arguments: tuple[Any, ...], answer: Any) -> None:
        """Record a call of the Master's API (no ``uri``), or of the slave API at ``uri``, and its response."""
        if not self._scheduler.is_scheduler_thread():
            self._scheduler.call_soon_threadsafe(
                partial(self.called, who, uri, method, arguments, answer)
            )  # the event on which the caller acts is unknown then
            return
        lane, cause = self._acting()
        about, *rest = [*arguments, ""]
        self._note(
            "call",
            MASTER if who == "/master" else who,
            self.name_at(uri) if uri else MASTER,
            about if isinstance(about, str) else "",
            what=method,
            arguments=", ".join(filter(None, (self._shown(each) for each in (about, *rest)))),
            answer=self._answered(method, answer),
            lane="" if lane is None else lane.name,
            cause=cause,
        )

    def _answered(self, method: str, answer: Any) -> str:
        code, status, value = answer
        if code != 1:
            return f"{code}: {status}"
        if method == "requestTopic":
            return str(value[0])
        if method.startswith(("register", "getParam", "lookup", "hasParam", "search", "unregister", "subscribe")):
            return self.name_at(value) if isinstance(value, str) else self._shown(value)
        return "1"

    def _shown(self, value: Any) -> str:
        """Return an argument, abbreviated: lists of addresses become names, a single address is left out."""
        if isinstance(value, list):
            names = [self.name_at(each) for each in value if isinstance(each, str)]
            return f"[{', '.join(names)}]" if len(names) == len(value) else ""
        if isinstance(value, str):
            return "" if value.startswith(("http://", "rosrpc://")) else value
        return "" if isinstance(value, dict) else str(value)

    def name_at(self, uri: str) -> str:
        """Return the name of the node whose slave API or services are at ``uri``, or ``uri`` if it is unknown."""
        place = uri.replace("rosrpc://", "http://").rstrip("/")
        if place not in self._names:
            self._names.update({node.uri.rstrip("/"): node.name for node in self._nodes.values()})
        return self._names.get(place, uri)

    def connected(self, subscriber: str, publisher: str, topic: str, message_type: str) -> None:
        """Record that a subscriber has connected to a publisher."""
        _, cause = self._acting()
        self._note("connection", subscriber, publisher, topic, arguments=message_type, cause=cause)

    def published(self, node: str, topic: str, frozen: Any) -> None:
        """Record a publication; the message carries its number from now on."""
        if topic in UNRECORDED:
            return
        lane, cause = self._acting()
        heard = self._heard.get(node)
        event = self._note(
            "publication",
            node,
            "",
            topic,
            count=self._count(topic),
            message=values(frozen),
            place=None if lane is None else self._caller(),
            lane="" if lane is None else lane.name,
            cause=cause,
            heard=() if heard is None else tuple(heard.values()),
        )
        self._keep(event)
        _set_cause(frozen, event.number)

    def _count(self, about: str) -> int:
        self._counts[about] += 1
        return self._counts[about]

    def _keep(self, event: Event) -> None:
        kept = self._last.get(event.about)
        if kept is None:
            kept = self._last[event.about] = deque(maxlen=KEPT_PUBLICATIONS)
        kept.append(event)

    @staticmethod
    def same(copy: Any, frozen: Any) -> None:
        """Give a copy of a message the number of the original's event."""
        cause = _cause_of(frozen)
        if cause is not None:
            _set_cause(copy, cause)

    def observer(self, connection: Connection) -> Observer:
        """Return an observer that records the messages of a connection."""
        return _Deliveries(self, connection)

    def delivered(self, node: str, peer: str, topic: str, frozen: Any, callback: Any) -> None:
        """Record that a message reaches a callback; the calling lane acts on it from now on."""
        event = self._arrived("delivery", node, peer, topic, frozen, place=self._place_of(callback))
        self._heard.setdefault(node, {})[topic] = event.number
        self.act_on(event.number)

    def lost(self, node: str, peer: str, topic: str, frozen: Any) -> None:
        """Record that a message is lost on its way to a node."""
        self._arrived("loss", node, peer, topic, frozen)

    def _arrived(self, kind: Kind, node: str, peer: str, topic: str, frozen: Any, **more: Any) -> Event:
        cause = _cause_of(frozen)
        source = self.event(cause)
        if source is None:
            return self._note(kind, peer, node, topic, message=values(frozen), cause=cause, **more)
        return self._note(kind, peer, node, topic, count=source.count, message=source.message, cause=cause, **more)

    def requested(self, node: str, peer: str, service: str, request: Any) -> Event:
        """Record a request, which carries its number from now on."""
        lane, cause = self._acting()
        event = self._note(
            "request",
            node,
            peer,
            service,
            count=self._count(service),
            message=values(request),
            place=self._caller(),
            lane="" if lane is None else lane.name,
            cause=cause,
        )
        self._keep(event)
        _set_cause(request, event.number)
        return event

    def answered(self, request: Event, response: Any, problem: str | None) -> None:
        """Record the response to a request, or the text ``problem`` if the request failed."""
        answer = problem if problem is not None else brief(values(response))
        request.answer = answer
        self._note("answer", request.whom, request.who, request.about, arguments=answer, cause=request.number)

    def serve(self, request: Any) -> None:
        """Record that the caller's lane acts on a request from now on."""
        self.act_on(_cause_of(request))

    def act_on(self, number: int | None) -> None:
        """Set the number of the event on which the caller's lane acts from now on; None for no event."""
        self._scheduler.current().cause = number

    # -- source lines --------------------------------------------------------------------------------------------

    def _caller(self) -> Place | None:
        frame: FrameType | None = sys._getframe(2)  # noqa: SLF001 - the documented way to find a caller
        while frame is not None:
            code, line = frame.f_code, frame.f_lineno
            place = self._lines.get((code, line))
            if place is not None:
                return place
            filename = code.co_filename
            if not filename.startswith((OWN, STANDARD_LIBRARY, "<frozen")) and not _is_others(filename):
                text = _as_written(linecache.getline(filename, line).strip())
                place = self._lines[code, line] = Place(_file(code), line, code.co_name, text)
                return place
            frame = frame.f_back
        return None

    def _place_of(self, callback: Any) -> Place | None:
        code: CodeType | None = getattr(getattr(callback, "__func__", callback), "__code__", None)
        if code is None or code.co_filename.startswith(OWN):
            return None
        place = self._callbacks.get(code)
        if place is None:
            place = self._callbacks[code] = Place(_file(code), code.co_firstlineno, code.co_name)
        return place


class _Deliveries(Observer):
    """Records each delivery on one connection as the cause of the events that its callbacks cause."""

    def __init__(self, history: History, connection: Connection) -> None:
        self._history = history
        self._connection = connection

    def before(self, frozen: Any) -> None:
        connection = self._connection
        callback = connection.first_callback
        if callback is not None:
            subscription = connection.subscription
            self._history.delivered(subscription.node.name, connection.peer, subscription.topic, frozen, callback)

    def after(self) -> None:
        self._history.act_on(None)


def _file(code: CodeType) -> str:
    return Path(source_of(code.co_filename)).name


def _as_written(text: str) -> str:
    """Return a line of a program as its author wrote it: IPython turns `%rostopic ...` into a call."""
    magic = _MAGIC.fullmatch(text)
    return text if magic is None else " ".join(literal_eval(f"({magic[1]})")).join(("%", ""))


def _is_others(filename: str) -> bool:
    return any(folder in filename for folder in OTHERS)


def values(message: Any) -> Values | None:
    """Return the values of a small message without its header; None for any other message."""
    cls: Any = type(message)
    names, take = _reader(cls)
    return None if take is None else (names, take(message))


def brief(kept: Values | None) -> str:
    """Return the stored values of a message as one line; fields that are 0 or empty are left out."""
    if kept is None:
        return ""
    names, found = kept
    if not names:
        return ""
    if len(names) == 1:
        return _short(found[0])
    some = [f"{name}: {_short(value)}" for name, value in zip(names, found, strict=True) if value]
    return ", ".join(some) or "all 0"


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else shown(value, MAX_TEXT_LENGTH)


@lru_cache(maxsize=1_000)
def _reader(cls: Any) -> tuple[tuple[str, ...], Callable[[Any], tuple[Any, ...]] | None]:
    try:
        names = tuple(_fields(cls))
    except _NotSmall:
        return (), None
    if len(names) > MAX_FIELDS:
        return (), None
    if not names:
        return (), lambda _: ()
    take = attrgetter(*names)
    return names, take if len(names) > 1 else lambda message: (take(message),)


class _NotSmall(Exception):
    """The message contains an array, or another field that cannot be shown in one line."""


def _fields(cls: Any) -> Iterator[str]:
    for field in cls._spec.fields:
        if field.size is not None or field.base != field.type:
            raise _NotSmall
        if field.type in SCALARS:
            yield field.name
        elif field.type in cls._nested:
            if field.type != "std_msgs/Header":
                for inner in _fields(cls._nested[field.type]):
                    yield f"{field.name}.{inner}"
        else:
            raise _NotSmall
