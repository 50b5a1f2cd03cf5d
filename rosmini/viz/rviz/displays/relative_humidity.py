"""RelativeHumidity: the relative humidity, from 0 to 1."""

from __future__ import annotations

from rosmini.viz.rviz.scalar_display import ScalarDisplay, bounds


class RelativeHumidity(ScalarDisplay, plugin="rviz/RelativeHumidity"):
    """A `sensor_msgs/RelativeHumidity`."""

    message = "sensor_msgs/RelativeHumidity"
    field = "relative_humidity"
    properties = bounds("relative_humidity", 0.0, 1.0)
