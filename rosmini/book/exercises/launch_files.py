"""Checks of the exercises in the chapter Launch files: each starts a launch file with two or three robots."""

from __future__ import annotations

import os
from collections import defaultdict
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.ros.launch import Launch, Plan, read
from rosmini.ros.launch.running import in_graph

from .names import PATROL

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

ROBOT = """
<launch>
  <arg name="name" doc="namespace of the robot"/>
  <arg name="speed" default="0.2" doc="speed [m/s]"/>
  <group ns="$(arg name)">
    <node pkg="notebook" type="patrol.py" name="patrol">
      <param name="speed" value="$(arg speed)"/>
    </node>
  </group>
</launch>
"""

WORLD = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="world" value="house"/>
    <rosparam command="load" file="$(env HOUSE)/robots.yaml"/>
  </node>
</launch>
"""

ROBOTS = """
robots:
  - {name: amy, x: -3.0, y: 1.0}
  - {name: bob, x: 3.0, y: 0.6, yaw: 3.14}
"""

CLEO = """
  - {name: cleo, x: 0.0, y: 1.0}
"""

FILES = {
    "notebook/package.xml": "<package><name>notebook</name><version>0.0.0</version></package>",
    "notebook/scripts/patrol.py": f"#!/usr/bin/env python3{PATROL}",
    "notebook/launch/robot.launch": ROBOT.strip(),
    "notebook/launch/world.launch": WORLD.strip(),
}
"""The chapter's package; the check brings its own, in case that its cells have been changed or were not run."""


@contextmanager
def _packages(robots: str) -> Iterator[tuple[PackageIndex, Mapping[str, str]]]:
    """Yield packages that include that of the chapter, and the environment of its launch files."""
    with TemporaryDirectory() as folder:
        for name, text in (FILES | {"house/robots.yaml": robots}).items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        yield PackageIndex([folder, *PackageIndex().paths]), {**os.environ, "HOUSE": str(Path(folder, "house"))}


class House(Trial):
    """A launch file that runs; the picture shows what its robots did."""

    def __init__(self, plan: Plan, packages: PackageIndex, said: str) -> None:
        from rosmini.sim.recorder import Recorder

        self._begin(is_shown=True)
        self.launch = Launch(plan, self.graph, in_graph(self.graph, packages, capture_output=True))
        try:
            self.launch.start()
        except RosminiError as error:
            self.graph.shutdown()
            raise Wrong(f"{said}, it cannot be started: {error}") from error
        self.graph.run(0.1)
        found = self.graph.nodes.get("/simulator")
        if found is None:
            self.graph.shutdown()
            raise Wrong(f"{said}, there is no node /simulator.", "include world.launch")
        self._recorder = Recorder(self.graph, found.program)
        self.speeds: dict[str, list[float]] = defaultdict(list)
        listener = self.graph.node("listener")
        for robot in found.program.robots:
            listener.subscriber(
                f"/{robot}/cmd_vel", Twist, lambda message, robot=robot: self.speeds[robot].append(message.linear.x)
            )

    def expect_speeds(self, said: str, wanted: Mapping[str, float | None], hint: str) -> None:
        """Expect robots to drive at these speeds [m/s], None for a robot that nobody drives."""
        for robot, speed in wanted.items():
            top = max(self.speeds[robot], default=None)
            if speed is None:
                expect(top is None, f"{said}, {robot} drives at {top} m/s, and should stand still.", hint)
            else:
                does = "gets no commands" if top is None else f"drives at {top:g} m/s"
                expect(
                    top is not None and abs(top - speed) < 1e-9,
                    f"{said}, {robot} {does}; it should drive at {speed:g} m/s.",
                    hint,
                )


def _launched(answer: Any, packages: PackageIndex, environ: Mapping[str, str], **args: str) -> tuple[House, str]:
    """Start the text of a launch file; return the house, and how it was started."""
    words = " ".join(f"{name}:={value}" for name, value in args.items())
    said = f"Started with {words}" if args else "Started without arguments"
    package = packages.path("notebook")
    path = str(package / "launch" / "answer.launch")
    try:
        plan = read(text=answer, path=path, args=args, packages=packages, environ=environ)
    except RosminiError as error:
        why = str(error).replace(f"{package.parent}{os.sep}", "")  # a temporary folder
        raise Wrong(f"{said}, roslaunch refuses it: {why}") from error
    unknown = [line for line in plan.warnings if "no launch file has an arg" in line]
    expect(not unknown, f"{said}: {'; '.join(unknown)}.", 'declare it: <arg name="..." default="..."/>')
    return House(plan, packages, said), said


# ---- fleet: three robots from one file ----


@exercise("fleet", praise="Three robots, and their program appears only once.")
def fleet(answer: object) -> Any:
    """A launch file that sends three robots on patrol, with one argument."""
    expect_type(answer, str, "fleet is", "a text")
    with _packages(ROBOTS + CLEO.strip("\n")) as (packages, environ):
        for args, speed in (({}, 0.2), ({"speed": "0.12"}, 0.12)):
            house, said = _launched(answer, packages, environ, **args)
            with house:
                house.run(8.0)
                house.expect_speeds(
                    said,
                    {"amy": speed, "bob": speed, "cleo": 0.1},
                    "include robot.launch for each robot, and give each include the args name and speed",
                )
                view = house.view()
    return view


# ---- repaired: four mistakes without a message ----


@exercise("repaired_launch", praise="None of the four mistakes produced an error message, and you found them all.")
def repaired_launch(answer: object) -> Any:
    """A launch file without the four mistakes."""
    expect_type(answer, str, "repaired is", "a text")
    with _packages(ROBOTS) as (packages, environ):
        for args, speed in (({}, 0.2), ({"speed": "0.05"}, 0.05)):
            house, said = _launched(answer, packages, environ, **args)
            with house:
                house.run(6.0)
                house.expect_speeds(
                    said, {"amy": speed, "bob": speed}, "compare --nodes, --dump-params and --args with what you want"
                )
                cards = {
                    robot: house.graph.ask_as("/check").call("getParam", f"/{robot}/card")[2]
                    for robot in ("amy", "bob")
                }
                expect(
                    cards == {"amy": "0042", "bob": "0043"},
                    f"The cards of the robots are {cards['amy']!r} and {cards['bob']!r}, not '0042' and '0043'.",
                    "which attribute of <param> makes a value a string?",
                )
                view = house.view()
    return view


# ---- night_shift: conditions, and a node that comes back ----

BACK_S = 3.0
"""Time in which the node has to be back [s]."""


@exercise("night_shift", praise="One file for day and night, and a patrol that survives being killed.")
def night_shift(answer: object) -> Any:
    """A launch file with a condition, an expression and a node that is started again."""
    expect_type(answer, str, "night_shift is", "a text")
    day = {"amy": 0.2, "bob": 0.2}
    with _packages(ROBOTS) as (packages, environ):
        for args, wanted in (({}, day), ({"night": "false"}, day), ({"night": "true"}, {"amy": None, "bob": 0.05})):
            house, said = _launched(answer, packages, environ, **args)
            with house:
                house.run(5.0)
                house.expect_speeds(
                    said, wanted, 'use if="..." or unless="..." for amy, $(eval ...) for the speed of bob'
                )
                watched = [robot for robot, speed in wanted.items() if speed is not None]
                for robot in watched:
                    node = f"/{robot}/patrol"
                    expect(node in house.graph.nodes, f"{said}, there is no node {node}.", "name it patrol, in a group")
                    house.graph.nodes[node].shutdown("the check ends it")
                house.run(BACK_S)
                house.speeds.clear()
                house.run(2.0)
                house.expect_speeds(
                    f"{said}, {BACK_S:g} s after its node was killed", {robot: wanted[robot] for robot in watched},
                    'use respawn="true", with a respawn_delay of 2 s or less',
                )  # fmt: skip
                view = house.view()
    return view
