"""The devices of simulated robots, shared by TurtleBot3's simulator, Stage and Gazebo."""

from .board import BatteryDevice, SensorStateDevice, Switches
from .bumper import Bumper
from .camera import CameraDevice
from .clock import ClockDevice
from .drive import DifferentialDrive, GroundTruth, JointStates, OdometryTransforms, PlanarMove, one_of
from .imu import ImuDevice
from .laser import Laser, RangeDevice
from .namespaces import prefixed, within
from .sensor import Sensor

__all__ = [
    "BatteryDevice",
    "Bumper",
    "CameraDevice",
    "ClockDevice",
    "DifferentialDrive",
    "GroundTruth",
    "ImuDevice",
    "JointStates",
    "Laser",
    "OdometryTransforms",
    "PlanarMove",
    "RangeDevice",
    "Sensor",
    "SensorStateDevice",
    "Switches",
    "one_of",
    "prefixed",
    "within",
]
