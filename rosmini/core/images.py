"""Image files, checked by size before they are read."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rosmini.core import files
from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["LARGEST", "ImageError", "opened", "strips"]

LARGEST = 100_000_000
"""Maximum number of pixels: a map of 10,000 x 10,000 cells."""

IN_COLOUR = 50_000_000
"""Maximum number of pixels of an image that takes more than one byte for each in memory."""

BYTES = 5
"""Maximum file size per pixel [bytes]."""

AT_ONCE = 1_000_000
"""Maximum number of pixels of a strip."""

FORMATS = ("BMP", "GIF", "JPEG", "PNG", "PPM", "TGA", "TIFF", "WEBP")
"""The formats that SDL_image reads in ROS, by Pillow's names. Some of Pillow's other formats run programs."""


class ImageError(RosminiError):
    """An image cannot be read, or is too large."""


@contextmanager
def opened(path: str | os.PathLike[str]) -> Iterator[Image]:
    """Open an image for reading its pixels. Raises `ImageError`, also while reading, and `FileNotFoundError`."""
    from PIL import Image, UnidentifiedImageError

    try:
        files.check(path, LARGEST * BYTES)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)  # our limit replaces it
            with Image.open(path, formats=FORMATS) as image:
                most = LARGEST if image.mode in ("1", "L", "P") else IN_COLOUR
                if image.width * image.height > most:
                    size = f"{image.width} x {image.height} pixels in mode {image.mode}"
                    raise ImageError(f"it has {size}; {most} are allowed")
                yield image
    except FileNotFoundError:
        raise
    except UnidentifiedImageError as error:
        raise ImageError(f"this is no image ({', '.join(FORMATS)})") from error
    except Image.DecompressionBombError as error:
        raise ImageError(f"it has too many pixels; {LARGEST} are allowed") from error
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


def strips(image: Image) -> Iterator[tuple[int, Image]]:
    """Yield the rows of an image from the top, a strip at a time, each with the number of its first row.

    Converting an image needs several times its memory; converting its strips does not.
    """
    rows = max(1, AT_ONCE // max(1, image.width))
    for top in range(0, image.height, rows):
        yield top, image.crop((0, top, image.width, min(top + rows, image.height)))
