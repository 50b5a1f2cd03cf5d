"""Point clouds as arrays: the fields of `sensor_msgs/PointCloud2` and `PointCloud` for each point, by name."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .primitives import DisplayError, Floats

MAX_BYTES = 1 << 30
MAX_SHOWN = 1_000_000
"""Maximum number of points; of larger clouds only every second, third ... point is shown."""

_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
_FLOAT, _INTS = "f4", ("i4", "u4")
_PACKED = ("rgb", "rgba")


def read_cloud(cloud: Any) -> dict[str, NDArray[Any]]:
    """Return the fields of a `sensor_msgs/PointCloud2`, each (n,) in its own type; points are row by row.

    Raises:
        DisplayError: the sizes do not match the data, or a field lies outside its point or has an unknown type.

    """
    width, height, step = int(cloud.width), int(cloud.height), int(cloud.point_step)
    data = np.frombuffer(bytes(cloud.data), dtype=np.uint8)
    if len(data) != width * height * step or len(data) > MAX_BYTES:
        raise DisplayError(
            f"Data size ({len(data)} bytes) does not match width ({width}) times height ({height}) times point_step "
            f"({step}).  Dropping message."
        )
    order = ">" if cloud.is_bigendian else "<"
    found: dict[str, NDArray[Any]] = {}
    rows = data.reshape(width * height, step) if len(data) else np.empty((0, step), np.uint8)
    rows = rows[:: -(-len(rows) // MAX_SHOWN) or 1]
    for field in cloud.fields:
        kind = _TYPES.get(field.datatype)
        if kind is None:
            raise DisplayError(f"the field {field.name:.50} has the unknown type {field.datatype}")
        number = np.dtype(order + kind)
        start, end = int(field.offset), int(field.offset) + number.itemsize
        if end > step and len(rows):
            raise DisplayError(f"the field {field.name:.50} ends at byte {end} of points of {step} bytes")
        if len(rows):
            found.setdefault(field.name, np.ascontiguousarray(rows[:, start:end]).view(number)[:, 0])
        else:
            found.setdefault(field.name, np.empty(0, number))
    return found


def channels_of(fields: dict[str, NDArray[Any]]) -> tuple[Floats, dict[str, Floats]]:
    """Return points (n, 3) and their channels (n,) by name, with `rgb` (n, 3) from 0 to 1, from `read_cloud`'s result.

    Points that are not finite are left out. Raises `DisplayError` if x, y or z is missing.
    """
    if not {"x", "y", "z"} <= fields.keys():
        raise DisplayError(f"No position transformer available for cloud: its fields are {_listed(fields)}")
    points = np.column_stack([fields[name].astype(float) for name in "xyz"])
    valid = np.isfinite(points).all(axis=1)
    channels = {
        name: values[valid].astype(float)
        for name, values in fields.items()
        if name not in _PACKED and len(values) == len(valid)
    }
    for name in _PACKED:
        if name in fields and len(fields[name]) == len(valid):
            channels["rgb"] = unpacked(fields[name][valid])
            break
    return points[valid], channels


def unpacked(values: NDArray[Any]) -> Floats:
    """Unpack colours (n,), the bytes of a float or an integer, to red, green and blue (n, 3) from 0 to 1."""
    native = values.astype(values.dtype.newbyteorder("="))
    if native.dtype.str[1:] not in (_FLOAT, *_INTS):
        raise DisplayError(f"packed colours must be 4 bytes, a float or an integer, not {native.dtype}")
    bits = np.ascontiguousarray(native).view(np.uint32)
    return np.stack([(bits >> shift & 255) / 255.0 for shift in (16, 8, 0)], axis=1)


def _listed(names: dict[str, Any]) -> str:
    return ", ".join(list(names)[:12]) or "none"
