"""Robots by their numbers. Lengths in metres, masses in kilograms, angles in radians, frames after REP 103 and REP 105.

The numbers of a robot are the published ones, and each says where it was published:

- *e-manual*: https://emanual.robotis.com/docs/en/platform/turtlebot3/features/ (the table of hardware specifications);
- *description*: the package `turtlebot3_description` of https://github.com/ROBOTIS-GIT/turtlebot3, its URDF;
- *gazebo*: the same package's `turtlebot3_burger.gazebo.xacro`, which is what Gazebo simulates;
- *firmware*: `turtlebot3_core` of https://github.com/ROBOTIS-GIT/OpenCR, what the robot's own controller runs;
- *navigation*: the package `turtlebot3_navigation`, the costmaps' parameters;
- *LDS-01*: https://emanual.robotis.com/docs/en/platform/turtlebot3/appendix_lds_01/.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from functools import cached_property

from rosmini.errors import RosminiError, nearest

Point = tuple[float, float, float]

VARIABLE = "TURTLEBOT3_MODEL"
"""The environment variable by which ROBOTIS's launch files choose a model."""


class UnknownModel(RosminiError, ValueError):
    """There is no robot model of this name."""


@dataclass(frozen=True)
class LidarModel:
    """A spinning laser: one revolution is one scan."""

    name: str
    mount: Point
    """Where it sits, seen from base_footprint."""
    beams: int
    rate: float
    """Scans a second."""
    range_min: float
    range_max: float
    noise: float
    """Standard deviation of a range [m]."""
    frame: str = "base_scan"


@dataclass(frozen=True)
class ImuModel:
    """An inertial measurement unit."""

    mount: Point
    rate: float
    gyro_noise: float
    """Standard deviation of an angular velocity [rad/s]."""
    accel_noise: float
    """Standard deviation of a linear acceleration [m/s2]."""
    frame: str = "imu_link"
    gyro_bias: float = 0.0
    """Standard deviation, from one unit to another, of the angular velocity it shows at rest [rad/s]."""
    accel_bias: float = 0.0
    """The same of a linear acceleration [m/s2]."""


@dataclass(frozen=True)
class WheelErrors:
    """How far real wheels differ from the numbers that the odometry counts with: standard deviations, as fractions."""

    radius: float = 0.0015
    """Of each wheel's radius: tyres are not turned to a micrometre."""
    separation: float = 0.01
    """Of the distance of the wheels: a tyre touches the ground along its width, not in a line."""
    slip: float = 0.002
    """Of how far a wheel rolls in one turn, from second to second: the ground is not even."""


@dataclass(frozen=True)
class RobotModel:
    """A robot with two driven wheels."""

    name: str
    mass: float
    inertia: float
    """About the vertical axis through base_footprint [kg m2]."""
    wheel_radius: float
    wheel_separation: float
    max_linear: float
    """[m/s]"""
    max_angular: float
    """[rad/s]"""
    wheel_acceleration: float
    """How fast a wheel's rim changes its speed [m/s2]."""
    ticks_per_turn: int
    """What an encoder counts in one turn of the wheel."""
    footprint: tuple[tuple[float, float], ...]
    """Corners of what touches walls, counter-clockwise, seen from base_footprint; a convex polygon."""
    height: float
    lidar: LidarModel
    imu: ImuModel
    rate: float = 30.0
    """Messages a second on odom, tf and joint_states."""
    errors: WheelErrors = WheelErrors()
    body_radius: float = 0.105
    """Of the disc, around the laser's axis, as which other robots' lasers see it."""
    title: str = ""

    @cached_property
    def reach(self) -> float:
        """The distance from base_footprint to the farthest corner of the footprint."""
        return max(math.hypot(x, y) for x, y in self.footprint)


BURGER = RobotModel(
    name="burger",
    title="TurtleBot3 Burger",
    mass=1.0,  # e-manual, with battery, computer and laser
    # description: the base (0.00201), two wheels of 28.5 g 8 cm aside (0.00019 each), the laser of 114 g 3.2 cm behind (0.00012)
    inertia=0.0025,
    wheel_radius=0.033,  # description, firmware
    wheel_separation=0.160,  # description, firmware
    max_linear=0.22,  # e-manual, firmware
    max_angular=2.84,  # e-manual, firmware
    wheel_acceleration=1.0,  # gazebo
    ticks_per_turn=4096,  # firmware: the 12-bit encoder of the XL430
    footprint=((-0.105, -0.105), (0.041, -0.105), (0.041, 0.105), (-0.105, 0.105)),  # navigation
    height=0.192,  # e-manual: 0.138 x 0.178 x 0.192 m
    lidar=LidarModel(
        name="LDS-01",
        mount=(-0.032, 0.0, 0.182),  # description: 0.172 above base_link, which is 0.010 above base_footprint
        beams=360,  # LDS-01: one a degree
        rate=5.0,  # LDS-01: 300 revolutions a minute
        range_min=0.12,  # LDS-01
        range_max=3.5,  # LDS-01
        noise=0.01,  # gazebo; LDS-01 itself: 10 mm near by, 3.5 % beyond half a metre
    ),
    imu=ImuModel(
        mount=(-0.032, 0.0, 0.078),  # description
        rate=200.0,  # firmware, gazebo
        gyro_noise=2e-4,  # gazebo
        accel_noise=1.7e-2,  # gazebo
        gyro_bias=7.5e-6,  # gazebo
        accel_bias=0.1,  # gazebo
    ),
    rate=30.0,  # firmware, gazebo
    body_radius=0.105,  # firmware
)

MODELS = {BURGER.name: BURGER}

LATER = ("waffle", "waffle_pi")


def model(name: str | None = None) -> RobotModel:
    """The robot model called `name`; if there is no name, the one that the environment variable TURTLEBOT3_MODEL names, else the Burger.

    Raises `UnknownModel`.
    """
    wanted = name or os.environ.get(VARIABLE) or BURGER.name
    if wanted in MODELS:
        return MODELS[wanted]
    where = "" if name else f" (from the environment variable {VARIABLE})"
    if wanted in LATER:
        raise UnknownModel(
            f"the TurtleBot3 model {wanted!r}{where} is not in this version of rosmini, which has the Burger alone; take 'burger'"
        )
    hint = nearest(wanted, MODELS) or f"the models are: {', '.join(MODELS)}"
    raise UnknownModel(f"there is no robot model {wanted!r}{where}; {hint}")
