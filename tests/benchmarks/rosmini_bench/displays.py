"""What is measured of RViz's displays: drawing each as a still, drawing it to be turned, and how heavy both are."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from rosmini import Graph
from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex
from rosmini.core.tf import StaticTransformBroadcaster
from rosmini.msgs.geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovarianceStamped,
)
from rosmini.msgs.nav_msgs.msg import GridCells, OccupancyGrid, Odometry, Path
from rosmini.msgs.sensor_msgs.msg import LaserScan, Range
from rosmini.sim.urdf import load
from rosmini.sim.urdf.xacro import expand
from rosmini.viz.rviz import Scene, still, turnable

from . import Measure

ROBOT = "package://turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro"


class Subject(NamedTuple):
    """A display, what it shows, and the messages for it."""

    kind: str
    what: str
    messages: Callable[[], list[Any]]
    properties: dict[str, Any]


def pose(x: float, y: float = 0.0) -> Pose:
    """A pose that looks along x."""
    made = Pose()
    made.position.x, made.position.y, made.orientation.w = x, y, 1.0
    return made


def grid(side: int) -> OccupancyGrid:
    """A map with rooms of four metres."""
    made = OccupancyGrid()
    made.info.width = made.info.height = side
    made.info.resolution, made.info.origin.orientation.w = 0.05, 1.0
    cells = np.zeros((side, side), dtype=np.int8)
    cells[::80], cells[:, ::80] = 100, 100
    made.data = cells.ravel()
    return made


def scans(beams: int, count: int = 1) -> list[LaserScan]:
    """Scans of a round wall."""
    ranges = 3.0 + 0.2 * np.sin(np.linspace(0, 40, beams))
    step = 2 * math.pi / beams
    return [LaserScan(ranges=ranges, angle_increment=step, range_min=0.1, range_max=10.0)] * count


def odometry() -> list[Odometry]:
    """A hundred steps along a line."""
    made = [Odometry() for _ in range(100)]
    for i, each in enumerate(made):
        each.pose.pose = pose(0.2 * i)
    return made


def polygon() -> list[PolygonStamped]:
    """The footprint of a robot."""
    made = PolygonStamped()
    made.polygon.points = [Point32(x=x, y=y) for x, y in ((0.1, 0.1), (-0.2, 0.1), (-0.2, -0.1), (0.1, -0.1))]
    return [made]


def believed() -> list[PoseWithCovarianceStamped]:
    """A pose that is not sure."""
    made = PoseWithCovarianceStamped()
    made.pose.pose, made.pose.covariance = pose(1.0), np.diag([0.2, 0.1, 0, 0, 0, 0.05]).ravel()
    return [made]


SUBJECTS = (
    Subject("Grid", "10 x 10 cells", list, {}),
    Subject("TF", "TurtleBot3", list, {}),
    Subject("RobotModel", "TurtleBot3", list, {}),
    Subject("LaserScan", "360 points", partial(scans, 360), {}),
    Subject("LaserScan", "50 scans of 360 points", partial(scans, 360, 50), {"Decay Time": 100.0}),
    Subject("LaserScan", "100,000 points", partial(scans, 100_000), {}),
    Subject("Map", "384 x 384 cells", lambda: [grid(384)], {}),
    Subject("Map", "4000 x 4000 cells", lambda: [grid(4000)], {}),
    Subject("Path", "500 poses", lambda: [Path(poses=[PoseStamped(pose=pose(0.05 * i)) for i in range(500)])], {}),
    Subject("Odometry", "100 arrows", odometry, {}),
    Subject("Pose", "an arrow", lambda: [PoseStamped(pose=pose(1.0))], {}),
    Subject("PoseArray", "2000 particles", lambda: [PoseArray(poses=[pose(0.01 * i) for i in range(2000)])], {}),
    Subject("PoseWithCovariance", "an ellipsoid", believed, {}),
    Subject("PointStamped", "a ball", lambda: [PointStamped(point=Point(x=1.0))], {}),
    Subject("Polygon", "a footprint", polygon, {}),
    Subject("Range", "a cone", lambda: [Range(field_of_view=0.5, min_range=0.1, max_range=4.0, range=2.0)], {}),
    Subject("GridCells", "1000 cells",
            lambda: [GridCells(cell_width=0.1, cell_height=0.1, cells=[Point(x=0.1 * i) for i in range(1000)])], {}),
)  # fmt: skip


@cache
def description() -> str:
    """The robot's URDF."""
    return expand(PackageIndex().resolve(ROBOT))


class Stage:
    """A scene with one display that has received what it shows."""

    def __init__(self, subject: Subject) -> None:
        self._stack = ExitStack()
        graph = self._stack.enter_context(Graph())
        node = graph.node("robot")
        node.set_param("/robot_description", description())
        self.scene = self._stack.enter_context(Scene(graph, fixed_frame="base_footprint"))
        self.display = self.scene.add(subject.kind, {"Topic": "/it"} if subject.messages is not list else {})
        for name, value in subject.properties.items():
            self.display[name] = value
        broadcaster = StaticTransformBroadcaster(node)
        for joint in load(description().encode(), meshes=False).joints.values():
            broadcaster.send(joint.parent, joint.child, tuple(joint.transform()[:3, 3]))
        messages = subject.messages()
        if messages:
            publisher = node.publisher("/it", type(messages[0]), queue_size=None)
            publisher.wait_for_subscribers()
            for message in messages:
                message.header.frame_id = "base_footprint"
                publisher.publish(message)
        graph.run(0.1)
        if not self.scene.update()[0].primitives:
            said = "; ".join(map(str, self.display.statuses))
            raise RosminiError(f"{subject.kind} drew nothing, so there is no figure: {said}")

    def close(self) -> None:
        """Leave the graph."""
        self._stack.close()


def spent_ms(subject: Subject, draw: Callable[[Scene], object], count: int) -> float:
    """Return the milliseconds of CPU from the messages to the picture."""
    stage = Stage(subject)
    try:
        draw(stage.scene)
        begin = time.process_time()
        for _ in range(count):
            stage.display.version += 1  # draw again what is known
            draw(stage.scene)
        return (time.process_time() - begin) * 1e3 / count
    finally:
        stage.close()


def weight_kb(subject: Subject, *, turn: bool) -> float:
    """Return how heavy the page's part is: a still, or what is beside it to turn the scene [kB]."""
    stage = Stage(subject)
    try:
        if turn:
            return sum(map(len, turnable(stage.scene).scene.commands)) * 4 / 3 / 1000
        return len(still(stage.scene).svg or "") / 1000
    finally:
        stage.close()


def measures(scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""
    for subject in SUBJECTS:
        count = max(int(5 * scale), 1)
        name = f"rviz {subject.kind}, {subject.what}"
        for form, draw in (("still", still), ("3D", turnable)):
            yield Measure(f"{name}: {form}", "ms of CPU", partial(spent_ms, subject, draw, count), more_is_better=False)
            weigh = partial(weight_kb, subject, turn=form == "3D")
            yield Measure(f"{name}: {form}", "kB", weigh, more_is_better=False, once=True)
