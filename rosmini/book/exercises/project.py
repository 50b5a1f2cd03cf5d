"""Checks of the exercises in the chapter A project: a robot visits rooms, and people put crates into doors.

`nights` runs a reader's package in seeded houses and returns what happened in each, so a lecturer can use other seeds.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import SEED, Script, Wrong, exercise, expect, expect_type
from rosmini.book.drives import Drive, Pose
from rosmini.book.trials import Trial
from rosmini.core.actionlib import SimpleActionServer
from rosmini.core.errors import RosminiError
from rosmini.core.geometry import polygons
from rosmini.core.packages import PackageIndex
from rosmini.msgs.move_base_msgs.msg import MoveBaseAction
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Empty
from rosmini.viz.view import Views

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.ros.launch import Plan
    from rosmini.sim.models import RobotModel

PLACES = {"child": (-1.05, -1.1), "study": (1.65, -1.0), "bath": (2.6, 2.4)}
DOORS = {"child": (-1.05, -0.075), "study": (1.65, -0.075), "bath": (2.6, 1.675)}
START = (0.3, 0.8)
SHELF: dict[str, Pose] = {"crate 1": (6.6, 2.6, 0.0), "crate 2": (6.2, 3.3, 0.0)}
"""Where the crates are while every door is open."""
HALL = ((-0.6, 0.3), (-0.6, 1.3), (0.9, 0.4), (1.0, 1.3))
"""Places for a box in the hall."""
SEEDS = (1, 2, 3)
PATIENCE = 60.0
"""Time in which people open doors again; a robot may give a place up afterwards [s]."""
LIMIT = 150.0
"""Length of a night [s]."""
NEAR = 0.35
"""Greatest distance from a place that has been reached [m]."""
STEP = 0.25


@dataclass(frozen=True)
class Trouble:
    """Which door is shut from which time on [s], "" for none, and where a box is in the hall."""

    shut: tuple[tuple[float, str], ...] = ()
    box: Pose = (-2.5, -2.1, 0.35)

    @property
    def open_at_the_end(self) -> list[str]:
        """The places whose doors are open at the end of the night."""
        return [place for place in PLACES if not self.shut or place != self.shut[-1][1]]


def trouble(seed: int) -> Trouble:
    """Return the trouble of a seed: one shut door, opened again within 45 s or, in a third of all nights, never."""
    rng = np.random.default_rng([seed, 9])  # with 9, each of the first three seeds shuts another door
    door, opens = list(DOORS)[rng.integers(len(DOORS))], round(float(rng.uniform(20.0, 45.0)), 1)
    x, y = HALL[rng.integers(len(HALL))]
    shut: tuple[tuple[float, str], ...] = ((0.0, door),) if rng.random() < 1 / 3 else ((0.0, door), (opens, ""))
    return Trouble(shut, (x, y, round(float(rng.uniform(-math.pi, math.pi)), 2)))


def shut_door(door: str, simulator: Any = None) -> None:
    """Move the two crates into a door of the house; without a simulator in that of the notebook's graph."""
    x, y = DOORS[door]
    _move_crates({"crate 1": (x - 0.22, y, 0.0), "crate 2": (x + 0.21, y, 0.0)}, simulator)


def open_doors(simulator: Any = None) -> None:
    """Move the two crates back to their shelf."""
    _move_crates(SHELF, simulator)


def _move_crates(poses: dict[str, Pose], simulator: Any) -> None:
    if simulator is None:
        from rosmini import default_graph

        simulator = default_graph().nodes["/simulator"].program
    for crate, pose in poses.items():
        simulator.drag(crate, pose)


@dataclass(frozen=True)
class Night:
    """What happened in one night: times [s] of visits and reports, and what the tray has touched."""

    name: str
    visits: dict[str, float]
    reports: list[tuple[float, str]]
    touched: list[str]
    view: Any

    def __str__(self) -> str:
        visits = [f"{place} {self.visits[place]:.0f} s" if place in self.visits else f"{place} -" for place in PLACES]
        return f"{self.name}: {', '.join(visits)}; contacts: {len(self.touched)}"


class Patrol(Drive):
    """A launch file that starts a robot with the Navigation Stack, and maybe its patrol."""

    def __init__(self, text: str, name: str, tray: bool = True) -> None:
        super().__init__(text)
        self.name, self._has_tray = name, tray
        self.begin = self.graph.now().to_sec() - 2.1  # after the start of a Drive
        self.visits: dict[str, float] = {}
        self.reports: list[tuple[float, str]] = []
        self.touched: list[str] = []
        self._desk.subscriber("/report", String, self._heard)

    @property
    def time(self) -> float:
        """Time since the launch [s]."""
        return self.graph.now().to_sec() - self.begin

    def _heard(self, message: Any) -> None:
        self.reports.append((self.time, message.data.strip()))
        place, _, what = message.data.partition(":")
        if what.strip() == "reached" and place in PLACES:
            off = math.dist(self.robot.truth()[:2], PLACES[place])
            if off > NEAR:
                self.reports[-1] = (self.time, f"{place}: reached, at a distance of {off:.1f} m")

    @cached_property
    def outline(self) -> RobotModel:
        """The robot's model with the outline of its tray. Raises `Wrong` if the description has none."""
        from rosmini.sim.urdf import Box, load

        model = next(iter(self.robot.robots.values())).model
        if not self._has_tray:
            return model
        _, _, text = self.graph.ask_as("/check").call("getParam", "/robot_description")
        expect(isinstance(text, str), "There is no parameter /robot_description.", "see bringup.launch")
        robot = load(text)
        shapes = [each.geometry for each in robot.links["tray"].collisions] if "tray" in robot.links else []
        if len(shapes) != 1 or not isinstance(shapes[0], Box):
            raise Wrong("The description has no link tray whose collision shape is one box.", "see robot.urdf.xacro")
        x, y = (side / 2 for side in shapes[0].size[:2])
        place = robot.transforms()["tray"]
        corners = [(a, b, 0.0, 1.0) for a, b in ((-x, -y), (x, -y), (x, y), (-x, y))]
        return replace(
            model, footprint=tuple((float((place[0] * c).sum()), float((place[1] * c).sum())) for c in corners)
        )

    def expect_footprints(self) -> None:
        """Expect the outlines in both costmaps to contain the tray."""
        for name in ("global_costmap", "local_costmap"):
            costmap = getattr(self.graph.nodes["/move_base"].program, name)
            sides = polygons.sides_of(np.array(costmap.footprint))
            inner = [(x * 0.999, y * 0.999) for x, y in self.outline.footprint]
            expect(
                polygons.inside(np.array(inner), sides).all(),
                f"The tray is larger than the footprint of the {name}.",
                "the corners of the footprint are those of the tray, in the frame base_footprint",
            )

    def night(self, what: Trouble) -> Night:
        """Let the robot patrol until it reports "done", at the latest until the end of the night."""
        todo = list(what.shut)
        self.robot.drag("toy box", what.box)
        while self.time < LIMIT and "done" not in (text for _, text in self.reports):
            if todo and self.time >= todo[0][0]:
                door = todo.pop(0)[1]
                shut_door(door, self.robot) if door else open_doors(self.robot)
            self.run(STEP)
            pose = self.robot.truth()
            hit = self.robot.engine.obstruction(self.outline, pose, self.robot.name)
            if hit and hit not in self.touched:
                self.touched.append(hit)
            for place, there in PLACES.items():
                if math.dist(pose[:2], there) < NEAR:
                    self.visits.setdefault(place, self.time)
        night = Night(self.name, self.visits, self.reports, self.touched, None)
        with suppress(RosminiError):
            return replace(night, view=self._recorder.recording().replay(title=str(night)))
        return night


def judge(night: Night, what: Trouble) -> None:
    """Raise `Wrong` with the first fault of a night."""
    lines = [f"{time:.0f} s {text}" for time, text in night.reports] or ["none"]
    said = f"{night.name}, reports: {'; '.join(lines if len(lines) < 9 else [*lines[:6], '...', *lines[-2:]])}.\n"
    false = [text for _, text in night.reports if "at a distance" in text]
    expect(
        not false,
        f"{said}It reported {false and false[0]}.",
        "the frame is map; wait for the result, and use get_state() to find out whether the goal has succeeded",
    )
    expect(
        not night.touched,
        f"{said}The tray touched {night.touched and night.touched[0]}.",
        "is the footprint as large as the tray?",
    )
    texts = [text for _, text in night.reports]
    for place in what.open_at_the_end:
        opens = max((time for time, door in what.shut if door != place and time), default=0.0)
        expect(
            place in night.visits and f"{place}: reached" in texts,
            f"{said}{place} was not {'reported' if place in night.visits else 'visited'}, "
            f"although its door was open{f' from {opens:.0f} s on' if opens else ''}.",
            "come back to places that failed; clear the costmaps; is the goal in the frame map?",
        )
    for place in PLACES.keys() - set(what.open_at_the_end):
        times = [time for time, text in night.reports if text == f"{place}: given up"]
        expect(
            times and times[0] >= PATIENCE,
            f"{said}{place} was {f'given up after {times[0]:.0f} s' if times else 'not given up'}.",
            f"its door stays shut: report '{place}: given up', at the earliest {PATIENCE:.0f} s after the start",
        )
    expect("done" in texts, f"{said}After {LIMIT:.0f} s the patrol has not ended.", "report done at the end")


# ---- night_round: a node with its own recovery ----

STACK = """
<launch>
  <param name="/simulator/obstacles" value="true"/>
  <include file="$(find rosmini_sim)/launch/navigation.launch">
    <arg name="x" value="{x}"/>
    <arg name="y" value="{y}"/>
    <arg name="localization" value="amcl"/>
  </include>
  <rosparam ns="move_base">
    planner_patience: 2.0
    controller_patience: 2.0
    recovery_behavior_enabled: false
  </rosparam>
  <rosparam param="/patrol/places">{places}</rosparam>
</launch>
"""


@exercise("night_round", praise="It comes back to a door that was shut, and knows when to give up.")
def night_round(answer: Script) -> Any:
    """A node that visits all places, though a door is shut for some time, and another one for ever."""
    _expect_patience(answer)
    places = [{"name": name, "x": x, "y": y} for name, (x, y) in PLACES.items()]
    what = Trouble(((0.0, "child"), (16.0, "bath")))
    with Patrol(STACK.format(x=START[0], y=START[1], places=places), "The night", tray=False) as drive:
        drive.start(answer)
        night = drive.night(what)
        judge(night, what)
        return night.view


def _expect_patience(answer: Script) -> None:
    """Expect no place to be given up in the first minute, however often a `move_base` aborts its goal."""
    with Trial("empty", is_shown=False) as trial:
        desk, mover = trial.graph.node("desk"), trial.graph.node("move_base")
        reports: list[str] = []
        desk.subscriber("/report", String, lambda message: reports.append(message.data))
        desk.set_param("/patrol/places", [{"name": "child", "x": 1.0, "y": 0.0}])
        mover.service("~clear_costmaps", Empty, lambda _: {})

        def drive(_: Any) -> None:
            mover.sleep(5.0)
            server.set_aborted()

        server = SimpleActionServer(mover, "/move_base", MoveBaseAction, drive)
        trial.start(answer)
        for second in range(round(PATIENCE)):
            trial.graph.run(1.0)
            expect(
                "child: given up" not in reports,
                f"With one place whose goal fails every few seconds, it was given up after {second + 1} s.",
                f"come back to it, however often it fails, until {PATIENCE:.0f} s after the start",
            )


# ---- patrol_test: a test that fails when it should ----

GOOD = ["child: later", "study: reached", "bath: reached", "child: reached", "done"]
BAD = {
    "a place that was given up": ["child: later", "study: reached", "bath: reached", "child: given up", "done"],
    "a place that is never reported": ["study: reached", "bath: reached", "done"],
    "a patrol that never says done": ["child: reached", "study: reached", "bath: reached"],
}


@exercise("patrol_test", praise="It passes for a good patrol, and fails for each bad one.")
def patrol_test(answer: Any) -> None:
    """A script with unittest, for a patrol that reports as told."""
    expect_type(answer, str, "test is", "a text")
    expect(_passes(answer, GOOD), "The test fails, although all three places are reached.", f"the reports are {GOOD}")
    for what, reports in BAD.items():
        expect(not _passes(answer, reports), f"The test passes for {what}.", f"the reports are {reports}")


def _passes(answer: str, reports: Sequence[str]) -> bool:
    """Return whether a test passes while a patrol sends these reports, one every five seconds."""
    with Trial("empty", is_shown=False) as trial:
        patrol = trial.graph.node("patrol")
        patrol.set_param("~places", [{"name": name, "x": x, "y": y} for name, (x, y) in PLACES.items()])
        report = patrol.publisher("/report", String, queue_size=10)
        report.expect_nobody()
        test = trial.start(Script("test_patrol.py", answer))
        for text in reports:
            trial.graph.run(5.0)
            report.publish(String(text))
        trial.graph.run(LIMIT, until=lambda: test.poll() is not None)
        ended = test.poll()
        expect(ended is not None, "The test does not end.", "wait for the report done, but no longer than 120 s")
        ran = "\nRan " in trial.output and "\nRan 0 " not in trial.output
        expect(ran, f"No test was run. {trial.output.strip().rpartition(chr(10))[2]}", "a test begins with test_")
        return ended == 0


# ---- project: the whole package ----


@exercise("project", praise="The package patrols a house that it has never seen like this.")
def project(answer: Any) -> Any:
    """The name of a package, or a tuple: the name, and the seeds of the nights. A seed of the check replaces these."""
    name, *seeds = answer if isinstance(answer, tuple) else (answer,)
    expect_type(name, str, "project is", "the name of a package")
    seeds_said = "The seeds must be whole numbers from 0."
    expect(all(isinstance(seed, int) and seed >= 0 for seed in seeds), seeds_said, '("patrol_robot", 4, 5)')
    if seed := SEED.get():
        seeds = [seed]
    return Views([night.view for night in nights(name, seeds or SEEDS)])


def nights(name: str, seeds: Sequence[int]) -> list[Night]:
    """Run a package in a calm house with its test, and in the houses of the seeds. Raises `Wrong` at a fault."""
    packages = PackageIndex()
    expect(name in packages, f"There is no package {name}.", "build the workspace, and source devel/setup.bash")
    folder = packages.path(name)
    tests = sorted(folder.glob("test/*.test"))
    expect(tests, f"The package {name} has no file test/*.test.", "see the section A test")
    _run_test(folder, tests[0])
    found = []
    for seed in seeds:
        with _started(folder, folder / "launch" / "patrol.launch", f"Seed {seed}") as drive:
            night = drive.night(trouble(seed))
            _expect_alive(drive)
            judge(night, trouble(seed))
            found.append(night)
    return found


def _started(folder: Path, file: Path, said: str) -> Patrol:
    """Start a launch file of a package, and check what can be checked without driving."""
    relative = file.relative_to(folder)
    try:
        expect(file.is_file(), f"There is no file {relative}.")
        shown = '<param name="/simulator/obstacles" value="true"/>'
        drive = Patrol(f'<launch>{shown}<include file="{file}"/></launch>', said)
    except Wrong as wrong:
        raise Wrong(str(wrong).replace(str(folder), folder.name), wrong.hint) from wrong
    try:
        _expect_whole(folder, drive.launch.plan)
        failed = [each.executable for each in drive.launch.failed]
        expect(not failed, f"{failed and failed[0]} could not be started.", "does it exist, and may it be run?")
        x, y, _ = drive.robot.truth()
        expect(math.dist((x, y), START) < 0.3, f"The robot starts at ({x:.1f}, {y:.1f}), not at {START}.")
        drive.expect_footprints()
    except BaseException:
        drive.graph.shutdown()
        raise
    return drive


def _expect_whole(folder: Path, plan: Plan) -> None:
    """Expect the manifest to name the packages of all nodes, and the map to be in the package."""
    package = PackageIndex().find(folder.name)
    known = {folder.name, *package.depends, *package.exec_depends}
    lacking = sorted({node.package for node in plan.nodes} - known)
    expect(
        not lacking,
        f"package.xml does not name {', '.join(lacking)}, whose nodes the launch files start.",
        "add <exec_depend>NAME</exec_depend>",
    )
    maps = [node.args for node in plan.nodes if node.package == "map_server"]
    expect(maps, "No launch file starts a map_server.")
    inside = Path(maps[0].strip()).resolve().is_relative_to(folder.resolve())
    expect(inside, "The map is not in the package.", "save it to the folder maps")


def _run_test(folder: Path, file: Path) -> None:
    """Run the first test of a file in a house without trouble."""
    with _started(folder, file, "Without trouble") as drive:
        tests = drive.launch.plan.tests
        expect(tests, f"{file.name} has no <test>.", "see the section A test")
        test = drive.launch.start_node(tests[0])
        if test is None:
            raise Wrong(f"The test {tests[0].executable} could not be started.", "does it exist, and may it be run?")
        test.asked_to_end = True
        night = drive.night(Trouble())
        _expect_alive(drive)
        judge(night, Trouble())
        drive.graph.run(5.0, until=lambda: test.handle.poll() is not None)
        ended = test.handle.poll()
        expect(ended is not None, "The patrol is done, but its test does not end.", "end it after the report done")
        expect(ended == 0, "The test fails in a house without trouble.", "see the exercise patrol_test")


def _expect_alive(drive: Patrol) -> None:
    """Expect that no node of a launch has crashed."""
    for made in drive.launch.running:
        code = made.handle.poll()
        expect(
            not code or made.asked_to_end,
            f"{made.node.full_name} ended with exit status {code}.",
            "roslaunch shows why",
        )
