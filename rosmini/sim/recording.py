"""A recorded run: poses, odometry, commands and scans of a robot as arrays; also other robots and moving obstacles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import compose, inverse
from rosmini.core.geometry.products import norms
from rosmini.core.graph.show import show

from .models import RobotModel
from .world import Obstacle, Pose, World

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SubjectRobot:
    """A robot in a Gazebo world."""

    model: RobotModel
    namespace: str
    axle: Pose
    """The middle of its axle in the frame of its model."""


@dataclass(frozen=True)
class Subject:
    """What a recorder needs to know of a Gazebo world, whose topics do not say it."""

    world: World
    """Everything that is no robot; movable objects have their current poses."""
    robots: Mapping[str, SubjectRobot]
    states: str
    """The topic with the poses of all models: `gazebo_msgs/ModelStates`."""


class RecordingError(RosminiError, ValueError):
    """There is no recording, or its arrays are inconsistent; the message says which one, or what to run first."""


class Drift(NamedTuple):
    """Error of odometry over time."""

    position: Floats
    """(n,) [m]"""
    heading: Floats
    """(n,) [rad] in (-pi, pi]: positive if odometry's heading is too far to the left."""


@dataclass(frozen=True, eq=False)
class Moved:
    """An obstacle that moves, and its poses.

    Raises:
        RecordingError: an array has the wrong shape, or times do not increase.

    """

    obstacle: Obstacle
    """The obstacle, at its initial pose."""
    times: Floats
    """(n,) [s], increasing; n is at least 1. It moves uniformly between them, and is at rest before and after."""
    poses: Floats
    """(n, 3): x [m], y [m], heading [rad]; headings are not wrapped."""

    def __post_init__(self) -> None:
        name, n = self.obstacle.name, len(self.times)
        if not n or self.times.shape != (n,) or self.poses.shape != (n, 3):
            raise RecordingError(
                f"where {name!r} was must be times (n,) and poses (n, 3), not {self.times.shape} and {self.poses.shape}"
            )
        if not np.isfinite(self.poses).all() or (np.diff(self.times) <= 0).any():
            raise RecordingError(f"the times when {name!r} was somewhere must increase, and its poses be finite")

    def at(self, time: float) -> Obstacle:
        """Return the obstacle at its pose at this time."""
        return replace(self.obstacle, pose=_between(self.times, self.poses, time))

    @property
    def distance(self) -> float:
        """Distance it moved [m]."""
        return float(norms(np.diff(self.poses[:, :2], axis=0)).sum())

    def window(self, t0: float, t1: float) -> Moved:
        """Return the part from `t0` to `t1`."""
        inner = (self.times > t0) & (self.times < t1)
        ends = [_between(self.times, self.poses, t) for t in (t0, t1)]
        if t1 <= t0:
            return replace(self, times=np.array([t0]), poses=np.array(ends[:1]))
        return replace(
            self,
            times=np.concatenate([[t0], self.times[inner], [t1]]),
            poses=np.vstack([ends[0], self.poses[inner], ends[1]]),
        )


@dataclass(frozen=True, eq=False)
class Recording:
    """A run of one robot, and of other robots in the same world.

    All times are seconds since the beginning of the run, all poses x [m], y [m], heading [rad]. `truth` and `odom` are
    sampled at `times`; each is in its own frame (`map` and `odom`), as in the messages.

    Raises:
        RecordingError: an array has the wrong shape or contains inf or nan, or times do not increase.

    """

    world: World
    model: RobotModel
    times: Floats
    """(n,), increasing; n is at least 1."""
    truth: Floats
    """(n, 3): true poses; headings are not wrapped."""
    odom: Floats
    """(n, 3): poses according to odometry; headings are not wrapped."""
    commands: Floats
    """(m, 3): time, linear [m/s] and angular [rad/s] velocity of each command."""
    scan_times: Floats
    """(k,), increasing."""
    scans: Floats
    """(k, beams): ranges [m], inf for no hit, -inf for too near.

    Beam i is at angle_min + i increment of the laser's model, counter-clockwise: 2 pi i / beams for a full circle.
    """
    time_increment: float = 0.0
    """The time between neighbouring beams [s], as in the messages: negative if the last beam was measured first."""
    name: str = ""
    """The robot's name if there are several robots."""
    others: tuple[Recording, ...] = ()
    """The runs of the other robots, on the same clock."""
    things: tuple[Moved, ...] = ()
    """Obstacles that were moved, or moved by themselves."""
    messages: tuple[tuple[float, str, Any], ...] = ()
    """Other messages: (time [s], topic, message), in order; maps, plans, particles ... and transforms."""
    topics: tuple[str, ...] = ()
    """The topics of other messages, also those without a message in this run."""

    def __post_init__(self) -> None:
        n, k, beams = (len(self.times), len(self.scan_times), 0 if self.model.lidar is None else self.model.lidar.beams)
        if not n:
            raise RecordingError("a recording needs at least one sample: truth and odom at one time")
        wanted = {"times": (n,), "truth": (n, 3), "odom": (n, 3), "scan_times": (k,), "scans": (k, beams)}
        wanted["commands"] = (len(self.commands), 3)
        for name, shape in wanted.items():
            array = getattr(self, name)
            if array.shape != shape:
                raise RecordingError(f"{name} of a recording must be an array {shape}, not {array.shape}")
            bad = np.isnan(array) if name == "scans" else ~np.isfinite(array)
            if bad.any():
                place = ", ".join(str(i) for i in np.argwhere(bad)[0])
                raise RecordingError(f"{name}[{place}] of a recording is {array[bad][0]}, which is not a number")
        for name in ("times", "scan_times"):
            if (np.diff(getattr(self, name)) <= 0).any():
                raise RecordingError(f"{name} of a recording must increase")

    def __repr__(self) -> str:
        who = self.model.name if not self.others else " and ".join(each.name for each in self.robots)
        return (
            f"<Recording of {who} in {self.world.name}: {self.duration:.1f} s, {len(self.times)} poses, "
            f"{len(self.scans)} scans, {len(self.commands)} commands>"
        )

    @property
    def robots(self) -> tuple[Recording, ...]:
        """The runs of all robots, this one first."""
        return (self, *self.others)

    def world_at(self, time: float) -> World:
        """Return the world with its obstacles at their poses at this time."""
        moved = {thing.obstacle.name: thing.at(time) for thing in self.things}
        stayed = [moved.pop(o.name, o) for o in self.world.obstacles]
        return replace(self.world, obstacles=(*stayed, *moved.values()))

    @property
    def duration(self) -> float:
        """Duration of the run [s]."""
        return float(self.times[-1] - self.times[0])

    @property
    def distance(self) -> float:
        """True distance travelled by the robot [m]."""
        return float(norms(np.diff(self.truth[:, :2], axis=0)).sum())

    def odom_in_map(self) -> Floats:
        """Return odometry (n, 3) in the frame of `truth`, aligned so that both start with the same pose."""
        return compose(compose(_pose(self.truth[0]), inverse(_pose(self.odom[0]))), self.odom)

    def drift(self) -> Drift:
        """Return odometry's error since the start: its distance from the true position, and its error in heading."""
        off = self.odom_in_map() - self.truth
        return Drift(np.hypot(off[:, 0], off[:, 1]), normalize_angle(off[:, 2]))

    def pose_at(self, time: float) -> tuple[float, float, float]:
        """Return the robot's true pose at a time, limited to the beginning and end of the run."""
        return _between(self.times, self.truth, time)

    def scan_poses(self, which: int) -> Floats:
        """Return the robot's true pose at each beam of a scan (beams, 3)."""
        times = self.scan_times[which] + self.time_increment * np.arange(self.scans.shape[1])
        return np.column_stack([np.interp(times, self.times, column) for column in self.truth.T])

    def show(self, **options: Any) -> Any:
        """Return a picture of the run from above.

        Options and their defaults:
            scan=False: also draw the last scan
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("recording", self, **options)

    def replay(self, **options: Any) -> Any:
        """Return a player for the run, with play, pause, scrub and speed, and a switch for each layer.

        Options and their defaults:
            title=None: a caption, and the first words of the text form
            names=None: a list with the run's name
            topics=None: of the other messages, only these topics; None: all
            frame=None: the frame they are drawn in; None: map, odom or world, whichever exists first
            robot=None: not needed here, since the recording knows its robot
            opens_at_end=False: show the end at first, not the start
        """
        return show("replay", self, **options)

    def replay3d(self, **options: Any) -> Any:
        """Return a player for the run in three dimensions.

        Options and their defaults:
            focus='robot': the camera follows the robot; 'world': it does not move
            distance=None: of the camera from its target [m]; None: chosen automatically
            azimuth=None: direction of the camera [deg]: 0 towards x, 90 towards y; None: chosen automatically
            elevation=None: elevation of the camera [deg]; None: chosen automatically
            scans=True: show the laser's scans
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
            topics=None: of the other messages, only these topics; None: all
            frame=None: the frame they are drawn in; None: map, odom or world, whichever exists first
            robot=None: not needed here, since the recording knows its robot
            names=None: for runs side by side; no effect for one run
        """
        return show("replay_3d", self, **options)


def since(commands: Floats, begin: float) -> Floats:
    """Return the commands (m, 3) from `begin` on, preceded by the one in force then, with the time `begin`."""
    before = commands[commands[:, 0] < begin][-1:].copy()
    after = commands[commands[:, 0] >= begin]
    if len(after) and after[0, 0] == begin:
        return after
    before[:, 0] = begin
    return np.vstack([before, after])


def _between(times: Floats, poses: Floats, time: float) -> tuple[float, float, float]:
    """Interpolate poses (n, 3) at `times` (n,) linearly."""
    x, y, heading = (float(np.interp(time, times, column)) for column in poses.T)
    return (x, y, heading)


def _pose(row: Floats) -> tuple[float, float, float]:
    x, y, heading = row.tolist()
    return (x, y, heading)
