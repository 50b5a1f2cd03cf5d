"""A TurtleBot3, or another robot with a drive, in a simulator: its devices, topics and frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeVar

from rosmini.core.geometry.poses import Pose

from .devices.board import BatteryDevice, SensorStateDevice, Switches
from .devices.camera import CameraDevice
from .devices.drive import DifferentialDrive, GroundTruth, JointStates, PlanarMove
from .devices.imu import ImuDevice
from .devices.laser import Laser
from .devices.namespaces import prefixed, within
from .devices.sensor import Sensor
from .engine.robot import Robot
from .host import Device, Host
from .messages import BASE, BASE_LINK, MAP, ODOM
from .models import BURGER, CameraModel, RobotModel
from .sensors.battery import BURGER_BATTERY, WAFFLE_BATTERY, Battery

D = TypeVar("D", bound=Device)
S = TypeVar("S", bound=Sensor)

COMMAND_TIMEOUT = 0.5
"""Duration of a command [s]: CONTROL_MOTOR_TIMEOUT of TurtleBot3's firmware."""


ODOMETRY = ("imu", "wheels")
"""Sources of the heading in odometry: the IMU, as in TurtleBot3's firmware, or the wheels, as in Gazebo."""


@dataclass(frozen=True)
class Options:
    """Settings of the robots of one simulator."""

    noise: float = 1.0
    cmd_vel_timeout: float = COMMAND_TIMEOUT
    tf: bool = True
    use_rep_117: bool = True
    board: bool = False
    """True to publish sensor_state and battery_state, and subscribe to motor_power and reset."""
    battery: float = 1.0
    """Initial charge level of the battery."""
    odometry: str = ODOMETRY[0]
    """One of `ODOMETRY`; a robot without an IMU, or not on two wheels, always uses the wheels."""
    sweep: bool = True
    """True if the laser measures one beam after another."""


class TurtleBot:
    """Adds the devices of a robot in the engine to the host.

    Args:
        host: the simulated world.
        robot: the engine's robot.
        namespace: the namespace of its topics, relative to the node's namespace.
        tf_prefix: the prefix of its frames.
        options: its settings.

    """

    def __init__(self, host: Host, robot: Robot, *, namespace: str = "", tf_prefix: str = "", options: Options) -> None:
        self.host = host
        self.robot = robot
        self.name = robot.name
        self.model: RobotModel = robot.model
        self.namespace, self.tf_prefix, self.options = namespace, tf_prefix, options
        self.devices: list[Device] = []
        name = robot.name
        self.laser: Laser | None = None
        if self.model.lidar is not None:
            self.laser = self._add(
                Laser(
                    host,
                    name,
                    topic=self.topic("scan"),
                    frame=self.frame(self.model.lidar.frame),
                    noise=options.noise,
                    rep_117=options.use_rep_117,
                    measures=True,
                    sweep=options.sweep,
                )
            )
        self.imu: ImuDevice | None = None
        if self.model.imu is not None:
            frame = self.frame(self.model.imu.frame)
            self.imu = self._add(ImuDevice(host, name, topic=self.topic("imu"), frame=frame, noise=options.noise))
        kind = PlanarMove if self.model.drive == "holonomic" else DifferentialDrive
        self.drive = self._add(
            kind(
                host,
                name,
                cmd_vel=self.topic("cmd_vel"),
                odom=self.topic("odom"),
                odom_frame=self.frame(ODOM),
                base_frame=self.frame(BASE),
                timeout=options.cmd_vel_timeout,
                imu=self.imu if options.odometry == "imu" else None,
            )
        )
        self.truth = self._add(
            GroundTruth(host, name, topic=self.topic("base_pose_ground_truth"), frame=MAP, child=self.frame(BASE))
        )
        if options.tf:
            self.drive.publish_transform("/tf")
        if self.model.drive == "differential":
            topic, frame = self.topic("joint_states"), self.frame(BASE_LINK)
            self._add(JointStates(host, self.drive, topic=topic, frame=frame))
        self.cameras = tuple(self._add(self._camera(camera)) for camera in self.model.cameras)
        self.battery: BatteryDevice | None = None
        self._switches: Switches | None = None
        if options.board:
            self._add_board()

    def _camera(self, camera: CameraModel) -> CameraDevice:
        """Return a camera device, on the topics of ROBOTIS's descriptions in Gazebo."""
        depth = camera.depth
        return CameraDevice(
            self.host,
            self.name,
            camera,
            image=self.topic(f"{camera.name}/rgb/image_raw"),
            info=self.topic(f"{camera.name}/rgb/camera_info"),
            depth=self.topic(f"{camera.name}/depth/image_raw") if depth else None,
            depth_info=self.topic(f"{camera.name}/depth/camera_info") if depth else None,
            points=self.topic(f"{camera.name}/depth/points") if depth else None,
            frame=self.frame(camera.frame),
            noise=self.options.noise,
        )

    def _add_board(self) -> None:
        """Add the other devices of the real robot's board."""
        host, name = self.host, self.name
        kind = BURGER_BATTERY if self.model.name == BURGER.name else WAFFLE_BATTERY
        self.battery = self._add(
            BatteryDevice(
                host, name, Battery(kind, self.options.battery), drive=self.drive, topic=self.topic("battery_state")
            )
        )
        self._add(SensorStateDevice(host, self.drive, self.battery, topic=self.topic("sensor_state")))
        self._switches = Switches(
            host,
            self.drive,
            None if self.imu is None else self.imu.calibrate,
            motor_power=self.topic("motor_power"),
            reset=self.topic("reset"),
        )

    def _add(self, device: D) -> D:
        self.devices.append(self.host.add(device))
        return device

    def add(self, kind: type[S], *, topic: str | None = None, frame: str | None = None, **options: Any) -> S:
        """Add another sensor; its topic is in the robot's namespace, and its frame gets the robot's prefix.

        `options` are the sensor's own. Raises `RosminiError` if there is already a device of this name.
        """
        topic = self.topic(kind.default_topic if topic is None else topic)
        frame = self.frame(kind.default_frame if frame is None else frame)
        return self._add(kind(self.host, self.name, topic=topic, frame=frame, **options))

    def topic(self, name: str) -> str:
        """Return the name of one of its topics."""
        return within(self.namespace, name)

    def frame(self, name: str) -> str:
        """Return the name of one of its frames."""
        return prefixed(self.tf_prefix, name)

    @property
    def odometry(self) -> Pose:
        """Its pose by odometry: x [m], y [m], heading [rad, not wrapped], in its frame odom."""
        return self.drive.reckoned.pose

    def close(self) -> None:
        """Close its topics."""
        for device in self.devices:
            self.host.remove(device)
        if self._switches is not None:
            self._switches.close()
