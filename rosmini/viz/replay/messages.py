"""A run from the messages of a bag or of a recorder. The type of the messages decides how they are shown."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from copy import copy
from functools import partial
from typing import Any, NamedTuple, Protocol

import numpy as np

from rosmini.core.errors import DeserializationError, RosminiError, nearest
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.ros.bag import Bag
from rosmini.viz.replay.collectors import COLLECTORS, TRANSFORMS, UPDATE, Collector, TrackCollector, moved_to
from rosmini.viz.replay.layers import Layer
from rosmini.viz.replay.recorded_frames import RecordedFrames
from rosmini.viz.replay.run import MAX_POSES, Body, Run
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural

MAX_MOMENTS = 240
"""Maximum number of moments of a layer: 2 Hz for two minutes."""
SAME = 1e-6
"""Tolerance of equal poses [m, rad]."""
NEAR = 0.3
"""Maximum error of the first estimate of amcl [m, rad]."""


class NothingToSee(ViewError):
    """No message contains anything that can be seen from above."""


class Entry(NamedTuple):
    """A message: its recording time [s], its topic, and a function that reads it on demand."""

    time: float
    topic: str
    read: Callable[[], Any]


class Log(Protocol):
    """Messages in order of time."""

    name: str
    topics: dict[str, str]
    """The type of the messages on each topic."""
    silent: Collection[str]
    """Topics without a message."""
    start: float
    end: float

    def entries(self, topics: Collection[str]) -> Iterator[Entry]:
        """Return the messages on these topics."""


class BagLog:
    """The messages of a bag. Raises `ViewError` if it has none."""

    def __init__(self, bag: Bag) -> None:
        index = bag.index
        self.name = (bag.filename or "the bag").replace("\\", "/").rpartition("/")[2]
        self.topics = {conn.topic: conn.type for conn in bag.connections()}
        self.silent: Collection[str] = ()
        if index.start is None or index.end is None:
            raise ViewError(f"{self.name} contains no messages, so there is nothing to play")
        self.start, self.end = index.start / 1e9, index.end / 1e9
        self._bag = bag

    def entries(self, topics: Collection[str]) -> Iterator[Entry]:
        """Return the messages on these topics."""
        if not topics:
            return
        for topic, (_, data, _, _, cls), time in self._bag.read_messages(sorted(topics), raw=True):
            yield Entry(time.to_nsec() / 1e9, topic, partial(cls._decode, data))


class MemoryLog:
    """Messages in memory: (time [s], topic, message). `topics` are all that were recorded."""

    def __init__(
        self, name: str, messages: Collection[tuple[float, str, Any]], start: float, end: float,
        topics: Collection[str] = (),
    ) -> None:  # fmt: skip
        self.name, self.start, self.end = name, start, end
        self.topics = {topic: message._type for _, topic, message in messages}
        self.silent: Collection[str] = [topic for topic in topics if topic not in self.topics]
        self._messages = messages

    def entries(self, topics: Collection[str]) -> Iterator[Entry]:
        """Return the messages on these topics."""
        for time, topic, message in self._messages:
            if topic in topics:
                yield Entry(time, topic, partial(_identity, message))


def _identity(message: Any) -> Any:
    return message


def run_of(
    log: Log, *, topics: Collection[str] | None = None, frame: str | None = None,
    outline: tuple[tuple[float, float], ...] | None = None, start_at: Pose | None = None,
) -> Run:  # fmt: skip
    """Return a run with everything in a log that can be shown.

    Args:
        log: the messages.
        topics: only these, with the updates of their grids, and transforms; None for everything that can be shown.
        frame: the fixed frame; None for the first of map, odom and world that exists.
        outline: outline of the robots, in their frames [m].
        start_at: the known pose of the robot at the start: a fixed frame in which it started elsewhere, such as that of
            SLAM, whose map begins at the robot, is moved to match.

    Raises:
        ViewError: a topic or a frame does not exist, or nothing can be shown (`NothingToSee`).

    """
    shown = _shown(log, topics)
    frames = _recorded_frames(log, frame, shown)
    times = np.linspace(log.start, log.end, 1 + min(MAX_POSES, int(30 * (log.end - log.start))))
    if start_at is not None:
        _align_map(frames, times, start_at)
    collectors = _collectors(log, shown, frames)
    _collect(log, collectors)
    bodies = _bodies(frames, times, outline)
    layers: list[Layer] = []
    notes = [f"{topic}: no message in this time." for topic in topics or () if topic in log.silent]
    for topic, collector in dict.fromkeys((c.topic, c) for c in collectors.values()):
        found = collector.result()
        if isinstance(found, Body):
            if isinstance(collector, TrackCollector) and collector.frame:
                notes.append(
                    f"{topic} is in the frame {collector.frame}, which no transform connects with {frames.fixed}: "
                    "it is laid on the robot's start."
                )
                start = bodies[0].poses[0].tolist() if bodies else (0.0, 0.0, 0.0)
                found = moved_to(found, (start[0], start[1], start[2]))
            bodies.append(found)
        elif found is not None:
            layers.append(found)
        notes += [
            f"{topic}: {plural(count, 'message')} left out: {reason}." for reason, count in collector.left_out.items()
        ]
    if not bodies and not layers:
        raise NothingToSee(_nothing_to_see(log, notes))
    layers.sort(key=lambda layer: (layer.depth, "local" in layer.name, layer.name))
    return Run(log.name, log.start, log.end, tuple(bodies), tuple(layers), frame=frames.fixed, notes=tuple(notes))


def _shown(log: Log, topics: Collection[str] | None) -> list[str]:
    """Return the topics that can be shown, without those of transforms."""
    for topic in topics or ():
        if topic not in log.topics and topic not in log.silent:
            known = [*log.topics, *log.silent]
            raise ViewError(f"{log.name} has no message on {topic!r}. {nearest(topic, known) or ''}".rstrip())
    return [
        topic
        for topic, kind in sorted(log.topics.items())
        if (kind in COLLECTORS or kind == UPDATE)
        and (topics is None or topic in topics or (kind == UPDATE and topic.removesuffix("_updates") in topics))
    ]


def _nothing_to_see(log: Log, notes: list[str]) -> str:
    there = ", ".join(f"{topic} [{kind}]" for topic, kind in sorted(log.topics.items())[:8]) or "no topics"
    said = f" {' '.join(notes)}" if notes else ""
    return (
        f"nothing in {log.name} can be shown from above: it has {there}. A player shows poses (tf, nav_msgs/Odometry), "
        f"maps, plans, particles, scans, markers and images.{said}"
    )


def _recorded_frames(log: Log, frame: str | None, shown: list[str]) -> RecordedFrames:
    frames = RecordedFrames()
    kinds = {topic: kind for topic, kind in log.topics.items() if kind in TRANSFORMS}
    for time, topic, read in log.entries(kinds):
        try:
            frames.take(read(), time, static=topic.endswith("tf_static"))
        except DeserializationError:
            continue
    others: dict[str, None] = {}
    first = dict.fromkeys(shown)
    for _, topic, read in log.entries(shown):
        if topic in first:
            first.pop(topic)
            try:
                header = getattr(read(), "header", None)
            except DeserializationError:
                continue
            if header is not None and (log.topics[topic] == "nav_msgs/OccupancyGrid" or not kinds):
                others[header.frame_id] = None
        if not first:
            break
    frames.choose_fixed_frame(frame, others)
    return frames


def _align_map(frames: RecordedFrames, times: Any, start: Pose) -> None:
    """Move a map that begins where the odometry begins, such as that of SLAM, to this place; leave others in place.

    Such a map is recognised by its first transform to odometry. It is the identity if SLAM draws the map, or if there
    is no map. On a map that SLAM has saved, amcl estimates it, and the pose in the map differs from the true one.
    """
    bases = frames.bases()
    if not bases or frames.fixed not in frames.tree:
        return
    known, poses = frames.track(bases[0], times)
    _, odom = frames.track("odom", known[:1])
    if not len(odom):
        return
    off = np.abs(odom).max()
    if off >= SAME:
        if off > NEAR or np.hypot(*(poses[0, :2] - start[:2])) < NEAR:
            return
        odometry = copy(frames)
        odometry.fixed = "odom"
        _, poses = odometry.track(bases[0], times)  # known earlier than the pose in the map
    x, y, heading = poses[0].tolist()
    frames.offset = compose(start, inverse((x, y, heading)))


def _collectors(log: Log, shown: list[str], frames: RecordedFrames) -> dict[str, Collector]:
    found: dict[str, Collector] = {}
    for topic in shown:
        if log.topics[topic] != UPDATE:
            found[topic] = COLLECTORS[log.topics[topic]](topic, frames, len(found))
    for topic in shown:
        base = found.get(topic.removesuffix("_updates"))
        if log.topics[topic] == UPDATE and base is not None:
            base.accumulates = True
            found[topic] = base
    return found


def _collect(log: Log, collectors: dict[str, Collector]) -> None:
    """Give each collector its messages: not more than can be seen, but always the last one."""
    due: dict[str, float] = {}
    skipped: dict[str, Entry] = {}
    for entry in log.entries(collectors):
        collector = collectors[entry.topic]
        collector.found += 1
        if collector.accumulates:
            _process(collector, entry)
            if entry.time >= due.get(collector.topic, -np.inf):
                collector.snapshot(entry.time)
                due[collector.topic] = entry.time + _period(log, collector)
        elif entry.time >= due.get(entry.topic, -np.inf):
            _process(collector, entry)
            skipped.pop(entry.topic, None)
            due[entry.topic] = entry.time + _period(log, collector)
        else:
            skipped[entry.topic] = entry
    for topic, entry in skipped.items():
        _process(collectors[topic], entry)
    for collector in collectors.values():
        if collector.accumulates:
            collector.snapshot(log.end)


def _period(log: Log, collector: Collector) -> float:
    most = MAX_POSES if isinstance(collector, TrackCollector) else MAX_MOMENTS
    # a message that arrives slightly early is still used
    return max(collector.period, (log.end - log.start) / most) * 0.9


def _process(collector: Collector, entry: Entry) -> None:
    try:
        collector.take(entry.time, entry.read())
    except DeserializationError as error:
        reason = f"not readable ({error})"
    except RosminiError as error:
        reason = str(error)
    else:
        return
    collector.left_out[reason] = collector.left_out.get(reason, 0) + 1


def _bodies(frames: RecordedFrames, times: Any, outline: tuple[tuple[float, float], ...] | None) -> list[Body]:
    found: list[Body] = []
    for frame in frames.bases():
        known, poses = frames.track(frame, times)
        if len(known):
            colour = "blue" if not found else ("green", "purple", "sky")[len(found) % 3]
            found.append(Body(frame, known, poses, colour=colour, outline=outline))
    return found
