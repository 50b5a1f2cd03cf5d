"""Checks of the exercises in the chapter Frames."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.core.tf import Buffer
from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import Rigid, compose, from_yaw
from rosmini.core.time import Time
from rosmini.msgs.sensor_msgs.msg import LaserScan

SECOND = 1_000_000_000


def _buffer(*told: tuple[str, str, Rigid, int]) -> Buffer:
    buffer = Buffer(None)
    for parent, child, transform, stamp in told:
        buffer.set_transform(to_stamped(parent, child, transform, stamp * SECOND))
    return buffer


def _scan(*ranges: float) -> Any:
    scan = LaserScan(angle_increment=math.pi / 2, range_min=0.1, range_max=5.0, ranges=ranges)
    scan.header.frame_id = "front_laser"
    scan.header.stamp = Time(5)
    return scan


@exercise("nearest_to_base", praise="The point nearest to the laser is not always nearest to the robot.")
def nearest_to_base(answer: Any) -> None:
    """The distance on the ground, in the frame base_link, at the time of the scan."""
    # The laser is 0.5 m ahead and faces left: a point 0.9 m to its left is 0.4 m behind the robot's centre.
    mounted = from_yaw(0.5, 0.0, math.pi / 2, z=1.0)
    scan, still = _scan(1.0, 0.9, 0.8, math.inf), ("base_link", "front_laser", mounted, 5)
    found = answer(_buffer(still), scan)
    expect_type(found, int | float, "It returned", "a number", "take the smallest distance")
    expect(
        abs(found - 0.4) < 1e-6,
        f"With a laser 0.5 m ahead that faces left, the nearest point is 0.40 m from base_link, not {found:.2f} m.",
        "transform the points of the scan to base_link, then take the smallest hypot(x, y)",
    )
    turned = ("base_link", "front_laser", from_yaw(0.5, 0.0, -math.pi / 2, z=1.0), 6)
    found = answer(_buffer(still, turned), scan)
    expect(
        abs(found - 0.4) < 1e-6,
        f"The laser was turned after the scan, and you return {found:.2f} m: you used the transform of a "
        "different time.",
        "the time of the scan is scan.header.stamp",
    )
    try:
        nothing = answer(_buffer(still), _scan(math.inf, math.inf))
    except ValueError as error:
        raise Wrong("It fails if all ranges are infinite.", "use min(..., default=math.inf)") from error
    expect(nothing == math.inf, f"All ranges are infinite, and you return {nothing!r}.", "return math.inf")


@exercise("map_to_odom", praise="amcl publishes exactly this transform on /tf.")
def map_to_odom(answer: Any) -> None:
    """The transform from map to odom, from the odometry at the time of the pose in map."""
    map_base, odom_base = from_yaw(2.0, 1.0, 0.7), from_yaw(1.5, -0.2, 0.4)
    then = ("odom", "base_footprint", odom_base, 5)
    later = ("odom", "base_footprint", from_yaw(1.9, 0.1, 0.9), 6)
    found = answer(_buffer(then, later), map_base, Time(5))
    expect(
        isinstance(found, tuple) and len(found) == 7,
        "A transform must be a tuple of seven numbers.",
        "compose, inverse and transform_of return one",
    )
    late = compose(found, from_yaw(1.9, 0.1, 0.9))
    expect(
        any(abs(a - b) > 1e-6 for a, b in zip(late, map_base, strict=True)),
        "It uses the current odometry. The pose in map is that of the time `stamp`, "
        "and the robot has moved since then.",
        'use buffer.lookup_transform("odom", "base_footprint", stamp)',
    )
    through = compose(found, odom_base)
    expect(
        all(abs(a - b) < 1e-6 for a, b in zip(through, map_base, strict=True)),
        "Composed with the odometry of that time, your transform does not give the robot's pose in map.",
        "map -> base is map -> odom followed by odom -> base; solve this for map -> odom",
    )


@exercise("moved", praise="The buffer keeps past transforms, so you did not have to store any.")
def moved(answer: Any) -> None:
    """The distance that base moved in odom."""
    buffer = _buffer(
        ("odom", "base", from_yaw(0.0, 0.0, 0.0), 1),
        ("odom", "base", from_yaw(3.0, 4.0, 1.0), 2),
        ("odom", "base", from_yaw(3.0, 10.0, 2.0), 3),
    )
    found = answer(buffer, Time(1), Time(2))
    expect_type(found, int | float, "It returned", "a number")
    expect(
        abs(found - 5) < 1e-6,
        f"From (0, 0) to (3, 4) it is 5 m, not {found:.2f} m.",
        "look the frame up at both times, and return the distance between the two positions",
    )
    found = answer(buffer, Time(2), Time(3))
    expect(abs(found - 6) < 1e-6, f"From (3, 4) to (3, 10) it is 6 m, not {found:.2f} m.", "use both times")
