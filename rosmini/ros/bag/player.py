"""``rosbag play`` as a node: publishes the messages of bags with the intervals at which they were recorded.

It uses the graph's time, simulated or wall-clock, even if nodes use ``/clock``, which it can publish
(``clock=True``).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from heapq import merge
from typing import Any

from rosmini.core.graph import MessageFactory, Node, Publisher
from rosmini.core.time import Time

from .bag import Bag
from .errors import ROSBagException
from .reader import RawMessage

PLAYED_LATCHED = frozenset({"/tf_static"})
"""Topics that are latched whatever the bag says, being useless otherwise (http://wiki.ros.org/tf2#tf_static)."""


@dataclass(frozen=True)
class PlayOptions:
    """Options for playing, named after ROS's; times are in seconds.

    Raises ``ROSBagException`` for invalid options.
    """

    rate: float = 1.0
    start: float = 0.0
    duration: float | None = None
    loop: bool = False
    pause: bool = False
    immediate: bool = False
    clock: bool = False
    hz: float = 100.0
    delay: float = 0.2
    queue: int = 100
    keep_alive: bool = False
    topics: tuple[str, ...] = ()
    prefix: str = ""
    wait_for_subscribers: bool = False
    quiet: bool = False

    def __post_init__(self) -> None:
        for name in ("rate", "hz"):
            if not getattr(self, name) > 0:
                raise ROSBagException(f"{name} must be more than zero, not {getattr(self, name)}")
        for name in ("start", "duration", "delay", "queue"):
            value = getattr(self, name)
            if value is not None and not value >= 0:
                raise ROSBagException(f"{name} cannot be less than zero: {value}")


class Player:
    """Plays bags, starting now.

    Args:
        node: the node that publishes; it is shut down at the end, as in ROS, unless ``keep_alive``.
        bags: paths, or open bags, which are played as one.
        options: the options for playing.
        fields: the same options as keyword arguments: see `PlayOptions`.

    Raises:
        ROSBagException: a bag cannot be read, a topic is in none of them, or there is nothing to play.

    """

    def __init__(
        self,
        node: Node,
        bags: Sequence[str | os.PathLike[str] | Bag] | str | os.PathLike[str] | Bag,
        options: PlayOptions | None = None,
        **fields: Any,
    ) -> None:
        self.node = node
        self.options = options or PlayOptions(**fields)
        self.played = 0
        """Number of messages published."""
        self.done = False
        self.paused = self.options.pause
        self._scheduler = node.scheduler
        several = [bags] if isinstance(bags, str | os.PathLike | Bag) else list(bags)
        self._own: list[Bag] = []
        self._bags: list[Bag] = []
        self._messages: Iterator[tuple[RawMessage, Bag]] = iter(())
        self._next: tuple[RawMessage, Bag] | None = None
        self._cancel: Callable[[], None] = _nothing
        self._cancel_clock: Callable[[], None] = _nothing
        self._publishers: dict[str, Publisher] = {}
        self._latched: dict[str, dict[tuple[int, int], Any]] = {}
        node.on_shutdown(self._finish)
        try:
            for bag in several:
                self._say(f"Opening {bag.filename if isinstance(bag, Bag) else bag}")
                self._bags.append(bag if isinstance(bag, Bag) else self._opened(bag))
            self.start, self.end = self._span()
        except BaseException:
            self._close()
            raise
        self._origin = self.start
        """Time in the bags that corresponds to the graph's time ``_began`` [ns]."""
        self._began = 0
        node.scheduler.run_in_scheduler(self._begin)

    def __repr__(self) -> str:
        state = "done" if self.done else "paused" if self.paused else "playing"
        return f"<Player {self.node.name}: {state}, {self.played:,} messages published>"

    def _opened(self, path: str | os.PathLike[str]) -> Bag:
        bag = Bag(path)
        self._own.append(bag)
        return bag

    def _span(self) -> tuple[int, int]:
        """Return the first and last time to play [ns]."""
        starts = [bag.index.start for bag in self._bags if bag.index.start is not None]
        ends = [bag.index.end for bag in self._bags if bag.index.end is not None]
        if not starts:
            raise ROSBagException(f"there is no message in {', '.join(str(bag.filename) for bag in self._bags)}")
        topics = {conn.topic for bag in self._bags for conn in bag.connections()}
        for topic in self.options.topics:
            if self.node.resolve(topic) not in topics and topic not in topics:
                raise self._bags[0].no_topic(topic)
        start = min(starts) + int(self.options.start * 1e9)
        end = max(ends)
        if start > end:
            length = (end - min(starts)) / 1e9
            raise ROSBagException(f"cannot start {self.options.start:g} s into bags of {length:.1f} s")
        if self.options.duration is not None:
            end = min(end, start + int(self.options.duration * 1e9))
        return start, end

    def _say(self, text: str) -> None:
        if not self.options.quiet:
            self.node.loginfo(text)

    # -- the beginning ---------------------------------------------------------------------------------------------

    def _chosen(self, bag: Bag) -> set[int]:
        names = {name for topic in self.options.topics for name in (topic, self.node.resolve(topic))}
        return {conn.id for conn in bag.connections() if not names or conn.topic in names}

    def _stream(self) -> Iterator[tuple[RawMessage, Bag]]:
        streams = [
            ((message, bag) for message in bag.reader().messages(self._chosen(bag), self.start, self.end))
            for bag in self._bags
        ]
        return merge(*streams, key=lambda pair: pair[0].time)

    def _begin(self) -> None:
        for bag in self._bags:
            for number in sorted(self._chosen(bag)):
                self._advertise(bag, number)
        if self.options.clock:
            self._publishers["/clock"] = self.node.publisher("/clock", self.node.graph.clock_class, queue_size=None)
        self._rewind(self._scheduler.now_ns() + int(self.options.delay * 1e9))
        if self.options.wait_for_subscribers and not self.paused:
            self.paused = True
            self.node.run(self._wait_for_subscribers, f"{self.node.name} waits for subscribers")

    def target(self, topic: str) -> str:
        """Return the name under which a topic of the bags is published: prefixed and remapped."""
        return self.node.resolve(self.options.prefix.rstrip("/") + topic if self.options.prefix else topic)

    def _advertise(self, bag: Bag, number: int) -> None:
        conn = bag.index.connections[number]
        topic = self.target(conn.topic)
        latch = conn.latching or conn.topic in PLAYED_LATCHED
        greets = latch and topic not in self._latched
        if greets:
            self._latched[topic] = {}
        self._publishers[topic] = self.node.publisher(
            topic,
            bag.message_class(conn),
            queue_size=self.options.queue or None,
            latch=latch,
            on_connect=(lambda peer: self._greet(topic, peer)) if greets else None,
        )
        self._publishers[topic].expect_nobody()

    def _greet(self, topic: str, peer: str) -> None:
        """Send a late subscriber the latched message of each connection; the graph has already sent it the newest."""
        for message in list(self._latched[topic].values())[:-1]:
            self._publishers[topic].publish_to(peer, _as_recorded(message))

    def _wait_for_subscribers(self) -> None:
        for topic, publisher in self._publishers.items():
            if topic != "/clock":
                publisher.wait_for_subscribers()
        self.resume()

    def _rewind(self, begin_ns: int) -> None:
        self._messages = self._stream()
        self._next = next(self._messages, None)
        self._origin, self._began = self.start, begin_ns
        if not self.paused:
            self._go_on()

    # -- time ------------------------------------------------------------------------------------------------------

    def _now(self) -> int:
        """Return the current time in the bags [ns]."""
        if self.paused:
            return self._origin
        passed = max(0, self._scheduler.now_ns() - self._began)
        return min(self.end, self._origin + int(passed * self.options.rate))

    @property
    def position(self) -> Time:
        """Current position in the bags, as a time of recording."""
        return Time.from_nsec(self._now())

    def _due(self, time: int) -> int:
        """Return the graph's time at which a message recorded at this time is due."""
        if self.options.immediate:
            return self._began
        return self._began + int((time - self._origin) / self.options.rate)

    def _go_on(self) -> None:
        when = self._due(self.end if self._next is None else self._next[0].time)
        self._cancel = self._scheduler.call_at(when, self._fire).cancel
        if self.options.clock:
            first = max(self._began, self._scheduler.now_ns())
            self._cancel_clock = self._scheduler.call_at(first, self._tick).cancel

    def _fire(self) -> None:
        """Publish the message that is due, each in a separate event, so that it is sent before the next."""
        if self.done or self.paused:
            return
        if self._next is None:
            self._at_end()
            return
        self._publish_next()
        when = self._due(self.end if self._next is None else self._next[0].time)
        if when <= self._scheduler.now_ns():
            self._cancel = _nothing
            self._scheduler.call_soon(self._fire)
        else:
            self._cancel = self._scheduler.call_at(when, self._fire).cancel

    def _publish_next(self) -> int:
        """Publish the next message, and return its time."""
        assert self._next is not None  # noqa: S101 - asked before
        stored, bag = self._next
        conn, time = stored.connection, stored.time
        self._next = next(self._messages, None)
        topic = self.target(conn.topic)
        message = bag.decode(stored)
        if topic in self._latched:
            kept = self._latched[topic]
            key = id(bag), conn.id
            kept.pop(key, None)
            kept[key] = message  # the newest comes last
        self._publishers[topic].publish(_as_recorded(message))
        self.played += 1
        return time

    def _tick(self) -> None:
        if self.done or self.paused:
            return
        self._publishers["/clock"].publish(clock=self.position)
        period = int(1e9 / self.options.hz)
        self._cancel_clock = self._scheduler.call_at(self._scheduler.now_ns() + period, self._tick).cancel

    # -- what one can do meanwhile ---------------------------------------------------------------------------------

    def _hold(self, time: int) -> None:
        self.paused = True
        self._origin = time
        self._cancel()
        self._cancel_clock()

    def pause(self) -> None:
        """Pause playing; has no effect if already paused."""
        if not self.paused and not self.done:
            self._hold(self._now())

    def resume(self) -> None:
        """Resume playing; has no effect if not paused."""
        if self.paused and not self.done:
            self.paused = False
            self._began = max(self._scheduler.now_ns(), self._began)
            self._go_on()

    def step(self) -> bool:
        """Publish the next message of a paused player and move to its time; False if no message is left.

        Raises ``ROSBagException`` if the player is not paused.
        """
        if not self.paused:
            raise ROSBagException("only a player that is paused can step: call pause() first")
        if self._next is None or self.done:
            return False
        self._scheduler.run_in_scheduler(self._step)
        return True

    def _step(self) -> None:
        if self.options.clock and self._next is not None:
            self._publishers["/clock"].publish(clock=Time.from_nsec(self._next[0].time))
        self._origin = self._publish_next()

    # -- the end ---------------------------------------------------------------------------------------------------

    def _at_end(self) -> None:
        self._cancel_clock()
        if self.options.clock:
            self._publishers["/clock"].publish(clock=Time.from_nsec(self.end))
        if self.options.loop:
            # latched messages restart as well; a loop without a length would never let time pass
            self._rewind(self._scheduler.now_ns() + int(max(self.options.delay, 1e-3) * 1e9))
            return
        self.done = True
        if not self.options.keep_alive:
            self.node.shutdown("everything was played")

    def stop(self) -> None:
        """Stop playing and end the node; may be called repeatedly."""
        self.node.shutdown("playing was stopped")

    def _finish(self) -> None:
        self.done = True
        self._cancel()
        self._cancel_clock()
        self._close()

    def _close(self) -> None:
        for bag in self._own:
            bag.close()


def _nothing() -> None:
    """Cancel nothing."""


def _as_recorded(message: Any) -> MessageFactory:
    """Return a message that is published with the sequence number that its header has in the bag."""
    return MessageFactory(lambda: message, keeps_number=True)
