"""The messages of Gazebo's own topics, as far as the server and its client need them (gazebo.msgs).

They print as `gz topic -e` does: field by field, in Protocol Buffers' text form.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, ClassVar

from rosmini.sim.models import RobotModel
from rosmini.sim.sdf import Pose6
from rosmini.sim.world import Obstacle, World
from rosmini.tf.rigid import from_rpy


@dataclass(frozen=True)
class Message:
    """The base of all messages."""

    TYPE: ClassVar[str]
    """What `gz topic -i` calls it."""

    def __init_subclass__(cls) -> None:
        cls.TYPE = f"gazebo.msgs.{cls.__name__}"

    def __str__(self) -> str:
        return "\n".join(_lines(self, ""))


@dataclass(frozen=True)
class Time(Message):
    """A time [s] in two parts."""

    sec: int = 0
    nsec: int = 0

    @classmethod
    def of(cls, seconds: float) -> Time:
        """Return the time `seconds` after zero."""
        whole, rest = divmod(round(seconds * 1e9), 1_000_000_000)
        return cls(whole, rest)


@dataclass(frozen=True)
class Vector3d(Message):
    """Three numbers."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


@dataclass(frozen=True)
class Quaternion(Message):
    """A rotation."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0


@dataclass(frozen=True)
class Pose(Message):
    """Where something of a name is, seen from the world."""

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

    time: Time
    pose: tuple[Pose, ...] = ()


@dataclass(frozen=True)
class LaserScan(Message):
    """What a ray sensor measured."""

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

    time: Time
    scan: LaserScan


@dataclass(frozen=True)
class WorldStatistics(Message):
    """How time goes on."""

    sim_time: Time
    pause_time: Time
    real_time: Time
    paused: bool
    iterations: int
    model_count: int


@dataclass(frozen=True)
class WorldReset(Message):
    """What is to go back to how it was."""

    all: bool = False
    time_only: bool = False
    model_only: bool = False


@dataclass(frozen=True)
class WorldControl(Message):
    """What the server is to do with time."""

    pause: bool | None = None
    step: bool | None = None
    multi_step: int | None = None
    reset: WorldReset | None = None


@dataclass(frozen=True)
class Request(Message):
    """A question to the server, or an order; it answers on ~/response."""

    id: int
    request: str
    data: str = ""


@dataclass(frozen=True)
class Response(Message):
    """An answer."""

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

    sdf: str
    edit_name: str = ""
    pose: Pose | None = None


class Word(str):
    """A word of a list of words, which is printed without quotes."""

    __slots__ = ()


@dataclass(frozen=True)
class Color(Message):
    """A colour: parts from 0 to 1."""

    r: float = 0.0
    g: float = 0.0
    b: float = 0.0
    a: float = 1.0


@dataclass(frozen=True)
class Material(Message):
    """What the surface of something looks like."""

    diffuse: Color


@dataclass(frozen=True)
class BoxGeom(Message):
    """The lengths of a box."""

    size: Vector3d


@dataclass(frozen=True)
class CylinderGeom(Message):
    """A cylinder along its z."""

    radius: float
    length: float


@dataclass(frozen=True)
class SphereGeom(Message):
    """A ball."""

    radius: float


@dataclass(frozen=True)
class Vector2d(Message):
    """Two numbers."""

    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True)
class PlaneGeom(Message):
    """A flat rectangle."""

    normal: Vector3d
    size: Vector2d


@dataclass(frozen=True)
class Polyline(Message):
    """A closed outline, and how far it reaches up."""

    height: float
    point: tuple[Vector2d, ...]


@dataclass(frozen=True)
class MeshGeom(Message):
    """A file of triangles."""

    filename: str
    scale: Vector3d
    submesh: str | None = None


@dataclass(frozen=True)
class Geometry(Message):
    """A shape; of the fields one is set, that of its type."""

    type: Word
    """BOX, CYLINDER, SPHERE, PLANE, POLYLINE, MESH or EMPTY."""
    box: BoxGeom | None = None
    cylinder: CylinderGeom | None = None
    sphere: SphereGeom | None = None
    plane: PlaneGeom | None = None
    mesh: MeshGeom | None = None
    polyline: tuple[Polyline, ...] = ()


@dataclass(frozen=True)
class Visual(Message):
    """What is drawn of a link."""

    name: str
    """MODEL::LINK::VISUAL"""
    id: int
    parent_name: str
    pose: Pose
    """Seen from the link."""
    geometry: Geometry
    material: Material | None = None
    """None: a mesh has its own colours."""


@dataclass(frozen=True)
class Collision(Message):
    """What is solid of a link."""

    id: int
    name: str
    pose: Pose
    geometry: Geometry


@dataclass(frozen=True)
class Link(Message):
    """A rigid body of a model."""

    id: int
    name: str
    """MODEL::LINK"""
    pose: Pose
    """Seen from the model."""
    visual: tuple[Visual, ...] = ()
    collision: tuple[Collision, ...] = ()


@dataclass(frozen=True)
class Flat:
    """A model seen from above, in rosmini's flat world; not printed, for Gazebo's messages have nothing like it."""

    solids: tuple[Obstacle, ...] = ()
    """At the model's pose of zero."""
    robot: RobotModel | None = None
    """Of a model with a drive: its outline, its wheels and its laser."""
    axle: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Where the middle of the robot's axle is, seen from the model."""


@dataclass(frozen=True)
class Model(Message):
    """A model that has come into the world, or one that is to be changed."""

    name: str
    id: int
    is_static: bool = False
    pose: Pose | None = None
    link: tuple[Link, ...] = ()
    """What a client draws."""
    flat: Flat = Flat()


@dataclass(frozen=True)
class Scene(Message):
    """All that there is in the world."""

    name: str
    model: tuple[Model, ...] = ()
    flat: World | None = None
    """Walls that are no models, where the world was made from a map; not printed."""


@dataclass(frozen=True)
class Physics(Message):
    """How the world is stepped."""

    type: str = "ODE"
    max_step_size: float = 0.001
    real_time_update_rate: float = 1000.0
    real_time_factor: float = 1.0
    gravity: Vector3d = field(default_factory=Vector3d)


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """x, y, z and w of a rotation by yaw after pitch after roll about fixed axes."""
    return from_rpy((0.0, 0.0, 0.0), roll, pitch, yaw)[3:]


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
                lines.append(f"{indent}{each.name}: " + (item if isinstance(item, Word) else f'"{item}"'))
            elif isinstance(item, (int, float)):
                lines.append(f"{indent}{each.name}: {item:.12g}")
    return lines
