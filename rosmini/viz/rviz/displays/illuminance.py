"""Illuminance: the light level."""

from __future__ import annotations

from rosmini.viz.rviz.scalar_display import ScalarDisplay, bounds


class Illuminance(ScalarDisplay, plugin="rviz/Illuminance"):
    """A `sensor_msgs/Illuminance`."""

    message = "sensor_msgs/Illuminance"
    field = "illuminance"
    unit = "lx"
    properties = bounds("illuminance", 0.0, 1000.0)
