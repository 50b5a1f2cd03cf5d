"""A Gazebo world at one moment, for pictures: the result of `snapshot()` of a server or a client."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import compose
from rosmini.core.graph.show import show
from rosmini.sim.models import RobotModel
from rosmini.sim.sdf import placed_links, to_obstacles
from rosmini.sim.sdf.document import ORIGIN, Pose6, SdfCollision, SdfVisual
from rosmini.sim.world import Obstacle, World

from .model import Model
from .ros_plugins.lasers import lidar_of
from .running_world import RunningWorld
from .topics import Poses, wheels

Place = tuple[float, float, float]


@dataclass(frozen=True)
class Robot:
    """A model with a drive, seen from above."""

    name: str
    model: RobotModel
    pose: Place
    """Pose of the middle of its axle: x [m], y [m], heading [rad]."""


@dataclass(frozen=True)
class ShownLink:
    """A link of a model; its pose is in the frame of the model."""

    name: str
    pose: Pose6
    visuals: tuple[SdfVisual, ...]
    collisions: tuple[SdfCollision, ...]


@dataclass(frozen=True)
class ShownModel:
    """A model with its links, and its shape in a flat world."""

    name: str
    static: bool
    pose: Pose6
    links: tuple[ShownLink, ...]
    solids: tuple[Obstacle, ...]
    """Its obstacles, in the frame of the model."""
    robot: RobotModel | None
    """For a model with a drive: its outline, wheels and laser."""
    axle: Place
    """The middle of the robot's axle in the frame of the model."""

    @classmethod
    def of(cls, model: Model, poses: Poses) -> ShownModel:
        """Return a model at the given poses, or at its own if they do not contain it."""
        turning = wheels(model)
        links = []
        for name, link, pose in placed_links(model.sdf):
            if name in turning:
                pose = poses.places.get(f"{model.name}::{name}", pose)
            links.append(ShownLink(name, pose, tuple(link.visuals), tuple(link.collisions)))
        at = poses.places.get(model.name, model.pose)
        return cls(model.name, model.static, at, tuple(links), _solids(model), *_robot(model))

    @property
    def place(self) -> Place:
        """Its pose on the ground: x [m], y [m], heading [rad]."""
        return (self.pose[0], self.pose[1], normalize_angle(self.pose[5]))

    def placed_solids(self) -> Iterator[Obstacle]:
        """Yield its obstacles in the frame of the world."""
        for each in self.solids:
            yield replace(each, pose=compose(self.place, each.pose), mass=None, motion=None)


def _solids(model: Model) -> tuple[Obstacle, ...]:
    """Return a model's obstacles in a flat world, in its own frame."""
    if model.body is not None:
        return tuple(
            Obstacle(
                f"{model.name} {i}" if i else model.name,
                part.shape,
                compose(model.body.axle, part.pose),
                part.top,
                part.colour,
                bottom=part.bottom,
            )
            for i, part in enumerate(model.body.parts())
            if part.top > 0
        )
    if model.sdf.links and not any(link.collisions for link in model.sdf.links):
        own = (each for each in model.world.flat.obstacles if each.name in model.obstacles)
        return tuple(replace(each, pose=(0.0, 0.0, 0.0)) for each in own)
    at: Pose6 = (*ORIGIN[:2], *model.start[2:5], 0.0)
    return to_obstacles(replace(model.sdf, static=True), at)  # each part has its own colour


def _robot(model: Model) -> tuple[RobotModel | None, Place]:
    """Return a model with a drive as seen from above, and the middle of its axle."""
    if model.body is None or model.body.drive is None:
        return None, (0.0, 0.0, 0.0)
    robot = model.body.robot_model()
    for sensor in model.sensors:
        if sensor.element.find("ray") is not None or sensor.element.find("lidar") is not None:
            try:
                return replace(robot, lidar=lidar_of(sensor)), model.body.axle
            except RosminiError:  # the server has warned that this laser is not simulated
                continue
    return robot, model.body.axle


class Pictured(ABC):
    """The base of objects that are shown as a snapshot: a server, a client, and a snapshot itself."""

    @abstractmethod
    def snapshot(self) -> Snapshot:
        """Return the world as it is now, or as it was when this object was created."""

    def show(self, **options: Any) -> Any:
        """Return a picture of the world from above.

        Options and their defaults:
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("gazebo", self.snapshot(), **options)

    def show3d(self, **options: Any) -> Any:
        """Return a picture of the world in three dimensions.

        Options and their defaults:
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("gazebo_3d", self.snapshot(), **options)


@dataclass(frozen=True)
class Snapshot(Pictured):
    """The models of a world, their poses, and the time."""

    name: str
    models: tuple[ShownModel, ...]
    flat: World
    """The walls that are not models, in a world made from a map."""
    time: float
    """Time of the world [s]."""
    paused: bool

    @classmethod
    def of(cls, world: RunningWorld, poses: Poses | None = None) -> Snapshot:
        """Return the world at the given poses, or as it is now."""
        if poses is None:
            world.host.catch_up()
            poses = Poses.of(world)
        models = tuple(ShownModel.of(model, poses) for model in world.models.values())
        return cls(world.name, models, replace(world.flat, obstacles=()), poses.time, world.paused)

    def snapshot(self) -> Snapshot:
        """Return the snapshot itself."""
        return self

    @property
    def title(self) -> str:
        """The title of a picture of it."""
        return f"Gazebo's world {self.name}"

    @property
    def robots(self) -> tuple[Robot, ...]:
        """The models with a drive."""
        return tuple(
            Robot(model.name, model.robot, compose(model.place, model.axle))
            for model in self.models
            if model.robot is not None
        )

    @property
    def things(self) -> tuple[ShownModel, ...]:
        """The models that are neither static nor have a drive."""
        return tuple(model for model in self.models if not model.static and model.robot is None)

    @property
    def standing(self) -> tuple[ShownModel, ...]:
        """The static models."""
        return tuple(model for model in self.models if model.static and model.robot is None)

    def world(self, *, robots: bool = True) -> World:
        """Return everything solid as a flat world, with or without the models that have a drive."""
        names: dict[str, int] = {}
        found = []
        for model in self.models:
            for each in model.placed_solids() if robots or model.robot is None else ():
                count = names[each.name] = names.get(each.name, 0) + 1
                found.append(each if count == 1 else replace(each, name=f"{each.name} ({count})"))
        return replace(self.flat, name=self.name, obstacles=tuple(found), title=self.title)
