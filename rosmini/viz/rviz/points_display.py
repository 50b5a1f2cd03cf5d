"""Displays of points, such as LaserScan and PointCloud2: style, size and colours (by RViz's transformers)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

import numpy as np

from rosmini.core.geometry.products import matrix_product

from .context import Context
from .display import Level
from .primitives import DisplayError, Floats, Points, Primitive
from .properties import Colour, Property
from .topic_display import TopicDisplay

STYLES = ("Points", "Squares", "Flat Squares", "Spheres", "Boxes")
TRANSFORMERS = ("", "Intensity", "RGB8", "MONO8", "RGBF32", "FlatColor", "AxisColor")

POINT_PROPERTIES: tuple[Property, ...] = (
    Property("Style", "Flat Squares", "how a point is drawn", choices=STYLES),
    Property("Size (m)", 0.01, "size of a point, except in the style Points", unit="m", minimum=0.0001, maximum=1e4),
    Property("Size (Pixels)", 3.0, "size of a point in the style Points", unit="px", minimum=1.0, maximum=100.0),
    Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
    Property("Decay Time", 0.0, "time that points stay; 0 for the last message only", unit="s", minimum=0.0),
    Property("Selectable", True, "whether points can be selected"),
    Property("Position Transformer", "XYZ", "where positions come from"),
    Property("Color Transformer", "Intensity", "where colours come from", choices=TRANSFORMERS),
    Property("Use Fixed Frame", True, "for AxisColor: the axis of the fixed frame, not the message's"),
    Property("Channel Name", "intensity", "for Intensity: the channel"),
    Property("Use rainbow", True, "for Intensity: a rainbow, not from Min Color to Max Color"),
    Property("Invert Rainbow", False, "for Intensity: reverse the colours"),
    Property("Min Color", Colour(0, 0, 0), "for Intensity: colour of the minimum"),
    Property("Max Color", Colour(255, 255, 255), "for Intensity: colour of the maximum"),
    Property("Autocompute Intensity Bounds", True, "for Intensity: bounds from the data"),
    Property("Min Intensity", 0.0, "for Intensity: the minimum"),
    Property("Max Intensity", 4096.0, "for Intensity: the maximum"),
    Property("Color", Colour(255, 255, 255), "for FlatColor: the colour"),
    Property("Axis", "Z", "for AxisColor: the axis", choices=("X", "Y", "Z")),
    Property("Autocompute Value Bounds", True, "for AxisColor: bounds from the data"),
    Property("Autocompute Value Bounds/Min Value", -10.0, "for AxisColor: the minimum", unit="m"),
    Property("Autocompute Value Bounds/Max Value", 10.0, "for AxisColor: the maximum", unit="m"),
)


def rainbow(values: Floats) -> Floats:
    """Return colours (n, 3) from 0, magenta, through blue, green and yellow to 1, red: RViz's rainbow."""
    h = np.clip(values, 0.0, 1.0) * 5.0 + 1.0
    i = np.floor(h).astype(int)
    f = h - i
    n = 1.0 - np.where(i % 2 == 0, 1.0 - f, f)
    zero, one = np.zeros_like(n), np.ones_like(n)
    choices = [(n, zero, one), (zero, n, one), (zero, one, n), (n, one, zero), (one, n, zero)]
    at = np.clip(i, 1, 5) - 1
    return np.stack([np.choose(at, [each[k] for each in choices]) for k in range(3)], axis=1)


def styled(points: Floats, properties: Any, channels: Mapping[str, Floats], local: Floats | None = None) -> Points:
    """Return points (n, 3) of the fixed frame, all finite, in the style of a display's properties.

    Args:
        points: their positions.
        properties: the display, or its properties.
        channels: the values of the points (n,), by name: `intensity` ...
        local: the same points in the message's frame (n, 3).

    Raises:
        DisplayError: the colours come from a channel that the message does not contain.

    """
    kind, count = properties["Color Transformer"], len(points)
    colours = np.ones((count, 4))
    colours[:, 3] = properties["Alpha"]
    if kind == "AxisColor":
        axis = "XYZ".index(properties["Axis"])
        values = (points if properties["Use Fixed Frame"] or local is None else local)[:, axis]
        group = "Autocompute Value Bounds"
        bounds = None if properties[group] else (properties[f"{group}/Min Value"], properties[f"{group}/Max Value"])
        colours[:, :3] = rainbow(1.0 - _share(values, bounds))
    elif kind in ("Intensity", "") and (channel := _channel(properties["Channel Name"], channels)) is not None:
        auto = properties["Autocompute Intensity Bounds"]
        bounds = None if auto else (properties["Min Intensity"], properties["Max Intensity"])
        share = _share(channel, bounds)
        if properties["Use rainbow"]:
            colours[:, :3] = rainbow(share if properties["Invert Rainbow"] else 1.0 - share)
        else:
            low, high = (properties[name].rgba()[:3] for name in ("Min Color", "Max Color"))
            colours[:, :3] = low + share[:, None] * (high - low)
    elif kind == "RGB8" and "rgb" in channels:
        colours[:, :3] = channels["rgb"]
    elif kind == "RGBF32" and {"r", "g", "b"} <= channels.keys():
        colours[:, :3] = np.nan_to_num(np.column_stack([channels[name] for name in "rgb"]))
    elif kind == "MONO8" and "rgb" in channels:
        colours[:, :3] = matrix_product(channels["rgb"], (0.2989, 0.5870, 0.1140))[:, None]
    elif kind in ("FlatColor", ""):
        colours[:, :3] = properties["Color"].rgba()[:3]
    elif kind != "Intensity":
        raise DisplayError(f"No color transformer {kind} for this message: it has {_listed(channels)}")
    style = properties["Style"]
    size = properties["Size (Pixels)"] if style == "Points" else properties["Size (m)"]
    return Points(points, colours, size, style)


def _channel(name: str, channels: Mapping[str, Floats]) -> Floats | None:
    found = channels.get(name)
    return channels.get("intensities") if found is None and name == "intensity" else found


def _share(values: Floats, bounds: tuple[float, float] | None) -> Floats:
    """Return the position of values between their bounds, by default their minimum and maximum: 0 to 1."""
    if not len(values):
        return values
    if bounds is None:
        known = values[np.isfinite(values)]
        bounds = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    low, high = bounds
    share = (values - low) / (high - low if high != low else 1e20)
    return np.clip(np.nan_to_num(share), 0.0, 1.0)


def _listed(channels: Mapping[str, Floats]) -> str:
    return f"the channels {', '.join(channels)}" if channels else "no channels"


class PointsDisplay(TopicDisplay):
    """The base of displays that draw a message as points."""

    properties: ClassVar[tuple[Property, ...]] = POINT_PROPERTIES

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the points of all stored messages."""
        found = list(super().primitives(context))
        count = sum(len(each.points) for each in found if isinstance(each, Points))
        if self.stored:
            text = f"Showing [{count}] points from [{len(self.stored)}] messages"
            self.set_status(Level.OK if count else Level.WARN, "Points", text)
        return found
