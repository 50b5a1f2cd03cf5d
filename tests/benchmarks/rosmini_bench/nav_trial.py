"""One goal after another, each in a graph of its own: what move_base makes of it, and what the engine saw.

Map, simulator, localisation and move_base are started by a launch text, as a user starts them; nothing here knows
how a plan or a command comes about.
"""

from __future__ import annotations

import atexit
import io
import math
import shutil
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.core.maps import GridMap, save_map
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.launch import roslaunch
from rosmini.sim.models import model as model_called
from rosmini.sim.shapes import Cylinder
from rosmini.sim.world import Obstacle
from rosmini.sim.worlds import world as world_called
from rosmini.sim.worlds.world_map import to_map

from .nav_goals import DISC, Errand, errands, turning, unmapped

PATIENCE = 6.0
"""A robot that has not arrived after so many times the least time has failed; so has one after `LONGEST`."""
LONGEST = 60.0
"""Seconds that are always granted."""
LOOK = 0.02
"""How often it is asked what the robot touches [s]."""
STILL = 1e-3
"""A robot whose touched side goes no faster [m/s] towards what touches it was touched, and did not touch."""

STATUS = ("PENDING", "ACTIVE", "PREEMPTED", "SUCCEEDED", "ABORTED", "REJECTED")

FIELD = "field"
"""A square that is empty in the map."""
SIDE, FOREST, RADIUS, CELL = 7.0, 3.5, 0.1, 0.05
"""Of the field, of what cylinders cover in its middle, and of a cylinder and a cell [m]."""

LAUNCH = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="world" value="{world}"/>
    <param name="model" value="{model}"/>
    <param name="sweep" value="{sweep}"/>
    <param name="x" value="{x}"/> <param name="y" value="{y}"/> <param name="yaw" value="{yaw}"/>
  </node>
  <include file="$(find turtlebot3_navigation)/launch/turtlebot3_navigation.launch">
    <arg name="model" value="{model}"/>
    <arg name="map_file" value="{map}"/> <arg name="open_rviz" value="false"/>
    <arg name="careful" value="{careful}"/>
    <arg name="localization" value="{localization}"/>
    <arg name="initial_pose_x" value="{x}"/> <arg name="initial_pose_y" value="{y}"/>
    <arg name="initial_pose_a" value="{yaw}"/>
  </include>
  {more}
</launch>
"""

TRAJECTORY = '<rosparam ns="/move_base" file="$(find turtlebot3_navigation)/param/base_local_planner_params.yaml"/>'
"""Without it this planner takes the robot for one that can step aside."""


@dataclass(frozen=True)
class Setup:
    """What is the same for all goals of a row."""

    world: str
    model: str = "burger"
    sweep: bool = True
    overrides: tuple[tuple[str, Any], ...] = ()
    """Parameters set after the launch file's: names below /move_base and values."""
    gap: float | None = None
    """In a world of cylinders that are not in the map: how many robot widths are between any two of them."""
    careful: bool = True
    """Whether `careful.yaml` is loaded over the files that are in the shape of ROBOTIS's."""
    localization: str = "fake_localization"
    """What says where the robot is: or amcl, which is told where it begins."""
    seed: int = 0
    without: str = ""
    """Things of the world whose names begin so are taken away: walkers, or doors."""
    narrow: bool = False
    """Whether goals are in narrower places than usual."""

    @property
    def words(self) -> str:
        """A row's name."""
        where = self.world if self.gap is None else f"cylinders, gaps of {self.gap:g} widths"
        changed = "".join(
            f", {value.rpartition('/')[2]}" if name.endswith("_planner") else f", {name.rpartition('/')[2]} {value}"
            for name, value in self.overrides
        )
        sweep, care = "" if self.sweep else ", no sweep", ", careful" if self.careful else ""
        told = "" if self.localization == "fake_localization" else f", {self.localization}"
        gone = f", without {self.without}s" if self.without else ""
        places = ", narrower places" if self.narrow else ""
        return f"{where}{gone}{places}, {self.model}{sweep}{changed}{care}{told}, seed {self.seed}"


@dataclass(frozen=True)
class Outcome:
    """What became of one goal."""

    errand: Errand
    status: str
    text: str
    seconds: float
    """Of the graph, until the result."""
    driven: float
    """By the true pose [m]."""
    off: float
    """The true distance from the goal in the end [m]."""
    turned_off: float
    """The true difference of the headings in the end [rad]."""
    contacts: tuple[str, ...]
    """What the robot drove into, in order."""
    bumps: tuple[str, ...]
    """What drove, or walked, into the robot."""
    cpu: float
    """Seconds of the processor, without the start."""
    recoveries: tuple[str, ...] = ()

    def reached(self, xy: float, yaw: float) -> bool:
        """Whether it says so, and is there in truth within these tolerances [m, rad]."""
        return self.status == "SUCCEEDED" and self.off <= xy and self.turned_off <= yaw

    @property
    def stretch(self) -> float:
        """How many times the shortest path it drove."""
        return self.driven / self.errand.shortest


@cache
def place(name: str) -> tuple[GridMap, Path, tuple[float, float]]:
    """The map of a world, a file of it, and a point inside [m]."""
    if name == FIELD:
        cells = np.full((round(SIDE / CELL) + 4, round(SIDE / CELL) + 4), 100, dtype=np.int8)
        cells[2:-2, 2:-2] = 0
        grid = GridMap(cells, CELL, (-SIDE / 2 - 2 * CELL, -SIDE / 2 - 2 * CELL, 0.0), Path("field.yaml"))
        inside = (0.0, SIDE / 2 - 0.5)
    else:
        world = world_called(name)
        grid, inside = to_map(world), world.starts[0][:2]
    # Of this process alone: another study may run beside it, and a map must not be read while it is written.
    folder = Path(mkdtemp(prefix="rosmini_bench_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return grid, save_map(grid, folder / name)[0], inside


def drawn(setup: Setup, count: int) -> Iterator[Errand]:
    """The errands of a setup."""
    if setup.gap is not None:
        return across(count, setup.seed)
    grid, _, inside = place(setup.world)
    taken = unmapped(world_called(setup.world))
    # A waffle's corners reach farther than the disc: it would begin inside a wall.
    disc = max(DISC, model_called(setup.model).reach)
    return errands(grid, inside, count, setup.seed, taken, disc=disc, narrow=setup.narrow)


def width(model: str) -> float:
    """How wide a robot is [m]."""
    ys = [y for _, y in model_called(model).footprint]
    return max(ys) - min(ys)


def cylinders(gap: float) -> Iterator[Obstacle]:
    """A lattice of equal triangles of cylinders in the middle of the field, neighbours `gap` [m] apart."""
    step = gap + 2 * RADIUS
    rows = int(FOREST // (step * math.sqrt(3) / 2))
    columns = int(SIDE // step) + 1
    for row in range(rows):
        for column in range(columns):
            x = (column - (columns - 1) / 2 + (0.25 if row % 2 else -0.25)) * step
            y = (row - (rows - 1) / 2) * step * math.sqrt(3) / 2
            if abs(x) <= SIDE / 2 + RADIUS:
                yield Obstacle(f"cylinder {row}.{column}", Cylinder(RADIUS), (x, y, 0.0))


def across(count: int, seed: int) -> Iterator[Errand]:
    """Errands from one side of the forest to the other and back."""
    draw = np.random.default_rng(seed)
    for number in range(count):
        side = 1 if number % 2 else -1
        (ax, bx), (a, b) = (draw.uniform(-SIDE / 2 + 0.5, SIDE / 2 - 0.5, 2), draw.uniform(-math.pi, math.pi, 2))
        y = side * (FOREST / 2 + 0.6)
        start, goal = (float(ax), -y, float(a)), (float(bx), y, float(b))
        way = [start[:2], goal[:2]]
        yield Errand(number, start, goal, math.dist(*way), turning(way, start, goal))


def remove_obstacle(engine: Any, without: str) -> None:
    """Take away what has a name that begins so; nothing if it is empty."""
    for obstacle in engine.obstacles():
        if without and obstacle.name.startswith(without):
            engine.remove_obstacle(obstacle.name)


@dataclass
class Watch:
    """What is seen while the robot drives."""

    engine: Any
    robot: str
    driven: float = 0.0
    touching: frozenset[str] = frozenset()
    contacts: list[str] = field(default_factory=list)
    bumps: list[str] = field(default_factory=list)
    last: tuple[float, float] | None = None

    def look(self, _: Any = None) -> None:
        """Add up what was driven, and note what is newly touched."""
        x, y, yaw = self.engine.pose(self.robot)
        if self.last is not None:
            self.driven += math.dist(self.last, (x, y))
        self.last = (x, y)
        touches = self.engine.touching(self.robot)
        v, _, w = self.engine.velocity(self.robot)
        vx, vy = v * math.cos(yaw), v * math.sin(yaw)
        for touch in touches:
            if touch.other not in self.touching:
                ahead = -((vx - w * (touch.y - y)) * touch.nx + (vy + w * (touch.x - x)) * touch.ny)
                is_contact = ahead > STILL or not self._moves(touch.other)
                (self.contacts if is_contact else self.bumps).append(touch.other)
        self.touching = frozenset(touch.other for touch in touches)

    def _moves(self, name: str) -> bool:
        """Whether a thing can come to the robot; what cannot was touched by it, were it by turning along it."""
        return name in self.engine.robots or name in self.engine.movers


def run(setup: Setup, errand: Errand, *, watched: bool = True) -> Outcome:
    """Send one robot to one goal; without `watched` no contact is seen, and nothing measured of its drive."""
    _, file, _ = place(setup.world)
    graph = Graph(strict=False, seed=setup.seed * 100_003 + errand.number)
    try:
        return _run(graph, setup, errand, file, watched=watched)
    finally:
        graph.shutdown()


def _run(graph: Graph, setup: Setup, errand: Errand, file: Path, *, watched: bool) -> Outcome:
    x, y, yaw = errand.start
    more = "".join(f'<param name="/move_base/{name}" value="{value}"/>' for name, value in setup.overrides)
    if any("TrajectoryPlannerROS" in str(value) for _, value in setup.overrides):
        more += TRAJECTORY
    text = LAUNCH.format(
        map=file,
        world=file if setup.world == FIELD else setup.world,
        model=setup.model,
        sweep=str(setup.sweep).lower(),
        careful=str(setup.careful).lower(),
        localization=setup.localization,
        x=x,
        y=y,
        yaw=yaw,
        more=more,
    )
    launch_file = file.parent / f"{errand.number}.launch"
    launch_file.write_text(text, encoding="utf-8")
    console = {"stdout": io.StringIO(), "stderr": io.StringIO()}
    roslaunch(str(launch_file), graph=graph, console=console)
    graph.run(0.1)
    if "/simulator" not in graph.nodes:
        said = console["stderr"].getvalue() or console["stdout"].getvalue()
        raise RosminiError(
            f"the simulator did not start for goal {errand.number} of {setup.words}, with the robot at {errand.start}: "
            f"{said.strip()[-600:] or 'it said nothing'}"
        )
    simulator = graph.nodes["/simulator"].program
    for obstacle in () if setup.gap is None else cylinders(setup.gap * width(setup.model)):
        simulator.engine.insert(obstacle)
    remove_obstacle(simulator.engine, setup.without)
    node = graph.node("tester")
    watch = Watch(simulator.engine, simulator.name)
    results: list[Any] = []
    node.subscriber("/move_base/result", message_class("move_base_msgs/MoveBaseActionResult"), results.append)
    recoveries: list[str] = []
    node.subscriber(
        "/move_base/recovery_status",
        message_class("move_base_msgs/RecoveryStatus"),
        lambda message: recoveries.append(message.recovery_behavior_name),
    )
    sender = node.publisher("/move_base_simple/goal", message_class("geometry_msgs/PoseStamped"), queue_size=1)
    graph.run(2.0)  # the first scans and costmaps
    if watched:
        node.timer(LOOK, watch.look)
    begin, cpu = graph.scheduler.now_ns(), time.process_time()
    sender.publish(pose_stamped("map", Time(0), errand.goal))
    least = errand.shortest / 0.22 + errand.turning
    deadline = LONGEST + PATIENCE * least
    while not results and (graph.scheduler.now_ns() - begin) * 1e-9 < deadline:
        graph.run(0.5)
    cpu = time.process_time() - cpu
    seconds = (graph.scheduler.now_ns() - begin) * 1e-9
    x, y, yaw = simulator.engine.pose(simulator.name)
    status = STATUS[results[0].status.status] if results else "LOST"
    return Outcome(
        errand,
        status,
        results[0].status.text if results else f"no result within {deadline:.0f} s",
        seconds,
        watch.driven,
        math.dist((x, y), errand.goal[:2]),
        abs(math.remainder(yaw - errand.goal[2], math.tau)),
        tuple(watch.contacts),
        tuple(watch.bumps),
        cpu,
        tuple(recoveries),
    )
