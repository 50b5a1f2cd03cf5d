"""The drawing surface of turtles: the strokes, and the image of 500 by 500 pixels for the colour sensor.

Coordinates are pixels of the window, x to the right and y down. As in Qt without antialiasing, a pixel (column, row)
is painted if its centre is in the stroke: a rectangle of the pen's width, extended by half a width at either end (a
square cap, Qt's default); a line of one pixel has one in each column, or row. Compared with real Qt 5.15, pixels
differ in one of three hundred updates, if a centre is exactly on an edge and Qt's fixed-point arithmetic rounds.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

SIZE = 500
"""The width and the height of the window [px]."""

MAX_STROKES = 400_000
"""Maximum number of strokes in memory. Beyond it the older half is in the image only."""

CENTRE = 0.5 - 2**-10
"""Centre of a pixel from its top left [px]; slightly less, to resolve ties between edges as Qt does."""

Colour = tuple[int, int, int]
"""Red, green and blue, 0 to 255."""

BACKGROUND: Colour = (0x45, 0x56, 0xFF)
"""The default background."""


@dataclass(frozen=True)
class Pen:
    """A colour and a width [px]."""

    colour: Colour = (0xB3, 0xB8, 0xFF)
    width: int = 3


class Stroke(NamedTuple):
    """A straight line [px] that the turtle `owner` drew."""

    x1: float
    y1: float
    x2: float
    y2: float
    pen: Pen
    owner: str


class Paper:
    """Strokes in order, numbered from 0 since the last clear.

    Args:
        background: its colour.

    """

    def __init__(self, background: Colour = BACKGROUND) -> None:
        self.background = background
        self.clears = 0
        """Number of clears."""
        self._wipe()

    def _wipe(self) -> None:
        self._ends = array("d")
        self._styles = array("L")
        self._pens: dict[tuple[Pen, str], int] = {}
        self._first = 0
        self._painted = 0
        self._image: bytearray | None = None

    def clear(self, background: Colour | None = None) -> None:
        """Clear the paper, with this background or the same one as before."""
        self.background = self.background if background is None else background
        self.clears += 1
        self._wipe()

    def line(self, start: tuple[float, float], end: tuple[float, float], pen: Pen, owner: str = "") -> None:
        """Draw a stroke."""
        self._ends.extend((*start, *end))
        self._styles.append(self._pens.setdefault((pen, owner), len(self._pens)))
        if len(self._styles) > MAX_STROKES:
            self._painted_image()
            forgotten = len(self._styles) // 2
            del self._ends[: 4 * forgotten], self._styles[:forgotten]
            self._first += forgotten

    @property
    def first(self) -> int:
        """The number of the oldest stroke in memory; older ones are in the image only."""
        return self._first

    @property
    def count(self) -> int:
        """Number of strokes since the last clear, which is also the number of the next one."""
        return self._first + len(self._styles)

    def strokes(self, since: int = 0) -> Iterator[Stroke]:
        """Yield the strokes from this number on."""
        styles = list(self._pens)
        for index in range(max(since - self._first, 0), len(self._styles)):
            x1, y1, x2, y2 = self._ends[4 * index : 4 * index + 4]
            yield Stroke(x1, y1, x2, y2, *styles[self._styles[index]])

    def pixel(self, x: float, y: float) -> Colour:
        """Return the colour at a point [px]; for a point outside, that of the nearest pixel."""
        column, row = (min(max(math.floor(each + 0.5), 0), SIZE - 1) for each in (x, y))
        place = 3 * (SIZE * row + column)
        red, green, blue = self._painted_image()[place : place + 3]
        return red, green, blue

    def image(self) -> bytes:
        """Return the whole drawing: red, green and blue of each pixel, row by row from the top left."""
        return bytes(self._painted_image())

    def _painted_image(self) -> bytearray:
        """Return the image after painting the strokes that are not in it yet; called only when the image is needed."""
        image = self._image
        if image is None:
            image = self._image = bytearray(self.background) * SIZE**2
        for stroke in self.strokes(self._painted):
            _paint(image, stroke)
        self._painted = self.count
        return image


def _paint(image: bytearray, stroke: Stroke) -> None:
    x, y, end_x, end_y, pen, _ = stroke
    length = math.hypot(end_x - x, end_y - y)
    if not length < math.inf:  # a teleport beyond the largest number
        return
    if max(abs(x), abs(y)) > max(abs(end_x), abs(end_y)):  # measure from the end nearer to the image
        x, y, end_x, end_y = end_x, end_y, x, y
    if pen.width == 1:
        _paint_thin(image, (x, y), (end_x, end_y), pen.colour)
        return
    along_x, along_y = ((end_x - x) / length, (end_y - y) / length) if length else (1.0, 0.0)
    half = pen.width / 2
    left, right = _span(x, end_x, half)
    for row in range(*_span(y, end_y, half)):
        dy = row + (CENTRE - y)
        # A row's painted pixels are one run. This finds it to a pixel, and the test of each pixel decides.
        ranges = (
            _solutions(along_x, -half - dy * along_y, length + half - dy * along_y),
            _solutions(-along_y, -half - dy * along_x, half - dy * along_x),
        )
        first = max(left, math.floor(max(low for low, _ in ranges) - (CENTRE - x)) - 1)
        last = min(right, math.ceil(min(high for _, high in ranges) - (CENTRE - x)) + 2)
        inside = [
            column
            for column, dx in ((column, column + (CENTRE - x)) for column in range(first, last))
            if -half <= dx * along_x + dy * along_y < length + half and -half <= dy * along_x - dx * along_y < half
        ]
        if inside:
            begin, end = SIZE * row + inside[0], SIZE * row + inside[-1] + 1
            image[3 * begin : 3 * end] = bytes(pen.colour) * (end - begin)


def _solutions(slope: float, low: float, high: float) -> tuple[float, float]:
    """Return the range of x for which `slope * x` is from `low` to `high`, cut to twice the size of the image."""
    if abs(slope) < 1e-9:
        return -2.0 * SIZE, 2.0 * SIZE
    first, second = sorted((low / slope, high / slope))
    return max(first, -2.0 * SIZE), min(second, 2.0 * SIZE)


def _paint_thin(image: bytearray, start: tuple[float, float], end: tuple[float, float], colour: Colour) -> None:
    """Paint a line of one pixel: one pixel for each column, or for each row if it is steep."""
    # Qt rounds to a 64th of a pixel
    start, end = ((math.trunc(x * 64) / 64, math.trunc(y * 64) / 64) for x, y in (start, end))
    steep = abs(end[0] - start[0]) < abs(end[1] - start[1])
    (u, v), (end_u, end_v) = sorted((start[::-1], end[::-1]) if steep else (start, end))
    slope = (end_v - v) / (end_u - u) if end_u > u else 0.0
    first, last = (math.floor(min(max(each, -1.0), float(SIZE))) for each in (u, end_u))
    for step in range(max(first, 0), min(last + 1, SIZE)):
        across = math.floor(v + (step + (0.5 if slope > 0 else 0.0) - u) * slope)
        if 0 <= across < SIZE:
            place = 3 * (SIZE * step + across if steep else SIZE * across + step)
            image[place : place + 3] = bytes(colour)


def _span(first: float, second: float, half: float) -> tuple[int, int]:
    """Return the range of columns, or of rows, that a stroke may touch."""
    reach = 1.5 * half + 1.0  # the corner of a square cap is farther out than half a width
    low, high = min(first, second) - reach, max(first, second) + reach
    return math.floor(min(max(low, 0.0), float(SIZE))), math.ceil(min(max(high + 1.0, 0.0), float(SIZE)))
