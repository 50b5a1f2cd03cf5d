"""The node `stage_ros/stageros`: the robots of a Stage world file on a graph.

    rosrun stage_ros stageros [-g] [-u] world/willow-erratic.world

Of each robot it subscribes to `cmd_vel`, and publishes `odom`, `base_scan`, `base_pose_ground_truth`, and, of a camera, `image`, `depth` and `camera_info`; and
for all of them `/tf` and `/clock`, all of it once a step of the simulation (`interval_sim`, as a rule 0.1 s). Of several robots each has a namespace,
`/robot_0` and so on. The service `reset_positions` puts all back to where they began. Time begins at 0, and /use_sim_time is set, so that nodes that
start later live on it.

After 0.2 s without a command to any robot all of them stop: `~base_watchdog_timeout`. It is one watchdog for all, as in stageros: who is told nothing more goes on
while another one is told something.

Facts: http://wiki.ros.org/stage_ros, and stageros.cpp of https://github.com/ros-simulation/stage_ros. What differs from there: base_link is where it is there, but
frames have no slash before them; messages of several transforms are one; bodies touch, slide and push (there a robot that would touch something stays
where it is); with -g there are cameras too.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import IllegalName, RosminiError, ScriptError, nearest
from rosmini.geometry.angles import quaternion_from_yaw
from rosmini.geometry.poses import Pose
from rosmini.graph import Node
from rosmini.graph.show import show
from rosmini.msgs import service_class
from rosmini.sim.devices.clock import ClockDevice
from rosmini.sim.dragging import drag
from rosmini.sim.engine import Engine, RobotGone
from rosmini.sim.host import Host, HostState
from rosmini.sim.models import RobotModel
from rosmini.sim.parameters import Parameters, parameter

from .bases import laser_model, robot_model
from .camera import StageCameraDevice
from .devices import End, StageBase, StageLaserDevice, StageTransforms, StageTruth, Watchdog
from .errors import StageError
from .file import StageWorld, load
from .names import Names
from .odometry import STILL
from .robots import StageRobot

USAGE = "Usage: stageros [-g] [-u] <worldfile>   (-g: no window; -u: topics by the names of the models)"
WATCHDOG = 0.2


@dataclass(frozen=True)
class StageParameters(Parameters):
    """The private parameters of `stage_ros/stageros`."""

    base_watchdog_timeout: float = parameter(
        WATCHDOG, "without a command for so long all robots stop; 0: never", unit="s", minimum=0.0
    )
    is_depth_canonical: bool = parameter(
        True, "publish depth as 32FC1 in metres (REP 118); else as 16UC1 in millimetres"
    )


class OneRobot:
    """A robot of stageros, and what it publishes."""

    def __init__(self, stage: Stageros, robot: StageRobot, name: str, names: Names) -> None:
        self.file = robot
        """What the world file says of it."""
        self.name = name
        """What the engine calls it: robot_0, or its own name with -u."""
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
            self.lasers.append(
                host.add(StageLaserDevice(host, name, label, laser, model, topic=topic, frame=frame))
            )
            place = (laser.pose[0], laser.pose[1], laser.pose[2])
            stage.transforms.sensor(
                names.frame("base_link"), frame, place, quaternion_from_yaw(laser.pose[3])
            )
        self.cameras = [self._camera(stage, i) for i in range(len(robot.cameras))]

    @property
    def model(self) -> RobotModel:
        """What the engine knows of it."""
        return self.base.model

    @property
    def namespace(self) -> str:
        """What its topics begin with: robot_0; empty for a robot that is alone."""
        return self.names.prefix

    def _camera(self, stage: Stageros, i: int) -> StageCameraDevice:
        robot, names = self.file, self.names
        number = i if len(robot.cameras) > 1 else None
        rate, canonical = 1 / stage.file.interval, stage.parameters.is_depth_canonical
        camera = stage.host.add(
            StageCameraDevice(
                stage.host, self.name, robot.cameras[i], names, number, rate=rate, canonical=canonical
            )
        )
        place = robot.cameras[i].pose[:3]
        stage.transforms.sensor(
            names.frame("base_link"), camera.frame, place, camera.rotation(), camera.wanted
        )
        return camera


class Stageros:
    """A Stage world on a graph.

    Args:
        node: the started node.
        arguments: as on the command line: -g, -u, and the world file, its path or `package://` address.

    Raises:
        ScriptError: the arguments are none.
        StageError: the file cannot be read, or a robot has no room where it is to start.
        ParameterError: a parameter has no such name, a wrong type, or a value out of range.

    """

    def __init__(self, node: Node, *arguments: str) -> None:
        self.node = node
        path, by_model = _options(arguments)
        self.parameters = StageParameters.read(node)
        self.file: StageWorld = load(path)
        self.world = self.file.world
        for note in self.file.notes:
            node.loginfo(note)
        self.engine = Engine(self.world, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=0.0)
        self.host = Host(node, self.engine, from_zero=True, speed=self.file.speedup, paused=True)
        rate = 1 / self.file.interval
        self._ended = False
        node.set_param("/use_sim_time", True)
        self.watchdog = self.host.add(Watchdog(self.host, rate, self.parameters.base_watchdog_timeout))
        self.transforms = self.host.add(StageTransforms(self.host, rate))
        self.robots: dict[str, OneRobot] = {}
        """By the names that the engine has for them: robot_0, robot_1 ..., in the sequence of the file."""
        self._bring(by_model=by_model)
        self.clock = self.host.add(ClockDevice(self.host, rate=rate))
        if self.file.quit_time:
            self.host.add(End(self.host, rate, self.file.quit_time, self._quit))
        self._service = node.service(
            "reset_positions", service_class("std_srvs/Empty"), self._reset_positions
        )
        node.on_shutdown(self._end)
        self.host.unpause()  # only now: a kernel may have had to be compiled meanwhile

    def __repr__(self) -> str:
        return f"<Stageros {self.node.name}: {_count(len(self.robots), 'robot')} in {self.file.name}>"

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
                raise StageError(robot.place, str(error)) from error
            found.append((robot, name, names))
        for robot, name, names in found:
            try:
                self.robots[name] = OneRobot(self, robot, name, names)
            except IllegalName as error:
                what = f"with -u the name of {robot.name!r} is that of its topics, and that it cannot be: {error}"
                raise StageError(robot.place, what) from error
            if robot.lasers:
                self.engine.scan(name)  # where numba has to compile, it does so now
            devices = f"{_count(len(robot.lasers), 'laser')} and {_count(len(robot.cameras), 'camera')}"
            self.node.loginfo(f"robot {robot.number}, {robot.name}, has {devices}")

    # -- what happens --------------------------------------------------------------------------------------------

    def _reset_positions(self, _: Any) -> dict[str, Any]:
        self.reset()
        return {}

    def _quit(self) -> None:
        self.node.scheduler.call_soon(lambda: self.node.shutdown("quit_time of the world file"))

    def _end(self) -> None:
        self._ended = True
        self.host.end()

    # -- for who started it --------------------------------------------------------------------------------------

    def robot(self, name: str = "") -> OneRobot:
        """The robot of this name (robot_0, or the one that the file gives it), or the first. Raises `RobotGone`."""
        if self._ended:
            raise RobotGone(f"the node {self.node.name} was shut down; start another stageros")
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

    def truth(self, robot: str = "") -> Pose:
        """Where a robot really is now: x [m], y [m], heading [rad, not wrapped], in the world's frame. Raises `RobotGone`."""
        return self.node.scheduler.on_hub(
            lambda: self.engine.peek(self.robot(robot).name, self.host.engine_now)
        )

    def drag(self, name: str, pose: Pose) -> None:
        """Take a robot, or a thing that can be pushed, and put it down elsewhere, as one does with the mouse in Stage's window.

        A robot forgets its command; with localization "odom" it does not notice that it is elsewhere. Raises `WorldError` if something stands there,
        and `RobotGone` if there is nothing of this name.
        """

        def put() -> None:
            self.host.catch_up()
            if any(each.name == name for each in self.engine.world.obstacles):
                drag(self.engine, name, pose)
                return
            robot = self.robot(name)
            drag(self.engine, robot.name, pose)
            robot.base.reckoning.told(STILL, self.host.engine_now)

        self.node.scheduler.on_hub(put)

    def reset(self) -> None:
        """Put all robots, and all that was pushed, back to where it was: the service `reset_positions`. Odometry goes on. Raises `RobotGone`."""

        def put_back() -> None:
            if self._ended:
                raise RobotGone(f"the node {self.node.name} was shut down; start another stageros")
            self.host.reset()

        self.node.scheduler.on_hub(put_back)

    def pause(self) -> None:
        """Let the world's time stand."""
        self.node.scheduler.on_hub(self.host.pause)

    def unpause(self) -> None:
        """Let the world's time go on."""
        self.node.scheduler.on_hub(self.host.unpause)

    def save(self) -> HostState:
        """All that goes on from here: poses, velocities, odometry, noise that is to come, and the time. It can be pickled.

        Messages that are on their way are no part of it. What was published in a step is heard right after that step: whoever saves between the two
        hears it before what follows, and whoever restores then hears first what was published last before, with its later stamp.
        """
        return self.node.scheduler.on_hub(self.host.save)

    def restore(self, state: HostState) -> None:
        """Go on, to the last bit, as it went on after `save`; time goes back too, and with it /clock.

        Raises `RosminiError` for what is no state of a stageros, or that of another world.
        """

        def become() -> None:
            if isinstance(state, HostState) and state.engine.world.name != self.world.name:
                there = state.engine.world.name
                msg = f"a state of the world {there!r} cannot be restored in the world {self.world.name!r}"
                raise RosminiError(msg)
            self.host.restore(state)

        self.node.scheduler.on_hub(become)

    @property
    def speedup(self) -> float:
        """How many seconds of the world pass in one."""
        return self.host.speed

    @speedup.setter
    def speedup(self, speed: float) -> None:
        self.host.speed = speed

    def last_scan(self, robot: str = "") -> Any:
        """The last `sensor_msgs/LaserScan` of a robot's first laser, whether anybody heard it or not; None before the first. Raises `RobotGone`."""

        def copy() -> Any:
            lasers = self.robot(robot).lasers
            return lasers[0].message if lasers else None

        return self.node.scheduler.on_hub(copy)

    @property
    def scan_pose(self) -> Pose:
        """Where the first robot was when its laser measured last."""
        robot = self.robot()
        return robot.lasers[0].pose if robot.lasers else robot.base.robot.pose

    @property
    def scan_poses(self) -> NDArray[np.float64]:
        """The same for a picture of the scan (1, 3): Stage measures all beams at once."""
        return np.array([self.scan_pose])

    def pad(self, robot: str = "", **options: Any) -> Any:
        """A pad to drive a robot with, the first if none is named. Raises `RobotGone`.

        Options, with what they are unless given:
            topic='cmd_vel': where to publish, as the simulation's node calls it: in its namespace, remapped as it is there
            name='teleop_pad': the name of the pad's node
            limits=None: how fast at most; None: as fast as the robot may
            title=None: a caption under the pad, and the first line of its text form
        """
        return show("teleop_pad", self, robot=self.robot(robot).name, **options)

    def view(self, **options: Any) -> Any:
        """The running world, in which robots and boxes are dragged.

        Options, with what they are unless given:
            title=None: a caption under the view, and the first line of its text form
        """
        return show("simulation_view", self, **options)

    def show3d(self, **options: Any) -> Any:
        """The world with its robots, to be turned.

        Options, with what they are unless given:
            focus='robot': what the camera looks at, or 'world'
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg]: at 0 from the side of x, at 90 from the side of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("simulation_3d", self, **options)

    def show(self, **options: Any) -> Any:
        """A picture of the world with its robots.

        Options, with what they are unless given:
            scan=True: draw the first robot's last scan from where it was taken; there is none before its laser's first revolution
            trail=None: where the robot was: a `Recording`, of which odometry is drawn, too, or poses (n, 2) or (n, 3)
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("simulation", self, **options)


def _options(arguments: tuple[str, ...]) -> tuple[str, bool]:
    """The world file, and whether -u was given. Raises `ScriptError`."""
    files = [each for each in arguments if not each.startswith("-")]
    flags = [each for each in arguments if each.startswith("-")]
    unknown = [each for each in flags if each not in ("-g", "-u")]
    if unknown or len(files) != 1:
        what = (
            f"stageros knows no option {unknown[0]}"
            if unknown
            else f"stageros needs one world file, not {len(files)}"
        )
        raise ScriptError(f"{what}.\n{USAGE}")
    return os.fspath(files[0]), "-u" in flags


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
