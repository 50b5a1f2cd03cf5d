"""PointCloud: points in the older message, with a list of channels."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.rviz.clouds import MAX_SHOWN, channels_of
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.points_display import PointsDisplay, styled
from rosmini.viz.rviz.primitives import DisplayError, Primitive
from rosmini.viz.rviz.topic_display import Received


class PointCloud(PointsDisplay, plugin="rviz/PointCloud"):
    """A `sensor_msgs/PointCloud`; points that are not finite are left out."""

    message = "sensor_msgs/PointCloud"

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the points."""
        del context
        points, every = received.message.points, -(-len(received.message.points) // MAX_SHOWN) or 1
        xyz = np.array([(each.x, each.y, each.z) for each in points[::every]], dtype=float).reshape(-1, 3)
        fields: dict[str, NDArray[Any]] = dict(zip("xyz", xyz.T, strict=True))
        for channel in received.message.channels:
            if len(channel.values) != len(points):
                raise DisplayError(
                    f"the channel {channel.name:.50} has {len(channel.values)} values for {len(points)} points"
                )
            fields.setdefault(channel.name, np.asarray(channel.values, dtype=np.float32)[::every])
        local, channels = channels_of(fields)
        yield styled(received.points(local), self, channels, local)
