"""Displays of one number: where it was measured, in which colour, and what it is."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class

KINDS = {
    "Temperature": ("temperature", 25.0, "25 °C", 0.25),
    "RelativeHumidity": ("relative_humidity", 0.5, "0.5", 0.5),
    "Illuminance": ("illuminance", 800.0, "800 lx", 0.8),
    "FluidPressure": ("fluid_pressure", 101500.0, "101500 Pa", 0.5),
}
"""The field, a value, how it is written, and where that is in the rainbow of RViz's default range."""


@pytest.mark.parametrize("kind", KINDS)
def test_a_point_at_the_sensor_has_the_colour_of_its_value(stage, statuses, kind):
    field, value, text, share = KINDS[kind]
    scene, display = stage.display(kind, "/value")
    low, high = display["Min Intensity"], display["Max Intensity"]

    def measure(number):
        stage.place("map", "sensor", (1.0, 2.0, 3.0))
        stage.graph.run(0.1)
        stage.publish("/value", message_class(f"sensor_msgs/{kind}")(**{field: number}), "sensor")
        stage.place("map", "sensor", (1.0, 2.0, 3.0))
        stage.graph.run(0.1)
        return scene.update()[0].primitives

    (points,) = measure(value)
    assert points.points == pytest.approx(np.array([(1.0, 2.0, 3.0)]))
    assert statuses(display)["Value"] == ("Ok", text)
    assert display["Channel Name"] == field
    assert (value - low) / (high - low) == pytest.approx(share)
    for number, colour in ((low, (1, 0, 0)), (high, (1, 0, 1))):
        (points,) = measure(number)
        expected = colour if kind != "Temperature" else {(1, 0, 0): (1, 0, 1), (1, 0, 1): (1, 0, 0)}[colour]
        assert points.colours[0, :3] == pytest.approx(np.array(expected), abs=1e-9)
    assert not measure(math.nan)
    assert "nans or infs" in statuses(display)["Topic"][1]
