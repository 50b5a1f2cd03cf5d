"""Drawings that chapters show; `assets/generate/drawings` makes the files."""

from __future__ import annotations

from html import unescape
from pathlib import Path

from rosmini.core.errors import RosminiError
from rosmini.viz.view import Picture

FOLDER = Path(__file__).parent


def drawing(name: str) -> Picture:
    """Return a drawing of the book, such as `drawing("rviz_window")`.

    Raises:
        RosminiError: there is no such drawing.

    """
    files = {path.stem: path for path in FOLDER.glob("*.svg")}
    if name not in files:
        raise RosminiError(f"there is no drawing {name!r}. There are {', '.join(sorted(files))}.")
    svg = files[name].read_text(encoding="utf-8").strip()
    alt = unescape(svg.partition("<desc>")[2].partition("</desc>")[0])
    return Picture(svg, text=alt, alt=alt)
