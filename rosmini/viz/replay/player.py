"""Recorded runs to play: a player in a page, with a still picture of the run for pages without scripts."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import Any

from rosmini.ros.bag import Bag
from rosmini.ros.bag.mcap import from_mcap
from rosmini.sim.models import RobotModel, model
from rosmini.sim.recording import Recording
from rosmini.viz.embed import MovingView
from rosmini.viz.recording_pictures import RunScene, recording_picture
from rosmini.viz.replay.encode import replay_data
from rosmini.viz.replay.layers import Shapes
from rosmini.viz.replay.messages import BagLog, MemoryLog, NothingToSee, run_of
from rosmini.viz.replay.run import BUDGET, Body, Run, thinned
from rosmini.viz.replay.still import still_of
from rosmini.viz.rounding import fixed
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError

SCRIPTS = ("rosmini-canvas.js", "rosmini-replay-data.js", "rosmini-replay.js")
LAYER_SCRIPT = "rosmini-replay-layers.js"
HEIGHT = 320
"""Minimum height of a player [CSS px]: the world at the width of a phone, and the controls."""

Source = Recording | Run | Bag | str | os.PathLike[str]


class PlayerRun:
    """One run of a player: its data, its still picture and its description."""

    def __init__(self, source: Recording | Run, layers: Run | None = None, *, name: str | None = None) -> None:
        self.source = source
        self.layers = layers
        self.name = name or self._default_name()

    def _default_name(self) -> str:
        source = self.source
        return source.name if isinstance(source, Run) else f"{source.model.name} in {source.world.name}"

    def data(self, budget: int) -> dict[str, Any]:
        """Return the data for the script, in about this number of bytes."""
        source = self.source
        if isinstance(source, Run):
            return source.data(budget)
        data = replay_data(source)
        if self.layers is not None:
            used = len(str(data))
            layers, notes = thinned(self.layers.layers, max(20_000, budget - used))
            data |= {"layers": layers, "bodies": [body.data() for body in self.layers.bodies]}
            notes = [*self.layers.notes, *notes]
            if notes:
                data["notes"] = notes
        return data

    def text(self, title: str) -> str:
        """The run in numbers."""
        source = self.source
        if isinstance(source, Run):
            return source.text(title)
        text = RunScene(source, scan=len(source.scans) > 0).text(title)
        more = self.layers.text().splitlines()[1:] if self.layers is not None else []
        return "\n".join([text, *more])

    @property
    def alt(self) -> str:
        """The run in two sentences."""
        run = self.source
        if isinstance(run, Run):
            return run.alt()
        return (
            f"Player of a run of {run.model.name} in the world {run.world.name}, {fixed(run.duration, 1)} seconds "
            f"long. The robot drives {fixed(run.distance, 2)} m; at the end its odometry is off by "
            f"{fixed(float(run.drift().position[-1]), 2)} m.{other_robots_sentence(run)}{layers_sentence(self.layers)}"
        )

    def still(self, title: str) -> Picture:
        """Return the run in one picture."""
        source = self.source
        if isinstance(source, Run):
            return still_of(source, title=title, alt=self.alt)
        return recording_picture(source, scan=len(source.scans) > 0, title=title)

    @property
    def needs_layers(self) -> bool:
        """True if the page needs the script of the layers."""
        return isinstance(self.source, Run) or self.layers is not None


class ReplayView(MovingView):
    """A player of runs. Its text form reports how the runs went; its image is the first run's picture."""

    call = "rosminiReplay.mount"
    height = HEIGHT

    def __init__(self, runs: Sequence[PlayerRun], *, title: str | None = None, opens_at_end: bool = False) -> None:
        self.runs = tuple(runs)
        self.title = title
        self.opens_at_end = opens_at_end
        layered = any(run.needs_layers for run in self.runs)
        self.scripts = (*SCRIPTS, LAYER_SCRIPT) if layered else SCRIPTS

    @cached_property
    def text(self) -> str:
        """The runs in numbers, with the same text as their pictures."""
        if len(self.runs) == 1:
            return self.runs[0].text(self.name)
        return "\n".join([self.name, *(run.text(run.name) for run in self.runs)])

    @cached_property
    def alt(self) -> str:
        """The runs in a few sentences."""
        both = "" if len(self.runs) == 1 else f"{len(self.runs)} runs side by side, by one clock. "
        return both + " ".join(run.alt for run in self.runs)

    @cached_property
    def still(self) -> Picture:
        """An SVG of the first run.

        Raises:
            ViewError: matplotlib, which draws it, is not installed.

        """
        return self.runs[0].still(self.name)

    @cached_property
    def fallback(self) -> str:
        """Pictures of the runs, side by side."""
        if len(self.runs) == 1:
            return self.svg
        drawn = [element("div", run.still(run.name).svg or "", style="flex:1 1 18rem;min-width:0") for run in self.runs]
        return element("div", "".join(drawn), style="display:flex;flex-wrap:wrap;gap:8px")

    @property
    def svg(self) -> str:
        """The first run in one picture."""
        return self.still.svg or ""

    @cached_property
    def data(self) -> dict[str, Any]:
        """The data for the script; layers are thinned until the page is small enough."""
        more = {"opens": "end"} if self.opens_at_end else {}
        if len(self.runs) == 1:
            return self.runs[0].data(BUDGET) | more
        each = BUDGET // len(self.runs)
        return {"runs": [{**run.data(each), "title": run.name} for run in self.runs]} | more

    @property
    def name(self) -> str:
        """The title, or a short description."""
        if self.title or len(self.runs) > 1:
            return self.title or f"Replay of {len(self.runs)} runs"
        return f"Replay of {self.runs[0].name}"


def other_robots_sentence(run: Recording) -> str:
    """Return a sentence about the other robots of a run; empty if there are none."""
    others = ", ".join(each.name for each in run.others[:6])
    more = f" and {len(run.others) - 6} more" if len(run.others) > 6 else ""
    return f" Beside it drive {others}{more}." if others else ""


def layers_sentence(run: Run | None) -> str:
    """Return a sentence about the layers of a run; empty if there are none."""
    names = [] if run is None else [layer.name for layer in run.layers]
    return f" Layers that can be switched: {', '.join(names)}." if names else ""


def replay(
    *sources: Source,
    title: str | None = None,
    names: Sequence[str] | None = None,
    topics: Collection[str] | None = None,
    frame: str | None = None,
    robot: str | RobotModel | None = None,
    opens_at_end: bool = False,
) -> ReplayView:
    """Return a player for a recorded run, or for several side by side with one clock.

    It has play, pause, a slider, speeds from a quarter to eight times, zoom, a view that follows the robot, a switch
    for each layer, and keys for all of these.

    Args:
        sources: runs: recordings of robots, bags, paths of bags and MCAP files, runs made from layers.
        title: a caption, and the first words of the text form.
        names: names of the runs, shown above each if there are several.
        topics: show only these topics of a bag or of a recorder; None for all that can be shown.
        frame: the frame in which messages are drawn; None for the first of map, odom and world that exists.
        robot: how the robots of a bag look from above: a model or its name; None for an arrowhead.
        opens_at_end: show the end at first, not the start.

    Raises:
        ViewError: a source cannot be played, or contains nothing to show.
        ROSBagException: a bag cannot be read.

    """
    if not sources or (names is not None and len(names) != len(sources)):
        raise ViewError(f"replay needs at least one run, and as many names as runs, not {len(sources)} and {names}")
    given: Sequence[str | None] = names or [None] * len(sources)
    known = model(robot) if isinstance(robot, str) else robot
    options: dict[str, Any] = {"topics": topics, "frame": frame}
    return ReplayView(
        [_shown(source, name, known, options) for source, name in zip(sources, given, strict=True)],
        title=title,
        opens_at_end=opens_at_end,
    )


def _shown(source: Source, name: str | None, robot: RobotModel | None, options: dict[str, Any]) -> PlayerRun:
    if isinstance(source, Recording):
        return PlayerRun(source, recorder_run(source, **options), name=name)
    return PlayerRun(run_from(source, robot=robot, **options), name=name)


def run_from(source: Run | Bag | str | os.PathLike[str], *, robot: RobotModel | None = None, **options: Any) -> Run:
    """Return the run in a bag or in an MCAP file; a `Run` is returned as it is. `options` are those of `run_of`.

    Raises:
        ViewError: the source cannot be played, or contains nothing to show.
        ROSBagException: a bag cannot be read.

    """
    if isinstance(source, Run):
        return source
    if isinstance(source, Bag):
        outline = None if robot is None else tuple((float(x), float(y)) for x, y in robot.footprint)
        return run_of(BagLog(source), outline=outline, **options)
    suffix = Path(source).suffix if isinstance(source, str | os.PathLike) else ""
    if suffix == ".bag":
        with Bag(source) as bag:
            return run_from(bag, robot=robot, **options)
    if suffix == ".mcap":
        with BytesIO() as file:
            from_mcap(source, file)
            run = run_from(Bag(file), robot=robot, **options)
            return replace(run, name=Path(source).name)
    what = repr(source) if isinstance(source, str) else f"a {type(source).__name__}"
    raise ViewError(
        f"replay shows a Recording, a bag, an MCAP file or a Run, not {what}: record a run with rosmini.sim.Recorder, "
        "and give what its recording() returns, or give the path of a .bag or .mcap"
    )


def recorder_run(recording: Recording, **options: Any) -> Run | None:
    """Return the messages of a recorder as a run that starts at the robot's true pose; None if they show nothing.

    Raises:
        ViewError: one of the `topics` asked for was not recorded, or there are only topics that show nothing.

    """
    messages = recording.messages
    if not messages:
        return None
    start, end = float(recording.times[0]), float(recording.times[-1])
    x, y, heading = recording.truth[0].tolist()
    try:
        log = MemoryLog("the run", messages, start, end, recording.topics)
        run = run_of(log, start_at=(x, y, heading), **options)
    except NothingToSee:
        return None
    believed: tuple[Body, ...] = ()
    if run.frame.rpartition("/")[2] != "odom":
        colour = _colour_beside(run)
        believed = tuple(
            replace(b, name=f"{b.name} in {run.frame}", colour=colour if b.colour == "blue" else b.colour)
            for b in run.bodies
        )
    if run.layers or believed:
        return replace(run, bodies=believed)
    if options.get("topics") and run.notes:
        raise NothingToSee(" ".join(run.notes))
    return None


def _colour_beside(run: Run) -> str:
    """Return a colour for the estimated path: not the blue of the true one, and none of a plan."""
    shapes = [shape for layer in run.layers if isinstance(layer, Shapes) for item in layer.items for shape in item]
    return "green" if any(shape.colour == "purple" for shape in shapes) else "purple"
