"""Checks of the exercises in the chapter Costmaps."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.drives import Drive, navigation, settings_of
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.maps import GridMap, save_map
from rosmini.core.tf import StaticTransformBroadcaster
from rosmini.msgs.geometry_msgs.msg import PointStamped, Twist
from rosmini.msgs.nav_msgs.msg import OccupancyGrid, Odometry
from rosmini.msgs.std_msgs.msg import Int8
from rosmini.navigation.costmap_2d.inflation import cost_at
from rosmini.ros.scripts import rosrun

# ---- cost: a cost by its distance ----


@exercise("cost", praise="The inflation layer computes exactly this for each cell.")
def cost(answer: Any) -> Any:
    """The cost at a distance, including the ends of each range."""
    for r, big, s in ((0.051, 0.6, 5.0), (0.17, 0.55, 10.0), (0.2, 1.0, 2.5), (0.3, 0.2, 3.0)):
        for d in (0.0, 0.05, 0.1, 0.15, r, r + 0.05, 0.3, 0.45, big, big + 0.05, 2.0):
            wanted = 0 if d > big else cost_at(d, r, s)
            got = answer(d, r, big, s)
            where = f"At d = {d:g} m, with r = {r:g}, R = {big:g} and s = {s:g}, the cost"
            hint = (
                "it is 254 at distance 0, 253 up to r, the formula up to R, and 0 beyond"
                if wanted in (0, 253, 254)
                else "it is 252 exp(-s (d - r)), rounded down"
            )
            expect(got == wanted, f"{where} is {wanted}, not {got!r}.", hint)
            expect_type(got, (int, np.integer), f"{where} is", "a whole number")
    return None


# ---- door: a door and a gap ----

CELL = 0.05
WALL = slice(59, 62)
"""Columns of the wall between two rooms."""
GAP, DOOR = slice(50, 54), slice(14, 30)
"""Rows of its openings: a gap of 20 cm, narrower than a Burger, and a door of 80 cm."""
START, GOAL = (1.2, 2.6, 0.0), (4.8, 2.6, 0.0)
MIDDLE_M = 0.12
"""Largest distance at which the robot may pass the middle of the door [m]."""
RADII_M = (0.105, 0.2)
"""Inscribed radii that suit a Burger: half its width, and a little more than the distance of its corners."""


def _flat() -> GridMap:
    """Return two rooms and a wall with a door, and with a gap on the line from start to goal."""
    occupancy = np.zeros((80, 120), np.int8)
    occupancy[[0, 1, -2, -1]] = 100
    occupancy[:, [0, 1, -2, -1]] = 100
    occupancy[:, WALL] = 100
    occupancy[GAP, WALL] = occupancy[DOOR, WALL] = 0
    return GridMap(occupancy, CELL, (0.0, 0.0, 0.0))


@exercise("door", praise="The robot's size closes the gap, and the costs lead it through the middle of the door.")
def door(answer: Any) -> Any:
    """Settings with which the robot drives through the middle of the door."""
    settings = settings_of(answer, "settings")
    for costmap in ("global_costmap", "local_costmap"):
        block = settings.get(costmap)
        expect(
            not isinstance(block, dict) or "inflation_layer" not in block,
            f"{costmap} has a block inflation_layer. This configuration sets inflation_radius directly in the costmap, "
            "which overrides the block.",
            f"write inflation_radius and cost_scaling_factor directly below {costmap}",
        )
    with TemporaryDirectory() as folder:
        path, _ = save_map(_flat(), Path(folder) / "flat")
        drive = Drive(navigation(START, settings, world=path, map_file=path))
    with drive:
        radius = drive.graph.nodes["/move_base"].program.global_costmap.inscribed_radius
        expect(
            radius >= RADII_M[0],
            f"The global costmap believes that the inscribed radius is {radius:.3f} m, and the Burger is 21 cm wide.",
            'robot_radius counts only if footprint is "[]"',
        )
        expect(radius <= RADII_M[1], f"The inscribed radius is {radius:.2f} m: the Burger is smaller.", "use 0.12")
        track: list[tuple[float, float]] = []

        def follow(message: Any) -> None:
            track.append((message.pose.pose.position.x, message.pose.pose.position.y))

        drive.graph.node("watch").subscriber("/base_pose_ground_truth", Odometry, follow)
        drive.expect_arrival(GOAL, 60.0, "costs of 253 close the gap, and must not close the door")
        middle = (DOOR.start + DOOR.stop) / 2 * CELL
        left, right = WALL.start * CELL, WALL.stop * CELL
        off = max(abs(y - middle) for x, y in track if left <= x <= right)
        expect(
            off <= MIDDLE_M,
            f"The robot passes {off * 100:.0f} cm from the middle of the door.",
            "the middle is 40 cm from each post: costs must reach that far, and still be above 0 there",
        )
        return drive.view()


# ---- cost_there: the cost at a point ----

GRID = ((0, 12, 99), (50, 100, -1), (98, 0, 7), (1, 33, 64))
"""Published costs, the lowest row first."""
GRID_CELL, GRID_ORIGIN = 0.5, (-1.0, 2.0)
OUTSIDE = ((-1.1, 2.3), (0.6, 2.3), (-0.9, 1.9), (-0.9, 4.1), (30.0, 30.0))


@exercise("cost_there", praise="Your node finds the cell of any point.")
def cost_there(answer: Script) -> None:
    """A node that answers a point with the cost published for its cell."""
    answers: list[int] = []
    with Trial(is_shown=False) as trial:
        desk = trial.graph.node("desk")
        costmap = desk.publisher("/move_base/global_costmap/costmap", OccupancyGrid, queue_size=1, latch=True)
        costmap.publish(_grid())
        desk.subscriber("cost", Int8, lambda message: answers.append(message.data))
        question = desk.publisher("question", PointStamped, queue_size=5)
        trial.start(answer)
        trial.run(1.0)
        left, bottom = GRID_ORIGIN
        inside = [
            ((left + GRID_CELL * i + 0.1, bottom + GRID_CELL * j + 0.4), value)
            for j, row in enumerate(GRID)
            for i, value in enumerate(row)
        ]
        outside = [(point, -1) for point in OUTSIDE]
        for (x, y), wanted in (*inside, *outside):
            answers.clear()
            message = PointStamped()
            message.header.frame_id = "map"
            message.point.x, message.point.y = x, y
            question.publish(message)
            trial.run(0.3)
            expect(answers, f"There was no answer for ({x:.1f}, {y:.1f}).", "publish once for each question")
            where = "outside the grid" if (x, y) in OUTSIDE else "inside the grid"
            expect(
                answers == [wanted],
                f"The answer for ({x:.1f}, {y:.1f}), {where}, was {answers}, not [{wanted}].",
                "subtract the origin, divide by the resolution, and round down with math.floor: int() rounds towards 0",
            )


def _grid() -> Any:
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.resolution, grid.info.width, grid.info.height = GRID_CELL, len(GRID[0]), len(GRID)
    grid.info.origin.position.x, grid.info.origin.position.y = GRID_ORIGIN
    grid.info.origin.orientation.w = 1.0
    grid.data = [value for row in GRID for value in row]
    return grid


# ---- params: a parameter file with faults ----


@exercise("params", praise="Your costmap marks, clears and inflates obstacles, and moves with the robot.")
def params(answer: Any) -> Any:
    """A local costmap with a rolling window that marks, clears and inflates."""
    read = settings_of(answer, "params")
    with Trial(is_shown=False) as trial:
        graph = trial.graph
        StaticTransformBroadcaster(graph.node("state")).send("base_footprint", "base_scan", (-0.03, 0, 0.18))
        graph.node("loader").set_param("/eyes/costmap", read)
        trial.run(1.0)
        trial.robot.drag("crate", (0.8, 0.0, 0.0))
        try:
            rosrun("costmap_2d", "costmap_2d_node", "__name:=eyes", graph=graph, capture_output=True)
            trial.run(3.0)
        except RosminiError as error:
            raise Wrong(f"The costmap does not start: {error}", "the message names the parameter") from error
        costmap = getattr(graph.nodes["/eyes"].program if "/eyes" in graph.nodes else None, "costmap", None)
        expect(
            costmap is not None,
            "The costmap does not start: it waits for a frame or a map that does not exist.",
            "compare the names of the frames with those of the robot; a rolling window needs no map",
        )
        return _tried(trial, costmap)


def _tried(trial: Trial, costmap: Any) -> Any:
    """Test the costmap of a file with an obstacle and a drive."""
    grid = costmap.grid

    def cost_of(x: float, y: float) -> int:
        cell = grid.world_to_map(x, y)
        return 0 if cell is None else grid.cost(*cell)

    def box() -> int:
        return max(cost_of(0.6 + 0.025 * i, y) for i in range(9) for y in (-0.05, 0.0, 0.05))

    def shown(title: str) -> Any:
        return costmap.show(title=title)

    def require(condition: bool, message: str, hint: str) -> None:
        if not condition:
            raise Wrong(message, hint, shown("The costmap of your file"))

    x, y = grid.origin[0] + grid.size_m[0] / 2, grid.origin[1] + grid.size_m[1] / 2
    require(
        max(abs(x), abs(y)) < 0.2,
        f"The robot is at (0, 0), but the centre of the window is at ({x:.1f}, {y:.1f}).",
        "rolling_window",
    )
    require(
        box() == 254,
        "There is a crate 0.8 m ahead of the robot, but no lethal cell there.",
        "observation_sources lists the names of blocks; one of them needs marking: true",
    )
    radius = costmap.inscribed_radius
    require(radius < 0.25, f"The robot's inscribed radius is {radius:.2f} m: a Burger is smaller.", "set robot_radius")
    levels = {int(value) for value in np.unique(grid.costs)}
    require(
        253 in levels and bool(levels & set(range(1, 253))),
        "There are no costs below 253 around obstacles.",
        "the inflation layer must be the last plugin, and inflation_radius larger than the robot's radius",
    )
    final = shown("The costmap of your file")
    trial.robot.drag("crate", (-0.5, 1.3, 0.0))
    trial.run(2.0)
    require(box() < 254, "The crate is gone, but its cells are still lethal.", "a source needs clearing: true")
    before = grid.origin
    node = trial.graph.node("driver")
    cmd_vel, command = node.publisher("cmd_vel", Twist, queue_size=1), Twist()
    command.linear.x = 0.2
    node.timer(0.1, lambda _: cmd_vel.publish(command))
    trial.run(3.0)
    moved = math.dist(before, grid.origin)
    require(moved > 0.3, "The robot has moved, but the window has not.", "set update_frequency")
    return final
