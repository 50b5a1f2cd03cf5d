"""Image: a camera image, in a separate pane."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.viz.rviz.camera_images import image_pixels, thinned_image
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Shown
from rosmini.viz.rviz.image_display import ImageDisplay, described
from rosmini.viz.rviz.primitives import Pane
from rosmini.viz.rviz.properties import Property


class Image(ImageDisplay, plugin="rviz/Image"):
    """A `sensor_msgs/Image`; ranges are shown from black to white."""

    properties = (
        Property("Normalize Range", True, "for an image of ranges: from its minimum to its maximum"),
        Property("Min Value", 0.0, "value of black if it is not normalised"),
        Property("Max Value", 1.0, "value of white if it is not normalised"),
        Property("Median window", 5, "number of images over which the range is smoothed", minimum=1, maximum=1000),
    )

    def pane(self, image: Any, context: Context, shown: Sequence[Shown]) -> Pane | None:
        """Return the image."""
        del context, shown
        normalised = self["Normalize Range"]
        bounds = self.bounds(self["Median window"]) if normalised else (self["Min Value"], self["Max Value"])
        pixels = image_pixels(image, bounds)
        return Pane(self.name, thinned_image(pixels), described(image, pixels))
