"""The names of a robot's topics and frames in stageros.

A single robot has plain names (`odom`, `base_scan`); of several each has a namespace, `/robot_0/odom`, and a prefix
of its frames, `robot_0/odom`. With the option -u a robot that has a name in the file has that as its namespace. If a
robot has several sensors of a kind, their names end in numbers: `/base_scan_0`. (Facts:
http://wiki.ros.org/stage_ros, and mapName in stageros.cpp.)
"""

from __future__ import annotations

from dataclasses import dataclass

from rosmini.sim.devices import prefixed, within

from .robots import StageRobot


@dataclass(frozen=True)
class Names:
    """The names of one robot."""

    prefix: str
    """Empty for one that is alone."""

    @classmethod
    def of(cls, robot: StageRobot, *, alone: bool, by_model: bool = False) -> Names:
        """Those of a robot, which may be the only one; with `by_model` as -u wants it."""
        if by_model and robot.named and ":" not in robot.name:
            return cls(robot.name)
        return cls("" if alone and not by_model else f"robot_{robot.number}")

    def topic(self, name: str, device: int | None = None) -> str:
        """A topic; of the sensor with this number, if there are several of its kind."""
        return (
            name if device is None and not self.prefix else within(f"/{self.prefix}", _numbered(name, device))
        )

    def frame(self, name: str, device: int | None = None) -> str:
        """A frame; of the sensor with this number, if there are several of its kind."""
        return prefixed(self.prefix, _numbered(name, device))


def _numbered(name: str, device: int | None) -> str:
    return name if device is None else f"{name}_{device}"
