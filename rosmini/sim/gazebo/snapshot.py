"""A world at one moment, as Gazebo's messages describe it: what a client shows."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from rosmini.geometry.poses import compose
from rosmini.graph.show import show
from rosmini.sim.models import RobotModel
from rosmini.sim.sdf import Pose6
from rosmini.sim.sdf.poses import from_quaternion
from rosmini.sim.world import Obstacle, World

from .msgs import Model, Pose, Scene

Place = tuple[float, float, float]


@dataclass(frozen=True)
class Robot:
    """A model with a drive, seen from above."""

    name: str
    model: RobotModel
    pose: Place
    """Of the middle of its axle: x [m], y [m], heading [rad]."""


class Pictured(ABC):
    """What has a snapshot to be shown: the server, a client, and a snapshot itself."""

    @abstractmethod
    def snapshot(self) -> Snapshot:
        """The world as it is now, or as it was when this was made."""

    def show(self, **options: Any) -> Any:
        """A picture of the world from above.

        Options, with what they are unless given:
            robot=None: the pose of the robot of `scan`, `trail` and `odom`; None: that of `name`
            model=None: what robot it is; None: as Gazebo has it
            scan=None: what its laser measured: a `sensor_msgs/LaserScan`, or ranges [m]
            scan_from=None: where it was then; None: where it is
            trail=None: where it was, (n, 2) or (n, 3)
            odom=None: where its odometry believes that it was, likewise
            others=(): more robots, each an `Other`
            name='': of the model that is drawn as the first robot; '': the first that drives
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("gazebo", self.snapshot(), **options)

    def show3d(self, **options: Any) -> Any:
        """The world in three dimensions.

        Options, with what they are unless given:
            focus='world': what the camera looks at: 'world', or the name of a model
            collisions=False: show what is solid in place of what one sees
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg], 0: from the side of x, 90: of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("gazebo_3d", self.snapshot(), **options)


@dataclass(frozen=True)
class Snapshot(Pictured):
    """What there is in a world, where all of it is, and what time it is there."""

    name: str
    models: tuple[Model, ...]
    """Each with its pose, and with its links where they are now."""
    flat: World
    """Walls that are no models."""
    time: float
    """[s]"""
    paused: bool

    @classmethod
    def of(cls, scene: Scene, poses: Mapping[str, Pose], time: float, *, paused: bool) -> Snapshot:
        """A scene with its models and links where ~/pose/info said last."""
        models = tuple(_moved(model, poses) for model in scene.model)
        flat = scene.flat or World(scene.name)
        return cls(scene.name, models, flat, time, paused)

    def snapshot(self) -> Snapshot:
        """The snapshot itself."""
        return self

    @property
    def title(self) -> str:
        """What it is called."""
        return f"Gazebo's world {self.name}"

    @property
    def robots(self) -> tuple[Robot, ...]:
        """The models that have a drive."""
        return tuple(
            Robot(model.name, model.flat.robot, compose(place_of(model.pose), model.flat.axle))
            for model in self.models
            if model.flat.robot is not None and model.pose is not None
        )

    @property
    def things(self) -> tuple[Model, ...]:
        """The models that are neither static nor have a drive."""
        return tuple(model for model in self.models if not model.is_static and model.flat.robot is None)

    @property
    def standing(self) -> tuple[Model, ...]:
        """The static models."""
        return tuple(model for model in self.models if model.is_static and model.flat.robot is None)

    def world(self, *, robots: bool = True) -> World:
        """All that is solid, as a flat world; with or without the models that have a drive."""
        names: dict[str, int] = {}
        found = []
        for model in self.models:
            for each in solids_of(model) if robots or model.flat.robot is None else ():
                count = names[each.name] = names.get(each.name, 0) + 1
                found.append(each if count == 1 else replace(each, name=f"{each.name} ({count})"))
        return replace(self.flat, name=self.name, obstacles=tuple(found), title=self.title)


def solids_of(model: Model) -> Iterator[Obstacle]:
    """What is solid of a model, where it is."""
    if model.pose is not None:
        at = place_of(model.pose)
        for each in model.flat.solids:
            yield replace(each, pose=compose(at, each.pose), mass=None, motion=None)


def place_of(pose: Pose) -> Place:
    """Where something is on the ground."""
    x, y, _, _, _, yaw = pose_of(pose)
    return (x, y, yaw)


def pose_of(message: Pose) -> Pose6:
    """The six numbers of a pose."""
    at, to = message.position, message.orientation
    return (at.x, at.y, at.z, *from_quaternion(to.x, to.y, to.z, to.w))


def _moved(model: Model, poses: Mapping[str, Pose]) -> Model:
    links = tuple(replace(link, pose=poses[link.name]) if link.name in poses else link for link in model.link)
    return replace(model, pose=poses.get(model.name, model.pose), link=links)
