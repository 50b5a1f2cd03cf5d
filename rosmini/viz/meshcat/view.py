"""Views of scenes in three dimensions: a simulator at this moment, a world, a recorded run."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import RobotModel
from rosmini.sim.world import Pose, World
from rosmini.viz import style
from rosmini.viz.embed import MESHCAT, MovingView
from rosmini.viz.rounding import snap
from rosmini.viz.view import ViewError
from rosmini.viz.world_pictures import pose_text

from .compression import compress
from .drawing import draw
from .scene3d import Camera, Scene3D

if TYPE_CHECKING:
    from rosmini.sim.simulator import Simulator

Floats = NDArray[np.float64]
Focus = Literal["robot", "world"]
"""Target of the camera."""

HEIGHT = 420
"""Default height of the viewer [CSS px]."""

ELEVATION = 25.0
"""Default elevation of the camera above a robot [deg]."""

NEAR = 0.1
"""Minimum distance of the camera from things behind it [m]."""


class MeshcatView(MovingView):
    """A scene that can be turned, and played if something in it moves; its image is a drawing of the same scene.

    `title` is a caption below it and the first line of its text form; `label` names it for screen readers.

    In the book, the page's one copy of meshcat's viewer shows the recorded commands, without a server. A page should
    contain at most six: browsers support about eight three-dimensional pictures at a time.
    """

    scripts: Sequence[str] = ("rosmini-meshcat.js",)
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
        """The contents of the scene and their positions."""
        return self._text

    @property
    def alt(self) -> str:
        """The scene in one or two sentences."""
        return self._alt

    @cached_property
    def svg(self) -> str:
        """The drawing: the scene as the viewer first shows it."""
        return draw(self.scene, title=self.label, alt=self.alt)

    @property
    def data(self) -> dict[str, Any]:
        """The data for the viewer's script."""
        return {"commands": compress(self.scene.commands), **self.parts}

    @property
    def parts(self) -> dict[str, Any]:
        """The data for the script apart from the commands that build the scene."""
        return {
            "themes": self.scene.themes,
            "duration": self.scene.duration,
            "follow": self._follow,
            "legend": [[trail.name, style.variable(trail.colour)] for trail in self.scene.trails],
            **({"tracks": [motion.data for motion in self.scene.motions]} if self.scene.motions else {}),
            **({"copies": self.scene.copies} if self.scene.copies else {}),
            **self.extra,
        }

    @property
    def name(self) -> str:
        """The contents of the scene, in a few words."""
        return self.label


def camera_for(
    world: World, pose: Pose | None, *, focus: Focus, distance: float | None, azimuth: float | None,
    elevation: float | None,
) -> Camera:  # fmt: skip
    """Return a three-quarter view of the robot from ahead, or of the whole world from the south; arguments override it.

    Raises:
        ViewError: the focus is neither "robot" nor "world", or the distance is not positive.

    """
    if focus not in {"robot", "world"}:
        raise ViewError(f"the focus of a 3D picture must be 'robot' or 'world', not {focus!r}")
    check_distance(distance)
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


def check_distance(distance: float | None) -> None:
    """Raise `ViewError` for an invalid distance of the camera; None is valid."""
    if distance is not None and not 0 < distance < 1e4:
        raise ViewError(f"the distance of the camera must be a number of metres above 0, not {distance!r}")


def free_sight(world: World, pose: Pose, distance: float) -> tuple[float, float]:
    """Return the azimuth and elevation [deg] to see a robot from: ahead at an angle, or another free direction."""
    x, y, heading = (float(part) for part in snap(np.array(pose)))
    ahead = float(snap(math.degrees(heading), 1.0))
    for aside in (-38.0, 38.0, -142.0, 142.0):
        angle = math.radians(ahead + aside)
        reach = distance * math.cos(math.radians(ELEVATION)) + NEAR
        free = raycast(world.segments, world.discs, x, y, angle, 1.0, 1, reach, backend="numpy")
        if not np.isfinite(free[0]):
            return (ahead + aside, ELEVATION)
    return (ahead - 38.0, 60.0)


def simulation_3d(
    simulator: Simulator, *, focus: Focus = "robot", distance: float | None = None, azimuth: float | None = None,
    elevation: float | None = None, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """Show a simulator at this moment: its world, the true pose of its robot, and the last scan from its own pose.

    Raises:
        RobotGone: the robot was removed, or the node shut down.
        ViewError: the focus or the distance is invalid.

    """
    fixed_ones = [obstacle for obstacle in simulator.world.obstacles if obstacle.fixed]
    others = [
        (name, robot.model, simulator.truth(name)) for name, robot in simulator.robots.items() if name != simulator.name
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
    """Show a robot in a world at a pose, with a scan of its laser: ranges (beams,) [m], not finite without a hit.

    The scan was taken at the pose `scan_from`, or each beam at one of several poses (beams, 3); by default at the
    pose of the robot. `others` are further robots: name, model and pose.

    Raises:
        ViewError: the focus or the distance is invalid, or the number of ranges is wrong.

    """
    camera = camera_for(world, pose, focus=focus, distance=distance, azimuth=azimuth, elevation=elevation)
    scene = Scene3D(camera)
    scene.add_world(world)
    scene.add_robot(model, pose)
    beside = []
    for other, its_model, where in others:
        scene.add_robot(its_model, where, node_of(other))
        beside.append(f"{other} ({its_model.name}) at {pose_text(where)}")
    hits = ""
    if ranges is not None:
        if ranges.shape != (model.laser.beams,):
            raise ViewError(f"a scan of {model.name} has {model.laser.beams} ranges, not {ranges.shape}")
        scene.add_scan(model, ranges, scan_from)
        hits = f"; {int(np.isfinite(ranges).sum())} of {len(ranges)} beams hit"
    name = model.title or model.name
    text = "\n".join([f"3D: {model.name} at {pose_text(pose)}{hits}", *beside, _contents(world)])
    alt = f"{name} in {title_of(world)}, in three dimensions, at {pose_text(pose)}{hits}."
    alt += f" Beside it {', '.join(beside)}." if beside else ""
    return MeshcatView(
        scene, label=f"{name} in {title_of(world)}, in 3D", text=text, alt=alt, title=title, height=height
    )


def title_of(world: World) -> str:
    """Return a world's title as it appears in the middle of a sentence."""
    return world.title[:1].lower() + world.title[1:] if world.title else f"the world {world.name!r}"


def _contents(world: World) -> str:
    counts = [(len(world.walls), "wall"), (len(world.obstacles), "obstacle")]
    return f"{world.name} with " + ", ".join(f"{n} {what}{'s' * (n != 1)}" for n, what in counts)


def node_of(name: str) -> str:
    """Return the path of another robot in the scene."""
    return "others/" + name.replace("/", " ")
