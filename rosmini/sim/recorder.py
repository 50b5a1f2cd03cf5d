"""A node that writes down a run: it subscribes to what a robot says of itself, and gathers arrays from the messages."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.angles import yaw_from_quaternion
from rosmini.msgs import message_class

from .models import LidarModel, RobotModel
from .recording import Recording, RecordingError, since
from .world import World

if TYPE_CHECKING:
    from rosmini.graph import Graph

Floats = NDArray[np.float64]

TRUTH, ODOM, SCAN, COMMANDS = "base_pose_ground_truth", "odom", "scan", "cmd_vel"


class Simulated(Protocol):
    """What a simulator says of itself."""

    @property
    def world(self) -> World: ...  # noqa: D102 (the class says it)

    @property
    def model(self) -> RobotModel: ...  # noqa: D102


class Recorder:
    """Gathers `scan`, `odom`, `base_pose_ground_truth` and `cmd_vel` of one robot.

    It is an ordinary node and knows only what the messages say. Times are those of their headers; a `geometry_msgs/Twist` has none, so
    a command counts from when it arrives. If the clock goes back (a simulation that was reset, a bag in a loop), a new run begins.

    Args:
        graph: where the robot is.
        simulator: what has `world` and `model`; or give these two.
        world: what the robot drives in.
        model: which robot it is.
        namespace: that of the robot's topics, and of this node.
        name: of this node.

    Raises:
        RecordingError: neither a simulator nor a world and a model are given.

    """

    def __init__(
        self,
        graph: Graph,
        simulator: Simulated | None = None,
        *,
        world: World | None = None,
        model: RobotModel | None = None,
        namespace: str = "/",
        name: str = "recorder",
    ) -> None:
        if simulator is not None:
            world, model = world or simulator.world, model or simulator.model
        if world is None or model is None:
            raise RecordingError(
                "a recorder has to know the world and the robot: Recorder(graph, simulator), or Recorder(graph, world=..., model=...)"
            )
        self.world = world
        self.model = model
        self._tracks: dict[str, _Track] = {name: _Track() for name in (TRUTH, ODOM, SCAN, COMMANDS)}
        self.node = graph.node(name, namespace=namespace or "/")
        odometry = message_class("nav_msgs/Odometry")
        self.node.subscriber(TRUTH, odometry, self._pose, arguments=(TRUTH,))
        self.node.subscriber(ODOM, odometry, self._pose, arguments=(ODOM,))
        self.node.subscriber(SCAN, message_class("sensor_msgs/LaserScan"), self._scan)
        self.node.subscriber(COMMANDS, message_class("geometry_msgs/Twist"), self._command)

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(track.rows)} {topic}" for topic, track in self._tracks.items())
        return f"<Recorder {self.node.name}: {counts}>"

    def clear(self) -> None:
        """Forget what was recorded; what comes from now on is a new run."""
        for track in self._tracks.values():
            track.stamps.clear()
            track.rows.clear()

    def stop(self) -> None:
        """End the node; what was recorded stays. Harmless when repeated."""
        self.node.shutdown("the recording was stopped")

    def recording(self) -> Recording:
        """The run so far. It begins with the first pose of which both the truth and odometry are known.

        Odometry is interpolated at the times of the truth; a simulator gives both at the same times. A command that came earlier and
        is still in force counts from the begin.

        Raises:
            RecordingError: nothing was recorded yet, or the scans are not those of the robot's laser.

        """
        truth, odom = self._tracks[TRUTH], self._tracks[ODOM]
        stamps = np.array(truth.stamps, dtype=np.int64)
        if truth.rows and odom.rows:
            stamps = stamps[(stamps >= odom.stamps[0]) & (stamps <= odom.stamps[-1])]
        if not (truth.rows and odom.rows and len(stamps)):
            raise RecordingError(self._nothing())
        begin = int(stamps[0])
        times = seconds(stamps, begin)
        commands, scans = self._tracks[COMMANDS], self._tracks[SCAN]
        given = np.column_stack(
            [seconds(commands.stamps, begin), np.array(commands.rows, dtype=float).reshape(-1, 2)]
        )
        scan_times = seconds(scans.stamps, begin)
        kept = scan_times >= 0
        turned = [
            aligned(scan, self.model.laser) for scan, keep in zip(scans.rows, kept, strict=True) if keep
        ]
        return Recording(
            self.world,
            self.model,
            times=times,
            truth=truth.at(times, begin),
            odom=odom.at(times, begin),
            commands=since(given, 0.0),
            scan_times=scan_times[kept],
            scans=np.array(turned, dtype=float).reshape(len(turned), self.model.laser.beams),
        )

    def _nothing(self) -> str:
        silent = [topic for topic in (TRUTH, ODOM) if not self._tracks[topic].rows]
        if not silent:
            return f"the messages on {TRUTH} and {ODOM} have no time in common: do both come from the same clock?"
        names = [self.node.resolve(topic) for topic in silent]
        said = "; ".join(f"no message on {name}, {self.node.graph.who_publishes(name)}" for name in names)
        if self.node.shutdown_reason is not None:
            return f"nothing was recorded before the recorder was stopped: {said}."
        return (
            f"nothing is recorded yet: {said}. Let time pass while the simulator runs, for instance graph.run(5.0); if the robot's "
            f"topics have a namespace, give it: Recorder(..., namespace='/robot1')."
        )

    def _pose(self, message: Any, topic: str) -> None:
        position, q = message.pose.pose.position, message.pose.pose.orientation
        yaw = yaw_from_quaternion(q.x, q.y, q.z, q.w)
        self._add(topic, self._stamp(message), (position.x, position.y, yaw))

    def _scan(self, message: Any) -> None:
        self._add(SCAN, self._stamp(message), message)

    def _command(self, message: Any) -> None:
        velocities = (message.linear.x, message.angular.z)
        if all(math.isfinite(v) for v in velocities):  # nobody can drive another one
            self._add(COMMANDS, self.node.clock.now_ns(), velocities)

    def _stamp(self, message: Any) -> int:
        """The header's time [ns]; that of arrival where the sender left it out."""
        return message.header.stamp.to_nsec() or self.node.clock.now_ns()

    def _add(self, topic: str, stamp: int, row: Any) -> None:
        track = self._tracks[topic]
        if track.stamps and stamp < track.stamps[-1]:
            self.node.logwarn(
                f"the time on {self.node.resolve(topic)} went back by {(track.stamps[-1] - stamp) / 1e9:.3f} s: "
                "a new recording begins"
            )
            self.clear()
        if track.stamps and stamp == track.stamps[-1]:  # the last word counts
            track.rows[-1] = row
            return
        track.stamps.append(stamp)
        track.rows.append(row)


class _Track:
    """What came on one topic."""

    def __init__(self) -> None:
        self.stamps: list[int] = []
        self.rows: list[Any] = []

    def at(self, times: Floats, begin: int) -> Floats:
        """Poses (n, 3) at `times` [s since begin], linear between those that came; headings are not wrapped."""
        poses = np.array(self.rows, dtype=float)
        poses[:, 2] = np.unwrap(poses[:, 2])
        known = seconds(self.stamps, begin)
        return np.column_stack([np.interp(times, known, column) for column in poses.T])


def seconds(stamps: list[int] | NDArray[np.int64], begin: int) -> Floats:
    """Stamps [ns] as seconds since `begin` [ns]; the difference is taken before anything is rounded."""
    return (np.array(stamps, dtype=np.int64) - begin) / 1e9


def aligned(scan: Any, lidar: LidarModel) -> Floats:
    """The ranges (beams,) of a `sensor_msgs/LaserScan` so that beam i looks at 2 pi i / beams from ahead; inf where nothing was hit.

    What lies outside of the scan's range_min and range_max is no hit, as its message definition says; so are nan, and the 0 that an
    LDS-01 gives for a beam that did not come back.

    Raises:
        RecordingError: it has another number of beams than the laser, or they are not spread evenly over a whole turn.

    """
    ranges = np.array(scan.ranges, dtype=float)
    if len(ranges) != lidar.beams:
        raise RecordingError(
            f"a scan has {len(ranges)} ranges, but the {lidar.name} has {lidar.beams} beams: "
            "give the recorder the model of the robot that publishes it"
        )
    step = 2 * math.pi / lidar.beams
    first = scan.angle_min / step
    # angles are 32-bit numbers, and real drivers give an angle_max, and so an increment, that is one beam off
    if abs(scan.angle_increment - step) > 1.5 * step / lidar.beams or abs(first - round(first)) > 0.01:
        raise RecordingError(
            f"a scan begins at {scan.angle_min:.4f} rad and goes on by {scan.angle_increment:.6f} rad; a recording holds scans of a "
            f"whole turn, here by {step:.6f} rad, in which one beam looks straight ahead"
        )
    hit = (ranges >= scan.range_min) & (ranges <= scan.range_max)
    return np.roll(np.where(hit, ranges, np.inf), round(first))
