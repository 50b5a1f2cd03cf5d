"""Trials of launch files, scripts and settings with the whole Navigation Stack: a robot drives to goals."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.move_base_msgs.msg import MoveBaseActionResult
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.launch import Launch, read
from rosmini.ros.launch.running import in_graph

from .checks import Script, Wrong, expect, expect_type
from .trials import Trial

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

Pose = tuple[float, float, float]


def navigation(start: Pose, settings: Mapping[str, Any], node: str = "move_base", **arguments: Any) -> str:
    """Return the text of a launch file with the Navigation Stack in a simulation.

    Args:
        start: the true pose at which the robot starts.
        settings: parameters of `node`, which replace those of the stack.
        node: the name of a node of the stack.
        arguments: other arguments of navigation.launch.

    """
    given = {**dict(zip(("x", "y", "yaw"), start, strict=True)), **arguments}
    tags = "".join(f'<arg name="{name}" value="{value}"/>' for name, value in given.items())
    return f"""
<launch>
  <include file="$(find rosmini_sim)/launch/navigation.launch">{tags}</include>
  <rosparam ns="{node}">
{yaml.safe_dump(dict(settings))}
  </rosparam>
</launch>
"""


def launched(text: str, graph: Graph, settle: float = 0.1) -> Launch:
    """Start the text of a launch file in a graph, and let `settle` seconds pass.

    Raises:
        Wrong: roslaunch refuses the text. The graph is shut down then.

    """
    packages = PackageIndex()
    try:
        path = str(Path("answer.launch").resolve())
        environ = {"TURTLEBOT3_MODEL": "burger", **os.environ}
        plan = read(text=text, path=path, args={}, packages=packages, environ=environ)
        launch = Launch(plan, graph, in_graph(graph, packages, capture_output=True))
        launch.start()
        graph.run(settle)
    except RosminiError as error:
        graph.shutdown()
        said = str(error).replace(f"{Path.cwd()}{os.sep}", "")
        raise Wrong(f"It cannot be started: {said}", "the message names the tag or the parameter") from error
    return launch


class Launched(Trial):
    """The text of a launch file, started in a graph of its own.

    Args:
        text: the text.
        simulator: the name of the node that simulates the robots.
        settle: the time until the recording begins [s].
        before: a script that starts a second before the launch file.

    Raises:
        Wrong: roslaunch refuses the text, or it starts no simulator.

    """

    def __init__(
        self, text: str, simulator: str = "/simulator", *, settle: float = 0.1, before: Script | None = None
    ) -> None:
        from rosmini.sim.recorder import Recorder

        self._begin(is_shown=True)
        if before is not None:
            self.start(before)
            self.graph.run(1.0)
        self.launch = launched(text, self.graph, settle)
        found = self.graph.nodes.get(simulator)
        if found is None:
            self.graph.shutdown()
            raise Wrong(f"There is no node {simulator}.", "the launch file starts the simulator")
        self.simulation = self.robot = found.program
        try:
            self._recorder = Recorder(self.graph, found.program)
        except RosminiError as error:
            self.graph.shutdown()
            raise Wrong("The simulator has no robot.", "spawn_model needs -urdf, -model and -param") from error


class Drive(Launched):
    """The text of a launch file with the Navigation Stack, started in a graph of its own.

    Args:
        text: the launch file.
        before: a script that starts a second before the launch file.

    Raises:
        Wrong: roslaunch refuses the text, or it starts no simulator or no `move_base`.

    """

    def __init__(self, text: str, *, before: Script | None = None) -> None:
        super().__init__(text, before=before)
        if "/move_base" not in self.graph.nodes:
            self.graph.shutdown()
            raise Wrong("There is no node /move_base.", "include navigation.launch")
        self.results: list[str] = []
        """Texts of the goals that `move_base` has finished."""
        self._desk = self.graph.node("desk")
        self._desk.subscriber(
            "/move_base/result", MoveBaseActionResult, lambda message: self.results.append(message.status.text)
        )
        self.goals: list[Any] = []
        """Goals that were published on `move_base_simple/goal`."""
        self._desk.subscriber("/move_base_simple/goal", PoseStamped, self.goals.append)
        self._goals = self._desk.publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        self.run(2.0)

    def finish(self, seconds: float) -> None:
        """Let time pass until `move_base` has finished a goal that a script sends, for at most `seconds`."""
        end = self.graph.now().to_sec() + seconds
        while not self.results and self.graph.now().to_sec() < end:
            self.run(0.5)

    def go(self, goal: Pose, seconds: float) -> float:
        """Drive to a goal. Return the distance from it [m] when `move_base` is done, at the latest after `seconds`."""
        self.results.clear()
        self._goals.publish(pose_stamped("map", Time(), goal))
        self.finish(seconds)
        x, y, _ = self.robot.truth()
        return math.dist((x, y), goal[:2])

    def driven(self) -> list[tuple[float, float]]:
        """Return the true positions of the robot so far [m]."""
        return [(float(x), float(y)) for x, y, _ in self._recorder.recording().truth]

    def expect_arrival(self, goal: Pose, seconds: float, hint: str) -> None:
        """Expect that the robot reaches a goal in this time."""
        off = self.go(goal, seconds)
        said = self.results[0] if self.results else "nothing"
        expect(
            bool(self.results) and "reached" in said and off < 0.25,
            f"After at most {seconds:g} s the robot is {off:.1f} m from its goal, and move_base said: {said}",
            hint,
        )


def settings_of(answer: Any, name: str) -> dict[str, Any]:
    """Return the parameters in an answer, a text in YAML. Raises `Wrong` if it is no dictionary."""
    expect_type(answer, str, f"{name} is", "a text")
    try:
        settings = yaml.safe_load(answer)
    except yaml.YAMLError as error:
        raise Wrong(f"It is not valid YAML: {str(error).splitlines()[0]}", "check the indentation") from error
    expect_type(settings, dict, "The text contains", "a dictionary of parameters")
    found: dict[str, Any] = settings
    return found


def courier(answer: Any, name: str, start: Pose, *, before: Script | None = None) -> tuple[Drive, dict[str, Any]]:
    """Start the Navigation Stack in the house, with an answer as `move_base`'s settings in YAML.

    Args:
        answer: the text of the settings.
        name: the name of the reader's variable.
        start: the pose at which the robot starts.
        before: a script that starts a second before the Navigation Stack.

    Returns:
        The trial, and the settings.

    Raises:
        Wrong: the answer is no text with a dictionary in YAML.

    """
    settings = settings_of(answer, name)
    return Drive(navigation(start, settings), before=before), settings
