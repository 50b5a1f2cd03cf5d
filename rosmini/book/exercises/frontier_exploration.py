"""Checks of the exercises in the chapter Frontier exploration."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from rosmini import rosrun
from rosmini.book.checks import Script, exercise, expect
from rosmini.book.drives import Drive
from rosmini.book.trials import TurtleTrial
from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.msgs.actionlib_msgs.msg import GoalID
from rosmini.msgs.frontier_exploration.msg import ExploreTaskAction, ExploreTaskActionGoal, ExploreTaskGoal
from rosmini.msgs.geometry_msgs.msg import Point32
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.std_msgs.msg import Float64

Cells = set[tuple[int, int]]

# ---- sizes: the frontiers that cells make ----

GROUPS: tuple[tuple[Cells, list[int], str], ...] = (
    ({(0, 0), (1, 0), (2, 0)}, [3], "three cells in a row are one frontier"),
    ({(0, 0), (1, 1), (2, 2), (3, 1)}, [4], "cells that touch at a corner are one frontier"),
    ({(0, 0), (5, 5), (6, 5), (6, 6)}, [3, 1], "separate groups are separate frontiers, the largest first"),
    ({(0, 0), (0, 2), (2, 0), (1, 1)}, [4], "cells may be joined by a chain through others"),
    ({(0, 0), (2, 0), (4, 1), (-3, -3)}, [1, 1, 1, 1], "cells with another cell between them do not touch"),
    (set(), [], "without cells there is no frontier"),
    ({(i, 0) for i in range(20_000)}, [20_000], "a frontier may be very long, so do not use recursion"),
)


@exercise("sizes", praise="Your function finds the same groups as the explorer.")
def sizes(answer: Any) -> None:
    """The sizes of the connected groups."""
    expect(callable(answer), f"sizes is {answer!r}, not a function.", "write def sizes(cells): ...")
    for cells, wanted, why in GROUPS:
        given = set(cells)
        try:
            found = answer(given)
        except RecursionError:
            found = "a RecursionError"
        shown = sorted(cells) if len(cells) < 9 else f"{len(cells)} cells in a row"
        said = f"For {shown} it returned {found!r}, not {wanted}."
        ok = isinstance(found, list | tuple) and list(found) == wanted
        expect(ok, said, why)
        expect(given == cells, "It changes the set in its argument.", "left = set(cells) makes a copy")


# ---- the flat, in which scripts start and stop an exploration ----

WORLD = """
define wall model( size [5.6 0.1 0.5] color "gray30" )
wall( pose [1.75 -1.05 0 0] )
wall( pose [1.75 3.05 0 0] )
wall( pose [-1.05 1 0 90] size [4.2 0.1 0.5] )
wall( pose [4.55 1 0 90] size [4.2 0.1 0.5] )
wall( pose [0.9 1.35 0 0] size [1.8 0.1 0.5] )
wall( pose [1.75 0.2 0 90] size [2.4 0.1 0.5] )
"""
MAPPING = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="world" value="{world}"/>
    <param name="board" value="false"/>
  </node>
  <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
    <arg name="model" value="burger"/>
  </include>
  <node pkg="gmapping" type="slam_gmapping" name="slam_gmapping">
    <rosparam>
      {{base_frame: base_footprint, particles: 8, linearUpdate: 0.3, xmin: -2.0, xmax: 6.0, ymin: -2.0, ymax: 4.5}}
    </rosparam>
  </node>
  <include file="$(find turtlebot3_navigation)/launch/move_base.launch">
    <arg name="model" value="burger"/>
  </include>
  {explorer}
</launch>
"""
AREA = [(-1.3, -1.3), (4.8, -1.3), (4.8, 3.3), (-1.3, 3.3)]
"""The rectangle around the flat [m]."""


class Flat(Drive):
    """A flat with a mapper and `move_base`, for use in a ``with`` block like a `Trial`.

    Args:
        explorer: further tags of the launch file.
        text: the world file; by default that of the flat in this chapter.

    """

    def __init__(self, explorer: str, text: str = WORLD) -> None:
        with TemporaryDirectory() as folder:
            world = Path(folder) / "flat.world"
            world.write_text(text, encoding="utf-8")
            super().__init__(MAPPING.format(world=world, explorer=explorer))


SERVER = '<include file="$(find frontier_exploration)/launch/global_map.launch"/>'


# ---- clicker: a script in place of the mouse ----


@exercise("clicker", praise="Your script replaces six clicks, and the robot explores.")
def clicker(answer: Script) -> Any:
    """The points that make `explore_client` send the rectangle, and the robot drive."""
    with Flat(SERVER) as flat:
        goals: list[Any] = []
        desk = flat.graph.node("customer")
        desk.subscriber("explore_server/goal", ExploreTaskActionGoal, lambda message: goals.append(message.goal))
        flat.graph.nodes["/explore_client"].shutdown("it starts later, so that the script has to wait")
        flat.start(answer)
        flat.run(2.0)
        client: Any = rosrun("frontier_exploration", "explore_client", graph=flat.graph, capture_output=True).instance()
        flat.run(15.0)
        corners_so_far = len(client.selection.polygon)
        expect(
            bool(goals),
            f"explore_client sent no area within 15 s of its start; number of corners so far: {corners_so_far}.",
            "wait for get_num_connections(), then publish the corners, the first one again, and a point inside",
        )
        goal = goals[0]
        expect(
            goal.explore_boundary.header.frame_id.lstrip("/") == "map",
            f"The frame is {goal.explore_boundary.header.frame_id!r}, not 'map'.",
            'set header.frame_id = "map"',
        )
        corners = [(round(float(p.x), 2), round(float(p.y), 2)) for p in goal.explore_boundary.polygon.points]
        expect(
            sorted(corners) == sorted(AREA),
            f"The polygon has the corners {corners}.",
            "publish the four corners of the rectangle, in order around it",
        )
        inside = goal.explore_center.point
        expect(
            math.dist((inside.x, inside.y), (0.3, 0.2)) < 0.01,
            f"The exploration begins at ({inside.x:.1f}, {inside.y:.1f}), not at (0.3, 0.2).",
            "the last of the six points is the starting point",
        )
        x, y, _ = flat.robot.truth()
        expect(math.hypot(x, y) > 0.3, "The robot did not drive.", "the points must be in order around the area")
        return flat.view()


# ---- enough: a script that ends an exploration ----

ENOUGH = 12.0
"""Area at which the exploration of the flat ends [m2]."""


@exercise("enough", praise="It measures the map, and stops the robot in time.")
def enough(answer: Script) -> Any:
    """The known area of each map, and a cancelled exploration."""
    _check_areas(answer)
    with Flat(SERVER) as flat:
        desk = flat.graph.node("customer")
        known: list[float] = []
        desk.subscriber("map", OccupancyGrid, lambda grid: known.append(_area(grid)))
        client = SimpleActionClient(desk, "explore_server", ExploreTaskAction)
        flat.start(answer, f"_enough:={ENOUGH}")
        flat.run(1.0)
        client.send_goal(_flat_goal(desk))
        for _ in range(40):
            flat.run(1.0)
            if client.get_state() not in (Status.PENDING, Status.ACTIVE):
                break
        expect(
            client.get_state() == Status.PREEMPTED,
            f"{known[-1]:.1f} m2 of the flat are known, and the exploration was not cancelled.",
            "publish GoalID() on explore_server/cancel when the area is at least `enough`",
        )
        expect(
            known[-1] >= ENOUGH,
            f"The exploration was cancelled when only {known[-1]:.1f} m2 were known.",
            "compare the area in m2 with `enough`",
        )
        flat.run(1.0)
        begin = flat.robot.truth()
        flat.run(2.0)
        expect(math.dist(begin[:2], flat.robot.truth()[:2]) < 0.02, "The robot has not stopped.", "cancel only once")
        return flat.view()


def _flat_goal(desk: Any) -> ExploreTaskGoal:
    """Return the goal that explores the whole flat."""
    goal = ExploreTaskGoal()
    goal.explore_boundary.header.frame_id = goal.explore_center.header.frame_id = "map"
    goal.explore_boundary.header.stamp = goal.explore_center.header.stamp = desk.now()
    goal.explore_boundary.polygon.points = [Point32(x=x, y=y) for x, y in AREA]
    goal.explore_center.point.x, goal.explore_center.point.y = 0.3, 0.2
    return goal


def _area(grid: OccupancyGrid) -> float:
    """Return the known area of a map [m2]."""
    return float(np.count_nonzero(np.asarray(grid.data) >= 0)) * grid.info.resolution**2


def _check_areas(answer: Script) -> None:
    """Expect the area of two maps with cells of different sizes, and a cancellation after the second only."""
    draw = np.random.default_rng(3)
    with TurtleTrial(None) as trial:
        node = trial.graph.node("mapper")
        heard: list[float] = []
        cancelled: list[GoalID] = []
        node.subscriber("known_area", Float64, lambda message: heard.append(message.data))
        node.subscriber("explore_server/cancel", GoalID, cancelled.append)
        maps = node.publisher("map", OccupancyGrid, queue_size=5)
        trial.start(answer, "_enough:=5.0")
        trial.run(2.0)
        for width, height, resolution in ((20, 30, 0.05), (8, 5, 0.5)):
            message = OccupancyGrid()
            message.header.frame_id, message.info.resolution = "map", resolution
            message.info.width, message.info.height = width, height
            message.data = draw.choice(np.array([-1, 0, 100], dtype=np.int8), width * height)
            maps.publish(message)
            trial.run(1.0)
            wanted = _area(message)
            cells = np.count_nonzero(np.asarray(message.data) >= 0)
            expect(bool(heard), "There was no message on known_area.", "call area.publish(...) in on_map")
            expect(
                math.isclose(heard[-1], wanted, rel_tol=1e-4),
                f"For a map with {cells} known cells of {resolution} m it published {heard[-1]:.4g} m2, "
                f"not {wanted:.4g} m2.",
                "multiply the number of known cells by the resolution squared; free is 0, occupied 100, unknown -1",
            )
            expect(
                bool(cancelled) == (wanted >= 5.0),
                f"With _enough:=5.0, {wanted:.4g} m2 are known, and it has published {len(cancelled)} GoalID.",
                "publish GoalID() on explore_server/cancel when the area is at least `enough`",
            )
