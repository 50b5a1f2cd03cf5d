"""A model in the running world, and the interface of the world for models and plugins.

A model with a drive or a sensor is a robot of the engine. Any other model consists of fixed obstacles if it is
static, and is a movable obstacle if not. Everything stands upright on flat ground: height, roll and pitch never
change.
"""

from __future__ import annotations

import contextlib
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.geometry.products import matrix_product
from rosmini.core.graph import Node
from rosmini.core.markup import Element
from rosmini.sim.engine import Engine
from rosmini.sim.engine.robot import Robot
from rosmini.sim.host import Host
from rosmini.sim.sdf import placed_links
from rosmini.sim.sdf.document import ORIGIN, Pose6, SdfModel, SdfSensor
from rosmini.sim.sdf.poses import compose as compose6
from rosmini.sim.sdf.poses import pose6
from rosmini.sim.world import World, WorldError

from .body import Body
from .errors import UnknownEntity
from .physics_properties import PhysicsProperties

Velocity = tuple[float, float, float]
"""Along x and y of the world [m/s], and rate of turn, counter-clockwise [rad/s]."""

STILL: Velocity = (0.0, 0.0, 0.0)

WORLD_FRAMES = ("", "world", "map", "/map")
"""Names of the world's frame."""


class GazeboWorld(ABC):
    """The world as its models and plugins see it (gazebo::physics::World); implemented by `RunningWorld`."""

    node: Node
    name: str
    noise: float
    """Scale of the noise of all sensors; 0: no noise."""
    physics: PhysicsProperties
    flat: World
    """Its walls and fixed obstacles as loaded."""
    engine: Engine
    host: Host
    """Its time: `pause`, `unpause`, `step`."""
    models: dict[str, Model]
    """Models by name, in insertion order."""

    def __repr__(self) -> str:
        return f"<GazeboWorld {self.name}: {len(self.models)} models, {self.now:.3f} s{', paused' * self.paused}>"

    @property
    def now(self) -> float:
        """The world's time [s]."""
        return self.host.now

    @property
    def paused(self) -> bool:
        """True if time is paused."""
        return self.host.paused

    @abstractmethod
    def spawn(
        self,
        sdf: SdfModel,
        name: str = "",
        pose: Pose6 | None = None,
        *,
        namespace: str = "",
        frames: Mapping[str, tuple[str, Pose6]] | None = None,
    ) -> Model:
        """Insert a model as `name` at `pose`, to which its own pose is relative. Unless static it stands on the ground.

        Raises `SpawnError`, and inserts nothing, if the name is used, another object is in the way, or a plugin lacks
        what it needs; also raises the readers' errors.
        """

    @abstractmethod
    def delete(self, name: str) -> None:
        """Remove a model, whether or not it moves: its topics close, all else continues. Raises `UnknownEntity`."""

    @abstractmethod
    def move(self, model: Model, pose: Pose6, velocity: Velocity = STILL) -> None:
        """Put a model elsewhere, with a velocity in the world's frame.

        Raises `GazeboError` for values that are not finite, `WorldError` if something is in the way.
        """

    def model(self, name: str) -> Model:
        """Return the model of this name. Raises `UnknownEntity`, with the nearest name."""
        if name not in self.models:
            hint = nearest(name, self.models) or f"the models are: {', '.join(self.models) or 'none'}"
            raise UnknownEntity(f"there is no model {name!r} in the world {self.name!r}; {hint}")
        return self.models[name]

    def entity(self, name: str) -> tuple[Model, str]:
        """Return the model and link named by `model::link`; `model` means its first link. Raises `UnknownEntity`."""
        model_name, _, link = name.partition("::")
        model = self.model(model_name)
        if not link:
            link = model.links[0] if model.links else ""
        elif link not in model.frames:
            model.link_frame(link)
        return model, link

    def frame(self, name: str) -> tuple[Pose6, Velocity]:
        """Return pose and velocity in the world of a model, a link, or the world itself. Raises `UnknownEntity`."""
        if name in WORLD_FRAMES:
            return ORIGIN, STILL
        model, link = self.entity(name)
        if "::" not in name or not link:
            return model.pose, model.velocity
        return model.link_pose(link), model.link_velocity(link)

    def is_immovable(self, name: str) -> bool:
        """Return True if the engine's object of this name cannot be pushed: a wall or a fixed obstacle."""
        if name in self.engine.robots:
            return math.isinf(self.engine.robots[name].model.mass)
        return not any(each.name == name for each in self.engine.obstacles())


@dataclass
class Model:
    """A model in a world; created by `GazeboWorld.spawn`."""

    world: GazeboWorld
    name: str
    sdf: SdfModel
    """Its description, relative to its own origin."""
    start: Pose6
    """The pose where it was spawned, and to which a reset returns it."""
    namespace: str = ""
    """Namespace of its topics, unless its plugins set their own."""
    frames: Mapping[str, tuple[str, Pose6]] = field(default_factory=dict)
    """Links of its URDF that became part of another one: name of the other link, and pose in it."""
    body: Body | None = None
    """None for an obstacle, which is not a robot of the engine."""
    obstacles: tuple[str, ...] = ()
    """The names of its obstacles in the engine, if it is not a robot."""
    fixed: Pose6 | None = None
    """Its pose if only services move it."""
    sensors: list[Sensor] = field(default_factory=list)

    def __repr__(self) -> str:
        x, y, _, _, _, yaw = self.pose
        return f"<Model {self.name} at ({x:.2f}, {y:.2f}), heading {yaw:.2f}>"

    @property
    def static(self) -> bool:
        """True if it is static: contacts and forces do not move it."""
        return self.sdf.static

    @property
    def robot(self) -> Robot | None:
        """The engine's robot, if it is one."""
        return self.world.engine.robot(self.name) if self.body is not None else None

    # -- where it is ---------------------------------------------------------------------------------------------

    @property
    def flat(self) -> Pose:
        """Pose of its origin: x [m], y [m] and heading [rad]."""
        if self.fixed is not None:
            return (self.fixed[0], self.fixed[1], self.fixed[5])
        if self.body is not None:
            pose = self.world.engine.robot(self.name).pose
            return pose if self.body.axle == (0.0, 0.0, 0.0) else compose(pose, inverse(self.body.axle))
        return self.world.engine.pose(self.obstacles[0])

    @property
    def pose(self) -> Pose6:
        """Pose of its origin: x, y, z [m], roll, pitch, yaw [rad]."""
        x, y, yaw = self.flat
        return (x, y, self.start[2], self.start[3], self.start[4], yaw)

    @property
    def velocity(self) -> Velocity:
        """Velocity of its origin in the world's frame."""
        if self.fixed is not None:
            return STILL
        vx, vy, w = self.world.engine.velocity(self.name if self.body is not None else self.obstacles[0])
        if self.body is not None and self.body.axle[:2] != (0.0, 0.0):
            at, middle = self.flat, self.world.engine.robot(self.name).pose
            vx, vy = vx - w * (at[1] - middle[1]), vy + w * (at[0] - middle[0])
        return (vx, vy, w)

    @property
    def weight(self) -> tuple[float, float]:
        """Its mass [kg], and its inertia about the vertical axis [kg m2]."""
        if self.body is not None:
            numbers = self.body.robot_model()
            return (numbers.mass, numbers.inertia)
        return Body(self.sdf).weight()

    def set_pose(self, pose: Pose6, velocity: Velocity = STILL) -> None:
        """Put it elsewhere, with a velocity in the world's frame.

        Raises `GazeboError` for values that are not finite, `WorldError` if something is in the way.
        """
        self.world.move(self, pose, velocity)

    def set_velocity(self, velocity: Velocity) -> None:
        """Give it a velocity in the world's frame, as if it were pushed.

        The part of the velocity towards a wall or a fixed obstacle that it touches has no effect, and the wheels of a
        driven robot counteract the rest. Raises `GazeboError` for values that are not finite.
        """
        self.world.host.catch_up()
        vx, vy, w = velocity
        if self.fixed is None:
            for touch in self.world.engine.touching(self.name if self.body is not None else self.obstacles[0]):
                inwards = min(0.0, vx * touch.nx + vy * touch.ny)
                if inwards and self.world.is_immovable(touch.other):  # it cannot be pushed, so this part is lost
                    vx, vy = vx - inwards * touch.nx, vy - inwards * touch.ny
        with contextlib.suppress(WorldError):
            self.world.move(self, self.pose, (vx, vy, w))

    # -- its parts ----------------------------------------------------------------------------------------------

    @property
    def links(self) -> tuple[str, ...]:
        """The names of its links."""
        return tuple(name for name, _, _ in placed_links(self.sdf))

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of its joints."""
        return tuple(joint.name for joint in self.sdf.joints)

    def link_frame(self, link: str) -> Pose6:
        """Return the pose in the model of a link, or of one that became part of another. Raises `UnknownEntity`."""
        places = {name: pose for name, _, pose in placed_links(self.sdf)}
        if link in self.frames:
            host, inside = self.frames[link]
            return compose6(places[host], inside)
        if link in places:
            return places[link]
        there = (*places, *self.frames)
        hint = nearest(link, there) or f"its links are: {', '.join(there)}"
        raise UnknownEntity(f"the model {self.name!r} has no link {link!r}; {hint}")

    def on_robot(self, pose: Pose6) -> Pose6:
        """Convert a pose in the model to the frame of the engine's robot, which turns about the middle of its axle."""
        if self.body is None or self.body.axle == (0.0, 0.0, 0.0):
            return pose
        x, y, yaw = inverse(self.body.axle)
        return compose6((x, y, 0.0, 0.0, 0.0, yaw), pose)

    def link_in_model(self, link: str) -> Pose6:
        """Return the current pose of a link in the model, with wheels turned. Raises `UnknownEntity`."""
        frame = self.link_frame(link)
        wheels = self.body.sides if self.body is not None else {}
        for joint in self.sdf.joints:
            if joint.child == link and joint.name in wheels:
                return compose6(frame, _spin(joint.axis, self.joint(joint.name)[0]))
        return frame

    def link_pose(self, link: str) -> Pose6:
        """Return the pose of a link in the world. Raises `UnknownEntity`."""
        return compose6(self.pose, self.link_in_model(link))

    def link_velocity(self, link: str) -> Velocity:
        """Return the velocity of a link in the world's frame."""
        vx, vy, w = self.velocity
        at, here = self.flat, self.link_pose(link)
        return (vx - w * (here[1] - at[1]), vy + w * (here[0] - at[0]), w)

    def joint(self, name: str) -> tuple[float, float]:
        """Return the position and rate of a joint [rad, rad/s]; 0 for all except wheels. Raises `UnknownEntity`."""
        if name not in self.joints:
            hint = nearest(name, self.joints) or f"its joints are: {', '.join(self.joints) or 'none'}"
            raise UnknownEntity(f"the model {self.name!r} has no joint {name!r}; {hint}")
        robot = self.robot
        if robot is None or self.body is None or name not in self.body.sides:
            return (0.0, 0.0)
        radius = self.body.wheel_radius
        right = self.body.sides[name]
        way, speed = (robot.right_distance, robot.right) if right else (robot.left_distance, robot.left)
        return (way / radius, speed / radius)


@dataclass
class Sensor:
    """A sensor on a model."""

    model: Model
    sdf: SdfSensor
    link: str
    """The link that carries it."""

    @property
    def name(self) -> str:
        """Its name in the file."""
        return self.sdf.name

    @property
    def type(self) -> str:
        """ray, gpu_ray, camera, depth, imu, contact..."""
        return self.sdf.type

    @property
    def element(self) -> Element:
        """Its `<sensor>` element."""
        return self.sdf.element

    @property
    def device_name(self) -> str:
        """Name of its device, which seeds its noise: model/sensor."""
        return f"{self.model.name}/{self.name}"

    @property
    def mount(self) -> Pose6:
        """Its pose relative to the engine's robot."""
        return self.model.on_robot(compose6(self.model.link_frame(self.link), self.sdf.pose))


def _spin(axis: tuple[float, float, float], angle: float) -> Pose6:
    """Return a rotation about an axis as a pose."""
    x, y, z = axis
    length = math.sqrt(x * x + y * y + z * z)
    if not length or not angle:
        return ORIGIN
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]) / length
    turn = np.eye(4)
    turn[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * matrix_product(cross, cross)
    return pose6(turn)
