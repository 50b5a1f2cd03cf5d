"""Images from outside, by their size before they are read."""

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
"""How many pixels an image may have: a map of 10,000 x 10,000 cells."""

BYTES = 5
"""How many bytes a pixel may take in a file."""

FORMATS = ("BMP", "GIF", "JPEG", "PNG", "PPM", "TGA", "TIFF", "WEBP")
"""What SDL_image reads for ROS, as Pillow calls it. Pillow has others that run programs."""


class ImageError(RosminiError):
    """An image cannot be read, or is too large."""


@contextmanager
def opened(path: str | os.PathLike[str]) -> Iterator[Image]:
    """An image whose pixels can be read. Raises `ImageError`, also while they are read, and `FileNotFoundError`."""
    from PIL import Image, UnidentifiedImageError

    try:
        files.check(path, LARGEST * BYTES)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)  # the limit here is another
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
    # What Pillow raises for a broken one.
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
