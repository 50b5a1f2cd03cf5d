"""The module that scripts import as ``sensor_msgs.point_cloud2``: converts clouds from and to tuples."""

from __future__ import annotations

import math
import struct
from collections import namedtuple
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from rosmini.core.errors import MessageException
from rosmini.msgs import message_class

PointCloud2 = message_class("sensor_msgs/PointCloud2")
PointField = message_class("sensor_msgs/PointField")

CODES = dict(enumerate("bBhHiIfd", start=1))
"""Format character of :mod:`struct` for each data type of a ``PointField``."""


def read_points(
    cloud: Any, field_names: Sequence[str] | None = None, skip_nans: bool = False, uvs: Iterable[tuple[int, int]] = ()
) -> Iterator[tuple[Any, ...]]:
    """Yield the points of a cloud row by row, each as a tuple of its fields in memory order.

    Args:
        cloud: a ``sensor_msgs/PointCloud2``.
        field_names: the fields to read; all if None.
        skip_nans: omit points with NaN in one of these fields.
        uvs: columns and rows of the points to read; all if empty.

    Raises ``MessageException`` if it is not a cloud, or its data is shorter than its sizes say.

    """
    if getattr(cloud, "_type", None) != "sensor_msgs/PointCloud2":
        raise MessageException(f"a {getattr(cloud, '_type', type(cloud).__name__)} is not a sensor_msgs/PointCloud2")
    point = _layout(cloud.fields, field_names, big=cloud.is_bigendian)
    return _points(cloud, point, skip_nans, list(uvs))


def _points(cloud: Any, point: struct.Struct, skip_nans: bool, uvs: list[tuple[int, int]]) -> Iterator[tuple[Any, ...]]:
    data = bytes(cloud.data) if isinstance(cloud.data, (list, tuple)) else cloud.data
    step, row = cloud.point_step, cloud.row_step
    places = iter(uvs) if uvs else ((u, v) for v in range(cloud.height) for u in range(cloud.width))
    for u, v in places:
        try:
            values = point.unpack_from(data, row * v + step * u)
        except struct.error as error:
            raise MessageException(
                f"point ({u}, {v}) of {cloud.width} x {cloud.height} points is outside of its data, {len(data)} bytes "
                f"(point_step {step}, row_step {row})"
            ) from error
        if not (skip_nans and any(map(math.isnan, values))):
            yield values


def read_points_list(
    cloud: Any, field_names: Sequence[str] | None = None, skip_nans: bool = False, uvs: Iterable[tuple[int, int]] = ()
) -> list[Any]:
    """Return the points of a cloud as a list of named tuples; see :func:`read_points` for arguments and errors."""
    names = [field.name for field in cloud.fields] if field_names is None else field_names
    make: Any = namedtuple  # the names come with the cloud: nothing for a type checker
    point = make("Point", names)
    return [point(*values) for values in read_points(cloud, names, skip_nans, uvs)]


def create_cloud(header: Any, fields: Sequence[Any], points: Iterable[Sequence[Any]]) -> Any:
    """Return a cloud of one row from tuples of the values of ``fields``, each a ``sensor_msgs/PointField``.

    Raises ``MessageException`` for a point that does not fit the fields.
    """
    point = _layout(fields, None, big=False)
    rows = []
    for values in points:
        try:
            rows.append(point.pack(*values))
        except (struct.error, OverflowError) as error:
            names = ", ".join(field.name for field in fields)
            raise MessageException(
                f"the point {tuple(values)!r:.200} does not fit the fields {names}: {error}"
            ) from error
    return PointCloud2(
        header=header,
        height=1,
        width=len(rows),
        is_dense=False,
        is_bigendian=False,
        fields=fields,
        point_step=point.size,
        row_step=point.size * len(rows),
        data=b"".join(rows),
    )


def create_cloud_xyz32(header: Any, points: Iterable[Sequence[float]]) -> Any:
    """Return a cloud of points (x, y, z) [m] as 32-bit floats."""
    return create_cloud(header, [PointField(name, 4 * place, 7, 1) for place, name in enumerate("xyz")], points)


def _layout(fields: Iterable[Any], names: Sequence[str] | None, *, big: bool) -> struct.Struct:
    """Return the memory layout of a point: the requested fields by offset, with gaps between them."""
    text, end = ">" if big else "<", 0
    for field in sorted(fields, key=lambda one: one.offset):
        if names is not None and field.name not in names:
            continue
        if field.datatype not in CODES:
            raise MessageException(
                f"field {field.name} of a cloud has the unknown data type {field.datatype}; 1 to 8 are known"
            )
        text += f"{max(field.offset - end, 0)}x{field.count}{CODES[field.datatype]}"
        end = max(field.offset, end) + field.count * struct.calcsize(CODES[field.datatype])
    try:
        return struct.Struct(text)
    except struct.error as error:
        raise MessageException(f"the fields of a cloud are larger than memory: {error}") from error
