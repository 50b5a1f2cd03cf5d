"""What a simulated run has to look like.

The subscribers take out of their messages what is checked here (`READERS`), while the clock runs; the checks follow
when it has stopped. A run that fails one of them has no figure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.sim.geometry.raycast import raycast_each
from rosmini.sim.models import RobotModel
from rosmini.sim.world import Cylinder, World

Floats = NDArray[np.float64]
Row = tuple[Any, ...]
Heard = dict[str, list[Row]]
"""What was read of each message, by topic. Every row begins with the stamp [ns] and the frame."""

SIGMAS = 6.5
"""No error in a run is so many standard deviations large."""


def _read_odometry(message: Any) -> Row:
    header, pose, speed = message.header, message.pose.pose, message.twist.twist
    stamp, place, turn = header.stamp, pose.position, pose.orientation
    return (
        stamp.secs * 1_000_000_000 + stamp.nsecs,
        header.frame_id,
        message.child_frame_id,
        (place.x, place.y, turn.x, turn.y, turn.z, turn.w),
        speed.linear.x,
        speed.angular.z,
    )


def _read_joints(message: Any) -> Row:
    header = message.header
    stamp = header.stamp
    left, right = message.position
    return (stamp.secs * 1_000_000_000 + stamp.nsecs, header.frame_id, tuple(message.name), left, right)


def _read_imu(message: Any) -> Row:
    header = message.header
    stamp = header.stamp
    return (
        stamp.secs * 1_000_000_000 + stamp.nsecs,
        header.frame_id,
        message.angular_velocity.z,
        message.linear_acceleration.z,
    )


def _read_scan(message: Any) -> Row:
    header = message.header
    stamp = header.stamp
    return (
        stamp.secs * 1_000_000_000 + stamp.nsecs,
        header.frame_id,
        message.angle_min,
        message.angle_increment,
        message.ranges,
    )


def transforms(message: Any) -> list[tuple[str, Row]]:
    """What a subscriber reads of a message on /tf: each frame's prefix, which is the robot's name, and a row."""
    rows = []
    for transform in message.transforms:
        header, child = transform.header, transform.child_frame_id
        stamp, shift, turn = header.stamp, transform.transform.translation, transform.transform.rotation
        row = (
            stamp.secs * 1_000_000_000 + stamp.nsecs,
            header.frame_id,
            child,
            (shift.x, shift.y, turn.x, turn.y, turn.z, turn.w),
        )
        rows.append((child.rpartition("/")[0], row))
    return rows


READERS: Mapping[str, tuple[str, Callable[[Any], Row] | None]] = MappingProxyType(
    {
        "scan": ("sensor_msgs/LaserScan", _read_scan),
        "odom": ("nav_msgs/Odometry", _read_odometry),
        "tf": ("tf2_msgs/TFMessage", None),
        "joint_states": ("sensor_msgs/JointState", _read_joints),
        "imu": ("sensor_msgs/Imu", _read_imu),
        "base_pose_ground_truth": ("nav_msgs/Odometry", _read_odometry),
    }
)
"""For each topic of a robot its type, and what a subscriber reads of a message.

For `transforms` of all robots in one, None.
"""


def check_run(
    heard: Mapping[str, Heard], world: World, model: RobotModel, seconds: float, way: float
) -> None:
    """Raise `RosminiError` unless the messages, by robot, are those of robots sent `way` metres in `seconds`."""
    rates = {"scan": model.laser.rate, "imu": model.unit.rate}
    tracks = {}
    for name, rows in heard.items():
        for topic in READERS:
            check_rate(topic, rows[topic], rates.get(topic, model.rate), seconds)
        check_frames(rows, model, name)
        truth = tracks[name] = poses(rows["base_pose_ground_truth"])
        length = _way(truth)
        expect(abs(length - way) < 0.1 * way, f"a robot went {length:.3f} m, and was told to go {way:.3f} m")
        check_odometry(rows, truth, model)
        check_imu(rows, truth, model)
    for name, rows in heard.items():
        others = [track for other, track in tracks.items() if other != name]
        check_scans(rows, tracks[name], others, world, model)


def expect(condition: bool, what: str) -> None:
    """Raise `RosminiError` that says `what` is wrong unless `condition` holds."""
    if not condition:
        msg = f"a robot of the benchmark is not right, so there is no figure: {what}"
        raise RosminiError(msg)


def check_rate(topic: str, rows: list[Row], rate: float, seconds: float) -> None:
    """None is missing, and none is early or late."""
    count = len(rows)
    expect(abs(count - rate * seconds) <= 1, f"{count} messages on {topic} in {seconds} s at {rate} Hz")
    gaps = np.diff([row[0] for row in rows])
    expect(
        bool((abs(gaps - 1e9 / rate) <= 1).all()), f"the messages on {topic} are not {1 / rate:.4f} s apart"
    )


def check_frames(heard: Heard, model: RobotModel, name: str) -> None:
    """Everything says in which frame it is (REP 105), and of what it speaks."""
    prefix = f"{name}/" if name else ""
    frames = {
        "scan": prefix + model.laser.frame,
        "imu": prefix + model.unit.frame,
        "odom": f"{prefix}odom",
        "tf": f"{prefix}odom",
        "base_pose_ground_truth": "map",
    }
    for topic, frame in frames.items():
        found = {row[1] for row in heard[topic]}
        expect(found == {frame}, f"the frame of {topic} is {', '.join(sorted(found))}, not {frame}")
    children = {row[2] for topic in ("odom", "tf") for row in heard[topic]}
    expect(children == {f"{prefix}base_footprint"}, f"odom leads to {', '.join(sorted(children))}")
    names = {row[2] for row in heard["joint_states"]}
    expect(names == {("wheel_left_joint", "wheel_right_joint")}, f"the joints are {names}")


def check_odometry(heard: Heard, truth: Floats, model: RobotModel) -> None:
    """Odometry is off by no more than its wheels and its gyroscope explain.

    The transform says the same, and the joints belong to it.
    """
    expect([row[:4] for row in heard["odom"]] == [row[:4] for row in heard["tf"]], "odom and tf do not agree")
    odom = poses(heard["odom"])
    believed, really = (compose(inverse(_pose(track[0])), track) for track in (odom, truth))
    path, turned = _way(really), float(np.abs(np.diff(really[:, 2])).sum())
    errors = model.errors
    uneven = SIGMAS * (errors.radius + errors.slip) * path
    bent = gyroscope_error(model, turned, (heard["odom"][-1][0] - heard["odom"][0][0]) * 1e-9)
    drift = float(np.hypot(*(believed - really)[:, :2].T).max())
    most = uneven + bent * path + 0.005
    expect(
        0 < drift < most,
        f"odometry is {drift:.4f} m off after {path:.2f} m; its wheels and its gyroscope explain {most:.4f} m",
    )
    rolled = np.diff([(row[3] + row[4]) / 2 for row in heard["joint_states"]]) * model.wheel_radius
    speeds = np.array([row[4] for row in heard["odom"]])[1:]
    expect(
        bool(np.allclose(rolled * model.rate, speeds, rtol=0, atol=1e-9)),
        "odom's speed is not that of the joints",
    )


def check_scans(heard: Heard, truth: Floats, others: list[Floats], world: World, model: RobotModel) -> None:
    """Each range is the exact one at the time of its beam plus noise, and the noise is as large as it says.

    `others` are where the other robots were.
    """
    lidar = model.laser
    stamps = [row[0] for row in heard["base_pose_ground_truth"]]
    residuals = []
    for when, _, start, step, ranges in heard["scan"]:
        expect(len(ranges) == lidar.beams, f"a scan has {len(ranges)} ranges, not {lidar.beams}")
        beams = np.arange(lidar.beams)
        times = when - beams * lidar.beam_time * 1e9
        if times[-1] < stamps[0] or when > stamps[-1]:
            continue
        places = compose(_at(truth, stamps, times), (lidar.mount[0], lidar.mount[1], start))
        discs = [world.discs, *(_discs(model, _at(other, stamps, times)) for other in others)]
        rays = [np.tile((0, len(beams)), (len(world.discs), 1))]
        rays += [np.column_stack([beams, beams + 1])] * len(others)
        exact = raycast_each(
            world.segments,
            np.vstack(discs),
            places[:, :2],
            places[:, 2] + step * beams,
            lidar.range_max + 1,
            disc_rays=np.vstack(rays),
        )
        steady = _steady(exact)
        outside = steady & (exact > lidar.range_max + 0.1)
        inside = steady & (exact > lidar.range_min + 0.1) & (exact < lidar.range_max - 0.1)
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
    turned = float(np.abs(np.diff(truth[:, 2])).sum())
    expect(
        abs(measured - really) < gyroscope_error(model, turned, (ends[1] - ends[0]) * 1e-9),
        f"the gyroscope says {measured:.4f} rad, and the robot turned by {really:.4f}",
    )
    felt = float(gravity.mean())
    expect(abs(felt - 9.80665) < SIGMAS * model.unit.accel_bias, f"the imu feels {felt:.2f} m/s2 upwards")


def gyroscope_error(model: RobotModel, turned: float, seconds: float) -> float:
    """The largest error of an integrated gyroscope [rad] after a turn [rad] in `seconds`: scale, zero and noise."""
    unit = model.unit
    walk = unit.gyro_noise * math.sqrt(seconds / unit.rate)
    return SIGMAS * (unit.gyro_scale * turned + walk) + 1.2 * unit.gyro_step * seconds + 0.005


def first_hit(world: World, x: float, y: float, angle: float) -> float:
    """The distance [m] from (x, y) to the first wall or pillar in this direction, by a loop over all of them."""
    c, s = math.cos(angle), math.sin(angle)
    nearest = math.inf
    for x1, y1, x2, y2 in (world.segments - (x, y, x, y)).tolist():
        cross = c * (y2 - y1) - s * (x2 - x1)
        along = (x1 * (y2 - y1) - y1 * (x2 - x1)) / cross if cross else -1.0
        part = (x1 * s - y1 * c) / cross if cross else -1.0
        if along >= 0 and 0 <= part <= 1:
            nearest = min(nearest, along)
    for px, py, radius in (world.discs - (x, y, 0)).tolist():
        ahead = c * px + s * py
        chord = radius * radius - (c * py - s * px) ** 2
        if chord >= 0 and ahead > 0:
            nearest = min(nearest, ahead - math.sqrt(chord))
    return nearest


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


def _at(track: Floats, stamps: list[int], when: Floats) -> Floats:
    """The poses (n, 3) in between those that were heard, as if the path were straight."""
    return np.column_stack([np.interp(when, stamps, column) for column in track.T])


def _discs(model: RobotModel, poses: Floats) -> Floats:
    """What a laser of the same model sees of a robot: the round laser on top, at each of its poses."""
    height = model.laser.mount[2]
    (part,) = (part for part in model.solid if part.bottom <= height <= part.top)
    if not isinstance(part.shape, Cylinder):
        msg = f"the benchmark does not know what a laser sees of {part.shape}"
        raise RosminiError(msg)
    discs: Floats = compose(poses, part.pose)
    discs[:, 2] = part.shape.radius
    return discs


def _pose(row: Floats) -> Pose:
    x, y, theta = row.tolist()
    return (x, y, theta)


def _way(track: Floats) -> float:
    return float(np.hypot(*np.diff(track[:, :2], axis=0).T).sum())
