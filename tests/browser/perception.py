"""Whether two pictures look alike: by the mean colours of their blocks, not by their pixels.

Rasterisers differ in the weight of a stroke and in the grey of an edge. What a block of 8 pixels looks like on the
whole hardly differs, so such means are compared, every 4 pixels; and each may look like any of the nine around its
place in the other picture, since letters may lie a little beside. That is asked in both directions: what is missing in
one picture is too much in the other.
"""

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Floats = NDArray[np.float64]

CELL = 4
"""The side of a cell, of which a block has four [px]."""


def cells(png):
    """The mean colours (rows, columns, 3) of the cells of a screenshot, 0 to 255; the rest at its edges is cut off."""
    with Image.open(io.BytesIO(png)) as image:
        pixels = np.asarray(image.convert("RGB"), dtype=np.float64)
    rows, columns = (side // CELL for side in pixels.shape[:2])
    whole = pixels[: rows * CELL, : columns * CELL]
    return whole.reshape(rows, CELL, columns, CELL, 3).mean(axis=(1, 3))


def difference(one, other):
    """How much each block of two pictures of one size, given by their cells, differs in its worst channel, 0 to 255."""
    ours, theirs = ((each[:-1, :-1] + each[1:, :-1] + each[:-1, 1:] + each[1:, 1:]) / 4 for each in (one, other))
    return np.maximum(_beyond(ours, theirs), _beyond(theirs, ours))


def _beyond(ours, theirs):
    """How far each block of one is from the most alike of the nine around its place in the other."""
    rows, columns = ours.shape[:2]
    padded = np.pad(theirs, ((1, 1), (1, 1), (0, 0)), mode="edge")
    around = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    return np.min([np.abs(ours - each).max(axis=2) for each in around], axis=0)


def why(one, other, tolerance):
    """In what two pictures do not look alike, or None."""
    if one.shape != other.shape:
        return f"it is {one.shape[1]} x {one.shape[0]} cells, not {other.shape[1]} x {other.shape[0]}"
    found = difference(one, other)
    if found.max() <= tolerance:
        return None
    row, column = np.unravel_index(found.argmax(), found.shape)
    count = int((found > tolerance).sum())
    place = f"({column * CELL}, {row * CELL}) px"
    return f"{count} blocks differ, that at {place} by {found.max():.1f} of 255; {tolerance:g} may be"
