"""Write SVG: elements as strings, well formed whatever a name contains, with the same bytes at each run.

There are no ids, because two pictures on one page would share them: a picture is named by `aria-label`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape as _escape

from rosmini.viz.layout.model import Point
from rosmini.viz.style import FONT, themed

_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def number(value: float) -> str:
    """Return a coordinate to a tenth of a pixel, without a trailing zero and without negative zero."""
    text = f"{value:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def clean(text: str) -> str:
    """Return `text` without the characters that XML cannot contain (control characters, lone surrogates)."""
    return _FORBIDDEN.sub(_REPLACEMENT, text)


def escape(text: str) -> str:
    """Return `text` escaped for an attribute or an element of XML or HTML."""
    return _escape(clean(text), quote=True)


def element(tag: str, content: str = "", /, **attributes: str | float | None) -> str:
    """Return an element. `content` is markup; attribute values are escaped; `class_` is class, `_` in names is `-`."""
    parts = [tag]
    for name, value in attributes.items():
        if value is None:
            continue
        text = number(value) if isinstance(value, int | float) else escape(value)
        parts.append(f'{name.rstrip("_").replace("_", "-") if name != "viewBox" else name}="{text}"')
    start = " ".join(parts)
    return f"<{start}>{content}</{tag}>" if content else f"<{start}/>"


def bezier(points: Iterable[Point]) -> str:
    """Return path data for a chain of cubic curves: a start, then two control points and an end for each."""
    start, *rest = points
    pieces = (rest[i : i + 3] for i in range(0, len(rest), 3))
    curves = ("C" + " ".join(f"{number(x)},{number(y)}" for x, y in piece) for piece in pieces)
    return f"M{number(start[0])},{number(start[1])}" + "".join(curves)


def document(
    body: str,
    *,
    width: float,
    height: float,
    title: str,
    alt: str,
    css: str,
    colours: list[str],
    kind: str = "rosmini-svg",
    others: Iterable[str] = (),
) -> str:
    """Return a complete picture, which works as a file, and inline in a page of any theme.

    `alt` is the text for screen readers; `css` may use the custom properties named in `colours`; `kind` is the class
    that the picture's rules apply to; `others` are colours outside the palette that `css` uses. Outside the book the
    picture shrinks to at least 60 per cent, so that its text stays legible, and then the figure scrolls; in the book it
    shrinks with its column.
    """
    style = f".{kind} text{{font-family:{FONT}}}{css}{themed(f'.{kind}', colours, others)}"
    least = number(min(width, max(0.6 * width, 320.0)))
    return element(
        "svg",
        element("title", escape(title)) + element("desc", escape(alt)) + f"<style>{style}</style>" + body,
        xmlns="http://www.w3.org/2000/svg",
        class_=kind,
        role="img",
        aria_label=alt,
        viewBox=f"0 0 {number(width)} {number(height)}",
        width=width,
        height=height,
        style=f"max-width:100%;min-width:{least}px;height:auto",
    )
