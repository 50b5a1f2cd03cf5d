"""Camera images, small and slow: 64 colours, at most 96 pixels wide, each encoded as its difference to the last."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.replay.grids import runs_of
from rosmini.viz.replay.layers import Frames
from rosmini.viz.replay.packing import pack, pack_natural
from rosmini.viz.view import ViewError

Pixels = NDArray[np.uint8]

MAX_PIXELS = 96
"""Maximum width and height of an image."""
MIN_PIXELS = 24
LEVELS = 4
"""Number of levels of red, green and blue."""


def reduced_image(pixels: NDArray[Any], most: int = MAX_PIXELS) -> Pixels:
    """Return an image as colour indices (h, w), 0 to 63: 16 red + 4 green + blue; depths [m] as grey, near is light.

    Raises:
        ViewError: it has no pixels.

    """
    if not pixels.size:
        raise ViewError("an image has no pixels")
    every = -(-max(pixels.shape[:2]) // most)
    thin = pixels[every // 2 :: every, every // 2 :: every]
    if thin.ndim == 2:
        near = 1.0 / (1.0 + np.nan_to_num(thin, nan=np.inf, posinf=np.inf))
        thin = np.repeat((255 * near)[..., None], 3, axis=2)
    levels = np.clip(np.rint(thin.astype(float) * (LEVELS - 1) / 255), 0, LEVELS - 1).astype(np.uint8)
    numbers: Pixels = (levels * np.array([LEVELS * LEVELS, LEVELS, 1])).sum(axis=-1).astype(np.uint8)
    return numbers


@dataclass(frozen=True, eq=False)
class Images(Frames):
    """Images (h, w), all of the same size, made by `reduced_image`."""

    kind: ClassVar[str] = "images"
    depth: ClassVar[int] = 1

    images: tuple[Pixels, ...]

    def __post_init__(self) -> None:
        super().__post_init__()
        if len({image.shape for image in self.images}) > 1 or len(self.images) != len(self.times):
            raise ViewError(f"the layer {self.name!r} needs one image for each time, all of the same size")

    def at(self, which: NDArray[np.intp]) -> Self:
        """Return the layer with only these moments."""
        return replace(self, times=self.times[which], images=tuple(self.images[i] for i in which))

    def thinner(self) -> Self | None:
        """Return half of the moments, later half of the width in pixels."""
        if self.count > 8:
            return super().thinner()
        if not self.images or max(self.images[0].shape) < 2 * MIN_PIXELS:
            return None
        return replace(self, images=tuple(image[::2, ::2] for image in self.images))

    def data(self) -> dict[str, Any]:
        """Return width, height and the runs, encoded like those of grids: the image before the first is black."""
        height, width = self.images[0].shape if self.images else (0, 0)
        before = np.zeros(height * width, dtype=np.uint8)
        runs = []
        for image in self.images:
            runs.append(runs_of(before, image.ravel()))
            before = image.ravel()
        return {
            **self._head(),
            "width": width,
            "height": height,
            "counts": pack(np.array([len(each) for each in runs], dtype=np.int64)),
            "runs": pack_natural(np.concatenate([np.empty(0, dtype=np.int64), *(each.ravel() for each in runs)])),
        }

    def text(self) -> str:
        """Report the number and size of the images."""
        height, width = self.images[0].shape if self.images else (0, 0)
        return f"{self._counted()}, drawn with {width} x {height} pixels"
