"""``rosbag record`` as a node: subscribes to topics and writes the messages with their connections.

No message is lost at any rate, in simulated or wall-clock time: a message passed to a callback is written before the
graph continues.
"""

from __future__ import annotations

import re
import time
from collections import deque
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError

from .bag import Bag
from .errors import BagFull, ROSBagException
from .index import Connection, connection
from .records import Compression, check_compression
from .writer import CHUNK_THRESHOLD

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node, Subscriber
    from rosmini.core.time import Time

MEGABYTE = 1024 * 1024
SYNC_NS = 10**9
"""Period after which recorded data is flushed to the file, at the next message [ns]."""


class AnyMessage:
    """The message type of a subscriber that accepts any type."""

    _type = "*"
    _md5sum = "*"
    _full_text = ""


@dataclass(frozen=True)
class RecordOptions:
    """Options for recording, named after ROS's; sizes are in bytes and times in seconds.

    Raises ``ROSBagException`` for invalid options.
    """

    topics: tuple[str, ...] = ()
    all: bool = False
    regex: bool = False
    exclude: str | None = None
    output_name: str | None = None
    output_prefix: str | None = None
    split: bool = False
    size: int | None = None
    duration: float | None = None
    buffsize: int = 256 * MEGABYTE
    chunksize: int = CHUNK_THRESHOLD
    limit: int | None = None
    compression: str = Compression.NONE
    repeat_latched: bool = False
    quiet: bool = False
    patterns: tuple[re.Pattern[str], ...] = field(init=False)
    excluded: re.Pattern[str] | None = field(init=False)

    def __post_init__(self) -> None:
        check_compression(self.compression)
        if not (self.topics or self.all):
            raise ROSBagException("say what to record: topics, or all=True (-a)")
        if self.exclude is not None and not (self.all or self.regex):
            raise ROSBagException("exclude takes away from all=True (-a) or from regex=True (-e)")
        if self.split and not (self.size or self.duration):
            raise ROSBagException("split needs a size or a duration after which the next file begins")
        if self.output_name is not None and self.output_prefix is not None:
            raise ROSBagException("give a name (-O) or a prefix (-o), not both")
        for name in ("size", "duration", "limit"):
            value = getattr(self, name)
            if value is not None and not value > 0:
                raise ROSBagException(f"{name} must be more than zero, not {value}")
        patterns = tuple(_pattern(topic) for topic in self.topics) if self.regex else ()
        object.__setattr__(self, "patterns", patterns)
        object.__setattr__(self, "excluded", None if self.exclude is None else _pattern(self.exclude))

    @property
    def follows(self) -> bool:
        """True if topics advertised later may have to be recorded too."""
        return self.all or self.regex

    def wants(self, topic: str) -> bool:
        """Return True if a topic is to be recorded."""
        if self.excluded is not None and self.excluded.fullmatch(topic):
            return False
        return self.all or any(pattern.fullmatch(topic) for pattern in self.patterns)


def _pattern(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise ROSBagException(f"{text!r} is not a regular expression: {error}") from error


def _base_name(options: RecordOptions, now: Time, *, simulated: bool) -> str:
    """Return a recording's path without number and ``.bag``: its name (-O), or its prefix (-o) and the date.

    The date is local, as in ROS, but in UTC in simulated time, where nothing may depend on the machine.
    """
    if options.output_name is not None:
        return options.output_name.removesuffix(".bag")
    clock = time.gmtime(now.secs) if simulated else time.localtime(now.secs)
    date = time.strftime("%Y-%m-%d-%H-%M-%S", clock)
    return f"{options.output_prefix.removesuffix('.bag')}_{date}" if options.output_prefix else date


class BagFiles:
    """Opens the bags of a recording one after another; a file is named ``.active`` until it is closed, as in ROS.

    Args:
        base: the path without number and ``.bag``; files are numbered, from 0, if the recording is split.
        options: the options for recording.

    """

    def __init__(self, base: str, options: RecordOptions) -> None:
        self._base = base
        self._options = options
        self._number = 0
        self.bag: Bag | None = None
        self.paths: list[Path] = []
        """The finished files."""
        self.path = Path()
        """Final path of the open file."""

    def open(self) -> Bag:
        """Open the next file. Raises ``OSError`` if that is not possible."""
        number = f"_{self._number}" if self._options.split else ""
        self._number += 1
        self.path = Path(f"{self._base}{number}.bag")
        self.bag = Bag(self._active, "w", self._options.compression, self._options.chunksize)
        return self.bag

    @property
    def _active(self) -> Path:
        return self.path.with_name(self.path.name + ".active")

    def close(self) -> None:
        """Close the open file, if any, and give it its final name. Raises ``BagFull`` as ``Bag.close`` does."""
        bag, self.bag = self.bag, None
        if bag is None:
            return
        try:
            bag.close()
        finally:
            self._active.replace(self.path)
            self.paths.append(self.path)


class Recorder:
    """Records topics into a bag, starting now, until :meth:`stop`, the node's end, or the limit in the options.

    Args:
        node: the node that subscribes. It is shut down when the recording ends, as in ROS.
        options: the options for recording.
        fields: the same options as keyword arguments: see `RecordOptions`.

    Raises:
        ROSBagException: the options are invalid.
        OSError: the file cannot be opened.

    """

    def __init__(self, node: Node, options: RecordOptions | None = None, **fields: Any) -> None:
        self.node = node
        self.options = options or RecordOptions(**fields)
        self.error: BagFull | OSError | None = None
        """The error that ended the recording early."""
        self.dropped = 0
        """Number of messages dropped because the buffer was full."""
        self.counts: dict[str, int] = {}
        """Number of recorded messages for each topic."""
        self._subscribers: dict[str, Subscriber] = {}
        self._numbers: dict[int, int] = {}
        self._connections: dict[int, tuple[Connection, dict[str, str]]] = {}
        self._latched: dict[int, bytes] = {}
        self._queue: deque[tuple[int, int, bytes]] = deque()
        self._queued = 0
        self._draining = False
        self._synced = 0
        self._sync_due = False
        self._files: BagFiles | None = None
        self._cancel: Callable[[], None] = _nothing
        self._ended = False
        node.on_shutdown(self._finish)
        node.scheduler.run_in_scheduler(self._begin)

    def __repr__(self) -> str:
        state = "ended" if self._ended else "recording"
        count = f"{sum(self.counts.values()):,} messages of {len(self.counts)} topics"
        return f"<Recorder {self.node.name}: {state}, {count}>"

    @property
    def done(self) -> bool:
        """True if the recording has ended."""
        return self._ended

    @property
    def exit_status(self) -> int:
        """Exit status of the node: 1 if the recording ended early."""
        return int(self.error is not None)

    @property
    def paths(self) -> list[Path]:
        """Paths of the finished bags."""
        return [] if self._files is None else list(self._files.paths)

    @property
    def path(self) -> Path:
        """Path of the open bag, or of the last one."""
        if self._files is None:
            raise RosminiError("nothing is recorded before the first /clock message, since /use_sim_time is true")
        return self._files.path

    # -- the beginning ---------------------------------------------------------------------------------------------

    def _begin(self) -> None:
        from rosmini.core.graph.clock import TopicClock  # here: what only reads bags needs no graph

        clock = self.node.clock
        if isinstance(clock, TopicClock) and clock.now_ns() == 0:
            clock.call_at(1, self._begin)  # messages would have no time yet
            return
        if self._ended:
            return
        options, now = self.options, self.node.now()
        self._files = BagFiles(_base_name(options, now, simulated=self.node.graph.simulated), options)
        if not options.regex:
            for topic in options.topics:
                self._subscribe(self.node.resolve(topic))
        try:
            self._open(now.to_nsec())
        except OSError:
            self._finish()
            raise
        self._drain()
        if options.follows:
            self._follow()
            self.node.run(self._keep_following, f"{self.node.name} new topics")

    def _open(self, now_ns: int) -> None:
        assert self._files is not None  # noqa: S101 - made before the first file
        self._files.open()
        self._numbers.clear()
        self._synced = now_ns
        self._say(f"Recording to '{self._files.path}'.")
        if self.options.duration is not None:
            end = now_ns + int(self.options.duration * 1e9)
            self._cancel = self.node.clock.call_at(end, self._time_is_up)
        if self.options.repeat_latched:
            for key, data in self._latched.items():
                self._write(key, now_ns, data)

    def _say(self, text: str) -> None:
        if not self.options.quiet:
            self.node.loginfo(text)

    # -- which topics ----------------------------------------------------------------------------------------------

    def _wanted(self) -> list[str]:
        state = self.node.master.ask("getSystemState")
        published = {topic for topic, names in state[0] if names != [self.node.name]}
        return sorted(topic for topic in published if topic not in self._subscribers and self.options.wants(topic))

    def _keep_following(self) -> None:
        """Subscribe to new topics at once, before their publisher can send a message."""
        while not self._ended:
            self.node.wait_for_master(
                lambda: self._ended or bool(self._wanted()), None, "new topics to record", lambda: ""
            )
            self._follow()

    def _follow(self) -> None:
        if not self._ended:
            for topic in self._wanted():
                self._subscribe(topic)

    def _subscribe(self, topic: str) -> None:
        if topic in self._subscribers:
            return
        self._say(f"Subscribing to {topic}")
        self._subscribers[topic] = self.node.subscriber(
            topic, AnyMessage, self._take, arguments=(topic,), receipt=lambda _: None
        )

    # -- what arrives ----------------------------------------------------------------------------------------------

    def _take(self, message: Any, topic: str) -> None:
        if self._ended or self._files is None:
            return
        count = self.counts.get(topic, 0)
        limit = self.options.limit
        if limit is not None and count >= limit:
            return
        self.counts[topic] = count + 1
        header = message._connection_header
        key = id(header)
        if key not in self._connections:
            self._connections[key] = (connection(0, topic, header), header)  # kept alive, so that its id is not reused
        data = type(message)._encode(message)
        if self.options.repeat_latched and header.get("latching") == "1":
            self._latched[key] = data
        self._queue.append((key, self.node.clock.now_ns(), data))
        self._queued += len(data)
        if self.options.buffsize and self._queued > self.options.buffsize:
            self._drop()
        if not self._draining:
            self._draining = True
            self.node.scheduler.call_soon(self._drain)

    def _drop(self) -> None:
        if not self.dropped:
            self.node.logwarn(
                "rosbag record buffer exceeded. Dropping oldest queued message. Give it more with buffsize (-b), or 0."
            )
        while self._queued > self.options.buffsize and self._queue:
            _, _, data = self._queue.popleft()
            self._queued -= len(data)
            self.dropped += 1

    def _drain(self) -> None:
        """Write the queued messages once the file is open; the Master may take time for each topic before that."""
        self._draining = False
        if self._files is None or self._files.bag is None:
            return
        try:
            while self._queue:
                key, time, data = self._queue.popleft()
                self._queued -= len(data)
                self._write(key, time, data)
                self._check_size(time)
            self._keep_safe()
        except (BagFull, OSError) as error:
            self._fail(error)
            return
        limit, topics = self.options.limit, self.options.topics
        if limit is not None and not self.options.follows and topics:
            names = [self.node.resolve(topic) for topic in topics]
            if all(self.counts.get(name, 0) >= limit for name in names):
                self.stop()

    def _write(self, key: int, time: int, data: bytes) -> None:
        bag = None if self._files is None else self._files.bag
        if bag is None:
            return
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = bag.connect(self._connections[key][0])
        bag.write_raw(number, time, data)

    def _keep_safe(self) -> None:
        """Flush the file within a second of wall-clock time; in simulated time at the next message after a second."""
        scheduler, bag = self.node.scheduler, None if self._files is None else self._files.bag
        now = scheduler.now_ns()
        if bag is None or self._sync_due:
            return
        if not self.node.graph.simulated:
            self._sync_due = True
            scheduler.call_at(now + SYNC_NS, self._sync)
        elif now - self._synced >= SYNC_NS:
            self._synced = now
            bag.sync()

    def _sync(self) -> None:
        self._sync_due = False
        if self._files is not None and self._files.bag is not None:
            try:
                self._files.bag.sync()
            except (BagFull, OSError) as error:
                self._fail(error)

    # -- when it is enough -----------------------------------------------------------------------------------------

    def _check_size(self, time: int) -> None:
        files, size = self._files, self.options.size
        if size is None or files is None or files.bag is None or files.bag.size <= size:
            return
        self._next_file(time)

    def _time_is_up(self) -> None:
        try:
            self._drain()
            if not self._ended:
                self._next_file(self.node.clock.now_ns())
        except (BagFull, OSError) as error:
            self._fail(error)

    def _next_file(self, time: int) -> None:
        if not self.options.split:
            self.stop()
            return
        assert self._files is not None  # noqa: S101 - there is a file that is full
        self._cancel()
        self._files.close()
        self._open(time)

    def _fail(self, error: BagFull | OSError) -> None:
        self.error = error
        self._queue.clear()
        self._finish()
        self.node.graph.report(error, self.node)
        self.node.shutdown(f"the recording ended: {error}")

    def stop(self) -> list[Path]:
        """Stop the recording and its node; return the bags.

        Raises ``BagFull`` or ``OSError`` if the last bag could not be written completely.
        """
        error = self.error
        self.node.shutdown("the recording ended")
        if self.error is not None and error is None:
            raise self.error
        return self.paths

    def _finish(self) -> None:
        """Write the queued messages and close the bag."""
        if self._ended:
            return
        if self._queue:
            self._drain_rest()
        self._ended = True
        self._cancel()
        if self._files is not None:
            try:
                self._files.close()
            except (BagFull, OSError) as error:
                self._record_error(error)
        for subscriber in self._subscribers.values():
            subscriber.unregister()

    def _drain_rest(self) -> None:
        try:
            while self._queue:
                self._write(*self._queue.popleft())
        except (BagFull, OSError) as error:
            self._record_error(error)
            self._queue.clear()

    def _record_error(self, error: BagFull | OSError) -> None:
        """Store and log why the end of the recording is missing, unless an error was logged already."""
        if self.error is None:
            self.error = error
            self.node.logerr(error)


def _nothing() -> None:
    """Cancel nothing."""
