"""Temperature: the temperature, from 0 °C, where water freezes, to 100 °C."""

from __future__ import annotations

from rosmini.viz.rviz.scalar_display import ScalarDisplay, bounds


class Temperature(ScalarDisplay, plugin="rviz/Temperature"):
    """A `sensor_msgs/Temperature`."""

    message = "sensor_msgs/Temperature"
    field = "temperature"
    unit = "°C"
    properties = bounds("temperature", 0.0, 100.0, invert=True)
