"""The cover of the PDF and of the EPUB: the logo, the title, and ten robots in a house, as on the book's first page."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING

from defusedxml.ElementTree import fromstring
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path as Outline
from matplotlib.transforms import Affine2D, Transform

from rosmini.viz.style import LIGHT

if TYPE_CHECKING:
    from pathlib import Path
    from xml.etree.ElementTree import Element

    from matplotlib.axes import Axes

ALT = "rosmini: learn ROS by driving a robot. Ten robots drive through a house, each leaves a trail in its colour."
WIDTH, HEIGHT = 210.0, 297.0
"""Of the cover [mm]."""
POINTS = 72 / 25.4
"""In a millimetre."""
SCALE = 0.66
"""Millimetres in a pixel of the film."""
LEFT, TOP = 40.0, 78.0
"""Place of the house [mm]."""
TOKEN = re.compile(r"[MLHZ]|-?[\d.]+")


def draw_cover(static: Path, kind: str) -> bytes:
    """Draw the cover as "png" (1,240 by 1,753 pixels) or "svg"; `static` is the folder `_static` of the built book."""
    figure = Figure(figsize=(WIDTH / 25.4, HEIGHT / 25.4), facecolor=LIGHT["page"])
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, WIDTH), ylim=(HEIGHT, 0))
    axes.set_axis_off()
    _draw(axes, static / "logo-light.svg", 0.6, Affine2D().scale(0.6).translate(LEFT - 2, 23))
    turned = Affine2D().rotate_deg(90).translate(200, 0)
    _draw(axes, static / "films" / "ten.svg", SCALE, turned.scale(SCALE).translate(LEFT, TOP))
    axes.text(LEFT + 42, 44, "rosmini", size=54, weight="bold", color=LIGHT["ink"], va="baseline")
    axes.text(LEFT + 43, 57, "Learn ROS by driving a robot", size=16, color=LIGHT["muted"], va="baseline")
    file = io.BytesIO()
    figure.savefig(file, format=kind, dpi=150, metadata={"Software" if kind == "png" else "Date": None})
    return file.getvalue()


def _draw(axes: Axes, file: Path, scale: float, place: Affine2D) -> None:
    """Draw one of our SVG files, whose pixels are `scale` mm; it has groups, circles and straight lines."""

    def visit(tag: Element, given: dict[str, str], place: Transform) -> None:
        given = given | tag.attrib
        if moved := re.search(r"translate\(([-\d.]+)px,([-\d.]+)px\) rotate\(([-\d.]+)deg\)", tag.get("style", "")):
            x, y, degrees = map(float, moved.groups())
            place = Affine2D().rotate_deg(degrees).translate(x, y) + place
        kind = tag.tag.rpartition("}")[2]
        if kind in {"circle", "path"}:
            x, y = (float(tag.get(name, "0")) for name in ("cx", "cy"))
            shape = (
                Circle((x, y), float(tag.get("r", "0"))) if kind == "circle" else PathPatch(_outline(tag.get("d", "")))
            )
            fill, stroke = (_colour(given.get(name)) for name in ("fill", "stroke"))
            shape.set(facecolor=fill, edgecolor=stroke, alpha=float(given.get("opacity", "1")), capstyle="round")
            shape.set(linewidth=float(given.get("stroke-width", "1")) * scale * POINTS if stroke != "none" else 0)
            if "pathLength" not in given and (dashes := given.get("stroke-dasharray")):
                shape.set_linestyle((0, [float(each) / float(given["stroke-width"]) for each in dashes.split()]))
            shape.set_transform(place + axes.transData)
            axes.add_patch(shape)
        for child in tag:
            visit(child, given, place)

    visit(fromstring(file.read_text(encoding="utf-8")), {"fill": "#000000"}, place)


def _outline(data: str) -> Outline:
    """Return the path of a `d` of M, L, H and Z, in which a further point is a line to it."""
    points: list[tuple[float, float]] = []
    codes = []
    tokens = TOKEN.findall(data)
    command = "M"
    while tokens:
        if tokens[0].isalpha():
            command = tokens.pop(0)
        if command == "Z":
            points.append((0.0, 0.0))
            codes.append(Outline.CLOSEPOLY)
            continue
        x = float(tokens.pop(0))
        points.append((x, points[-1][1] if command == "H" else float(tokens.pop(0))))
        codes.append(Outline.MOVETO if command == "M" else Outline.LINETO)
        command = "L"
    return Outline(points, codes)


def _colour(paint: str | None) -> str:
    """Return a colour of matplotlib for a paint of SVG: that of the light theme."""
    named = re.match(r"var\(--\w+-([\w-]+)\)", paint or "none")
    return LIGHT[named[1]] if named else paint or "none"
