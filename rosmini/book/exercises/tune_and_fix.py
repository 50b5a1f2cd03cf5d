"""Checks of the exercises in the chapter Tune and fix: each starts the Navigation Stack and drives to a goal."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import yaml

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.move_base_msgs.msg import MoveBaseActionResult
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.launch import Launch, read
from rosmini.ros.launch.running import in_graph

COURIER = """
<launch>
  <include file="$(find rosmini_sim)/launch/navigation.launch">
    <arg name="x" value="{x}"/>
    <arg name="y" value="{y}"/>
    <arg name="yaw" value="{yaw}"/>
  </include>
  <rosparam ns="move_base">
{settings}
  </rosparam>
</launch>
"""

Pose = tuple[float, float, float]


class Drive(Trial):
    """The text of a launch file with the Navigation Stack, started in a graph of its own.

    Raises:
        Wrong: roslaunch refuses the text, or it starts no simulator.

    """

    def __init__(self, text: str) -> None:
        from rosmini.sim.recorder import Recorder

        self._begin(is_shown=True)
        packages = PackageIndex()
        try:
            path = str(Path("answer.launch").resolve())
            plan = read(text=text, path=path, args={}, packages=packages, environ=os.environ)
            self.launch = Launch(plan, self.graph, in_graph(self.graph, packages, capture_output=True))
            self.launch.start()
            self.graph.run(0.1)
        except RosminiError as error:
            self.graph.shutdown()
            said = str(error).replace(f"{Path.cwd()}{os.sep}", "")
            raise Wrong(f"It cannot be started: {said}", "the message names the tag or the parameter") from error
        found = self.graph.nodes.get("/simulator")
        if found is None or "/move_base" not in self.graph.nodes:
            self.graph.shutdown()
            raise Wrong("There is no node /simulator, or no /move_base.", "include navigation.launch")
        self.robot = found.program
        self._recorder = Recorder(self.graph, self.robot)
        self.results: list[str] = []
        self._desk = self.graph.node("desk")
        self._desk.subscriber(
            "/move_base/result", MoveBaseActionResult, lambda message: self.results.append(message.status.text)
        )
        self._goals = self._desk.publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        self.run(2.0)

    def go(self, goal: Pose, seconds: float) -> float:
        """Drive to a goal. Return the distance from it [m] when `move_base` is done, at the latest after `seconds`."""
        self._goals.publish(pose_stamped("map", Time(), goal))
        begin = self.graph.now().to_sec()
        while not self.results and self.graph.now().to_sec() < begin + seconds:
            self.run(0.5)
        x, y, _ = self.robot.truth()
        return math.dist((x, y), goal[:2])

    def expect_arrival(self, goal: Pose, seconds: float, hint: str) -> None:
        """Expect that the robot reaches a goal in this time."""
        off = self.go(goal, seconds)
        said = self.results[0] if self.results else "nothing"
        expect(
            bool(self.results) and "reached" in said and off < 0.25,
            f"After at most {seconds:g} s the robot is {off:.1f} m from its goal, and move_base said: {said}",
            hint,
        )


def _courier(answer: Any, name: str, start: Pose) -> tuple[Drive, dict[str, Any]]:
    """Start the stack in the house with the settings of an answer."""
    expect_type(answer, str, f"{name} is", "a text")
    try:
        settings = yaml.safe_load(answer)
    except yaml.YAMLError as error:
        raise Wrong(f"It is not valid YAML: {str(error).splitlines()[0]}", "check the indentation") from error
    expect_type(settings, dict, "The text contains", "a dictionary of parameters")
    x, y, yaw = start
    text = COURIER.format(x=x, y=y, yaw=yaw, settings=yaml.safe_dump(settings))
    return Drive(text), settings


# ---- spinning: a robot that turns at its goal for ever ----


@exercise("spinning", praise="It turns slowly enough to stop at the right heading.")
def spinning(answer: Any) -> Any:
    """Settings with which the robot stops at its goal, and looks where it should."""
    goal = (-2.0, 0.8, 1.57)
    drive, _ = _courier(answer, "settings", (-3.0, 1.0, 0.0))
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
    drive, _ = _courier(answer, "settings", (-1.0, 1.0, -1.57))
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


@exercise("lost", praise="It knows where it is and how large it is, and drives.")
def lost(answer: Any) -> Any:
    """A launch file with which the robot drives to a goal with amcl."""
    expect_type(answer, str, "lost is", "a text")
    with Drive(answer) as drive:
        x, y, _ = drive.robot.truth()
        expect(
            math.dist((x, y), (0.9, 2.6)) < 0.1,
            f"The robot stands at ({x:.1f}, {y:.1f}), not at (0.9, 2.6).",
            "x, y and yaw say where the robot stands: they are right",
        )
        expect("/amcl" in drive.graph.nodes, "There is no node /amcl.", "localization is amcl")
        drive.expect_arrival((-1.0, 1.0, 3.14), 30.0, "one fault is in the arguments, the other in the rosparam tag")
        return drive.view()
