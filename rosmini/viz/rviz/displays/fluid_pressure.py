"""FluidPressure: the pressure, by default in the range of air at sea level."""

from __future__ import annotations

from rosmini.viz.rviz.scalar_display import ScalarDisplay, bounds


class FluidPressure(ScalarDisplay, plugin="rviz/FluidPressure"):
    """A `sensor_msgs/FluidPressure`."""

    message = "sensor_msgs/FluidPressure"
    field = "fluid_pressure"
    unit = "Pa"
    properties = bounds("fluid_pressure", 98000.0, 105000.0)
