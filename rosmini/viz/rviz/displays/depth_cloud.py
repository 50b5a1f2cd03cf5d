"""DepthCloud: the points of a depth camera, in the colours of another image."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.viz.rviz.camera_images import depths, image_pixels, info_topic
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.points_display import PointsDisplay, styled
from rosmini.viz.rviz.primitives import DisplayError, Floats, Primitive
from rosmini.viz.rviz.properties import Property
from rosmini.viz.rviz.topic_display import Received

NEAR_NS = 500_000_000
"""Maximum difference between the stamps of depths and colours [ns]."""
INFO = "sensor_msgs/CameraInfo"


class DepthCloud(PointsDisplay, plugin="rviz/DepthCloud"):
    """A `sensor_msgs/Image` of depths with the `CameraInfo` beside it, and a colour image of the same size."""

    message = "sensor_msgs/Image"
    topic_property = "Depth Map Topic"
    properties = (
        Property("Depth Map Topic", "", "the topic of depths"),
        Property("Depth Map Transport Hint", "raw", "transport of images; always raw"),
        Property("Color Image Topic", "", "the topic of colours; empty for none"),
        Property("Color Transport Hint", "raw", "transport of images; always raw"),
        Property("Queue Size", 5, "maximum number of messages that wait for their transform", minimum=1, maximum=1000),
        Property("Topic Filter", True, "not used: all topics are offered"),
        Property("Auto Size", True, "make points as large as a pixel at their distance"),
        Property("Auto Size/Auto Size Factor", 1.0, "factor of that size", minimum=0.0001),
        Property("Occlusion Compensation", False, "keep points that nearer ones hide; not supported"),
        Property("Occlusion Compensation/Occlusion Time-Out", 30.0, "its duration", unit="s", minimum=0.0),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self._info: Any = None
        self._colours: deque[Any] = deque(maxlen=20)

    def start(self, context: Context) -> None:
        """Subscribe to depths, to the camera's calibration, and to colours."""
        super().start(context)
        if not self.topic:
            return
        self._topic = info_topic(self.topic)
        try:
            self.subscribe(context, self._topic, INFO, self._take_info)
            if self["Color Image Topic"]:
                self.subscribe(context, self["Color Image Topic"], self.message, self._take_colours)
        except RosminiError as error:
            self.fail("Message", error)
        self.set_status(Level.WARN, "CameraInfo", f"No CameraInfo received on [{self._topic}]")

    def changed(self, name: str) -> None:
        """Subscribe again if the topic of colours changes."""
        super().changed(name)
        if name == "Color Image Topic":
            self.restart()

    def reset(self) -> None:
        """Discard all images."""
        super().reset()
        self._info = None
        self._colours.clear()

    def _take_info(self, info: Any) -> None:
        self._info = info
        self._redraw_last()

    def _take_colours(self, image: Any) -> None:
        self._colours.append(image)
        self._redraw_last()

    def _redraw_last(self) -> None:
        """Draw the last depths again, with the calibration or colours that just arrived."""
        if self.stored:
            self.stored[-1].drawn = None

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield a point for each pixel with a depth."""
        del context
        info, image = self._info, received.message
        if info is None:
            return
        size = f"{image.width} x {image.height}"
        if (info.width, info.height) != (image.width, image.height):
            raise DisplayError(f"Depth image size and camera info don't match: {size} vs {info.width} x {info.height}")
        k = np.asarray(info.K, dtype=float)
        if not (np.isfinite(k).all() and k[0] > 0 and k[4] > 0):
            raise DisplayError("CameraInfo/K has no focal lengths")
        self.set_status(Level.OK, "CameraInfo", "OK")
        self.set_status(Level.OK, "Depth Image Size", size)
        away = depths(image)
        rows, columns = np.nonzero(np.isfinite(away) & (away > 0))
        z = away[rows, columns]
        local = np.column_stack([(columns - k[2]) * z / k[0], (rows - k[5]) * z / k[4], z])
        channels: dict[str, Floats] = {}
        colours = self._colours_of(received)
        if colours is not None:
            channels["rgb"] = colours[rows, columns] / 255.0
        chosen = _RGB8(self) if channels else self
        points = styled(received.points(local), chosen, channels, local)
        if self["Auto Size"] and len(z) and points.style != "Points":
            points = replace(points, size=float(self["Auto Size/Auto Size Factor"] * np.median(z) / k[0]))
        yield points

    def _colours_of(self, received: Received) -> Any:
        """Return the colours (h, w, 3) closest in time to the depths; None if there are none."""
        near = [each for each in self._colours if abs(each.header.stamp.to_nsec() - received.stamp_ns) <= NEAR_NS]
        if not near:
            return None
        image = min(near, key=lambda each: abs(each.header.stamp.to_nsec() - received.stamp_ns))
        depth = received.message
        if (image.width, image.height) != (depth.width, depth.height):
            raise DisplayError(
                f"Depth image resolution ({depth.width}x{depth.height}) does not match color image resolution "
                f"({image.width}x{image.height})"
            )
        if image.header.frame_id != received.frame:
            received.note(
                f"Depth image frame id [{received.frame}] doesn't match color image frame id [{image.header.frame_id}]"
            )
        return image_pixels(image)


class _RGB8:
    """The properties of a display, but with colours from the points' RGB channel."""

    def __init__(self, display: DepthCloud) -> None:
        self._display = display

    def __getitem__(self, name: str) -> Any:
        return "RGB8" if name == "Color Transformer" else self._display[name]
