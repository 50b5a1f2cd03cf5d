"""Camera: a camera image, with the scene drawn over it as the camera would see it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import matrix
from rosmini.viz.rviz.camera_images import MAX_SHOWN, image_pixels, info_topic, pin_hole, resized
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level, Shown
from rosmini.viz.rviz.flat import elements
from rosmini.viz.rviz.image_display import ImageDisplay, described
from rosmini.viz.rviz.primitives import DisplayError, Pane
from rosmini.viz.rviz.projection import Perspective
from rosmini.viz.rviz.properties import Property, Tree
from rosmini.viz.svg import element

BACKGROUND, OVERLAY, BOTH = "background", "overlay", "background and overlay"
EMPTY = 48
"""Brightness behind the scene if there is no image [0 to 255]."""


class Camera(ImageDisplay, plugin="rviz/Camera"):
    """A `sensor_msgs/Image` and the `sensor_msgs/CameraInfo` beside it, which defines the projection of the scene."""

    properties = (
        Property("Image Rendering", BOTH, "where the image is", choices=(BACKGROUND, OVERLAY, BOTH)),
        Property("Overlay Alpha", 0.5, "opacity of the image over the scene", minimum=0.0, maximum=1.0),
        Property("Zoom Factor", 1.0, "more than 1 magnifies", minimum=0.00001, maximum=100_000.0),
        Property("Visibility", Tree(), "which displays are seen by the camera"),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self._info: Any = None

    def start(self, context: Context) -> None:
        """Subscribe to images, and to the camera's calibration."""
        super().start(context)
        if self.topic:
            topic = info_topic(self.topic)
            text = f"No CameraInfo received on [{topic}].  Topic may not exist."
            self.set_status(Level.WARN, "Camera Info", text)
            try:
                self.subscribe(context, topic, "sensor_msgs/CameraInfo", self._take)
            except RosminiError as error:
                self.fail("Camera Info", error)

    def _take(self, info: Any) -> None:
        self._info = info

    def reset(self) -> None:
        """Discard image and calibration."""
        super().reset()
        self._info = None

    def pane(self, image: Any, context: Context, shown: Sequence[Shown]) -> Pane | None:
        """Return the image with the scene over it."""
        if self._info is None:
            return None
        try:
            camera = pin_hole(self._info, image.width, image.height)
        except DisplayError as error:
            self.fail("Camera Info", error)
            return None
        self.set_status(Level.OK, "Camera Info", "OK")
        try:
            pose = matrix(context.place(image.header.frame_id, image.header.stamp.to_nsec()))
        except TransformException:
            try:
                pose = matrix(context.place(image.header.frame_id))
            except TransformException as error:
                raise DisplayError(context.problem(image.header.frame_id, error)) from error
        pixels = image_pixels(image, self.bounds(5))
        scale = min(1.0, math.sqrt(MAX_SHOWN / (camera.width * camera.height)))
        zoom, alpha = float(self["Zoom Factor"]), float(self["Overlay Alpha"])
        visibility, rendering = self["Visibility"], self["Image Rendering"]
        seen = [each for name, primitives in shown if visibility.is_enabled(name) for each in primitives]
        drawn = elements(seen, Perspective.of_camera(camera.zoomed(zoom), pose, scale))
        behind = resized(pixels, max(1, round(camera.width * scale)), max(1, round(camera.height * scale)), zoom)
        if rendering == OVERLAY:
            behind = np.round(EMPTY * (1.0 - alpha) + behind * alpha).astype(np.uint8)
        opacity = None if rendering == BACKGROUND else 1.0 - alpha
        overlay = element("g", "".join(drawn), opacity=opacity) if drawn else ""
        return Pane(self.name, behind, described(image, pixels), overlay)
