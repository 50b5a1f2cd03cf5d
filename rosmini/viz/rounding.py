"""Numbers that are the same on every machine, for texts and pictures that the notebook tests compare byte by byte.

Sines, exponentials and sums may differ in their last bit between machines. A plain `round` makes this visible if a
value lies on a rounding boundary, and values that people choose often do: 0.125 m is 0.12 or 0.13. The functions here
have their boundaries elsewhere, where values fall only by chance.
"""

from __future__ import annotations

import math
from decimal import ROUND_HALF_UP, Decimal
from typing import TYPE_CHECKING

from rosmini.core.lazy import np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

MILLIMETRE = 1e-3
"""Resolution to which pictures of a world are rounded [m]: at most a tenth of a pixel."""


def fixed(value: float, digits: int) -> str:
    """Return `value` with this number of decimals: half rounded away from zero, and no negative zero.

    >>> fixed(0.125 - 1e-15, 2), fixed(-0.0001, 2)
    ('0.13', '0.00')
    """
    exact = Decimal(f"{value:.{digits + 6}f}")
    text = f"{exact.quantize(Decimal(1).scaleb(-digits), rounding=ROUND_HALF_UP):f}"
    return text.removeprefix("-") if not text.strip("-0.") else text


def degrees(angle: float, digits: int = 1) -> str:
    """Return an angle [rad] in degrees, in (-180, 180].

    >>> degrees(-3.141592653589793), degrees(7.0, 0)
    ('180.0', '41')
    """
    text = fixed(math.degrees(angle) % 360.0, digits)
    return text if float(text) <= 180 else fixed(float(text) - 360.0, digits)


def snap(values: ArrayLike, quantum: float = MILLIMETRE) -> NDArray[np.float64]:
    """Return `values` rounded to multiples of `quantum`; the rounding boundaries are slightly off the halves."""
    return np.floor(np.asarray(values, dtype=float) / quantum + 0.5371) * quantum + 0.0


def points_to_keep(points: NDArray[np.float64], tolerance: float) -> list[int]:
    """Return the points of a line (n, 2) that suffice to draw it: no other point is further away than `tolerance`.

    The ends are always included; see `rosmini.core.geometry.polygons.simplified_indices`.
    """
    from rosmini.core.geometry.polygons import simplified_indices

    x, y = (np.ascontiguousarray(column) for column in points.T)

    def gaps(first: int, last: int) -> NDArray[np.float64]:
        dx, dy = x[first + 1 : last] - x[first], y[first + 1 : last] - y[first]
        chord_x, chord_y = x[last] - x[first], y[last] - y[first]
        length = chord_x * chord_x + chord_y * chord_y
        if length:
            along = np.minimum(np.maximum((dx * chord_x + dy * chord_y) / length, 0.0), 1.0)
            dx, dy = dx - along * chord_x, dy - along * chord_y
        return np.asarray(np.hypot(dx, dy))

    return simplified_indices([0, len(points) - 1], gaps, tolerance)
