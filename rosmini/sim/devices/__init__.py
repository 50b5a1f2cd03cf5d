"""The devices of simulated robots, shared by TurtleBot3's simulator, Stage and Gazebo."""

from .board import BatteryDevice, SensorStateDevice, Switches, contacts
from .bumper import Bumper
from .camera import CameraDevice
from .clock import ClockDevice
from .drive import DifferentialDrive, GroundTruth, JointStates, OdometryTransforms, PlanarMove, one_of
from .imu import ImuDevice
from .laser import Laser, RangeDevice
from .namespaces import prefixed, within
from .sensor import Outlet, Sensor

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
    "Outlet",
    "PlanarMove",
    "RangeDevice",
    "Sensor",
    "SensorStateDevice",
    "Switches",
    "contacts",
    "one_of",
    "prefixed",
    "within",
]
