"""A model in the running world, and the world as models and plugins see it.

What drives or carries a sensor is a robot of the engine. Anything else is one or more fixed obstacles if it is
static, and one that can be pushed if not. Everything stands upright on flat ground: height, roll and pitch stay as
they were at first.
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
from rosmini.sim.sdf import ORIGIN, Pose6, SdfModel, SdfSensor, placed_links
from rosmini.sim.sdf.poses import compose as compose6
from rosmini.sim.sdf.poses import pose6
from rosmini.sim.world import World, WorldError

from .body import Body
from .errors import UnknownEntity
from .physics_properties import PhysicsProperties

Velocity = tuple[float, float, float]
"""Along x and y of the world [m/s], and counter-clockwise [rad/s]."""

STILL: Velocity = (0.0, 0.0, 0.0)

WORLD_FRAMES = ("", "world", "map", "/map")
"""What stands for the world where a model or a link is named."""


class GazeboWorld(ABC):
    """The world as its models and plugins see it (gazebo::physics::World); `RunningWorld` is one."""

    node: Node
    name: str
    noise: float
    """Scales the noise of all sensors; 0: none."""
    physics: PhysicsProperties
    flat: World
    """Its walls and fixed obstacles, as they were at first."""
    engine: Engine
    host: Host
    """Its time: `pause`, `unpause`, `step`."""
    models: dict[str, Model]
    """By name, in insertion order."""

    def __repr__(self) -> str:
        return f"<GazeboWorld {self.name}: {len(self.models)} models, {self.now:.3f} s{', paused' * self.paused}>"

    @property
    def now(self) -> float:
        """The world's time [s]."""
        return self.host.now

    @property
    def paused(self) -> bool:
        """Whether time stands still."""
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
        """Insert a model, as `name`, at `pose`, from which its own pose counts. Unless static it stands on the ground.

        Raises `SpawnError`, and inserts nothing, if the name is used, something stands there, or a plugin lacks what it
        needs; and what the readers raise.
        """

    @abstractmethod
    def delete(self, name: str) -> None:
        """Remove a model, whether it moves or not: its topics end, all else goes on. Raises `UnknownEntity`."""

    @abstractmethod
    def move(self, model: Model, pose: Pose6, velocity: Velocity = STILL) -> None:
        """Put a model elsewhere, with a velocity in the world's frame.

        Raises `GazeboError` for what is not finite, `WorldError` if something is in the way.
        """

    def model(self, name: str) -> Model:
        """The model of this name. Raises `UnknownEntity`, with the nearest."""
        if name not in self.models:
            hint = nearest(name, self.models) or f"the models are: {', '.join(self.models) or 'none'}"
            raise UnknownEntity(f"there is no model {name!r} in the world {self.name!r}; {hint}")
        return self.models[name]

    def entity(self, name: str) -> tuple[Model, str]:
        """The model and the link that `model::link` names; `model` means its first link. Raises `UnknownEntity`."""
        model_name, _, link = name.partition("::")
        model = self.model(model_name)
        if not link:
            link = model.links[0] if model.links else ""
        elif link not in model.frames:
            model.link_frame(link)
        return model, link

    def frame(self, name: str) -> tuple[Pose6, Velocity]:
        """Pose and velocity, in the world, of a model, of a link, or of the world itself. Raises `UnknownEntity`."""
        if name in WORLD_FRAMES:
            return ORIGIN, STILL
        model, link = self.entity(name)
        if "::" not in name or not link:
            return model.pose, model.velocity
        return model.link_pose(link), model.link_velocity(link)

    def holds(self, name: str) -> bool:
        """Return whether what the engine calls so cannot be pushed: a wall, or a fixed obstacle."""
        if name in self.engine.robots:
            return math.isinf(self.engine.robots[name].model.mass)
        return not any(each.name == name for each in self.engine.obstacles())


@dataclass
class Model:
    """A model in a world; made by `GazeboWorld.spawn`."""

    world: GazeboWorld
    name: str
    sdf: SdfModel
    """What it is, seen from its own origin."""
    start: Pose6
    """Where it was spawned, and where a reset puts it."""
    namespace: str = ""
    """Of its topics, unless its plugins name their own."""
    frames: Mapping[str, tuple[str, Pose6]] = field(default_factory=dict)
    """Links of its URDF that became part of others: of which, and their pose in it."""
    body: Body | None = None
    """None for a thing, which is no robot of the engine."""
    obstacles: tuple[str, ...] = ()
    """The names of its obstacles in the engine, if it is a thing."""
    fixed: Pose6 | None = None
    """Its pose if nothing but a service moves it."""
    sensors: list[Sensor] = field(default_factory=list)

    def __repr__(self) -> str:
        x, y, _, _, _, yaw = self.pose
        return f"<Model {self.name} at ({x:.2f}, {y:.2f}), heading {yaw:.2f}>"

    @property
    def static(self) -> bool:
        """Whether it never moves by itself."""
        return self.sdf.static

    @property
    def robot(self) -> Robot | None:
        """The engine's robot, if it is one."""
        return self.world.engine.robot(self.name) if self.body is not None else None

    # -- where it is ---------------------------------------------------------------------------------------------

    @property
    def flat(self) -> Pose:
        """Where its origin is: x [m], y [m] and heading [rad]."""
        if self.fixed is not None:
            return (self.fixed[0], self.fixed[1], self.fixed[5])
        if self.body is not None:
            pose = self.world.engine.robot(self.name).pose
            return pose if self.body.axle == (0.0, 0.0, 0.0) else compose(pose, inverse(self.body.axle))
        return self.world.engine.pose(self.obstacles[0])

    @property
    def pose(self) -> Pose6:
        """Where its origin is: x, y, z [m], roll, pitch, yaw [rad]."""
        x, y, yaw = self.flat
        return (x, y, self.start[2], self.start[3], self.start[4], yaw)

    @property
    def velocity(self) -> Velocity:
        """How fast its origin goes, in the frame of the world."""
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

        Raises `GazeboError` for what is not finite, `WorldError` if something is in the way.
        """
        self.world.move(self, pose, velocity)

    def set_velocity(self, velocity: Velocity) -> None:
        """Push, drag or kick it: give it a velocity in the world's frame. If something is in its way, it keeps its own.

        A driven robot's wheels undo that. Raises `GazeboError` for what is not finite.
        """
        self.world.host.catch_up()
        vx, vy, w = velocity
        if self.fixed is None:
            for touch in self.world.engine.touching(
                self.name if self.body is not None else self.obstacles[0]
            ):
                inwards = min(0.0, vx * touch.nx + vy * touch.ny)
                if inwards and self.world.holds(touch.other):  # what cannot be pushed would have to be
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
        """Where a link, or one that became part of another, is in the model. Raises `UnknownEntity`."""
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
        """A pose in the model, seen from the robot of the engine, which turns about the middle of its axle."""
        if self.body is None or self.body.axle == (0.0, 0.0, 0.0):
            return pose
        x, y, yaw = inverse(self.body.axle)
        return compose6((x, y, 0.0, 0.0, 0.0, yaw), pose)

    def link_in_model(self, link: str) -> Pose6:
        """Pose of a link in the model now: wheels turn. Raises `UnknownEntity`."""
        frame = self.link_frame(link)
        wheels = self.body.sides if self.body is not None else {}
        for joint in self.sdf.joints:
            if joint.child == link and joint.name in wheels:
                return compose6(frame, _spin(joint.axis, self.joint(joint.name)[0]))
        return frame

    def link_pose(self, link: str) -> Pose6:
        """Where a link is in the world. Raises `UnknownEntity`."""
        return compose6(self.pose, self.link_in_model(link))

    def link_velocity(self, link: str) -> Velocity:
        """How fast a link goes, in the frame of the world."""
        vx, vy, w = self.velocity
        at, here = self.flat, self.link_pose(link)
        return (vx - w * (here[1] - at[1]), vy + w * (here[0] - at[0]), w)

    def joint(self, name: str) -> tuple[float, float]:
        """The position of a joint and its rate [rad, rad/s]; 0 for all but wheels. Raises `UnknownEntity`."""
        if name not in self.joints:
            hint = nearest(name, self.joints) or f"its joints are: {', '.join(self.joints) or 'none'}"
            raise UnknownEntity(f"the model {self.name!r} has no joint {name!r}; {hint}")
        robot = self.robot
        if robot is None or self.body is None or name not in self.body.sides:
            return (0.0, 0.0)
        radius = self.body.wheel_radius
        right = self.body.sides[name]
        way, speed = (robot.right_way, robot.right) if right else (robot.left_way, robot.left)
        return (way / radius, speed / radius)


@dataclass
class Sensor:
    """A sensor on a model."""

    model: Model
    sdf: SdfSensor
    link: str
    """The link that it sits on."""

    @property
    def name(self) -> str:
        """As in the file."""
        return self.sdf.name

    @property
    def type(self) -> str:
        """ray, gpu_ray, camera, depth, imu, contact..."""
        return self.sdf.type

    @property
    def element(self) -> Element:
        """The raw tag."""
        return self.sdf.element

    @property
    def device_name(self) -> str:
        """Under which its device draws noise: model/sensor."""
        return f"{self.model.name}/{self.name}"

    @property
    def mount(self) -> Pose6:
        """Where it sits, seen from the robot of the engine."""
        return self.model.on_robot(compose6(self.model.link_frame(self.link), self.sdf.pose))


def _spin(axis: tuple[float, float, float], angle: float) -> Pose6:
    """A turn about an axis, as a pose."""
    x, y, z = axis
    length = math.sqrt(x * x + y * y + z * z)
    if not length or not angle:
        return ORIGIN
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]) / length
    turn = np.eye(4)
    turn[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * matrix_product(cross, cross)
    return pose6(turn)
