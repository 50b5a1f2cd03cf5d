"""Runs in three dimensions: a recording, a bag or a run of layers, played in meshcat's viewer."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.models import RobotModel, model
from rosmini.sim.recording import Recording
from rosmini.sim.world import Pose, World
from rosmini.viz.embed import MESHCAT, MovingView
from rosmini.viz.replay.layers import RANGE
from rosmini.viz.replay.packing import LENGTH, pack, whole
from rosmini.viz.replay.player import (
    LAYER_SCRIPT,
    Source,
    layers_sentence,
    other_robots_sentence,
    recorder_run,
    run_from,
)
from rosmini.viz.replay.run import BUDGET, Run, size, thinned
from rosmini.viz.replay.still import still_of
from rosmini.viz.rounding import fixed, snap
from rosmini.viz.svg import element
from rosmini.viz.view import ViewError
from rosmini.viz.world_pictures import colour_of, pose_text

from .compression import compress
from .moving_frames import MovingFrames
from .scene3d import ROBOT, Scene3D, obstacle_node
from .view import HEIGHT, Focus, MeshcatView, camera_for, node_of, title_of

Floats = NDArray[np.float64]
ROBOT_DISTANCE = 1.5
"""Distance of the camera from a robot that it follows [m]."""

TF = "/tf"
"""The topic that stands for the axes of all frames."""

PLAYER_SCRIPTS = ("rosmini-replay-data.js", "rosmini-meshcat.js", "rosmini-meshcat-player.js")
"""Scripts that a viewer needs to play a run."""
LAYER_SCRIPTS = (
    "rosmini-canvas.js",
    "rosmini-replay-data.js",
    LAYER_SCRIPT,
    "rosmini-meshcat-layers.js",
    *PLAYER_SCRIPTS[1:],
)
"""Scripts that it also needs for layers, which are drawn as on the canvas and laid on the ground."""
MIN_LAYER_BYTES = 140_000
"""Budget for the layers of a page, independent of the size of the world and the robots [bytes]."""
RATE = 10.0
"""Sampling rate of robot poses that come from messages [Hz]."""


def replay_3d(
    *sources: Source, focus: Focus = "robot", distance: float | None = None, azimuth: float | None = None,
    elevation: float | None = None, scans: bool = True, title: str | None = None, height: int = HEIGHT,
    topics: Collection[str] | None = None, frame: str | None = None, robot: str | RobotModel | None = None,
    names: Sequence[str] | None = None,
) -> MeshcatView | RunsView:  # fmt: skip
    """Play a run: the robot as it drives, and published maps, costmaps, plans and particles on the ground.

    The camera follows the robot, or stands still if the focus is the world. `scans` shows the laser scans of a
    recording, each beam from the robot's pose at its measurement. `topics` and `frame` are those of `replay`, but `/tf`
    among the topics shows the axes of the recorded frames; `robot`
    is the model of the robots of a bag, which are otherwise flat arrowheads. Several runs are shown side by side with
    one clock, with `names` above them, and turning one view turns all.

    Raises:
        ViewError: a source cannot be played, or contains nothing to show; the focus or the distance is invalid;
            the number of names differs from the number of runs.
        ROSBagException: a bag cannot be read.

    """
    if not sources or (names is not None and len(names) != len(sources)):
        raise ViewError(f"replay_3d needs at least one run, and as many names as runs, not {len(sources)} and {names}")
    camera_args = {"focus": focus, "distance": distance, "azimuth": azimuth, "elevation": elevation}
    known = model(robot) if isinstance(robot, str) else robot
    has_axes = topics is not None and TF in topics
    made: list[MeshcatView] = []
    alone = title if len(sources) == 1 else None
    for source in sources:
        if isinstance(source, Recording):
            kept = recorder_run(source, topics=topics, frame=frame)
            view = _recording(source, kept, camera_args, scans=scans, axes=has_axes, title=alone, height=height)
        else:
            kept = run_from(source, topics=topics, frame=frame, robot=known)
            view = _run(kept, known, camera_args, title=alone, height=height)
        view.scripts = LAYER_SCRIPTS if kept is not None else PLAYER_SCRIPTS
        if kept is not None:
            _add_layers(view, kept, len(sources))
        made.append(view)
    return made[0] if len(made) == 1 else RunsView(made, names or [each.label for each in made], title=title)


def _recording(
    recording: Recording, kept: Run | None, camera_args: dict[str, Any], *, scans: bool, axes: bool, title: str | None,
    height: int,
) -> MeshcatView:  # fmt: skip
    """Show a simulated robot in its world; `kept` has the layers recorded with it, `axes` asks for its frames."""
    world, model, truth = recording.world, recording.model, recording.truth
    start: Pose = tuple(truth[0].tolist())
    is_close = camera_args["focus"] == "robot"
    if is_close and camera_args["distance"] is None:
        camera_args = {**camera_args, "distance": ROBOT_DISTANCE}
    scene = Scene3D(camera_for(world, start, **camera_args))
    begin = float(recording.times[0])
    scene.add_world(recording.world_at(begin) if recording.things else world)
    believed = recording.odom_in_map()
    scene.add_trail("odometry", believed[:, :2], "orange", 0.004)
    scene.add_trail("truth", truth[:, :2], "blue", 0.006)
    for i, other in enumerate(recording.others):
        scene.add_trail(other.name, other.truth[:, :2], colour_of(i), 0.005)
        scene.add_robot(other.model, other.pose_at(begin), node_of(other.name))
    scene.add_robot(model, start)
    seen = _scan_track(recording) if scans and len(recording.scans) else None
    if seen is not None:
        scene.add_scan(model, np.full(seen["beams"], np.inf))
    scene.animate(recording.times - begin, _all_tracks(scene, recording))
    frames = MovingFrames(recording) if axes else None
    if frames is not None:
        frames.add_to(scene)
    label = f"{model.title or model.name} in {title_of(world)}: a run in 3D"
    driven = f"{fixed(recording.duration, 1)} s, {fixed(recording.distance, 2)} m"
    off = fixed(float(recording.drift().position[-1]), 2)
    text = (
        f"3D replay: {model.name} in {world.name}, {driven}\n"
        f"from {pose_text(start)} to {pose_text(tuple(truth[-1].tolist()))}; odometry ends {off} m off"
        + "".join(f"\n{each.name} ({each.model.name}): {fixed(each.distance, 2)} m" for each in recording.others)
        + (f"\nframes: {', '.join(frames.poses)}" if frames is not None else "")
        + "".join(f"\n{line}" for line in (kept.text().splitlines()[1:] if kept is not None else ()))
    )
    alt = (
        f"A player with {model.title or model.name} in {title_of(world)}, in three dimensions: it drives {driven}. "
        f"Lines on the ground show its way and, {off} m off at its end, the way that odometry believes in."
        f"{' Red, green and blue bars are the axes of its frames.' if frames is not None else ''}"
        f"{other_robots_sentence(recording)}{layers_sentence(kept)}"
    )
    view = MeshcatView(
        scene, label=label, text=text, alt=alt, title=title, height=height,
        follow=f"/meshcat/{ROBOT}" if is_close else None,
    )  # fmt: skip
    if seen is not None:
        view.extra["scan"] = seen
    return view


def _run(
    run: Run, robot: RobotModel | None, camera_args: dict[str, Any], *, title: str | None, height: int
) -> MeshcatView:
    """Show the content of messages: bare ground, with robots on it if their model is known."""
    x0, y0, x1, y1 = run.extent()
    # poses of a robot according to topics (names with a slash) lie flat under the robot itself
    own = [body for body in run.bodies if not body.name.startswith("/")] or list(run.bodies[:1])
    bodies = own if robot is not None else []
    start = bodies[0].poses[0].tolist() if bodies else None
    if start is None:
        camera_args = {**camera_args, "focus": "world"} if camera_args["focus"] == "robot" else camera_args
    elif camera_args["focus"] == "robot" and camera_args["distance"] is None:
        camera_args = {**camera_args, "distance": ROBOT_DISTANCE}
    fence = np.array([(x0, y0, x1, y0), (x1, y1, x0, y1)])
    scene = Scene3D(camera_for(World("ground", (), walls=fence), start and tuple(start), **camera_args))
    scene.add_ground((x0, y0, x1, y1))
    times = np.linspace(run.start, run.end, 1 + min(1200, int(RATE * run.duration)))
    tracks: list[tuple[str, str, Floats]] = []
    for i, body in enumerate(bodies):
        assert robot is not None  # noqa: S101 - there are no bodies without a model
        node = node_of(body.name) if i else ROBOT
        poses = _sampled(times, body.times, body.poses)
        scene.add_robot(robot, tuple(poses[0].tolist()), node)
        tracks += _tracks(robot, poses, node, wheels=f"{node}/wheel_left" in scene.nodes)
    scene.animate(times - run.start, tracks)
    label, alt = f"{run.name}: a run in 3D", run.alt().replace("seen from above", "in three dimensions")
    view = MeshcatView(
        scene, label=label, text=run.text(f"3D replay: {run.name}"), alt=alt, title=title, height=height,
        follow=f"/meshcat/{ROBOT}" if bodies and camera_args["focus"] == "robot" else None,
    )  # fmt: skip
    view.svg = still_of(run, title=label, alt=run.alt()).svg or ""  # a drawing of bare ground would show nothing
    return view


def _add_layers(view: MeshcatView, run: Run, runs: int) -> None:
    """Give a viewer, one of `runs`, the layers on its ground, thinned until the page is small enough."""
    bodies = [body.data() for body in run.bodies]
    used = size({**view.parts, "bodies": bodies}) + 4 * len(compress(view.scene.commands)) // 3
    layers, notes = thinned(run.layers, max(MIN_LAYER_BYTES, BUDGET - used) // runs)
    view.extra["layered"] = {
        "start": run.start, "bounds": [round(side, 3) for side in view.scene.bounds], "layers": layers,
        "bodies": bodies, "notes": [*run.notes, *notes],
    }  # fmt: skip


def _all_tracks(scene: Scene3D, recording: Recording) -> list[tuple[str, str, Floats]]:
    """Return the tracks of everything that moves, at the recording's times."""
    times = recording.times
    tracks = _tracks(recording.model, recording.truth, ROBOT, wheels=f"{ROBOT}/wheel_left" in scene.nodes)
    for other in recording.others:
        node, poses = node_of(other.name), _sampled(times, other.times, other.truth)
        tracks += _tracks(other.model, poses, node, wheels=f"{node}/wheel_left" in scene.nodes)
    for thing in recording.things:
        poses = _sampled(times, thing.times, thing.poses)
        tracks += _tracks(recording.model, poses, obstacle_node(thing.obstacle.name), wheels=False)
    return tracks


def _sampled(times: Floats, known: Floats, poses: Floats) -> Floats:
    """Return poses (n, 3) at `times` (n,), by linear interpolation between those at the times `known`."""
    return np.column_stack([np.interp(times, known, column) for column in poses.T])


def _tracks(model: RobotModel, truth: Floats, node: str, *, wheels: bool) -> list[tuple[str, str, Floats]]:
    """Return the tracks of a robot and of its wheels, if any; they roll without slipping along the true path."""
    place = np.column_stack([truth[:, :2], np.zeros(len(truth))])
    steps, turns = np.diff(truth[:, :2], axis=0), np.diff(truth[:, 2])
    towards = truth[:-1, 2] + turns / 2
    travelled = (steps[:, 0] * np.cos(towards) + steps[:, 1] * np.sin(towards)) / np.sinc(turns / 2 / np.pi)
    turning: list[tuple[str, str, Floats]] = []
    for side, sign in (("left", -1), ("right", 1)) if wheels else ():
        rolled = np.cumsum(travelled + sign * turns * model.wheel_separation / 2) / model.wheel_radius
        turning.append((f"{node}/wheel_{side}", "rotation[y]", np.concatenate([[0.0], rolled])))
    return [(node, "position", place), (node, "rotation[z]", truth[:, 2]), *turning]


MAX_SCANS = 120
BEAM_STEP = 2


def _scan_track(recording: Recording) -> dict[str, Any]:
    """Return every second beam of at most `MAX_SCANS` scans, rounded if scans are left out; 0 means no hit."""
    every = -(-len(recording.scans) // MAX_SCANS)
    ranges = recording.scans[::every, ::BEAM_STEP]
    hit = np.isfinite(ranges)
    unit = LENGTH if every == 1 else RANGE
    times = snap(recording.scan_times[::every] - recording.times[0])
    lidar = recording.model.laser
    fan = lidar.angle_max is not None or lidar.angle_min
    return {
        **({"start": round(lidar.angle_min, 8), "step": round(BEAM_STEP * lidar.increment, 8)} if fan else {}),
        **({"increment": round(BEAM_STEP * recording.time_increment, 9)} if recording.time_increment else {}),
        "path": f"/meshcat/{ROBOT}/scan",
        "beams": ranges.shape[1],
        "times": [round(t, 3) for t in times.tolist()],
        "unit": unit,
        "ranges": pack(whole(np.where(hit, ranges, 0.0), unit).ravel()),
    }


# -- several runs side by side -----------------------------------------------------------------------------------------


class RunsView(MovingView):
    """Several runs, each in its own viewer, with one bar of controls; the image is that of the first."""

    assets = (MESHCAT,)
    call = "rosminiMeshcat.mount"

    def __init__(self, runs: Sequence[MeshcatView], names: Sequence[str], *, title: str | None = None) -> None:
        self.runs = tuple(runs)
        self.names = tuple(names)
        self.title = title
        self.scripts = max((run.scripts for run in runs), key=len)

    @property
    def name(self) -> str:
        """The title, or a short description."""
        return self.title or f"{len(self.runs)} runs in 3D, side by side"

    @property
    def text(self) -> str:
        """The result of each run, in numbers."""
        told = (f"{name}: {run.text}" for name, run in zip(self.names, self.runs, strict=True))
        return "\n".join([self.name, *told])

    @property
    def alt(self) -> str:
        """The runs in a few sentences."""
        told = " ".join(f"{name}: {run.alt}" for name, run in zip(self.names, self.runs, strict=True))
        return f"{len(self.runs)} runs side by side, by one clock. {told}"

    @property
    def svg(self) -> str:
        """A picture of the first run."""
        return self.runs[0].svg

    @property
    def fallback(self) -> str:
        """Pictures of the runs, side by side."""
        drawn = [element("div", run.svg, style="flex:1 1 18rem;min-width:0") for run in self.runs]
        return element("div", "".join(drawn), style="display:flex;flex-wrap:wrap;gap:8px")

    @property
    def height(self) -> int:
        """The height of one viewer [CSS px]."""
        return self.runs[0].height

    @property
    def data(self) -> dict[str, Any]:
        """The data for the viewers' script: the commands of all runs together, since much is the same in each."""
        return {
            "commands": compress(command for run in self.runs for command in run.scene.commands),
            "duration": max(run.scene.duration for run in self.runs),
            "runs": [
                {**run.parts, "count": len(run.scene.commands), "title": name}
                for name, run in zip(self.names, self.runs, strict=True)
            ],
        }
