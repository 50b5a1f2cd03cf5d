"""The devices of simulated robots, which TurtleBot3's simulator, Stage and Gazebo share: topics, frames, rates and noise are their arguments."""

from .drive import DifferentialDrive, GroundTruth, OdometryTransforms, PlanarMove, WheelStates
from .names import one_of, order, prefixed
from .sensors import ImuDevice, Laser

__all__ = [
    "DifferentialDrive",
    "GroundTruth",
    "ImuDevice",
    "Laser",
    "OdometryTransforms",
    "PlanarMove",
    "WheelStates",
    "one_of",
    "order",
    "prefixed",
]
