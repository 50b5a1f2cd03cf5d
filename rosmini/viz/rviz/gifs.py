"""Pixels as GIF: its bytes are the same on every machine with one version of Pillow; those of PNG depend on zlib.

Pages are compared byte by byte, so their contents must be reproducible. A map has at most 256 colours.
"""

from __future__ import annotations

import base64
import io

import numpy as np

from .primitives import Pixels


def gif(pixels: Pixels) -> tuple[bytes, float]:
    """Return pixels (h, w, 4) as a GIF and its opacity (0 to 1), since a GIF has only fully transparent pixels."""
    from PIL import Image

    clear = pixels[..., 3] == 0
    alphas = pixels[..., 3][~clear]
    opacity = float(alphas.mean()) / 255 if len(alphas) else 0.0
    colours = pixels[..., :3].astype(np.uint32)
    packed = (colours[..., 0] << 16) | (colours[..., 1] << 8) | colours[..., 2]
    packed[clear] = 1 << 24
    found, places = np.unique(packed, return_inverse=True)
    if len(found) > 256:
        return _reduced(pixels, clear), round(opacity, 3)
    image = Image.fromarray(places.reshape(clear.shape).astype(np.uint8), mode="P")
    image.putpalette(np.stack([found >> 16 & 255, found >> 8 & 255, found & 255], axis=1).astype(np.uint8).tobytes())
    return _written(image, int(len(found) - 1) if clear.any() else None), round(opacity, 3)


def _reduced(pixels: Pixels, clear: np.ndarray) -> bytes:
    """Return the pixels in 255 colours, and one for transparent."""
    from PIL import Image

    image = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    image = image.quantize(255, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    if not clear.any():
        return _written(image, None)
    places = np.asarray(image).copy()
    places[clear] = 255
    marked = Image.fromarray(places, mode="P")
    marked.putpalette([*(image.getpalette() or [])[: 3 * 255], 0, 0, 0])
    return _written(marked, 255)


def _written(image: object, transparency: int | None) -> bytes:
    file = io.BytesIO()
    options = {} if transparency is None else {"transparency": transparency}
    image.save(file, format="GIF", optimize=False, **options)  # type: ignore[attr-defined]
    return file.getvalue()


def gif_url(data: bytes) -> str:
    """Return a GIF as a data URL."""
    return f"data:image/gif;base64,{base64.b64encode(data).decode()}"
