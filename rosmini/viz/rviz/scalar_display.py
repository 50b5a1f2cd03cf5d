"""Displays of a single measured number: a point at the sensor, coloured by the value."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from .context import Context
from .display import Level
from .points_display import PointsDisplay, styled
from .primitives import INVALID, DisplayError, Primitive
from .properties import Property
from .topic_display import Received


def bounds(channel: str, low: float, high: float, *, invert: bool = False) -> tuple[Property, ...]:
    """Return RViz's properties whose defaults differ from those of points: the channel and its range."""
    return (
        Property("Channel Name", channel, "the channel"),
        Property("Autocompute Intensity Bounds", False, "bounds from the data"),
        Property("Invert Rainbow", invert, "for Intensity: reverse the colours"),
        Property("Min Intensity", low, "the value at one end of the rainbow"),
        Property("Max Intensity", high, "the value at its other end"),
    )


class ScalarDisplay(PointsDisplay):
    """The base of displays of a number; `field` is its name in the message, `unit` its unit."""

    properties: ClassVar[tuple[Property, ...]] = ()
    field: ClassVar[str] = ""
    unit: ClassVar[str] = ""

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the point."""
        del context
        value = float(getattr(received.message, self.field))
        if not math.isfinite(value):
            raise DisplayError(INVALID)
        self.set_status(Level.OK, "Value", f"{value:.6g} {self.unit}".rstrip())
        origin = np.zeros((1, 3))
        yield styled(received.points(origin), self, {self.field: np.array([value])}, origin)
