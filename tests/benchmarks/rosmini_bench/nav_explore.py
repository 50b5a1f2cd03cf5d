"""How robots explore: worlds and seeds, by frontier_exploration and by explore_lite, with gmapping.

`rosmini bench nav` prints a line for each run, and the table; `nav_study` keeps the runs. What a run has seen is the
share of the cells that a robot's centre can reach and that are in the map.
"""

from __future__ import annotations

import io
import statistics
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.geometry.poses import Pose, inverse, transform_points
from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch
from rosmini.sim.worlds import world as world_called

from .nav_charts import label
from .nav_goals import DISC, Terrain, wilson
from .nav_trial import LOOK, Watch, place, remove_obstacle

WORLDS = ("house", "maze", "office")
FRONTIER, LITE = "frontier_exploration", "explore_lite"
FILES = {FRONTIER: "global_map.launch", LITE: "explore.launch"}
ARGUMENTS = {FRONTIER: "", LITE: '<arg name="progress_timeout" value="120"/>'}
"""In the house a frontier is near as the crow flies, and far on wheels."""
ENDS = ("Finished exploring room", "Failed exploration", "Exploration stopped.")
"""What an explorer says when it is over."""
LONGEST = 2400.0
"""Seconds that a run may take."""
GOOD = 0.97
"""The share of the reachable cells that a run has to see."""
SETTINGS = {"particles": 30, "linearUpdate": 0.5, "xmin": -1.0, "ymin": -1.0, "xmax": 1.0, "ymax": 1.0}
"""Of gmapping; the others are of ROBOTIS's file."""

LAUNCH = """
<launch>
  <include file="$(find rosmini_sim)/launch/simulator.launch">
    <arg name="world" value="{world}"/> <arg name="model" value="burger"/> <arg name="board" value="false"/>
  </include>
  <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
    <arg name="model" value="burger"/>
  </include>
  <include file="$(find turtlebot3_slam)/launch/turtlebot3_gmapping.launch">
    <arg name="model" value="burger"/>
  </include>
  {settings}
  <include file="$(find turtlebot3_navigation)/launch/move_base.launch">
    <arg name="model" value="burger"/> <arg name="careful" value="true"/>
  </include>
  <include file="$(find {method})/launch/{file}">{arguments}</include>
</launch>
"""


@dataclass(frozen=True)
class Explored:
    """What became of one run."""

    world: str
    method: str
    seed: int
    end: str
    """What the explorer said last; empty if it never ended."""
    seconds: float
    driven: float
    """By the true pose [m]."""
    share: float
    goals: int
    contacts: int
    cpu: float
    without: str = ""
    """Things of the world whose names begin so were taken away: walkers, or doors."""

    @property
    def ended(self) -> bool:
        """Whether it ended by itself, and not by a failure."""
        return self.end in (ENDS[0], ENDS[2])

    @property
    def place(self) -> str:
        """The world, and what was taken away."""
        return f"{self.world} without {self.without}s" if self.without else self.world

    def line(self) -> str:
        """As text."""
        return (
            f"{self.place:<8} {self.method:<20} {self.seed:>4} {self.seconds:6.0f} s {self.driven:6.1f} m "
            f"{self.share:6.1%} {self.goals:>4} goals {self.contacts:>3} contacts {self.cpu:6.1f} s CPU  {self.end}"
        )


def explore(world: str, method: str, seed: int, longest: float = LONGEST, *, without: str = "") -> Explored:
    """Let one robot explore a world until it ends by itself."""
    graph = Graph(strict=False, seed=seed)
    try:
        return _explore(graph, world, method, seed, longest, without)
    finally:
        graph.shutdown()


def _explore(graph: Graph, world: str, method: str, seed: int, longest: float, without: str) -> Explored:
    grid, file, _ = place(world)
    settings = "".join(
        f'<param name="/turtlebot3_slam_gmapping/{name}" value="{value}"/>' for name, value in SETTINGS.items()
    )
    text = LAUNCH.format(world=world, method=method, file=FILES[method], arguments=ARGUMENTS[method], settings=settings)
    launch_file = file.parent / f"explore_{method}_{seed}.launch"
    launch_file.write_text(text, encoding="utf-8")
    cpu, begin = time.process_time(), graph.scheduler.now_ns()
    roslaunch(str(launch_file), graph=graph, console={"stdout": io.StringIO(), "stderr": io.StringIO()})
    node = graph.node("tester")
    ends: list[str] = []
    goals: list[Any] = []
    maps: list[Any] = []

    def read(log: Any) -> None:
        if log.name in ("/explore", "/explore_server") and log.msg.startswith(ENDS):
            ends.append(log.msg)

    node.subscriber("/rosout", message_class("rosgraph_msgs/Log"), read)
    node.subscriber("/move_base/goal", message_class("move_base_msgs/MoveBaseActionGoal"), goals.append)
    node.subscriber("/map", message_class("nav_msgs/OccupancyGrid"), lambda each: maps.__setitem__(slice(None), [each]))
    graph.run(3.0)
    simulator = graph.nodes["/simulator"].program
    remove_obstacle(simulator.engine, without)
    watch = Watch(simulator.engine, simulator.name)
    node.timer(LOOK, watch.look)
    start = world_called(world).starts[0]
    if method == FRONTIER:
        _click(graph, node, start, grid)
    while not ends and (graph.scheduler.now_ns() - begin) * 1e-9 < longest:
        graph.run(2.0)
    return Explored(
        world,
        method,
        seed,
        ends[0] if ends else "",
        (graph.scheduler.now_ns() - begin) * 1e-9,
        watch.driven,
        share(maps[0], start, world),
        len(goals),
        len(watch.contacts),
        time.process_time() - cpu,
        without,
    )


def _click(graph: Graph, node: Any, start: Pose, grid: Any) -> None:
    """Click a rectangle around the world, then a point beside the robot, in the frame of a map that begins there."""
    (left, low, _), (height, width) = grid.origin, grid.occupancy.shape
    x0, y0 = left - 1, low - 1
    x1, y1 = left + width * grid.resolution + 1, low + height * grid.resolution + 1
    corners = transform_points(inverse(start), [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]).tolist()
    clicks = node.publisher("/clicked_point", message_class("geometry_msgs/PointStamped"), queue_size=10)
    graph.run(0.5)
    for x, y in [*corners, (0.1, 0.0)]:
        point = message_class("geometry_msgs/PointStamped")()
        point.header.frame_id, point.point.x, point.point.y = "map", x, y
        clicks.publish(point)
        graph.run(0.2)


def share(message: Any, start: Pose, world: str) -> float:
    """Of the cells that a robot's centre can reach from `start`, how many a map that begins there knows."""
    grid, _, _ = place(world)
    terrain = Terrain(grid)
    cells = np.argwhere(terrain.within(DISC, terrain.cell(*start[:2])))
    left, low, _ = grid.origin
    points = np.array([left, low]) + (cells[:, ::-1] + 0.5) * grid.resolution
    points = transform_points(inverse(start), points)
    info = message.info
    origin = np.array([info.origin.position.x, info.origin.position.y])
    columns, rows = np.floor((points - origin) / info.resolution).astype(int).T
    inside = (columns >= 0) & (rows >= 0) & (columns < info.width) & (rows < info.height)
    known = np.asarray(message.data).reshape(info.height, info.width) >= 0
    return float(known[rows[inside], columns[inside]].sum() / len(cells))


def table(found: Iterable[Explored]) -> Iterator[str]:
    """One line of Markdown for each world and method: medians, and of how many runs."""
    rows: dict[tuple[str, str], list[Explored]] = {}
    for one in found:
        rows.setdefault((one.place, one.method), []).append(one)
    heads = "world and explorer | ended by itself | 95% interval | saw all | seen | time | path | goals | contacts"
    yield f"| {heads} |"
    yield "|---" * (heads.count("|") + 1) + "|"
    for (world, method), runs in sorted(rows.items()):
        ended = sum(one.ended for one in runs)
        low, high = wilson(ended, len(runs))
        seen, seconds, driven, goals = (
            statistics.median(getattr(one, name) for one in runs) for name in ("share", "seconds", "driven", "goals")
        )
        anchor = f'<a id="{label(f"{world} {method}")}"></a>'
        yield (
            f"| {anchor}{world}, {method} | {ended} of {len(runs)} | {low:.0%} to {high:.0%} | "
            f"{sum(one.share >= GOOD for one in runs)} of {len(runs)} | {seen:.0%} "
            f"({min(one.share for one in runs):.0%}) | {seconds:.0f} s | {driven:.0f} m | {goals:.0f} | "
            f"{sum(one.contacts for one in runs)} |"
        )


def run(*, worlds: Iterable[str] = WORLDS, seeds: Iterable[int] = (1,)) -> list[Explored]:
    """Explore, and print."""
    found = []
    for seed in seeds:
        for world in worlds:
            for method in FILES:
                found.append(explore(world, method, seed))
                print(found[-1].line(), flush=True)
    print(*table(found), sep="\n")
    return found
