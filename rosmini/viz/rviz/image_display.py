"""The base of image displays: their topic, their counts, and the range of grey images."""

from __future__ import annotations

from abc import abstractmethod
from collections import deque
from collections.abc import Iterable, Sequence
from typing import Any, ClassVar

import numpy as np

from .camera_images import check_image, image_range
from .context import Context
from .display import Level, Shown
from .primitives import Pane, Pixels, Primitive
from .properties import Property
from .topic_display import Received, TopicDisplay


class ImageDisplay(TopicDisplay):
    """The base of displays that show an image in a separate pane."""

    message = "sensor_msgs/Image"
    topic_property = "Image Topic"
    needs_transform = False
    properties: ClassVar[tuple[Property, ...]] = (
        Property("Image Topic", "", "the topic to subscribe to"),
        Property("Transport Hint", "raw", "transport of images; always raw"),
        Property("Queue Size", 2, "maximum number of waiting images", minimum=1, maximum=1000),
    )

    def __init__(self, name: str = "", tree: Any = None) -> None:
        super().__init__(name, tree)
        self._ranges: deque[tuple[float, float]] = deque(maxlen=1000)

    def reset(self) -> None:
        """Discard all images."""
        super().reset()
        self._ranges.clear()

    def accept(self, received: Received, context: Context) -> bool:
        """Accept an image that can be shown."""
        del context
        check_image(received.message)
        found = image_range(received.message)
        if found is not None:
            self._ranges.append(found)
        return True

    def bounds(self, window: int) -> tuple[float, float]:
        """Return the medians of the minimum and of the maximum of the last `window` images."""
        last = list(self._ranges)[-window:]
        low, high = np.median(np.array(last or [(0.0, 1.0)]), axis=0)
        return float(low), float(high)

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Return nothing: images are not part of the scene."""
        del received, context
        return ()

    @abstractmethod
    def pane(self, image: Any, context: Context, shown: Sequence[Shown]) -> Pane | None:
        """Return the picture of an image, beside the other displays' primitives. May raise `DisplayError`."""

    def panes(self, context: Context, shown: Sequence[Shown] = ()) -> Iterable[Pane]:
        """Return the picture of the last image."""
        if not self.stored:
            self.set_status(Level.WARN, "Image", "No Image received")
            return ()
        try:
            found = self.pane(self.stored[-1].message, context, shown)
        except Exception as error:  # an error in one image must not stop the scene
            self.fail("Image", error)
            return ()
        self.set_status(Level.OK, "Image", f"{self.message_count} images received")
        return () if found is None else (found,)


def described(image: Any, pixels: Pixels) -> str:
    """Describe an image in one line: its size, its encoding, and its frame."""
    height, width = pixels.shape[:2]
    frame = f", in {image.header.frame_id}" if image.header.frame_id else ""
    return f"{width} x {height} pixels, {image.encoding}{frame}"
