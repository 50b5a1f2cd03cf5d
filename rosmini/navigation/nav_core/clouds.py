"""Point clouds of planners and costmaps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rosmini.core.time import Time
from rosmini.msgs import message_class


def point_cloud(frame_id: str, stamp: Time, names: Sequence[str], rows: ArrayLike) -> Any:
    """Return a `sensor_msgs/PointCloud2` of 32-bit floats: one point per row (n, k), with the fields `names` (k)."""
    points = np.asarray(rows, dtype="<f4").reshape(-1, len(names))
    message, field = message_class("sensor_msgs/PointCloud2")(), message_class("sensor_msgs/PointField")
    message.header.frame_id, message.header.stamp = frame_id, stamp
    message.fields = [field(name=name, offset=4 * i, datatype=field.FLOAT32, count=1) for i, name in enumerate(names)]
    message.height, message.width, message.is_dense = 1, len(points), True
    message.point_step, message.row_step = 4 * len(names), points.nbytes
    message.data = np.frombuffer(points.tobytes(), dtype=np.uint8)
    return message
