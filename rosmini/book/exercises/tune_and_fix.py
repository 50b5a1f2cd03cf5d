"""Checks of the exercises in the chapter Tune and fix: each starts the Navigation Stack and drives to a goal."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import exercise, expect, expect_type
from rosmini.book.drives import Drive, courier

# ---- spinning: a robot that turns at its goal for ever ----


@exercise("spinning", praise="The robot turns slowly enough to stop at the right heading.")
def spinning(answer: Any) -> Any:
    """Settings with which the robot stops at its goal, and looks where it should."""
    goal = (-2.0, 0.8, 1.57)
    drive, _ = courier(answer, "settings", (-3.0, 1.0, 0.0))
    with drive:
        drive.expect_arrival(goal, 25.0, "compare the turn between two commands with the width of the target")
        _, _, yaw = drive.robot.truth()
        off = abs(math.remainder(yaw - goal[2], math.tau))
        expect(
            off < 0.1,
            f"The robot has stopped, but its heading is {off:.2f} rad off.",
            "keep yaw_goal_tolerance at 0.05, and change the other parameter",
        )
        return drive.view()


# ---- ghosts: crates that are no longer there ----

CRATES = {"crate 1": (-1.27, -0.05, 0.0), "crate 2": (-0.82, -0.05, 0.0), "toy box": (-1.03, -0.45, 0.0)}
"""Things that block the door of the child's room."""
AWAY = {"crate 1": (-2.5, -2.6, 0.0), "crate 2": (-1.5, -3.5, 0.0), "toy box": (-2.5, -2.1, 0.35)}
DOOR = {"global_costmap": (-1.03, 0.0), "local_costmap": (1.0, 0.0)}
"""The middle of the door: in the frame map, and in the frame odom, which begins where the robot starts."""


@exercise("ghosts", praise="The laser removes what it no longer sees.")
def ghosts(answer: Any) -> Any:
    """Settings with which obstacles appear in both costmaps and disappear again."""
    drive, _ = courier(answer, "settings", (-1.0, 1.0, -1.57))
    with drive:
        for name, pose in CRATES.items():
            drive.robot.drag(name, pose)
        drive.run(3.0)
        for costmap in ("global_costmap", "local_costmap"):
            expect(
                _marks_the_door(drive, costmap),
                f"Crates block the door, but the {costmap} has no obstacle there.",
                "marking must stay true",
            )
        for name, pose in AWAY.items():
            drive.robot.drag(name, pose)
        drive.run(1.0)
        drive.expect_arrival((-1.0, -1.0, -1.57), 20.0, "the crates are gone: what removes an obstacle from a costmap?")
        return drive.view()


def _marks_the_door(drive: Drive, name: str) -> bool:
    """Return whether a costmap of `move_base` has a lethal cell where the crates are."""
    grid = getattr(drive.graph.nodes["/move_base"].program, name).grid
    x, y = DOOR[name]
    cells = (grid.world_to_map(x + 0.05 * i, y + 0.05 * j) for i in range(-5, 6) for j in range(-5, 6))
    return any(cell is not None and grid.cost(*cell) == 254 for cell in cells)


# ---- lost: a launch file with two faults ----


@exercise("lost", praise="The robot knows where it is and how large it is, and drives.")
def lost(answer: Any) -> Any:
    """A launch file with which the robot drives to a goal with amcl."""
    expect_type(answer, str, "lost is", "a text")
    with Drive(answer) as drive:
        x, y, _ = drive.robot.truth()
        expect(
            math.dist((x, y), (0.9, 2.6)) < 0.1,
            f"The robot is at ({x:.1f}, {y:.1f}), not at (0.9, 2.6).",
            "x, y and yaw say where the robot starts: they are right",
        )
        expect("/amcl" in drive.graph.nodes, "There is no node /amcl.", "localization is amcl")
        drive.expect_arrival((-1.0, 1.0, 3.14), 30.0, "one fault is in the arguments, the other in the rosparam tag")
        return drive.view()
