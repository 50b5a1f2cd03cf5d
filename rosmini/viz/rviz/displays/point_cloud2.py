"""PointCloud2: points with any number of fields."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.viz.rviz.clouds import channels_of, read_cloud
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.points_display import PointsDisplay, styled
from rosmini.viz.rviz.primitives import Primitive
from rosmini.viz.rviz.topic_display import Received


class PointCloud2(PointsDisplay, plugin="rviz/PointCloud2"):
    """A `sensor_msgs/PointCloud2`; points that are not finite are left out."""

    message = "sensor_msgs/PointCloud2"

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the points."""
        del context
        local, channels = channels_of(read_cloud(received.message))
        yield styled(received.points(local), self, channels, local)
