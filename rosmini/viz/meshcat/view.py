"""Scenes as views: a simulator at this moment, a world, a recorded run."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.raycast import raycast
from rosmini.sim.models import RobotModel
from rosmini.sim.recording import Recording
from rosmini.sim.world import Pose, World
from rosmini.viz import style
from rosmini.viz.embed import MESHCAT
from rosmini.viz.moving_view import MovingView
from rosmini.viz.replay.player import beside
from rosmini.viz.rounding import fixed, snap
from rosmini.viz.view import ViewError
from rosmini.viz.world_pictures import colour_of, pose_text

from .drawing import draw
from .scene3d import ROBOT, Camera, Scene3D, obstacle_node

if TYPE_CHECKING:
    from rosmini.sim.simulator import Simulator

Floats = NDArray[np.float64]
Focus = Literal["robot", "world"]
"""What the camera looks at."""

HEIGHT = 420
"""Of the viewer [CSS px]."""

ELEVATION = 25.0
"""How high the camera looks down on a robot [deg]."""

NEAR = 0.1
"""So far [m] the camera stays away from what is behind it."""


class MeshcatView(MovingView):
    """A scene that can be turned, and played if something in it moves; its image is a drawing of the same scene.

    `title` is a caption under it and the first line of its text form; `label` names it for those who do not see it.

    In the book, the page's one copy of meshcat's viewer shows the recorded commands, with no server. A page should hold
    at most six: browsers draw no more than some eight three-dimensional pictures at a time.
    """

    scripts = ("rosmini-meshcat.js",)
    assets = (MESHCAT,)
    call = "rosminiMeshcat.mount"
    height = HEIGHT

    def __init__(
        self, scene: Scene3D, *, label: str, text: str, alt: str, follow: str | None = None,
        height: int = HEIGHT, title: str | None = None,
    ) -> None:  # fmt: skip
        self.scene = scene
        self.label = label
        self.title = title
        self._text = f"{title}\n{text}" if title else text
        self._alt = alt
        self._follow = follow
        self.height = height
        self.extra: dict[str, Any] = {}

    @property
    def text(self) -> str:
        """What is in the scene and where."""
        return self._text

    @property
    def alt(self) -> str:
        """The scene in a sentence or two."""
        return self._alt

    @cached_property
    def svg(self) -> str:
        """The drawing: the scene as the viewer shows it first."""
        return draw(self.scene, title=self.label, alt=self.alt)

    @property
    def data(self) -> dict[str, Any]:
        """What the script of the viewer takes."""
        return {
            "commands": self.scene.commands,
            "themes": self.scene.themes,
            "duration": self.scene.duration,
            "follow": self._follow,
            "legend": [[trail.name, style.variable(trail.colour)] for trail in self.scene.trails],
            **({"copies": self.scene.copies} if self.scene.copies else {}),
            **self.extra,
        }

    @property
    def name(self) -> str:
        """What is in the scene, in a few words."""
        return self.label


def camera_for(
    world: World, pose: Pose | None, *, focus: Focus, distance: float | None, azimuth: float | None,
    elevation: float | None,
) -> Camera:  # fmt: skip
    """A three-quarter view of the robot from ahead, or of the whole world from the south; what is given overrides it.

    Raises:
        ViewError: the focus is neither "robot" nor "world", or the distance is not positive.

    """
    if focus not in {"robot", "world"}:
        raise ViewError(f"the focus of a 3D picture is 'robot' or 'world', not {focus!r}")
    if distance is not None and not 0 < distance < 1e4:
        raise ViewError(f"the distance of the camera is a number of metres above 0, not {distance!r}")
    x0, y0, x1, y1 = world.bounds
    if focus == "robot" and pose is not None:
        middle = (pose[0], pose[1], 0.09)
        usual = (0.65, *free_sight(world, pose, 0.65 if distance is None else distance))
    else:
        size = math.hypot(x1 - x0, y1 - y0)
        middle, usual = ((x0 + x1) / 2, (y0 + y1) / 2, 0.0), (1.2 * size + 0.3, -68.0, 42.0)
    x, y, z = (round(c, 3) for c in snap(middle).tolist())
    return Camera(
        (x, y, z),
        usual[0] if distance is None else distance,
        usual[1] if azimuth is None else azimuth,
        usual[2] if elevation is None else elevation,
    )


def free_sight(world: World, pose: Pose, distance: float) -> tuple[float, float]:
    """The azimuth and elevation [deg] to see a robot from: ahead at an angle, or where nothing stands between."""
    x, y, heading = (float(part) for part in snap(np.array(pose)))
    ahead = float(snap(math.degrees(heading), 1.0))
    for aside in (-38.0, 38.0, -142.0, 142.0):
        angle = math.radians(ahead + aside)
        reach = distance * math.cos(math.radians(ELEVATION)) + NEAR
        free = raycast(world.segments, world.discs, x, y, angle, 1.0, 1, reach, backend="numpy")
        if not np.isfinite(free[0]):
            return (ahead + aside, ELEVATION)
    return (ahead - 38.0, 60.0)


def world_3d(
    world: World, *, distance: float | None = None, azimuth: float | None = None, elevation: float | None = None,
    title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """A world in three dimensions: what stands in it, as high as it is."""
    camera = camera_for(world, None, focus="world", distance=distance, azimuth=azimuth, elevation=elevation)
    scene = Scene3D(camera)
    scene.add_world(world)
    label = f"{_title(world)} in 3D"
    text = f"3D: {_contents(world)}"
    alt = f"{_title(world)} in three dimensions, seen from above at an angle: {_contents(world)}."
    return MeshcatView(scene, label=label, text=text, alt=alt, title=title, height=height)


def replay_3d(
    recording: Recording, *, focus: Focus = "robot", distance: float | None = None, azimuth: float | None = None,
    elevation: float | None = None, scans: bool = True, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """A recorded run to play: the robot on its way, its wheels turning, its trail and where odometry saw it.

    The camera follows the robot, or stands still if the focus is the world. `scans` shows what the laser saw,
    each beam from where the robot was when it was measured.
    """
    world, model, truth = recording.world, recording.model, recording.truth
    start: Pose = tuple(truth[0].tolist())
    if focus == "robot" and distance is None:
        distance = 1.5
    camera = camera_for(world, start, focus=focus, distance=distance, azimuth=azimuth, elevation=elevation)
    scene = Scene3D(camera)
    begin = float(recording.times[0])
    scene.add_world(recording.world_at(begin) if recording.things else world)
    believed = recording.odom_in_map()
    scene.add_trail("odometry", believed[:, :2], "orange", 0.004)
    scene.add_trail("truth", truth[:, :2], "blue", 0.006)
    for i, other in enumerate(recording.others):
        scene.add_trail(other.name, other.truth[:, :2], colour_of(i), 0.005)
        scene.add_robot(other.model, other.pose_at(begin), _node(other.name))
    scene.add_robot(model, start)
    seen = _scan_track(recording) if scans and len(recording.scans) else None
    if seen is not None:
        scene.add_scan(model, np.full(seen["beams"], np.inf))
    scene.animate(recording.times - begin, _all_tracks(scene, recording))
    label = f"{model.title or model.name} in {_title(world)}: a run in 3D"
    driven = f"{fixed(recording.duration, 1)} s, {fixed(recording.distance, 2)} m"
    off = fixed(float(recording.drift().position[-1]), 2)
    text = (
        f"3D replay: {model.name} in {world.name}, {driven}\n"
        f"from {pose_text(start)} to {pose_text(tuple(truth[-1].tolist()))}; odometry ends {off} m off"
        + "".join(
            f"\n{each.name} ({each.model.name}): {fixed(each.distance, 2)} m" for each in recording.others
        )
    )
    alt = (
        f"A player with {model.title or model.name} in {_title(world)}, in three dimensions: it drives {driven}. "
        f"Lines on the ground show its way and, {off} m off at its end, the way that odometry believes in."
        f"{beside(recording)}"
    )
    view = MeshcatView(
        scene, label=label, text=text, alt=alt, title=title, height=height,
        follow=f"/meshcat/{ROBOT}" if focus == "robot" else None,
    )  # fmt: skip
    if seen is not None:
        view.extra["scan"] = seen
    return view


def simulation_3d(
    simulator: Simulator, *, focus: Focus = "robot", distance: float | None = None, azimuth: float | None = None,
    elevation: float | None = None, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """A simulator at this moment: its world, its robot where it truly is, and the last scan from where it was taken.

    Raises:
        RobotGone: the robot was removed, or the node shut down.
        ViewError: the focus or the distance is impossible.

    """
    fixed_ones = [obstacle for obstacle in simulator.world.obstacles if obstacle.fixed]
    others = [
        (name, robot.model, simulator.truth(name))
        for name, robot in simulator.robots.items()
        if name != simulator.name
    ]
    world = replace(simulator.world, obstacles=(*fixed_ones, *simulator.engine.obstacles()))
    scan = simulator.last_scan()
    return robot_3d(
        world, simulator.model, simulator.truth(), None if scan is None else np.asarray(scan.ranges, dtype=float),
        scan_from=simulator.scan_poses, others=others, focus=focus, distance=distance, azimuth=azimuth,
        elevation=elevation, title=title, height=height,
    )  # fmt: skip


def robot_3d(
    world: World, model: RobotModel, pose: Pose, ranges: Floats | None = None, *,
    scan_from: Pose | Floats | None = None, others: Iterable[tuple[str, RobotModel, Pose]] = (),
    focus: Focus = "robot", distance: float | None = None, azimuth: float | None = None,
    elevation: float | None = None, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """A robot in a world at a pose, with what its laser saw: ranges (beams,) [m], not finite where nothing was hit.

    It saw that from the pose `scan_from`, or at each beam from one of them (beams, 3); by default from the pose of the
    robot. `others` are more robots: name, model and pose.

    Raises:
        ViewError: the focus or the distance is impossible, or there is a wrong number of ranges.

    """
    camera = camera_for(world, pose, focus=focus, distance=distance, azimuth=azimuth, elevation=elevation)
    scene = Scene3D(camera)
    scene.add_world(world)
    scene.add_robot(model, pose)
    beside = []
    for other, its_model, where in others:
        scene.add_robot(its_model, where, _node(other))
        beside.append(f"{other} ({its_model.name}) at {pose_text(where)}")
    hits = ""
    if ranges is not None:
        if ranges.shape != (model.laser.beams,):
            raise ViewError(f"a scan of {model.name} has {model.laser.beams} ranges, not {ranges.shape}")
        scene.add_scan(model, ranges, scan_from)
        hits = f"; {int(np.isfinite(ranges).sum())} of {len(ranges)} beams hit"
    name = model.title or model.name
    text = "\n".join([f"3D: {model.name} at {pose_text(pose)}{hits}", *beside, _contents(world)])
    alt = f"{name} in {_title(world)}, in three dimensions, at {pose_text(pose)}{hits}."
    alt += f" Beside it {', '.join(beside)}." if beside else ""
    return MeshcatView(
        scene, label=f"{name} in {_title(world)}, in 3D", text=text, alt=alt, title=title, height=height
    )


def _title(world: World) -> str:
    return world.title[:1].lower() + world.title[1:] if world.title else f"the world {world.name!r}"


def _contents(world: World) -> str:
    counts = [(len(world.walls), "wall"), (len(world.obstacles), "obstacle")]
    return f"{world.name} with " + ", ".join(f"{n} {what}{'s' * (n != 1)}" for n, what in counts)


def _node(name: str) -> str:
    """Where in the scene another robot is."""
    return "others/" + name.replace("/", " ")


def _all_tracks(scene: Scene3D, recording: Recording) -> list[tuple[str, str, Floats]]:
    """How all that moves moves, at the recording's times."""
    times = recording.times
    tracks = _tracks(recording.model, recording.truth, ROBOT, wheels=f"{ROBOT}/wheel_left" in scene.nodes)
    for other in recording.others:
        node, poses = _node(other.name), _sampled(times, other.times, other.truth)
        tracks += _tracks(other.model, poses, node, wheels=f"{node}/wheel_left" in scene.nodes)
    for thing in recording.things:
        poses = _sampled(times, thing.times, thing.poses)
        tracks += _tracks(recording.model, poses, obstacle_node(thing.obstacle.name), wheels=False)
    return tracks


def _sampled(times: Floats, known: Floats, poses: Floats) -> Floats:
    """Poses (n, 3) at `times` (n,), linear between those at the times `known`."""
    return np.column_stack([np.interp(times, known, column) for column in poses.T])


def _tracks(model: RobotModel, truth: Floats, node: str, *, wheels: bool) -> list[tuple[str, str, Floats]]:
    """How a robot and its wheels, if it has some, move: the wheels roll without slipping along the true way."""
    place = np.column_stack([truth[:, :2], np.zeros(len(truth))])
    steps, turns = np.diff(truth[:, :2], axis=0), np.diff(truth[:, 2])
    towards = truth[:-1, 2] + turns / 2
    way = (steps[:, 0] * np.cos(towards) + steps[:, 1] * np.sin(towards)) / np.sinc(turns / 2 / np.pi)
    turning: list[tuple[str, str, Floats]] = []
    for side, sign in (("left", -1), ("right", 1)) if wheels else ():
        rolled = np.cumsum(way + sign * turns * model.wheel_separation / 2) / model.wheel_radius
        turning.append((f"{node}/wheel_{side}", "rotation[y]", np.concatenate([[0.0], rolled])))
    return [(node, "position", place), (node, "rotation[z]", truth[:, 2]), *turning]


MOST_SCANS = 120
BEAM_STEP = 2


def _scan_track(recording: Recording) -> dict[str, Any]:
    """Every second beam of at most `MOST_SCANS` scans, in millimetres as 16-bit numbers; 0 where nothing was hit."""
    every = -(-len(recording.scans) // MOST_SCANS)
    ranges = recording.scans[::every, ::BEAM_STEP]
    hit = np.isfinite(ranges)
    millimetres = np.where(hit, snap(np.where(hit, ranges, 0.0)) * 1000, 0.0)
    times = snap(recording.scan_times[::every] - recording.times[0])
    lidar = recording.model.laser
    fan = lidar.angle_max is not None or lidar.angle_min
    return {
        **(
            {"start": round(lidar.angle_min, 8), "step": round(BEAM_STEP * lidar.increment, 8)} if fan else {}
        ),
        **({"increment": round(BEAM_STEP * recording.time_increment, 9)} if recording.time_increment else {}),
        "path": f"/meshcat/{ROBOT}/scan",
        "beams": ranges.shape[1],
        "times": [round(t, 3) for t in times.tolist()],
        "ranges": np.rint(np.clip(millimetres, 0, 65535)).astype("<u2").tobytes(),
    }
