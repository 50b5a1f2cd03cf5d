"""Robots by their numbers. Lengths in metres, masses in kilograms, angles in radians, frames after REP 103 and REP 105."""

from __future__ import annotations

from dataclasses import dataclass

Point = tuple[float, float, float]


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
    """Corners of what touches walls, counter-clockwise, seen from base_footprint."""
    height: float
    lidar: LidarModel
    imu: ImuModel
    rate: float = 30.0
    """Messages a second on odom, tf and joint_states."""
