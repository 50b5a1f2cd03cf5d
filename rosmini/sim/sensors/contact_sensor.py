"""A bumper: which of its sectors is pressed, from where a robot touches something and how hard.

A sector is pressed when a contact lies within its angles, seen from the middle of the robot, and presses with the
bumper's least force or more.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose

Contact = tuple[tuple[float, float], float]
"""Where a robot touches something, in the frame of the world [m], and how hard that presses [N]."""


@dataclass(frozen=True)
class Sector:
    """A part of a bumper, from `angle_min` counter-clockwise to `angle_max` [rad], 0 straight ahead."""

    name: str
    angle_min: float
    angle_max: float
    bit: int
    """What it adds to the number that a message holds."""

    def holds(self, angle: float) -> bool:
        """Tell whether an angle [rad] lies in it; its ends do."""
        beyond = normalize_angle(angle - (self.angle_min + self.angle_max) / 2)
        return abs(beyond) <= (self.angle_max - self.angle_min) / 2 + 1e-9


@dataclass(frozen=True)
class BumperModel:
    """A ring of sectors around `centre`, which is seen from base_footprint [m]."""

    sectors: tuple[Sector, ...]
    centre: tuple[float, float] = (0.0, 0.0)
    force: float = 0.0
    """The least force that presses it [N]."""
    frame: str = "base_link"


TURTLEBOT3_BUMPER = BumperModel(
    (
        Sector("forward", -math.pi / 2, math.pi / 2, 1),
        Sector("backward", math.pi / 2, 3 * math.pi / 2, 2),
    )
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
    """The sectors, in the bumper's order, that are pressed on a robot at `pose`."""
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
    """The number that a message holds for pressed sectors."""
    return sum({sector.bit for sector in sectors})
