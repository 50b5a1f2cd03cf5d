"""The node `rosmini_sim/simulator`: a TurtleBot3 in a world, with the topics of the real one.

It subscribes to `cmd_vel` and publishes `scan`, `odom`, `/tf`, `joint_states` and `imu` at the rates of the robot's firmware, and beside them
`base_pose_ground_truth`, where the robot really is (Stage's name; no real robot knows that). It offers `reset_positions` (Stage's name too).

As on the real robot (firmware 1.2.3) and in Stage, a command holds for a moment only: half a second after the last `cmd_vel` the robot stops. So
whoever drives it repeats the command, as `rostopic pub -r 10` does. `_cmd_vel_timeout:=0` lets it go on, as in Gazebo.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rosmini.geometry.poses import Pose
from rosmini.graph import Node, Publisher
from rosmini.graph.show import show
from rosmini.msgs import message_class, service_class

from .engine import Engine, RobotGone
from .imu import Imu
from .lidar import unmeasured
from .messages import (
    BASE,
    MAP,
    ODOM,
    Headed,
    ImuMessage,
    JointStates,
    OdometryMessage,
    ScanMessage,
    TransformMessage,
)
from .models import RobotModel
from .models import model as model_called
from .odometry import Odometry
from .parameters import Parameters, parameter
from .robot import Robot
from .world import World
from .worlds import world as world_called

COMMAND_TIMEOUT = 0.5
"""How long a command holds [s]: CONTROL_MOTOR_TIMEOUT of TurtleBot3's firmware."""

LAG_S = 0.25
"""A simulator that is farther behind the clock on the wall lets the time go instead of running after it."""


@dataclass(frozen=True)
class SimulatorParameters(Parameters):
    """The private parameters of `rosmini_sim/simulator`."""

    world: str = parameter("room", "which world: a name, or a map's yaml file")
    model: str | None = parameter(None, "which robot; without it what TURTLEBOT3_MODEL says, else burger")
    x: float | None = parameter(
        None, "where the robot starts; without it at the world's first start", unit="m"
    )
    y: float | None = parameter(None, "where the robot starts", unit="m")
    yaw: float | None = parameter(None, "its heading there, counter-clockwise from the x axis", unit="rad")
    noise: float = parameter(1.0, "scales every error of wheels and sensors; 0: none", minimum=0.0)
    cmd_vel_timeout: float = parameter(
        COMMAND_TIMEOUT, "how long a command holds; 0: until the next", unit="s", minimum=0.0
    )
    tf: bool = parameter(True, "publish the transform from odom to base_footprint")
    use_rep_117: bool = parameter(
        True,
        "write inf for what is too far and -inf for what is too near; else 0.0, as a real LDS-01 does",
    )


class _Beat:
    """Something that happens `rate` times a second from `start_ns` on."""

    def __init__(self, rate: float, start_ns: int) -> None:
        self.period = 1e9 / rate
        self.start_ns = start_ns
        self.number = 1
        self.due_ns = self._at(1)

    def _at(self, number: int) -> int:
        return self.start_ns + round(number * self.period)

    def next(self) -> None:
        """Go on by one."""
        self.number += 1
        self.due_ns = self._at(self.number)

    def skip(self, now_ns: int) -> None:
        """Go on to the first that is after this time."""
        if self.due_ns <= now_ns:
            self.number = int((now_ns - self.start_ns) / self.period) + 1
            self.due_ns = self._at(self.number)
            if self.due_ns <= now_ns:
                self.next()

    def delay(self, by_ns: int) -> None:
        """Let all that is to come be later."""
        self.start_ns += by_ns
        self.due_ns += by_ns


class Simulator:
    """One robot in a world, as a node of a graph.

    Args:
        node: the started node; its private parameters say which world and robot (`SimulatorParameters`).
        world: the world, or its name; before the parameter.
        model: the robot, or its name; before the parameter.

    Raises:
        WorldError: there is no such world, or the robot has no room where it is to start.
        UnknownModel: there is no such robot.
        ParameterError: a parameter has no such name, a wrong type, or a value out of range.

    """

    def __init__(
        self, node: Node, *, world: World | str | None = None, model: RobotModel | str | None = None
    ) -> None:
        self.node = node
        self.parameters = SimulatorParameters.read(node)
        world = self.parameters.world if world is None else world
        model = self.parameters.model if model is None else model
        self.world = world if isinstance(world, World) else world_called(world)
        self.model = model if isinstance(model, RobotModel) else model_called(model)
        self.name = self.model.name
        noise = self.parameters.noise
        self.engine = Engine(self.world, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=noise)
        self._robot: Robot | None = self.engine.add(self.name, self.model, self._start())
        self._odometry = Odometry(self.model)
        self._imu = Imu(self.model.imu, node.graph.rng(f"{node.name}/{self.name}/imu"), noise)
        self._lidar_rng = node.graph.rng(f"{node.name}/{self.name}/lidar")
        self._scanned = False
        self.scan_pose: Pose = self._robot.pose
        """Where the robot was when it took the last scan."""
        self._complained: set[str] = set()
        self._lag_ns = int(LAG_S * 1e9 * max(1.0, node.scheduler.rate))
        self.engine.scan(
            self.name
        )  # where numba has to compile, it does so now and not while the robot drives
        self._open()
        self._begin()
        node.on_shutdown(self._end)

    def __repr__(self) -> str:
        what = (
            "removed"
            if self._robot is None
            else f"{self.name} at ({self._robot.pose[0]:.2f}, {self._robot.pose[1]:.2f})"
        )
        return f"<Simulator {self.node.name}: {what} in {self.world.name}>"

    def _start(self) -> Pose | None:
        """Where the parameters put the robot: what they do not say is taken from the world's first start."""
        given = (self.parameters.x, self.parameters.y, self.parameters.yaw)
        if given == (None, None, None):
            return None
        start = self.world.starts[0]
        x, y, yaw = (own if part is None else part for part, own in zip(given, start, strict=True))
        return (x, y, yaw)

    # -- topics --------------------------------------------------------------------------------------------------

    def _open(self) -> None:
        node = self.node
        odometry = message_class("nav_msgs/Odometry")
        self._scan = ScanMessage(self.model)
        self._imu_message = ImuMessage(self.model.imu.frame)
        self._odom = OdometryMessage(ODOM, BASE)
        self._truth = OdometryMessage(MAP, BASE)
        self._transform = TransformMessage(ODOM, BASE)
        self._joints = JointStates()
        self._to_scan = node.publisher("scan", type(self._scan.message), queue_size=5)
        self._to_imu = node.publisher("imu", type(self._imu_message.message), queue_size=50)
        self._to_odom = node.publisher("odom", odometry, queue_size=30)
        self._to_truth = node.publisher("base_pose_ground_truth", odometry, queue_size=30)
        self._to_tf = (
            node.publisher("/tf", message_class("tf2_msgs/TFMessage"), queue_size=100)
            if self.parameters.tf
            else None
        )
        self._to_joints = node.publisher("joint_states", type(self._joints.message), queue_size=30)
        self._commands = node.subscriber(
            "cmd_vel", message_class("geometry_msgs/Twist"), self._command, queue_size=1
        )
        self._service = node.service(
            "reset_positions", service_class("std_srvs/Empty"), self._reset_positions
        )

    def _publishers(self) -> list[Publisher]:
        every = [self._to_scan, self._to_imu, self._to_odom, self._to_truth, self._to_tf, self._to_joints]
        return [publisher for publisher in every if publisher is not None]

    def _command(self, message: Any) -> None:
        if self._robot is None:
            return
        v, w = message.linear.x, message.angular.z
        for field, value in (("linear.x", v), ("angular.z", w)):
            if not math.isfinite(value):
                self._refuse(message, field, value)
                v = w = 0.0
        self.engine.advance(self._now())
        self.engine.command(self.name, v, w, self.parameters.cmd_vel_timeout)

    def _refuse(self, message: Any, field: str, value: float) -> None:
        sender = (message._connection_header or {}).get("callerid", "somebody")
        if sender not in self._complained:
            self._complained.add(sender)
            self.node.logwarn(
                f"{sender} published {field} = {value} on {self._commands.topic}: a velocity has to be a finite number. "
                f"The robot stops instead, and so it will at each such message of {sender}, without another warning."
            )

    def _reset_positions(self, _: Any) -> dict[str, Any]:
        self.reset()
        return {}

    # -- time ----------------------------------------------------------------------------------------------------

    def _begin(self) -> None:
        self._start_ns = self.node.clock.now_ns()
        model = self.model
        rates = (model.rate, model.lidar.rate, model.imu.rate)
        self._beats = tuple(_Beat(rate, self._start_ns) for rate in rates)
        self._next(min(beat.due_ns for beat in self._beats))

    def _wake(self) -> None:
        """Go on. An event of the queue without a lane, for nothing in it can block."""
        due = self._due_ns
        try:
            self.node.guarded(self._tick, what="physics")
        finally:
            if self._robot is not None and self._due_ns == due:  # an error or Ctrl-C came in between
                for beat in self._beats:
                    beat.skip(due)
                self._next(min(beat.due_ns for beat in self._beats))

    def _next(self, due_ns: int) -> None:
        """Ask to be called then."""
        self._due_ns = due_ns
        self._cancel = self.node.clock.call_at(due_ns, self._wake)

    def _tick(self) -> None:
        robot = self._robot
        if robot is None:
            return
        due = self._due_ns
        behind = self.node.clock.now_ns() - due
        if behind > self._lag_ns or behind < -self._lag_ns:  # the computer is too slow, or the clock was set
            self._start_ns += behind
            for beat in self._beats:
                beat.delay(behind)
            due += behind
        self.engine.advance((due - self._start_ns) * 1e-9)
        stamp = divmod(due, 1_000_000_000)
        drive, scan, imu = self._beats
        if drive.due_ns == due:
            self._tell_drive(robot, stamp)
            drive.next()
        if scan.due_ns == due:
            self._tell_scan(robot, stamp)
            scan.next()
        following = min(drive.due_ns, scan.due_ns)
        if self._to_imu.num_connections():
            if imu.due_ns == due:
                self._send(
                    self._to_imu,
                    self._imu_message,
                    stamp,
                    self._imu_message.fill(self._imu, imu.number, robot),
                )
                imu.next()
            elif imu.due_ns < due:
                imu.skip(due)
            following = min(following, imu.due_ns)
        self._next(following)

    def _send(self, publisher: Publisher, told: Headed, stamp: tuple[int, int], message: Any) -> None:
        told.stamp(*stamp)
        publisher.publish(message)

    def _tell_drive(self, robot: Robot, stamp: tuple[int, int]) -> None:
        odometry = self._odometry
        odometry.update(*robot.ticks, 1 / self.model.rate)
        if self._to_odom.num_connections():
            self._send(
                self._to_odom, self._odom, stamp, self._odom.fill(odometry.pose, odometry.v, odometry.w)
            )
        if self._to_tf is not None and self._to_tf.num_connections():
            self._send(self._to_tf, self._transform, stamp, self._transform.fill(odometry.pose))
        if self._to_joints.num_connections():
            self._send(self._to_joints, self._joints, stamp, self._joints.fill(odometry))
        if self._to_truth.num_connections():
            motion = robot.motion()
            self._send(self._to_truth, self._truth, stamp, self._truth.fill(robot.pose, motion.v, motion.w))

    def _tell_scan(self, robot: Robot, stamp: tuple[int, int]) -> None:
        lidar, scale = self.model.lidar, self.parameters.noise
        noise = self._lidar_rng.standard_normal(lidar.beams) * (lidar.noise * scale) if scale else None
        ranges = self.engine.scan(self.name, noise)
        self.scan_pose = robot.pose
        self._scanned = True
        message = self._scan.fill(ranges if self.parameters.use_rep_117 else unmeasured(ranges))
        self._scan.stamp(*stamp)
        if self._to_scan.num_connections():
            self._to_scan.publish(message)

    # -- for who started it --------------------------------------------------------------------------------------

    def _there(self) -> Robot:
        if self._robot is None:
            why = f"the node {self.node.name} was shut down" if self.node.is_shutdown() else "it was removed"
            msg = f"the robot {self.name!r} is no longer in the world {self.world.name!r}: {why}. Start another simulator."
            raise RobotGone(msg)
        return self._robot

    def _now(self) -> float:
        return (self.node.clock.now_ns() - self._start_ns) * 1e-9

    def truth(self, robot: str = "") -> Pose:
        """Where the robot really is now: x [m], y [m], heading [rad, not wrapped], in the frame map. Raises `RobotGone`."""

        def look() -> Pose:
            self._there()
            return self.engine.peek(robot or self.name, self._now())

        return self.node.scheduler.on_hub(look)

    @property
    def odometry(self) -> Pose:
        """Where the robot believes to be, by its last odometry: x [m], y [m], heading [rad, not wrapped], in the frame odom."""
        return self._odometry.pose

    def place(self, pose: Pose) -> None:
        """Lift the robot and put it down elsewhere, at rest; its odometry does not notice. Raises `WorldError` and `RobotGone`."""

        def put() -> None:
            self._there()
            self.engine.advance(self._now())
            self.engine.place(self.name, pose)

        self.node.scheduler.on_hub(put)

    def reset(self) -> None:
        """Put the robot and all movable obstacles back to where they began, with odometry at zero. Raises `RobotGone`."""

        def put_back() -> None:
            self._there()
            self.engine.advance(self._now())
            self.engine.reset()
            self._odometry = Odometry(self.model)

        self.node.scheduler.on_hub(put_back)

    def last_scan(self) -> Any:
        """The last `sensor_msgs/LaserScan`, whether anybody heard it or not; None before the first. Raises `RobotGone`."""

        def copy() -> Any:
            self._there()
            cls = type(self._scan.message)
            return cls._thaw_numpy(cls._freeze(self._scan.message)) if self._scanned else None

        return self.node.scheduler.on_hub(copy)

    def remove(self) -> None:
        """Take the robot out of the world: its topics end, and the graph goes on. Harmless when repeated."""
        self.node.scheduler.on_hub(self._remove)

    def _remove(self) -> None:
        if self._robot is None:
            return
        self._end()
        self.engine.remove(self.name)
        for publisher in self._publishers():
            publisher.unregister()
        self._commands.unregister()
        self._service.shutdown("the robot was removed")

    def _end(self) -> None:
        """Stop to let time pass."""
        self._cancel()
        self._robot = None

    # -- pictures ------------------------------------------------------------------------------------------------

    def show(self, **options: Any) -> Any:
        """A picture of the robot in its world; the options are those of the renderer "simulation" in `rosmini.viz`."""
        return show("simulation", self, **options)

    def show3d(self, **options: Any) -> Any:
        """The robot in its world, to be turned; the options are those of the renderer "simulation_3d" in `rosmini.viz`."""
        return show("simulation_3d", self, **options)

    def pad(self, **options: Any) -> Any:
        """A pad to drive the robot with; the options are those of the renderer "teleop_pad" in `rosmini.widgets`."""
        return show("teleop_pad", self, **options)
