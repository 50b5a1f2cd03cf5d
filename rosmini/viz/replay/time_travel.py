"""Time travel: a run as it was, and as it would have been with a change at one instant.

A world could be saved at that instant (`Simulation.save`), but its nodes could not: a script is somewhere in the
middle of its code, with messages on their way to it. So the run is repeated from its start, with the change at that
instant. In simulated time this is valid, and each call verifies it: all messages of both runs up to the instant are
compared byte by byte.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from io import BytesIO
from itertools import zip_longest
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosmini.core.dynamic_reconfigure.client import Client
from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.core.graph.show import GROUP, find_extension
from rosmini.ros.bag import Bag, RecordOptions
from rosmini.ros.bag import Recorder as BagRecorder
from rosmini.ros.launch import roslaunch
from rosmini.sim.recorder import Recorder
from rosmini.sim.recording import Recording, RecordingError
from rosmini.viz.replay.player import ReplayView, replay
from rosmini.viz.rounding import fixed
from rosmini.viz.view import View

NAME = "time_travel"
Setup = Callable[[Graph], Any] | Sequence[str | os.PathLike[str]]
Change = Mapping[str, Any] | Callable[[Graph], object]


class TimeTravelError(RosminiError):
    """A run cannot be changed at the requested instant, or a repetition of it differs."""


@dataclass(frozen=True)
class CapturedMessage:
    """A message: its time [ns of the graph's time], topic, type and bytes."""

    time: int
    topic: str
    type: str
    data: bytes


@dataclass(frozen=True)
class CapturedRun:
    """A run: all its messages, as a bag and in order, and the recording of its robot, if a simulation ran."""

    bag: bytes
    messages: tuple[CapturedMessage, ...]
    start: int
    """The time of the start [ns]."""
    until_change: int
    """Number of messages before the instant of the change."""
    recording: Recording | None

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write all messages to a bag, and return its path."""
        target = Path(path)
        target.write_bytes(self.bag)
        return target


@dataclass(frozen=True)
class Fork:
    """A run without and with the change, which was made `at` seconds after its start."""

    at: float
    what: str
    """The change, in words."""
    before: CapturedRun
    after: CapturedRun

    @property
    def differs_after(self) -> float | None:
        """Time of the first message that differs [s after the start]; None if the change had no effect."""
        for one, other in zip_longest(self.before.messages, self.after.messages):
            if one != other and not (_is_log(one) or _is_log(other)):
                return min((each.time - self.before.start) / 1e9 for each in (one, other) if each is not None)
        return None

    def __str__(self) -> str:
        differs = self.differs_after
        effect = "which changed nothing" if differs is None else f"and differs from {fixed(differs, 2)} s on"
        same = f"{self.before.until_change} messages are the same to the byte up to {fixed(self.at, 2)} s"
        return f"{same}; then {self.what}, {effect}"

    def replay(self, *, title: str | None = None, topics: Sequence[str] | None = None) -> ReplayView:
        """Return a player of both runs, side by side with one clock.

        `title` is a caption; `topics` limits the topics shown beside the robot. Raises ``ViewError`` if nothing can be
        shown.
        """
        return replay(*self._runs(), title=title, names=self._names, topics=topics)

    def replay3d(self, **options: Any) -> View:
        """Return both runs in three dimensions; the options are those of `replay_3d`."""
        view: View = find_extension(GROUP, "replay_3d")(*self._runs(), names=self._names, **options)
        return view

    @property
    def _names(self) -> tuple[str, str]:
        return ("as it was", f"from {fixed(self.at, 1)} s: {self.what}")

    def _runs(self) -> list[Any]:
        runs: list[Any] = [self.before.recording, self.after.recording]
        if None in runs:
            runs = [Bag(BytesIO(made.bag)) for made in (self.before, self.after)]
        return runs


def what_if(setup: Setup, change: Change, *, at: float, seconds: float, seed: int = 0) -> Fork:
    """Run something twice, in simulated time: unchanged, and with a change at one instant.

    Args:
        setup: starts everything in a new graph: the arguments of `roslaunch`, such as `("my_pkg", "drive.launch")`, or
            a function of the graph. The simulator that the function returns is recorded; otherwise the one that runs.
        change: parameters and their new values (`{"/driver/speed": 0.1}`), of which nodes with dynamic_reconfigure are
            notified; or a function of the graph, for any other change.
        at: the instant of the change [s after the start].
        seconds: the duration of both runs [s].
        seed: the seed of the graph's random numbers.

    Raises:
        TimeTravelError: the instant is not within the run; or the two runs differ before it, because something in them
            depends on more than simulated time.

    """
    if not 0 <= at <= seconds:
        raise TimeTravelError(f"the change must be within the run of {seconds} s, not at {at} s")
    before = _capture(setup, None, at, seconds, seed)
    after = _capture(setup, change, at, seconds, seed)
    _check(before, after)
    return Fork(at, _description(change), before, after)


def _capture(setup: Setup, change: Change | None, at: float, seconds: float, seed: int) -> CapturedRun:
    with TemporaryDirectory(prefix="rosmini-") as folder, Graph(seed=seed) as graph:
        options = RecordOptions(all=True, quiet=True, output_name=str(Path(folder) / "run.bag"))
        start = graph.now().to_nsec()
        log = BagRecorder(graph.node(NAME), options)
        simulator = setup(graph) if callable(setup) else roslaunch(*setup, graph=graph)
        graph.run(0.0)  # launched nodes exist only after this
        robot = None
        with suppress(RecordingError):
            found: Any = simulator if hasattr(simulator, "world") else None
            robot = Recorder(graph, found, name=f"{NAME}_robot", layers=True)
        graph.run(at)
        until_change = sum(log.counts.values())
        if change is not None:
            _apply(graph, change)
        graph.run(seconds - at)
        recording = None
        if robot is not None:
            with suppress(RecordingError):
                recording = robot.recording()
        [path] = log.stop()
        data = path.read_bytes()
    with Bag(BytesIO(data)) as bag:
        messages = tuple(
            CapturedMessage(time, conn.topic, conn.type, content) for conn, time, content, _, _ in bag.read_raw()
        )
    return CapturedRun(data, messages, start, until_change, recording)


def _apply(graph: Graph, change: Change) -> None:
    if callable(change):
        change(graph)
        return
    node = graph.node(f"{NAME}_change")
    servers: dict[str, dict[str, Any]] = {}
    for name, value in change.items():
        owner, _, last = name.rpartition("/")
        if owner and node.master.find("lookupService", f"{owner}/set_parameters") is not None:
            servers.setdefault(owner, {})[last] = value
        else:
            node.set_param(name, value)
    for owner, values in servers.items():
        Client(node, owner).update_configuration(values)


def _description(change: Change) -> str:
    if callable(change):
        return getattr(change, "__name__", "the change").replace("_", " ").replace("<lambda>", "the change")
    return ", ".join(f"{name} = {value}" for name, value in change.items())


def _is_log(message: CapturedMessage | None) -> bool:
    """Return True if a message is a log message, which may come from the node that makes the change."""
    return message is not None and message.topic in ("/rosout", "/rosout_agg")


def _check(before: CapturedRun, after: CapturedRun) -> None:
    """Raise `TimeTravelError` unless both runs have the same messages up to the change."""
    pairs = zip_longest(before.messages[: before.until_change], after.messages[: after.until_change])
    for number, (one, other) in enumerate(pairs):
        if one != other:
            shown = one or other
            assert shown is not None  # noqa: S101 - one of the two exists
            raise TimeTravelError(
                f"the run differs when it is repeated: message {number + 1}, on {shown.topic} at "
                f"{shown.time / 1e9:.3f} s, differs before the change. Something in it depends on more than simulated "
                "time and seeds: wall time, unseeded random numbers, a file, another process"
            )
