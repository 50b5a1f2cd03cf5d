"""The names of a robot's topics and frames in stageros.

A single robot has plain names (`odom`, `base_scan`); each of several robots has a namespace, `/robot_0/odom`, and a
frame prefix, `robot_0/odom`. With the option -u a robot's name in the file becomes its namespace. If a
robot has several sensors of a kind, their names end in numbers: `/base_scan_0`. (Facts:
http://wiki.ros.org/stage_ros, and mapName in stageros.cpp.)
"""

from __future__ import annotations

from dataclasses import dataclass

from rosmini.sim.devices.namespaces import prefixed, within

from .robots import StageRobot


@dataclass(frozen=True)
class Names:
    """The names of one robot."""

    prefix: str
    """Empty for a single robot."""

    @classmethod
    def of(cls, robot: StageRobot, *, alone: bool, by_model: bool = False) -> Names:
        """Return the names of a robot, which may be the only one; with `by_model` as for -u."""
        if by_model and robot.named and ":" not in robot.name:
            return cls(robot.name)
        return cls("" if alone and not by_model else f"robot_{robot.number}")

    def topic(self, name: str, device: int | None = None) -> str:
        """Return a topic; of the sensor with this number, if there are several of its kind."""
        return name if device is None and not self.prefix else within(f"/{self.prefix}", _numbered(name, device))

    def frame(self, name: str, device: int | None = None) -> str:
        """Return a frame; of the sensor with this number, if there are several of its kind."""
        return prefixed(self.prefix, _numbered(name, device))


def _numbered(name: str, device: int | None) -> str:
    return name if device is None else f"{name}_{device}"
