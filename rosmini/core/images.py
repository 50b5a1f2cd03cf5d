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

__all__ = ["LARGEST", "ImageError", "opened"]

LARGEST = 100_000_000
"""Maximum number of pixels: a map of 10,000 x 10,000 cells."""

BYTES = 5
"""Maximum file size per pixel [bytes]."""

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
                if image.width * image.height > LARGEST:
                    raise ImageError(f"it has {image.width} x {image.height} pixels; {LARGEST} are allowed")
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
