"""A bumper: its pressed sectors, from the robot's contact points and their forces.

A sector is pressed when a contact lies within its angles, seen from the centre of the robot, and has at least the
bumper's minimum force.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose

Contact = tuple[tuple[float, float], float]
"""A contact point in the world's frame [m], and its force [N]."""


@dataclass(frozen=True)
class Sector:
    """A part of a bumper, from `angle_min` counter-clockwise to `angle_max` [rad], 0 straight ahead."""

    name: str
    angle_min: float
    angle_max: float
    bit: int
    """Its bit in the message's number."""

    def holds(self, angle: float) -> bool:
        """Return True if an angle [rad] is within the sector, ends included."""
        beyond = normalize_angle(angle - (self.angle_min + self.angle_max) / 2)
        return abs(beyond) <= (self.angle_max - self.angle_min) / 2 + 1e-9


@dataclass(frozen=True)
class BumperModel:
    """A ring of sectors around `centre`, relative to base_footprint [m]."""

    sectors: tuple[Sector, ...]
    centre: tuple[float, float] = (0.0, 0.0)
    force: float = 0.0
    """Minimum force that presses it [N]."""
    frame: str = "base_link"


TURTLEBOT3_BUMPER = BumperModel(
    (Sector("forward", -math.pi / 2, math.pi / 2, 1), Sector("backward", math.pi / 2, 3 * math.pi / 2, 2))
)
"""The two switches that TurtleBot3's firmware reads.

`turtlebot3_msgs/SensorState` calls their bits BUMPER_FORWARD and BUMPER_BACKWARD.
"""

KOBUKI_BUMPER = BumperModel(
    (
        Sector("right", math.radians(-90), math.radians(-30), 1),
        Sector("centre", math.radians(-30), math.radians(30), 2),
        Sector("left", math.radians(30), math.radians(90), 4),
    )
)
"""Three front switches, as on a TurtleBot 2 (`kobuki_msgs/SensorState`: BUMPER_RIGHT, _CENTRE and _LEFT)."""


def pressed(bumper: BumperModel, pose: Pose, contacts: Iterable[Contact]) -> tuple[Sector, ...]:
    """Return the pressed sectors of a robot at `pose`, in the bumper's order."""
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    angles = []
    for (px, py), force in contacts:
        if force >= bumper.force:
            ahead = c * (px - x) + s * (py - y) - bumper.centre[0]
            aside = c * (py - y) - s * (px - x) - bumper.centre[1]
            angles.append(math.atan2(aside, ahead))
    return tuple(sector for sector in bumper.sectors if any(sector.holds(angle) for angle in angles))


def bits(sectors: Iterable[Sector]) -> int:
    """Return the number for pressed sectors in a message."""
    return sum({sector.bit for sector in sectors})
