"""A node that records a run: it subscribes to the robots' topics and collects arrays from the messages."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph import Graph, Subscriber, running_graph
from rosmini.core.graph.show import find_extension
from rosmini.msgs import message_class

from .markers import first_poses, obstacles_of
from .models import LidarModel, RobotModel
from .recording import Moved, Recording, RecordingError, Subject, since
from .shapes import simple_parts
from .simulation import Simulation
from .world import Obstacle, World

Floats = NDArray[np.float64]

TRUTH, ODOM, SCAN, COMMANDS = "base_pose_ground_truth", "odom", "scan", "cmd_vel"
RECORDED = "rosmini.recorded_types"
"""Group of the entry points that name the types of messages that a replay shows."""
CHECK_PERIOD = 0.5
"""Interval between checks for new topics [s]."""
STATES_PERIOD = 1 / 30
"""Shortest interval between two recorded `gazebo_msgs/ModelStates`, which Gazebo sends in each step [s]."""


class Simulated(Protocol):
    """The properties that a recorder reads from a simulator."""

    @property
    def world(self) -> World: ...  # noqa: D102 (see the class)

    @property
    def model(self) -> RobotModel: ...  # noqa: D102


@runtime_checkable
class Described(Protocol):
    """A Gazebo server."""

    def subject(self) -> Subject: ...  # noqa: D102 (see the class)


class Recorder:
    """Records `scan`, `odom`, `base_pose_ground_truth` and `cmd_vel` of one robot or several.

    It is an ordinary node and uses only messages. Times are those of their headers; a `geometry_msgs/Twist` has no
    header, so a command's time is that of its arrival. In Gazebo, where no robot publishes `base_pose_ground_truth`,
    the true poses are those on `/gazebo/model_states`, and objects that are spawned later are not recorded. If the
    clock goes back (a simulation is reset, a bag is played in a loop), a new run begins.

    Args:
        graph: the robot's graph; the default graph if not given.
        simulator: an object with `world` and `model`, or Gazebo's server; or give these two; or neither, for the only
            simulation in the graph. If it has several robots, all present ones are recorded.
        world: the robot's world.
        model: the robot's model.
        namespace: the namespace of the robot's topics and of this node.
        name: the name of this node.
        things: the topic with the poses of moving obstacles: `visualization_msgs/MarkerArray`s, as on the
            simulator's `obstacles`, or `gazebo_msgs/ModelStates`, as on `/gazebo/model_states`. Without it they are
            assumed not to move.
        scan: the name of the laser topic: `scan`, or, in Stage, `base_scan`.
        layers: also record everything else that is visible from above, on any topic, now or later: maps, costmaps,
            plans, particles, markers, images, and transforms; a player of the run shows each as a layer.

    Raises:
        RecordingError: neither a simulator nor a world and a model are given, and not exactly one simulation runs.

    """

    def __init__(
        self,
        graph: Graph | None = None,
        simulator: Simulated | Described | None = None,
        *,
        world: World | None = None,
        model: RobotModel | None = None,
        namespace: str = "/",
        name: str = "recorder",
        things: str | None = None,
        scan: str = SCAN,
        layers: bool = False,
    ) -> None:
        graph = running_graph() if graph is None else graph
        if simulator is None and world is None and model is None:
            simulator = _only_simulation(graph)
        robots: dict[str, Any] = {}
        first = ""
        axles: dict[str, Pose] = {}
        if isinstance(simulator, Described):
            subject = simulator.subject()
            robots = dict(subject.robots)
            if not robots:
                raise RecordingError("there is no robot in Gazebo's world: spawn one, and record then")
            first, *_ = robots
            world, model = world or subject.world, model or robots[first].model
            things = things or subject.states
            axles = {name: robot.axle for name, robot in robots.items()}
        elif simulator is not None:
            world, model = world or simulator.world, model or getattr(simulator, "model", None)
            robots, first = dict(getattr(simulator, "robots", {})), getattr(simulator, "name", "")
            first = first if first in robots or not robots else next(iter(robots))
            if things is None and getattr(getattr(simulator, "parameters", None), "obstacles", False):
                things = simulator.node.resolve("obstacles")  # type: ignore[attr-defined]
        if world is None or model is None:
            raise RecordingError(
                "a recorder has to know the world and the robot: Recorder(graph, simulator), or Recorder(graph, "
                "world=..., model=...)"
            )
        self.world = world
        self.model = model
        self.node = graph.node(name, namespace=namespace or "/")
        self.scan_topic = scan
        self._things = None if things is None else _MovingObstacles(self, things, axles)
        self._layers = _Layers(self, things) if layers else None
        self._runs: dict[str, _Run] = {}
        own = robots.pop(first, None)
        # a namespace in the arguments is the first robot's, and this node is in it
        space = "" if own is None or namespace not in ("", "/") else own.namespace
        self._first = _Run(self, first, model, space and _resolved(simulator, space))
        self._runs[first] = self._first
        for other, robot in robots.items():
            self._runs[other] = _Run(self, other, robot.model, _resolved(simulator, robot.namespace or "/"))

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(track.rows)} {topic}" for topic, track in self._first.tracks.items())
        more = len(self._runs) - 1
        return f"<Recorder {self.node.name}: {counts}{f', and {more} more robots' if more else ''}>"

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the recorded robots."""
        return tuple(self._runs)

    def clear(self) -> None:
        """Discard the recorded data and begin a new run."""
        for run in self._runs.values():
            for track in run.tracks.values():
                track.clear()
        if self._things is not None:
            self._things.clear()
        if self._layers is not None:
            self._layers.clear()

    def stop(self) -> None:
        """Shut down the node and keep the recorded data; harmless when repeated."""
        self.node.shutdown("the recording was stopped")

    def recording(self) -> Recording:
        """Return the run so far. It begins with the first pose for which both the truth and odometry are known.

        Odometry is interpolated at the times of the truth; a simulator publishes both at the same times. An earlier
        command that is still in force is included at the beginning. Other robots' data begin at the same time; a robot
        without data is left out.

        Raises:
            RecordingError: nothing was recorded yet, or the scans do not match the robot's laser.

        """
        begin = self._first.begin()
        if begin is None:
            raise RecordingError(self._nothing())
        others = [
            run.recording(begin) for run in self._runs.values() if run is not self._first and run.begin() is not None
        ]
        own = self._first.recording(begin)
        if self._layers is not None:
            own = replace(own, messages=self._layers.messages(begin), topics=tuple(sorted(self._layers.topics)))
        if not others and self._things is None:
            return own
        things = () if self._things is None else self._things.moved(begin, float(own.times[-1]))
        return replace(own, name=self._first.name, others=tuple(others), things=things)

    def _nothing(self) -> str:
        tracks = self._first.tracks
        silent = [topic for topic in (TRUTH, ODOM) if not tracks[topic].rows]
        if not silent:
            return f"the messages on {TRUTH} and {ODOM} have no time in common: do both come from the same clock?"
        names = [self.node.resolve(self._first.topic(topic)) for topic in silent]
        said = "; ".join(f"no message on {name}, {self.node.master.who_publishes(name)}" for name in names)
        if self.node.shutdown_reason is not None:
            return f"nothing was recorded before the recorder was stopped: {said}."
        return (
            f"nothing is recorded yet: {said}. Let time pass while the simulator runs, for instance graph.run(5.0); "
            f"if the robot's topics have a namespace, give it: Recorder(..., namespace='/robot1')."
        )

    def clock_went_back(self, topic: str, by: float) -> None:
        """Log that the clock went back [s], and begin a new run."""
        self.node.logwarn(f"the time on {self.node.resolve(topic)} went back by {by:.3f} s: a new recording begins")
        self.clear()

    def add_truth(self, name: str, stamp: int, pose: Pose) -> None:
        """Record the true pose of a robot at a time [ns]."""
        self._runs[name].add(TRUTH, stamp, pose)

    def stamp(self, header: Any) -> int:
        """Return a header's time [ns], or the current time if the sender left it out."""
        return header.stamp.to_nsec() or self.node.clock.now_ns()


def _only_simulation(graph: Graph) -> Any:
    """Return the only simulation in a graph. Raises `RecordingError` unless there is exactly one."""
    found = {name: node.program for name, node in graph.nodes.items() if isinstance(node.program, Simulation)}
    if len(found) != 1:
        there = f"{len(found)} simulations run in this graph ({', '.join(found)})" if found else "no simulation runs"
        raise RecordingError(
            f"{there}: start one (rosrun rosmini_sim simulator), or say what to record: Recorder(graph, simulator)"
        )
    return next(iter(found.values()))


def _resolved(simulator: Any, namespace: str) -> str:
    """Return the full name of a namespace given by a simulator's node."""
    return str(simulator.node.resolve(namespace))


class _Run:
    """The data from the topics of one robot."""

    def __init__(self, recorder: Recorder, name: str, model: RobotModel, namespace: str) -> None:
        self.name, self.model, self._recorder, self._namespace = name, model, recorder, namespace
        self.tracks: dict[str, _Track] = {topic: _Track() for topic in (TRUTH, ODOM, SCAN, COMMANDS)}
        node, odometry = recorder.node, message_class("nav_msgs/Odometry")
        node.subscriber(self.topic(TRUTH), odometry, self._pose, arguments=(TRUTH,))
        node.subscriber(self.topic(ODOM), odometry, self._pose, arguments=(ODOM,))
        if model.lidar is not None:
            node.subscriber(self.topic(recorder.scan_topic), message_class("sensor_msgs/LaserScan"), self._scan)
        node.subscriber(self.topic(COMMANDS), message_class("geometry_msgs/Twist"), self._command)

    def topic(self, name: str) -> str:
        """Return the name of one of its topics."""
        return f"{self._namespace.rstrip('/')}/{name}" if self._namespace else name

    def _pose(self, message: Any, topic: str) -> None:
        self.add(topic, self._recorder.stamp(message.header), _flat(message.pose.pose))

    def _scan(self, message: Any) -> None:
        self.add(SCAN, self._recorder.stamp(message.header), message)

    def _command(self, message: Any) -> None:
        velocities = (message.linear.x, message.angular.z)
        if all(math.isfinite(v) for v in velocities):  # commands that are not finite drive no robot
            self.add(COMMANDS, self._recorder.node.clock.now_ns(), velocities)

    def add(self, topic: str, stamp: int, row: Any) -> None:
        """Add a value from a topic at a time [ns]."""
        back = self.tracks[topic].behind(stamp)
        if back:
            self._recorder.clock_went_back(self.topic(topic), back)
        self.tracks[topic].add(stamp, row)

    def _times(self) -> NDArray[np.int64]:
        """Return the stamps [ns] of the truth for which odometry is known too."""
        truth, odom = self.tracks[TRUTH], self.tracks[ODOM]
        stamps = np.array(truth.stamps, dtype=np.int64)
        if not (truth.rows and odom.rows):
            return stamps[:0]
        return stamps[(stamps >= odom.stamps[0]) & (stamps <= odom.stamps[-1])]

    def begin(self) -> int | None:
        """Return the first stamp [ns] for which the truth and odometry are known, or None."""
        stamps = self._times()
        return int(stamps[0]) if len(stamps) else None

    def recording(self, begin: int) -> Recording:
        """Return the data from `begin` [ns] on; all data of a robot that was added later."""
        stamps = self._times()
        times = seconds(stamps[stamps >= begin] if (stamps >= begin).any() else stamps[-1:], begin)
        commands, scans = self.tracks[COMMANDS], self.tracks[SCAN]
        given = np.column_stack([seconds(commands.stamps, begin), np.array(commands.rows, dtype=float).reshape(-1, 2)])
        scan_times = seconds(scans.stamps, begin)
        kept = scan_times >= 0
        lidar = self.model.lidar
        turned = (
            [] if lidar is None else [aligned(scan, lidar) for scan, keep in zip(scans.rows, kept, strict=True) if keep]
        )
        return Recording(
            self._recorder.world,
            self.model,
            times=times,
            truth=self.tracks[TRUTH].at(times, begin),
            odom=self.tracks[ODOM].at(times, begin),
            commands=since(given, 0.0),
            scan_times=scan_times[kept],
            scans=np.array(turned, dtype=float).reshape(len(turned), 0 if lidar is None else lidar.beams),
            time_increment=float(scans.rows[-1].time_increment) if turned else 0.0,
            name=self.name if len(self._recorder.names) > 1 else "",
        )


class _Layers:
    """Messages from all topics that are visible from above, unchanged; of images only as many as a player shows."""

    def __init__(self, recorder: Recorder, things: str | None) -> None:
        self._node = recorder.node
        self._intervals: dict[str, float] = find_extension(RECORDED, "layers")()
        self._left_out = {self._node.resolve(things)} if things else set()
        self.topics: set[str] = set()
        self._kept: list[tuple[int, str, Any]] = []
        self._subscribers: dict[str, Subscriber] = {}
        self._due: dict[str, int] = {}
        """When the recorder wants the next message of a topic [ns]."""
        self._subscribe()
        self._node.timer(CHECK_PERIOD, lambda _event: self._subscribe())

    def _subscribe(self) -> None:
        """Subscribe to new topics, and to those whose next message is wanted."""
        now = self._node.clock.now_ns()
        for topic, kind in sorted(self._node.master.ask("getTopicTypes")):
            is_waiting = topic in self._subscribers or self._due.get(topic, now) > now
            if kind in self._intervals and not is_waiting and topic not in self._left_out:
                self.topics.add(topic)
                self._subscribers[topic] = self._node.subscriber(
                    topic, message_class(kind), self._keep, arguments=(topic, self._intervals[kind])
                )

    def _keep(self, message: Any, topic: str, interval: float) -> None:
        """Keep a message. Until the next one is wanted, unsubscribe: a camera renders for its subscribers."""
        now = self._node.clock.now_ns()
        if now < self._due.get(topic, now):
            return
        self._kept.append((now, topic, message))
        if interval:
            self._due[topic] = now + round(1e9 * interval)
            self._subscribers.pop(topic).unregister()
            self._node.timer(interval, lambda _event: self._subscribe(), oneshot=True)

    def clear(self) -> None:
        """Discard the messages."""
        self._kept.clear()
        self._due.clear()

    def messages(self, begin: int) -> tuple[tuple[float, str, Any], ...]:
        """Return the messages; those from before `begin` [ns], such as a latched map, get the time of `begin`."""
        return tuple((max(0.0, (time - begin) / 1e9), topic, message) for time, topic, message in self._kept)


class _MovingObstacles:
    """The data from the topic with the poses of moving obstacles."""

    def __init__(self, recorder: Recorder, topic: str, axles: Mapping[str, Pose]) -> None:
        self._recorder, self._topic = recorder, topic
        self._axles = axles
        """The robots whose true poses are on the same topic."""
        self._last = -math.inf
        """Time of the last message that was used [s]."""
        self._tracks: dict[str, _Track] = {}
        self._appearances: dict[str, Obstacle] = {}
        if topic.rpartition("/")[2] == "model_states":
            recorder.node.subscriber(topic, message_class("gazebo_msgs/ModelStates"), self._states)
        else:
            recorder.node.subscriber(topic, message_class("visualization_msgs/MarkerArray"), self._markers)
        self._known = {o.name: o for o in recorder.world.obstacles}

    def clear(self) -> None:
        """Discard the data."""
        self._tracks.clear()
        self._last = -math.inf

    def _markers(self, message: Any) -> None:
        poses = first_poses(message)
        new = set(poses) - set(self._appearances)
        if new:
            made = obstacles_of(message)
            for name in new:
                known = self._known.get(name)
                self._appearances[name] = made[name] if known is None else known
        stamp = self._recorder.stamp(message.markers[0].header) if message.markers else 0
        for name, pose in poses.items():
            appearance = self._appearances[name]
            _, offset = next(iter(simple_parts(appearance.shape)))
            self._add(name, stamp, compose(pose, inverse(offset)))

    def _states(self, message: Any) -> None:
        stamp = self._recorder.node.clock.now_ns()
        if 0 <= stamp / 1e9 - self._last < STATES_PERIOD:
            return
        self._last = stamp / 1e9
        for name, pose in zip(message.name, message.pose, strict=True):
            if name in self._axles:
                self._recorder.add_truth(name, stamp, compose(_flat(pose), self._axles[name]))
            elif name in self._known:
                self._appearances[name] = self._known[name]
                self._add(name, stamp, _flat(pose))

    def _add(self, name: str, stamp: int, pose: Pose) -> None:
        track = self._tracks.setdefault(name, _Track())
        back = track.behind(stamp)
        if back:
            self._recorder.clock_went_back(self._topic, back)
            track = self._tracks.setdefault(name, _Track())
        track.add(stamp, pose)

    def moved(self, begin: int, end: float) -> tuple[Moved, ...]:
        """Return the motion from `begin` [ns] to `end` [s after it]; for an obstacle at rest only its pose."""
        found = []
        for name, track in self._tracks.items():
            times = seconds(track.stamps, begin)
            poses = np.array(track.rows, dtype=float)
            poses[:, 2] = np.unwrap(poses[:, 2])
            appearance = replace(self._appearances[name], pose=tuple(poses[0].tolist()), motion=None)
            whole = Moved(appearance, times, poses)
            first, last = max(0.0, float(times[0])), min(end, float(times[-1]))
            inside = whole.window(first, max(first, last))
            keep = turning_points(inside.poses)
            found.append(Moved(inside.at(first), inside.times[keep], inside.poses[keep]))
        return tuple(found)


def _flat(pose: Any) -> Pose:
    """Return x, y and heading of a `geometry_msgs/Pose`."""
    q = pose.orientation
    return (pose.position.x, pose.position.y, yaw_from_quaternion(q.x, q.y, q.z, q.w))


def turning_points(poses: Floats) -> NDArray[np.intp]:
    """Return the indices of relevant poses (n, 3): the first, the last, and those that differ from a neighbour."""
    if len(poses) == 1:
        return np.array([0])
    differs = (np.abs(np.diff(poses, axis=0)) > 1e-9).any(axis=1)
    keep = np.zeros(len(poses), dtype=bool)
    keep[0] = keep[-1] = True
    keep[1:] |= differs
    keep[:-1] |= differs
    return np.flatnonzero(keep)


class _Track:
    """The data from one topic."""

    def __init__(self) -> None:
        self.stamps: list[int] = []
        self.rows: list[Any] = []

    def clear(self) -> None:
        """Discard the data."""
        self.stamps.clear()
        self.rows.clear()

    def behind(self, stamp: int) -> float:
        """Return how far [s] a stamp [ns] is before the last one; 0 if it is not."""
        return max(0.0, (self.stamps[-1] - stamp) / 1e9) if self.stamps else 0.0

    def add(self, stamp: int, row: Any) -> None:
        """Add data; of two entries at one time the last one is kept."""
        if self.stamps and stamp == self.stamps[-1]:
            self.rows[-1] = row
            return
        self.stamps.append(stamp)
        self.rows.append(row)

    def at(self, times: Floats, begin: int) -> Floats:
        """Return poses (n, 3) at `times` [s since begin] by linear interpolation; headings are not wrapped."""
        poses = np.array(self.rows, dtype=float)
        poses[:, 2] = np.unwrap(poses[:, 2])
        known = seconds(self.stamps, begin)
        return np.column_stack([np.interp(times, known, column) for column in poses.T])


def seconds(stamps: list[int] | NDArray[np.int64], begin: int) -> Floats:
    """Convert stamps [ns] to seconds since `begin` [ns]; subtracts before rounding."""
    return (np.array(stamps, dtype=np.int64) - begin) / 1e9


def aligned(scan: Any, lidar: LidarModel) -> Floats:
    """Return the ranges (beams,) of a `sensor_msgs/LaserScan` in the order of the laser's beams.

    Beam i of a laser with a full circle is at 2 pi i / beams from ahead.

    A beam without a hit gives inf, and one that is too near to be measured -inf (REP 117). Values outside the scan's
    range_min and range_max are not hits, according to the message definition; nor are nan and the 0 that an LDS-01
    reports for a beam that did not return.

    Raises:
        RecordingError: the number or the angles of its beams differ from the laser's.

    """
    ranges = np.array(scan.ranges, dtype=float)
    if len(ranges) != lidar.beams:
        raise RecordingError(
            f"a scan has {len(ranges)} ranges, but the {lidar.name} has {lidar.beams} beams: "
            "give the recorder the model of the robot that publishes it"
        )
    if lidar.angle_max is not None:
        _check_fan(scan, lidar)
    step = lidar.increment
    first = 0.0 if lidar.angle_max is not None else scan.angle_min / step
    # angles are 32-bit numbers, and real drivers give an angle_max, and so an increment, that is one beam off
    if lidar.angle_max is None and (
        abs(scan.angle_increment - step) > 1.5 * step / lidar.beams or abs(first - round(first)) > 0.01
    ):
        raise RecordingError(
            f"a scan begins at {scan.angle_min:.4f} rad and goes on by {scan.angle_increment:.6f} rad; a recording "
            f"holds scans of a whole turn, here by {step:.6f} rad, in which one beam looks straight ahead"
        )
    hit = (ranges >= scan.range_min) & (ranges <= scan.range_max)
    near = (ranges == -np.inf) | (ranges > 0) & (ranges < scan.range_min)
    return np.roll(np.where(hit, ranges, np.where(near, -np.inf, np.inf)), round(first))


def _check_fan(scan: Any, lidar: LidarModel) -> None:
    """Raise `RecordingError` if a scan's beams differ from those of a laser with a limited field of view.

    A hundredth of the angle between two beams is tolerated.
    """
    first, _, step = lidar.message_angles
    off = abs(scan.angle_min - first), (lidar.beams - 1) * abs(scan.angle_increment - step)
    if max(off) > max(0.01 * abs(step), 1e-5):
        raise RecordingError(
            f"a scan begins at {scan.angle_min:.4f} rad and goes on by {scan.angle_increment:.6f} rad, but the "
            f"{lidar.name} begins at {first:.4f} rad and goes on by {step:.6f} rad"
        )
