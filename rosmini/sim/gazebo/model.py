"""A model in the running world: what plugins and services speak of.

What can drive, or carries a sensor, is a robot of the engine. Of the rest, what is static is one fixed obstacle or more, and what is not is one that can
be pushed. All stands upright on flat ground: a height, a roll or a pitch stays as it was when the model came.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from rosmini.errors import nearest
from rosmini.geometry.poses import Pose, compose, inverse
from rosmini.markup import Element
from rosmini.sim.engine.robot import Robot
from rosmini.sim.sdf import ORIGIN, Pose6, SdfModel, SdfSensor
from rosmini.sim.sdf.poses import compose as compose6
from rosmini.sim.sdf.poses import pose6
from rosmini.sim.world import WorldError

from .body import Body, placed_links
from .errors import UnknownEntity

if TYPE_CHECKING:
    from .plugins import Plugin
    from .world import GazeboWorld

Velocity = tuple[float, float, float]
"""Along x and y of the world [m/s], and counter-clockwise [rad/s]."""

STILL: Velocity = (0.0, 0.0, 0.0)


@dataclass
class Model:
    """A model in a world; made by `GazeboWorld.spawn`."""

    world: GazeboWorld
    name: str
    sdf: SdfModel
    """What it is, seen from its own origin."""
    start: Pose6
    """Where it came into the world, and where a reset puts it."""
    namespace: str = ""
    """Of its topics, where its plugins do not say their own."""
    frames: Mapping[str, tuple[str, Pose6]] = field(default_factory=dict)
    """Links of its URDF that became part of others: of which, and where in it."""
    body: Body | None = None
    """None: a thing, and no robot of the engine."""
    obstacles: tuple[str, ...] = ()
    """What it is to the engine if it is a thing."""
    fixed: Pose6 | None = None
    """Where it is if nothing but a service moves it."""
    sensors: list[Sensor] = field(default_factory=list)
    plugins: list[Plugin] = field(default_factory=list)

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
        """Put it elsewhere, with a velocity in the frame of the world. Raises `GazeboError` for what is not finite, `WorldError` if something stands there."""
        self.world.move(self, pose, velocity)

    def set_velocity(self, velocity: Velocity) -> None:
        """Give it a velocity in the frame of the world: what pushes, drags or kicks it; if something is in its way it keeps its own.

        A driven robot's wheels take that back. Raises `GazeboError` for what is not finite.
        """
        self.world.host.catch_up()
        vx, vy, w = velocity
        if self.fixed is None:
            for touch in self.world.engine.touching(
                self.name if self.body is not None else self.obstacles[0]
            ):
                inwards = min(0.0, vx * touch.nx + vy * touch.ny)
                if inwards and self.world.holds(touch.other):  # what stands fast would have to be pushed
                    vx, vy = vx - inwards * touch.nx, vy - inwards * touch.ny
        with contextlib.suppress(WorldError):
            self.world.move(self, self.pose, (vx, vy, w))

    # -- of what it consists -------------------------------------------------------------------------------------

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
        """Where a link is in the model now: wheels turn. Raises `UnknownEntity`."""
        frame = self.link_frame(link)
        wheels = self.body.wheels if self.body is not None else None
        for joint in self.sdf.joints:
            if wheels and joint.child == link and joint.name in wheels:
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
        """The position of a joint and how fast it changes [rad, rad/s]; what is no wheel stands at 0. Raises `UnknownEntity`."""
        if name not in self.joints:
            hint = nearest(name, self.joints) or f"its joints are: {', '.join(self.joints) or 'none'}"
            raise UnknownEntity(f"the model {self.name!r} has no joint {name!r}; {hint}")
        robot = self.robot
        if robot is None or self.body is None or not self.body.wheels or name not in self.body.wheels:
            return (0.0, 0.0)
        radius = self.body.wheel_radius
        left = name == self.body.wheels[0]
        way, speed = (robot.left_way, robot.left) if left else (robot.right_way, robot.right)
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
    turn[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * (cross @ cross)
    return pose6(turn)
