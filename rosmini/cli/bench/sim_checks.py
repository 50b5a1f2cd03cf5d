"""What a simulated run has to look like.

The subscribers take out of their messages what is checked here (`READERS`), while the clock runs; the checks follow when it has stopped. A run that fails
one of them has no figure.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
from rosmini.geometry.angles import yaw_from_quaternion
from rosmini.geometry.poses import Pose, compose, inverse
from rosmini.geometry.raycast import raycast
from rosmini.sim.models import RobotModel
from rosmini.sim.world import World

Floats = NDArray[np.float64]
Row = tuple[Any, ...]
Heard = dict[str, list[Row]]
"""What was read of each message, by topic. Every row begins with the stamp [ns] and the frame."""

SIGMAS = 6.5
"""No error in a run is so many standard deviations large."""


def _stamped(header: Any) -> tuple[int, str]:
    return (header.stamp.secs * 1_000_000_000 + header.stamp.nsecs, header.frame_id)


def _read_odometry(message: Any) -> Row:
    place, turn, speed = message.pose.pose.position, message.pose.pose.orientation, message.twist.twist
    return (
        *_stamped(message.header),
        message.child_frame_id,
        (place.x, place.y, turn.x, turn.y, turn.z, turn.w),
        speed.linear.x,
        speed.angular.z,
    )


def _read_tf(message: Any) -> Row:
    (transform,) = message.transforms
    shift, turn = transform.transform.translation, transform.transform.rotation
    return (
        *_stamped(transform.header),
        transform.child_frame_id,
        (shift.x, shift.y, turn.x, turn.y, turn.z, turn.w),
    )


def _read_joints(message: Any) -> Row:
    return (*_stamped(message.header), tuple(message.name), *message.position)


def _read_imu(message: Any) -> Row:
    return (*_stamped(message.header), message.angular_velocity.z, message.linear_acceleration.z)


def _read_scan(message: Any) -> Row:
    return (*_stamped(message.header), message.angle_min, message.angle_increment, message.ranges)


READERS: Mapping[str, tuple[str, Callable[[Any], Row]]] = MappingProxyType(
    {
        "scan": ("sensor_msgs/LaserScan", _read_scan),
        "odom": ("nav_msgs/Odometry", _read_odometry),
        "tf": ("tf2_msgs/TFMessage", _read_tf),
        "joint_states": ("sensor_msgs/JointState", _read_joints),
        "imu": ("sensor_msgs/Imu", _read_imu),
        "base_pose_ground_truth": ("nav_msgs/Odometry", _read_odometry),
    }
)
"""For each topic of the robot its type, and what a subscriber reads of a message."""


def check_run(heard: Heard, world: World, model: RobotModel, seconds: float, way: float) -> None:
    """Raise `RosminiError` unless the messages are those of a robot that was told to go `way` metres in `seconds`."""
    rates = {"scan": model.laser.rate, "imu": model.unit.rate}
    for topic in READERS:
        check_rate(topic, heard[topic], rates.get(topic, model.rate), seconds)
    check_frames(heard, model)
    truth = poses(heard["base_pose_ground_truth"])
    length = _way(truth)
    expect(abs(length - way) < 0.1 * way, f"the robot went {length:.3f} m, and was told to go {way:.3f} m")
    check_odometry(heard, truth, model)
    check_scans(heard, truth, world, model)
    check_imu(heard, truth, model)


def expect(condition: bool, what: str) -> None:
    """Raise `RosminiError` that says `what` is wrong unless `condition` holds."""
    if not condition:
        msg = f"the benchmark's robot is not right, so there is no figure: {what}"
        raise RosminiError(msg)


def check_rate(topic: str, rows: list[Row], rate: float, seconds: float) -> None:
    """None is missing, and none is early or late."""
    count = len(rows)
    expect(abs(count - rate * seconds) <= 1, f"{count} messages on {topic} in {seconds} s at {rate} Hz")
    gaps = np.diff([row[0] for row in rows])
    expect(
        bool((abs(gaps - 1e9 / rate) <= 1).all()), f"the messages on {topic} are not {1 / rate:.4f} s apart"
    )


def check_frames(heard: Heard, model: RobotModel) -> None:
    """Everything says in which frame it is (REP 105), and of what it speaks."""
    frames = {
        "scan": model.laser.frame,
        "imu": model.unit.frame,
        "odom": "odom",
        "tf": "odom",
        "base_pose_ground_truth": "map",
    }
    for topic, frame in frames.items():
        found = {row[1] for row in heard[topic]}
        expect(found == {frame}, f"the frame of {topic} is {', '.join(sorted(found))}, not {frame}")
    children = {row[2] for topic in ("odom", "tf") for row in heard[topic]}
    expect(children == {"base_footprint"}, f"odom leads to {', '.join(sorted(children))}")
    names = {row[2] for row in heard["joint_states"]}
    expect(names == {("wheel_left_joint", "wheel_right_joint")}, f"the joints are {names}")


def check_odometry(heard: Heard, truth: Floats, model: RobotModel) -> None:
    """Odometry is off by no more than its wheels explain; the transform says the same, and the joints belong to it."""
    expect([row[:4] for row in heard["odom"]] == [row[:4] for row in heard["tf"]], "odom and tf do not agree")
    odom = poses(heard["odom"])
    believed, really = (compose(inverse(_pose(track[0])), track) for track in (odom, truth))
    path, turned = _way(really), float(np.abs(np.diff(really[:, 2])).sum())
    errors = model.errors
    uneven = SIGMAS * (errors.radius + errors.slip) * path
    bent = uneven / model.wheel_separation + SIGMAS * errors.separation * turned
    drift = float(np.hypot(*(believed - really)[:, :2].T).max())
    most = uneven + bent * path + 0.005
    expect(
        0 < drift < most, f"odometry is {drift:.4f} m off after {path:.2f} m; its wheels explain {most:.4f} m"
    )
    rolled = np.diff([(row[3] + row[4]) / 2 for row in heard["joint_states"]]) * model.wheel_radius
    speeds = np.array([row[4] for row in heard["odom"]])[1:]
    expect(
        bool(np.allclose(rolled * model.rate, speeds, rtol=0, atol=1e-9)),
        "odom's speed is not that of the joints",
    )


def check_scans(heard: Heard, truth: Floats, world: World, model: RobotModel) -> None:
    """Each range is the exact one plus noise, and the noise is as large as it says."""
    lidar = model.laser
    stamps = [row[0] for row in heard["base_pose_ground_truth"]]
    residuals = []
    for when, _, start, step, ranges in heard["scan"]:
        if not stamps[0] <= when <= stamps[-1]:
            continue
        expect(len(ranges) == lidar.beams, f"a scan has {len(ranges)} ranges, not {lidar.beams}")
        robot = np.array([np.interp(when, stamps, column) for column in truth.T])
        x, y, heading = compose(robot, (lidar.mount[0], lidar.mount[1], start))
        exact = raycast(world.segments, world.discs, x, y, heading, step, lidar.beams, lidar.range_max + 1)
        steady = _steady(exact)
        inside, outside = steady & (exact < lidar.range_max - 0.1), steady & (exact > lidar.range_max + 0.1)
        expect(bool(np.isposinf(ranges[outside]).all()), "a range is not inf where nothing is within reach")
        residuals.append(ranges[inside] - exact[inside])
    errors = np.concatenate(residuals)
    expect(len(errors) > 20 * len(residuals) > 0, "the laser saw hardly anything")
    # Between two poses that were heard the path is taken for straight.
    worst = float(np.abs(errors).max())
    expect(worst < SIGMAS * lidar.noise + 1e-3, f"a range is {worst:.4f} m from the exact one")
    spread = float(errors.std())
    expect(
        abs(spread / lidar.noise - 1) < 0.15, f"the ranges scatter by {spread:.4f} m, not by {lidar.noise} m"
    )


def check_imu(heard: Heard, truth: Floats, model: RobotModel) -> None:
    """The gyroscope's integral is the turn of the robot, and it stands on the ground."""
    stamps, rates, gravity = (np.array([row[i] for row in heard["imu"]], dtype=float) for i in (0, 2, 3))
    times = np.array([row[0] for row in heard["base_pose_ground_truth"]], dtype=float)
    steps = (rates[1:] + rates[:-1]) / 2 * np.diff(stamps) * 1e-9
    turn = np.concatenate([[0.0], np.cumsum(steps)])
    ends = [max(times[0], stamps[0]), min(times[-1], stamps[-1])]
    measured = float(np.diff(np.interp(ends, stamps, turn))[0])
    really = float(np.diff(np.interp(ends, times, truth[:, 2]))[0])
    expect(
        abs(measured - really) < 0.005,
        f"the gyroscope says {measured:.4f} rad, and the robot turned by {really:.4f}",
    )
    felt = float(gravity.mean())
    expect(abs(felt - 9.80665) < SIGMAS * model.unit.accel_bias, f"the imu feels {felt:.2f} m/s2 upwards")


def poses(rows: list[Row]) -> Floats:
    """The poses (n, 3) that rows of `nav_msgs/Odometry` tell; headings are not wrapped."""
    found = np.array([(row[3][0], row[3][1], yaw_from_quaternion(*row[3][2:])) for row in rows])
    found[:, 2] = np.unwrap(found[:, 2])
    return found


def _steady(exact: Floats) -> NDArray[np.bool_]:
    """True where the neighbours see the same thing: at an edge, a hair's breadth changes a range by metres."""
    bounded = np.minimum(exact, 99.0)
    steps = np.abs(np.diff(bounded, append=bounded[0]))
    steady: NDArray[np.bool_] = (steps < 0.1) & (np.roll(steps, 1) < 0.1)
    return steady


def _pose(row: Floats) -> Pose:
    x, y, theta = row.tolist()
    return (x, y, theta)


def _way(track: Floats) -> float:
    return float(np.hypot(*np.diff(track[:, :2], axis=0).T).sum())
