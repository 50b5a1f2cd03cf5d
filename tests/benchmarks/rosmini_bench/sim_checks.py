"""Checks of a simulated run: no message is missing, and the robots went where they were told to.

The subscribers read each field that matters (`READERS`) while the clock runs; the checks follow when it has stopped. A
run that fails one of them has no figure. How exact sensors and odometry are is tested in tests/sim.
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
from rosmini.sim.models import RobotModel
from rosmini.sim.world import World

Floats = NDArray[np.float64]
Row = tuple[Any, ...]
Heard = dict[str, list[Row]]
"""What was read of each message, by topic. Every row begins with the stamp [ns] and the frame."""


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


def check_run(heard: Mapping[str, Heard], model: RobotModel, seconds: float, way: float) -> None:
    """Raise `RosminiError` unless the messages, by robot, are those of robots sent `way` metres in `seconds`."""
    rates = {"scan": model.laser.rate, "imu": model.unit.rate}
    for name, rows in heard.items():
        for topic in READERS:
            check_rate(topic, rows[topic], rates.get(topic, model.rate), seconds)
        check_frames(rows, model, name)
        length = _way(poses(rows["base_pose_ground_truth"]))
        expect(abs(length - way) < 0.1 * way, f"a robot went {length:.3f} m, and was told to go {way:.3f} m")
        check_odometry(rows, model)
        beams = {len(row[4]) for row in rows["scan"]}
        expect(beams == {model.laser.beams}, f"the scans have {beams} ranges, not {model.laser.beams}")


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
    expect(bool((abs(gaps - 1e9 / rate) <= 1).all()), f"the messages on {topic} are not {1 / rate:.4f} s apart")


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


def check_odometry(heard: Heard, model: RobotModel) -> None:
    """The transform says the same as the odometry, and the joints belong to it."""
    expect([row[:4] for row in heard["odom"]] == [row[:4] for row in heard["tf"]], "odom and tf do not agree")
    rolled = np.diff([(row[3] + row[4]) / 2 for row in heard["joint_states"]]) * model.wheel_radius
    speeds = np.array([row[4] for row in heard["odom"]])[1:]
    expect(bool(np.allclose(rolled * model.rate, speeds, rtol=0, atol=1e-9)), "odom's speed is not that of the joints")


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


def _way(track: Floats) -> float:
    return float(np.hypot(*np.diff(track[:, :2], axis=0).T).sum())
