"""The messages of Gazebo's own topics, as far as the server and its client need them (gazebo.msgs).

They print as `gz topic -e` does: field by field, in Protocol Buffers' text form.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any, ClassVar

from rosmini.sim.sdf import Pose6


@dataclass(frozen=True)
class Message:
    """The base of all messages."""

    TYPE: ClassVar[str] = ""

    def __str__(self) -> str:
        return "\n".join(_lines(self, ""))


@dataclass(frozen=True)
class Time(Message):
    """A time [s] in two parts."""

    TYPE: ClassVar[str] = "gazebo.msgs.Time"
    sec: int = 0
    nsec: int = 0

    @classmethod
    def of(cls, seconds: float) -> Time:
        """The time so many seconds after zero."""
        whole, rest = divmod(round(seconds * 1e9), 1_000_000_000)
        return cls(whole, rest)


@dataclass(frozen=True)
class Vector3d(Message):
    """Three numbers."""

    TYPE: ClassVar[str] = "gazebo.msgs.Vector3d"
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


@dataclass(frozen=True)
class Quaternion(Message):
    """A rotation."""

    TYPE: ClassVar[str] = "gazebo.msgs.Quaternion"
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0


@dataclass(frozen=True)
class Pose(Message):
    """Where something of a name is, seen from the world."""

    TYPE: ClassVar[str] = "gazebo.msgs.Pose"
    name: str
    id: int
    position: Vector3d
    orientation: Quaternion

    @classmethod
    def of(cls, name: str, number: int, pose: Pose6) -> Pose:
        """A pose of six numbers as a message."""
        x, y, z, *turn = pose
        return cls(name, number, Vector3d(x, y, z), Quaternion(*quaternion(turn[0], turn[1], turn[2])))


@dataclass(frozen=True)
class PosesStamped(Message):
    """Where everything is."""

    TYPE: ClassVar[str] = "gazebo.msgs.PosesStamped"
    time: Time
    pose: tuple[Pose, ...] = ()


@dataclass(frozen=True)
class LaserScan(Message):
    """What a ray sensor measured."""

    TYPE: ClassVar[str] = "gazebo.msgs.LaserScan"
    frame: str
    world_pose: Pose
    angle_min: float
    angle_max: float
    angle_step: float
    range_min: float
    range_max: float
    count: int
    ranges: tuple[float, ...] = ()


@dataclass(frozen=True)
class LaserScanStamped(Message):
    """What a ray sensor measured, and when."""

    TYPE: ClassVar[str] = "gazebo.msgs.LaserScanStamped"
    time: Time
    scan: LaserScan


@dataclass(frozen=True)
class WorldStatistics(Message):
    """How time goes on."""

    TYPE: ClassVar[str] = "gazebo.msgs.WorldStatistics"
    sim_time: Time
    pause_time: Time
    real_time: Time
    paused: bool
    iterations: int
    model_count: int


@dataclass(frozen=True)
class WorldReset(Message):
    """What is to go back to how it was."""

    TYPE: ClassVar[str] = "gazebo.msgs.WorldReset"
    all: bool = False
    time_only: bool = False
    model_only: bool = False


@dataclass(frozen=True)
class WorldControl(Message):
    """What the server is to do with time."""

    TYPE: ClassVar[str] = "gazebo.msgs.WorldControl"
    pause: bool | None = None
    step: bool | None = None
    multi_step: int | None = None
    reset: WorldReset | None = None


@dataclass(frozen=True)
class Request(Message):
    """A question to the server, or an order; it answers on ~/response."""

    TYPE: ClassVar[str] = "gazebo.msgs.Request"
    id: int
    request: str
    data: str = ""


@dataclass(frozen=True)
class Response(Message):
    """An answer."""

    TYPE: ClassVar[str] = "gazebo.msgs.Response"
    id: int
    request: str
    response: str
    """success, nonexistent, error..."""
    type: str = ""
    serialized_data: Any = None
    """A message of that type, or a text."""


@dataclass(frozen=True)
class Factory(Message):
    """A model that is to come into the world."""

    TYPE: ClassVar[str] = "gazebo.msgs.Factory"
    sdf: str
    edit_name: str = ""
    pose: Pose | None = None


@dataclass(frozen=True)
class Model(Message):
    """A model that has come into the world, or one that is to be changed."""

    TYPE: ClassVar[str] = "gazebo.msgs.Model"
    name: str
    id: int
    is_static: bool = False
    pose: Pose | None = None
    link: tuple[str, ...] = ()
    visual: tuple[Any, ...] = ()
    """What a client draws: `rosmini.sim.world.Obstacle`s at the model's pose of zero."""


@dataclass(frozen=True)
class Scene(Message):
    """All that there is in the world."""

    TYPE: ClassVar[str] = "gazebo.msgs.Scene"
    name: str
    model: tuple[Model, ...] = ()
    walls: Any = None
    """Thin walls (n, 4), where the world was made from a map."""


@dataclass(frozen=True)
class Physics(Message):
    """How the world is stepped."""

    TYPE: ClassVar[str] = "gazebo.msgs.Physics"
    type: str = "ODE"
    max_step_size: float = 0.001
    real_time_update_rate: float = 1000.0
    real_time_factor: float = 1.0
    gravity: Vector3d = field(default_factory=Vector3d)


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """x, y, z and w of a rotation by yaw after pitch after roll about fixed axes."""
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def _lines(message: Message, indent: str) -> list[str]:
    lines: list[str] = []
    for each in fields(message):
        value = getattr(message, each.name)
        for item in value if isinstance(value, tuple) else (value,):
            if item is None:
                continue
            if isinstance(item, Message):
                lines += [f"{indent}{each.name} {{", *_lines(item, indent + "  "), f"{indent}}}"]
            elif isinstance(item, bool):
                lines.append(f"{indent}{each.name}: {'true' if item else 'false'}")
            elif isinstance(item, str):
                lines.append(f'{indent}{each.name}: "{item}"')
            elif isinstance(item, (int, float)):
                lines.append(f"{indent}{each.name}: {item:.12g}")
            elif is_dataclass(item) and hasattr(item, "name"):
                lines.append(f'{indent}{each.name}: "{item.name}"')
    return lines
