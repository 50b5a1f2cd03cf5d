"""The node `stage_ros/stageros`: the robots of a Stage world file in a graph.

    rosrun stage_ros stageros [-g] [-u] world/willow-erratic.world

For each robot it subscribes to `cmd_vel`, and publishes `odom`, `base_scan` and `base_pose_ground_truth`; for all of
them `/tf` and `/clock`; everything once per step of the simulation (`interval_sim`, usually 0.1 s). With several robots
each has a namespace: `/robot_0` and so on. The service `reset_positions` returns everything to its initial pose. Time
starts at 0, and /use_sim_time is set, so that nodes that start later use it.

After 0.2 s without a command to any robot all of them stop: `~base_watchdog_timeout`. They share one watchdog, as in
stageros: a robot without commands continues while another one receives some.

Facts: http://wiki.ros.org/stage_ros, and stageros.cpp of https://github.com/ros-simulation/stage_ros. Differences:
frames have no leading slash; several transforms are in one message; bodies touch, slide and push (in Stage a robot
stops before a contact); cameras are not simulated.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import IllegalName, RosminiError, ScriptError, nearest
from rosmini.core.geometry.angles import quaternion_from_yaw
from rosmini.core.geometry.poses import Pose
from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import service_class
from rosmini.sim.devices.clock import ClockDevice
from rosmini.sim.engine import Engine, RobotGone
from rosmini.sim.host import Host
from rosmini.sim.models import RobotModel
from rosmini.sim.simulation import Simulation

from .bases import laser_model, robot_model
from .devices import End, StageBase, StageLaserDevice, StageTransforms, StageTruth, Watchdog
from .errors import StageError
from .odometry import STILL
from .robot_names import Names
from .robots import StageRobot
from .world_file import StageWorld, load

USAGE = "Usage: stageros [-g] [-u] <worldfile>   (-g: no window; -u: topics by the names of the models)"
WATCHDOG = 0.2

WINDOWLESS_RATE = 10.0
"""Step rate of stageros without a window [Hz], whatever the step's duration and `speedup`."""


@dataclass(frozen=True)
class StageParameters(Parameters):
    """The private parameters of `stage_ros/stageros`."""

    base_watchdog_timeout: float = parameter(
        WATCHDOG, "all robots stop after this time without a command; 0: never", unit="s"
    )


class OneRobot:
    """A robot of stageros, with its devices."""

    def __init__(self, stage: Stageros, robot: StageRobot, name: str, names: Names) -> None:
        self.file = robot
        """Its description in the world file."""
        self.name = name
        """The engine's name for it: robot_0, or its own name with -u."""
        self.names = names
        host, interval = stage.host, stage.file.interval
        self.base = host.add(StageBase(host, name, robot, names, stage.watchdog.feed))
        stage.watchdog.bases.append(self.base)
        stage.transforms.base(self.base, names)
        host.add(StageTruth(host, name, names))
        self.lasers: list[StageLaserDevice] = []
        for i, laser in enumerate(robot.lasers):
            number = i if len(robot.lasers) > 1 else None
            frame = names.frame("base_laser_link", number)
            model = laser_model(laser, names.topic("base_scan", number), interval)
            if not i and self.model.lidar is not None:
                model = self.model.lidar
            label = f"{name}/base_scan{'' if number is None else f'_{number}'}"
            topic = names.topic("base_scan", number)
            self.lasers.append(host.add(StageLaserDevice(host, name, label, laser, model, topic=topic, frame=frame)))
            place = (laser.pose[0], laser.pose[1], laser.pose[2])
            stage.transforms.sensor(names.frame("base_link"), frame, place, quaternion_from_yaw(laser.pose[3]))

    @property
    def model(self) -> RobotModel:
        """The engine's model of it."""
        return self.base.model

    @property
    def namespace(self) -> str:
        """The namespace of its topics: robot_0; empty for a single robot."""
        return self.names.prefix


class Stageros(Simulation):
    """A Stage world in a graph.

    Args:
        node: the started node.
        arguments: as on the command line: -g, -u, and the world file, its path or `package://` address.

    Raises:
        ScriptError: the arguments are invalid.
        StageError: the file cannot be read, or a robot has no room at its start.
        ParameterError: a parameter has an unknown name, a wrong type, or a value out of range.

    """

    program = "stage_ros/stageros"

    def __init__(self, node: Node, *arguments: str) -> None:
        path, by_model, window = _options(arguments)
        self.parameters = StageParameters.read(node)
        self.file: StageWorld = load(path)
        self.world = self.file.world
        if self.file.notes:
            log = node.logwarn if self.file.left_out else node.loginfo
            log("\n".join([f"{self.file.path} is not read as Stage itself would read it:", *self.file.notes]))
        engine = Engine(self.world, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=0.0)
        speed = self.file.speedup if window else WINDOWLESS_RATE * self.file.interval
        super().__init__(node, Host(node, engine, from_zero=True, speed=speed, paused=True))
        rate = 1 / self.file.interval
        node.set_param("/use_sim_time", True)
        self.watchdog = self.host.add(Watchdog(self.host, rate, self.parameters.base_watchdog_timeout))
        self.transforms = self.host.add(StageTransforms(self.host, rate))
        self.robots: dict[str, OneRobot] = {}
        """The robots by the engine's names: robot_0, robot_1 ..., in the order of the file."""
        self._bring(by_model=by_model)
        self.clock = self.host.add(ClockDevice(self.host, rate=rate))
        if self.file.quit_time:
            self.host.add(End(self.host, rate, self.file.quit_time, self._quit))
        self._service = node.service("reset_positions", service_class("std_srvs/Empty"), self._reset_positions)
        self.host.unpause()  # only now, because a kernel may have been compiled meanwhile

    def _bring(self, *, by_model: bool) -> None:
        alone = len(self.file.robots) == 1
        found = []
        for robot in self.file.robots:
            names = Names.of(robot, alone=alone, by_model=by_model)
            name = names.prefix or f"robot_{robot.number}"
            model = robot_model(robot, self.file.interval)
            try:
                self.engine.add(name, model, robot.pose)
            except RosminiError as error:
                raise StageError(robot.place, str(error), "a robot cannot start there") from error
            found.append((robot, name, names))
        for robot, name, names in found:
            try:
                self.robots[name] = OneRobot(self, robot, name, names)
            except IllegalName as error:
                what = f"with -u the name of {robot.name!r} is that of its topics, and that it cannot be: {error}"
                raise StageError(robot.place, what) from error
            devices = f"{len(robot.lasers)} laser{'' if len(robot.lasers) == 1 else 's'} and 0 cameras"
            self.node.loginfo(f"robot {robot.number}, {robot.name}, has {devices}")

    # -- events --------------------------------------------------------------------------------------------------

    def _reset_positions(self, _: Any) -> dict[str, Any]:
        self.reset()
        return {}

    def _quit(self) -> None:
        self.node.scheduler.call_soon(lambda: self.node.shutdown("quit_time of the world file"))

    # -- for Python ----------------------------------------------------------------------------------------------

    def robot(self, name: str = "") -> OneRobot:
        """Return the robot of this name (robot_0, or its name in the file), or the first. Raises `RobotGone`."""
        self._check_running()
        if not self.robots:
            raise RobotGone(f"the world {self.file.name!r} has no robots: none of its models is a position")
        if not name:
            return next(iter(self.robots.values()))
        if name in self.robots:
            return self.robots[name]
        titled = {each.file.name: each for each in self.robots.values()}
        if name in titled:
            return titled[name]
        hint = nearest(name, [*self.robots, *titled])
        there = ", ".join(f"{each.name} ({each.file.name})" for each in self.robots.values())
        raise RobotGone(
            f"there is no robot {name!r} in the world {self.file.name!r} (robots: {there}). {hint}".rstrip()
        )

    @property
    def name(self) -> str:
        """The first robot's name."""
        return self.robot().name

    @property
    def model(self) -> RobotModel:
        """The first robot's model."""
        return self.robot().model

    def _entity(self, name: str) -> str:
        if any(each.name == name for each in self.engine.world.obstacles):
            return name
        return self.robot(name).name

    def _drag(self, name: str, pose: Pose) -> None:
        """Drag as in Stage's window: clear the robot's command; odometry with localization "odom" does not change."""
        super()._drag(name, pose)
        robot = self.robots.get(self._entity(name))
        if robot is not None:
            robot.base.reckoning.set_velocity(STILL, self.host.engine_now)


def _options(arguments: tuple[str, ...]) -> tuple[str, bool, bool]:
    """Return the world file, whether -u was given, and whether there is a window. Raises `ScriptError`."""
    files = [each for each in arguments if not each.startswith("-")]
    flags = [each for each in arguments if each.startswith("-")]
    unknown = [each for each in flags if each not in ("-g", "-u")]
    if unknown or len(files) != 1:
        what = (
            f"stageros knows no option {unknown[0]}" if unknown else f"stageros needs one world file, not {len(files)}"
        )
        raise ScriptError(f"{what}.\n{USAGE}")
    return os.fspath(files[0]), "-u" in flags, "-g" not in flags
