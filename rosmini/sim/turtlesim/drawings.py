"""Drawings of turtles as filled outlines: path data for SVG and a canvas's `Path2D`.

Each is about 45 pixels long, a metre in the window, with its centre at 0, 0; it faces right, and y is down.
"""

from __future__ import annotations

from typing import NamedTuple


class Drawing(NamedTuple):
    """A turtle: its name, the colour `#rrggbb` of its shell, and its parts from bottom to top (path, colour)."""

    name: str
    colour: str
    parts: tuple[tuple[str, str], ...]


def _oval(x: float, y: float, rx: float, ry: float) -> str:
    return f"M{x - rx:g},{y:g}a{rx:g},{ry:g} 0 1,0 {2 * rx:g},0a{rx:g},{ry:g} 0 1,0 {-2 * rx:g},0Z"


def _pair(x: float, y: float, rx: float, ry: float) -> str:
    """Return two ovals, one on either side."""
    return _oval(x, -y, rx, ry) + _oval(x, y, rx, ry)


_EYES = (_pair(17.5, 2.6, 1.2, 1.2), "#1b2733")
_FEET = _pair(9, 12.5, 5, 3.6) + _pair(-9, 12.5, 5, 3.6)
_FLIPPERS = (
    "M4,-9C6,-18 12,-22 17,-21C15,-16 13,-12 11,-8ZM4,9C6,18 12,22 17,21C15,16 13,12 11,8Z"
    "M-10,-8C-14,-12 -17,-15 -20,-15C-19,-11 -17,-8 -14,-5ZM-10,8C-14,12 -17,15 -20,15C-19,11 -17,8 -14,5Z"
)
_TAIL = "M-14,-2.5L-22,0L-14,2.5Z"
_HEXAGON = "M-6,0L-3,-5.2L3,-5.2L6,0L3,5.2L-3,5.2Z"
_SPOKES = "M6,-0.6L14,-0.6L14,0.6L6,0.6ZM-14,-0.6L-6,-0.6L-6,0.6L-14,0.6Z" + "".join(
    f"M{x},{y * 5}L{x * 2.3:g},{y * 10.5}L{x * 2.3 + 1:g},{y * 10.5}L{x + 1},{y * 5}Z" for x in (-3, 3) for y in (-1, 1)
)

DRAWINGS = (
    Drawing(
        "meadow",
        "#8bb35a",
        (
            (_TAIL, "#4f7d3a"), (_FEET, "#4f7d3a"), (_oval(17, 0, 5.5, 4.8), "#5f9446"), _EYES,
            (_oval(0, 0, 15, 12), "#2f5a2a"), (_oval(0, 0, 13, 10.2), "#8bb35a"),
            (_HEXAGON, "#2f5a2a"), (_SPOKES, "#2f5a2a"),
        ),
    ),
    Drawing(
        "sea",
        "#5fc1b4",
        (
            (_FLIPPERS, "#2a7f8a"), (_TAIL, "#2a7f8a"), (_oval(17, 0, 5.5, 4.4), "#3a9aa5"), _EYES,
            ("M14,0C14,-8 6,-12 -3,-11C-11,-9 -16,-4 -17,0C-16,4 -11,9 -3,11C6,12 14,8 14,0Z", "#174f5c"),
            ("M12,0C12,-6 5,-10 -3,-9C-9,-7.5 -14,-3 -15,0C-14,3 -9,7.5 -3,9C5,10 12,6 12,0Z", "#5fc1b4"),
            ("M9,-1L-13,-0.6L-13,0.6L9,1Z", "#174f5c"),
            ("M5,-9L6.4,-9L3,0L6.4,9L5,9L1.5,0ZM-4,-9.2L-2.6,-9.2L-5,0L-2.6,9.2L-4,9.2L-6.4,0Z", "#174f5c"),
        ),
    ),
    Drawing(
        "sand",
        "#e0bf83",
        (
            (_TAIL, "#b98a4a"), (_FEET, "#b98a4a"), (_oval(17, 0, 5, 4.6), "#cfa364"), _EYES,
            (_oval(0, 0, 15.5, 12.5), "#7a5326"), (_oval(0, 0, 13.5, 10.7), "#e0bf83"),
            (_oval(0, 0, 9.5, 7.5), "#7a5326"), (_oval(0, 0, 8, 6.1), "#d2a45c"),
            (_oval(0, 0, 4, 3), "#7a5326"), (_oval(0, 0, 2.6, 1.8), "#f0dcb2"),
        ),
    ),
    Drawing(
        "berry",
        "#c2456e",
        (
            (_TAIL, "#7d6a2f"), (_FEET, "#7d6a2f"), (_oval(17, 0, 5.5, 4.8), "#9a8440"), _EYES,
            (_oval(0, 0, 15, 12), "#6b1f3f"), (_oval(0, 0, 13.2, 10.4), "#c2456e"),
            (_pair(5, 4.6, 2.2, 2.2) + _pair(-5, 4.6, 2.2, 2.2) + _oval(0, 0, 2.4, 2.4), "#f6c9d6"),
            (_oval(10, 0, 1.6, 1.6) + _oval(-10, 0, 1.6, 1.6), "#f6c9d6"),
        ),
    ),
    Drawing(
        "robot",
        "#c8d1d9",
        (
            ("M-14,-15L-3,-15L-3,-10L-14,-10ZM3,-15L14,-15L14,-10L3,-10Z", "#2b333b"),
            ("M-14,10L-3,10L-3,15L-14,15ZM3,10L14,10L14,15L3,15Z", "#2b333b"),
            ("M12,-5L20,-4.4L22,0L20,4.4L12,5Z", "#8896a3"),
            (_pair(18.5, 2.4, 1.5, 1.5), "#d97f00"),
            ("M-15,-8L-10,-12L10,-12L15,-8L15,8L10,12L-10,12L-15,8Z", "#46525e"),
            ("M-12.5,-7L-9,-10L9,-10L12.5,-7L12.5,7L9,10L-9,10L-12.5,7Z", "#c8d1d9"),
            (_oval(0, 0, 5, 5), "#46525e"), (_oval(0, 0, 3.4, 3.4), "#56b4e9"),
            ("M-0.5,-16L0.5,-16L0.5,-12L-0.5,-12Z" + _oval(0, -16.5, 1.5, 1.5), "#46525e"),
        ),
    ),
)  # fmt: skip
"""All drawings. The drawing of a turtle is chosen at random with the graph's seed."""
