"""Wrong answers to the exercises of the chapter Frames."""

from __future__ import annotations

import math
from typing import Any

from rosmini.core.tf import Buffer
from rosmini.core.tf.messages import scan_points, transform_of
from rosmini.core.tf.rigid import Rigid, compose, inverse, matrix
from rosmini.core.time import Time


def _points(buffer: Buffer, scan: Any) -> Any:
    header = scan.header
    return buffer.transform_points(scan_points(scan), "base_link", header.frame_id, header.stamp)


def _correction(map_base: Rigid, buffer: Buffer, stamp: Time) -> Rigid:
    return compose(map_base, inverse(transform_of(buffer.lookup_transform("odom", "base_footprint", stamp))))


MISTAKES = {
    "nearest_to_base": [
        lambda: lambda _buffer, scan: min(scan.ranges),
        lambda: (
            lambda buffer, scan: min(
                math.hypot(x, y) for x, y, _ in buffer.transform_points(scan_points(scan), "front_laser", "base_link")
            )
        ),
        lambda: _points,
        lambda: lambda buffer, scan: min(math.hypot(x, y, z) for x, y, z in _points(buffer, scan)),
        lambda: (
            lambda buffer, scan: min(
                math.hypot(x, y) for x, y, _ in buffer.transform_points(scan_points(scan), "base_link", "front_laser")
            )
        ),
        lambda: lambda buffer, scan: min(math.hypot(x, y) for x, y, _ in _points(buffer, scan)),
        lambda: lambda buffer, scan: min((math.hypot(x, y) for x, y, _ in _points(buffer, scan)), default=0.0),
    ],
    "map_to_odom": [
        lambda: (
            lambda buffer, map_base, stamp: compose(
                inverse(transform_of(buffer.lookup_transform("odom", "base_footprint", stamp))), map_base
            )
        ),
        lambda: lambda buffer, map_base, stamp: inverse(_correction(map_base, buffer, stamp)),
        lambda: lambda _buffer, map_base, _stamp: map_base,
        lambda: lambda buffer, map_base, _stamp: _correction(map_base, buffer, Time(0)),
        lambda: lambda buffer, map_base, stamp: matrix(_correction(map_base, buffer, stamp)),
    ],
    "moved": [
        lambda: lambda buffer, _start, _end: buffer.lookup_transform("odom", "base").transform.translation.x,
        lambda: lambda buffer, _start, end: buffer.lookup_transform("odom", "base", end).transform.translation.x,
        lambda: (
            lambda buffer, start, end: (
                buffer.lookup_transform("odom", "base", end).transform.translation.x
                - buffer.lookup_transform("odom", "base", start).transform.translation.x
            )
        ),
    ],
}
