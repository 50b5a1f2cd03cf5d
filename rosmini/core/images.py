"""Image files, checked by size before they are read."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rosmini.core import files
from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_PIXELS = 100_000_000
"""Maximum number of pixels: a map of 10,000 x 10,000 cells."""

MAX_SIDE = 65_535
"""Maximum number of pixels along a side, as in SDL."""

MEMORY = 250_000_000
"""Maximum memory [bytes] for the pixels and their decoder, or for a map made from them."""

BYTES = 5
"""Maximum file size per pixel [bytes]."""

AT_ONCE = 100_000
"""Maximum number of pixels in a strip."""

FORMATS = ("BMP", "GIF", "JPEG", "PNG", "PPM", "TGA", "TIFF", "WEBP")
"""The formats that SDL_image reads in ROS, by Pillow's names. Some of Pillow's other formats run programs."""


class ImageError(RosminiError):
    """An image cannot be read, or is too large."""


@contextmanager
def opened(path: str | os.PathLike[str]) -> Iterator[Image]:
    """Open an image for reading its pixels.

    Raises `FileNotFoundError` if it is missing, and `ImageError` if it is not an image, is too large, or is broken,
    which may only show when the caller reads the pixels.
    """
    from PIL import Image, UnidentifiedImageError

    try:
        files.check(path, MAX_PIXELS * BYTES)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)  # our limit replaces it
            with Image.open(path, formats=FORMATS) as image:
                _check(image)
                yield image
    except FileNotFoundError:
        raise
    except UnidentifiedImageError as error:
        raise ImageError(f"this is not an image ({', '.join(FORMATS)})") from error
    except Image.DecompressionBombError as error:
        raise ImageError(f"it has too many pixels; {MAX_PIXELS} are allowed") from error
    # Errors that Pillow raises for broken files.
    except (
        OSError,
        SyntaxError,
        ValueError,
        OverflowError,
        EOFError,
        TypeError,
        AttributeError,
        IndexError,
        KeyError,
    ) as error:
        raise ImageError(getattr(error, "strerror", None) or str(error) or type(error).__name__) from error


def _check(image: Image) -> None:
    """Raise `ImageError` for an image that has too many pixels or would take too much memory."""
    pixels = image.width * image.height
    text = f"it has {image.width} x {image.height} pixels in mode {image.mode}"
    if pixels > MAX_PIXELS or max(image.size) > MAX_SIDE:
        raise ImageError(f"{text}; {MAX_PIXELS} are allowed, and {MAX_SIDE} along a side")
    needed = pixels * _bytes(image) + max(pixels, _decoder_memory(image))
    if needed > MEMORY:
        raise ImageError(
            f"{text}, which take {needed // 10**6} MB; {MEMORY // 10**6} are allowed: make it smaller, or save it as a "
            "grey PNG"
        )


def _bytes(image: Image) -> int:
    """Return the memory that Pillow needs for a pixel [bytes]."""
    if image.mode.startswith("I;16"):
        return 2
    return 1 if image.mode in ("1", "L", "P") else 4


def _decoder_memory(image: Image) -> int:
    """Return an upper bound of the memory that the decoder of an image takes [bytes], apart from the pixels."""
    pixels, bands = image.width * image.height, len(image.getbands())
    match image.format:
        case "JPEG":  # with several scans, the decoder keeps all coefficients
            return 2 * bands * pixels
        case "WEBP":  # the file's frame, the canvas and a copy
            return 11 * pixels
        case "PPM" if getattr(image, "tile", [("raw",)])[0][0] != "raw":  # numbers as text: two copies
            return 2 * _bytes(image) * pixels
        case "TIFF":  # one strip or tile
            tags: Any = getattr(image, "tag_v2", {})
            rows = min(tags.get(_ROWS_PER_STRIP, image.height), image.height)
            tile = tags.get(_TILE_WIDTH, 0) * tags.get(_TILE_HEIGHT, 0)
            bits = sum(tags.get(_BITS_PER_SAMPLE, (8,) * bands))
            return int(max(rows * image.width, tile) * bits) // 8
        case _:
            return 0


_BITS_PER_SAMPLE, _ROWS_PER_STRIP, _TILE_WIDTH, _TILE_HEIGHT = 258, 278, 322, 323


def strips(image: Image) -> Iterator[tuple[int, Image]]:
    """Yield horizontal strips of an image from top to bottom, each with the number of its first row.

    Converting an image needs several times its memory; converting its strips does not.
    """
    rows = max(1, AT_ONCE // max(1, image.width))
    for top in range(0, image.height, rows):
        yield top, image.crop((0, top, image.width, min(top + rows, image.height)))
