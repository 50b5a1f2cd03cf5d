"""The devices of simulated robots, which TurtleBot3's simulator, Stage and Gazebo share: topics, frames, rates and noise are their arguments."""

from .board import BatteryDevice, SensorStateDevice, Switches, contacts
from .bumper import Bumper
from .camera import CameraDevice
from .clock import ClockDevice
from .drive import DifferentialDrive, GroundTruth, JointStates, OdometryTransforms, PlanarMove
from .names import one_of, order, prefixed, within
from .sensors import ImuDevice, Laser, RangeDevice

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
    "SensorStateDevice",
    "Switches",
    "contacts",
    "one_of",
    "order",
    "prefixed",
    "within",
]
