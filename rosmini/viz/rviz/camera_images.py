"""Camera images as RViz shows them: colours unchanged, ranges from black to white."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from rosmini.viz.image_pictures import ENCODINGS, pixels_of, values_of
from rosmini.viz.view import ViewError

from .primitives import DisplayError, Floats, Pixels

RANGED = ("32FC1", "16UC1", "16SC1", "mono16")
"""Encodings whose minimum and maximum are shown as black and white."""
MAX_SIDE = 10_000
MAX_PIXELS = 25_000_000
MAX_SHOWN = 320 * 240
"""Maximum number of pixels of an image in a page; a larger one is reduced by an integer factor."""


class PinHole(NamedTuple):
    """The projection of a camera: focal lengths and principal point [px], and the size of the image [px]."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    tx: float = 0.0
    ty: float = 0.0
    """The camera's position in its frame [m]: not 0 for the right camera of a stereo pair."""

    def zoomed(self, factor: float) -> PinHole:
        """Return the projection magnified around the centre of the image."""
        middle = (
            (self.cx - self.width / 2) * factor + self.width / 2,
            (self.cy - self.height / 2) * factor + self.height / 2,
        )
        return self._replace(fx=self.fx * factor, fy=self.fy * factor, cx=middle[0], cy=middle[1])


def pin_hole(info: Any, width: int, height: int) -> PinHole:
    """Return the projection of a `sensor_msgs/CameraInfo` from its P; its size is that of the image if it has none.

    Raises:
        DisplayError: it contains numbers that are not finite, or no focal length.

    """
    p = np.asarray(info.P, dtype=float).reshape(-1)
    if len(p) != 12 or not np.isfinite(p).all():
        raise DisplayError("Contains invalid floating point values (nans or infs)")
    if p[0] <= 0 or p[5] <= 0:
        raise DisplayError(f"the focal lengths in CameraInfo/P must be more than 0, not {p[0]:g} and {p[5]:g}")
    if max(info.width, info.height) > MAX_SIDE:
        raise DisplayError(f"an image of {info.width} x {info.height} pixels is too large to draw")
    return PinHole(
        p[0], p[5], p[2], p[6], int(info.width) or width, int(info.height) or height, -p[3] / p[0], -p[7] / p[5]
    )


def info_topic(image_topic: str) -> str:
    """Return the topic of the `sensor_msgs/CameraInfo` of an image: `camera_info` in the same namespace."""
    above, slash, _ = image_topic.rpartition("/")
    return f"{above}{slash}camera_info"


def check_image(message: Any) -> None:
    """Raise `DisplayError` for an unknown encoding or an invalid size."""
    if message.encoding not in ENCODINGS:
        raise DisplayError(f"Unsupported image encoding [{message.encoding:.50}]")
    size = int(message.width) * int(message.height)
    if not 0 < size <= MAX_PIXELS or max(message.width, message.height) > MAX_SIDE:
        raise DisplayError(f"an image of {message.width} x {message.height} pixels cannot be drawn")


def image_range(message: Any) -> tuple[float, float] | None:
    """Return the minimum and maximum of an image of ranges (0 and 1 if it has none); None for an image of colours.

    Raises `DisplayError` if its data do not match its size.
    """
    if message.encoding not in RANGED:
        return None
    values = _values(message)
    known = values[np.isfinite(values)]
    return (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)


def image_pixels(message: Any, bounds: tuple[float, float] = (0.0, 1.0)) -> Pixels:
    """Return the pixels (h, w, 3) of a `sensor_msgs/Image`; ranges go from black to white between `bounds`.

    Raises `DisplayError` if its data do not match its size.
    """
    check_image(message)
    if message.encoding not in RANGED:
        try:
            return np.asarray(pixels_of(message), dtype=np.uint8)
        except ViewError as error:
            raise DisplayError(str(error)) from error
    low, high = bounds
    share = (_values(message) - low) / ((high - low) or 1.0)
    grey = np.round(np.clip(np.nan_to_num(share), 0.0, 1.0) * 255).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=2)


def depths(message: Any) -> Floats:
    """Return the depths (h, w) [m] of a `sensor_msgs/Image`, nan for none. Raises `DisplayError` if it has none."""
    check_image(message)
    if ENCODINGS[message.encoding].order:
        raise DisplayError(f"an image with the encoding [{message.encoding}] has no depths; use 32FC1 or 16UC1")
    try:
        return np.asarray(pixels_of(message), dtype=float)
    except ViewError as error:
        raise DisplayError(str(error)) from error


def thinned_image(pixels: Pixels) -> Pixels:
    """Return the means of square blocks of pixels (h, w, 3), so that there are at most `MAX_SHOWN` pixels."""
    height, width = pixels.shape[:2]
    factor = max(1, math.ceil(math.sqrt(height * width / MAX_SHOWN)))
    while factor > 1 and (height // factor) * (width // factor) == 0:
        factor -= 1
    if factor == 1:
        return pixels
    rows, columns = height // factor, width // factor
    squares = pixels[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor, 3)
    thinned: Pixels = np.round(squares.mean(axis=(1, 3), dtype=np.float32)).astype(np.uint8)
    return thinned


def resized(pixels: Pixels, width: int, height: int, zoom: float = 1.0) -> Pixels:
    """Return pixels (h, w, 3) in another size, magnified around the centre; black outside the image."""
    rows = np.floor(((np.arange(height) + 0.5) / height - 0.5) / zoom * len(pixels) + len(pixels) / 2)
    columns = np.floor(((np.arange(width) + 0.5) / width - 0.5) / zoom * pixels.shape[1] + pixels.shape[1] / 2)
    found = np.zeros((height, width, 3), dtype=np.uint8)
    i, j = ((rows >= 0) & (rows < len(pixels))), ((columns >= 0) & (columns < pixels.shape[1]))
    found[np.ix_(i, j)] = pixels[np.ix_(rows[i].astype(int), columns[j].astype(int))]
    return found


def _values(message: Any) -> Floats:
    check_image(message)
    try:
        return np.asarray(values_of(message, ENCODINGS[message.encoding])[..., 0], dtype=float)
    except ViewError as error:
        raise DisplayError(str(error)) from error
