"""Turn matplotlib's SVG into ours, which follows the theme of its page, is small, and is the same on every machine.

- Colours of the light palette become custom properties, so the picture turns dark with its page; black is ink and white
  is the page. Other colours may become separate custom properties, lighter on dark pages. Each colour also stays as an
  attribute, for programs that do not support custom properties. Matplotlib's colour cycle becomes the palette's.
- Numbers have two decimals [px]. Matplotlib writes six, of which the last may depend on the machine; they are
  rounded as decimal text, so that equal numbers stay equal.
- Unused ids are removed. The others (of clip paths and markers) are derived from their content, so that two pictures
  on a page share an id only if it means the same in both.
- Many equal markers state their style only once.
- Text stays text, in the fonts of the house style; matplotlib's style sheet, which would affect the page, is removed.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Collection, Iterator, Mapping
from decimal import Decimal
from types import MappingProxyType
from typing import TYPE_CHECKING

from defusedxml.ElementTree import fromstring

from rosmini.viz import style
from rosmini.viz.style import HAIRLINE, LABEL_SIZE, LIGHT
from rosmini.viz.svg import document, element, escape

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CYCLE: Mapping[str, str] = MappingProxyType(
    {
        "#1f77b4": LIGHT["blue"],
        "#ff7f0e": LIGHT["orange"],
        "#2ca02c": LIGHT["green"],
        "#d62728": LIGHT["vermilion"],
        "#9467bd": LIGHT["purple"],
        "#17becf": LIGHT["sky"],
    }
)
"""matplotlib's colours C0 to C4 and C9 and their replacements; the palette has no equivalent of the others."""

KIND = "rosmini-plot"
"""The class of these pictures, so that rules of other pictures on the page do not apply to them."""

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
_FONT = re.compile(r"(?P<weight>bold|\d00)?\s*(?P<size>[\d.]+)px")
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_PAINT = re.compile(r' (fill|stroke)="(#[0-9a-f]{6})"')
_DOT = re.compile(r"M([^A-Za-z]+)L\1(?=M|$)")
_COORDINATES = {
    "d", "x", "y", "x1", "y1", "x2", "y2", "cx", "cy", "r", "width", "height", "points", "transform",
    "stroke-width", "stroke-dasharray", "stroke-dashoffset", "stroke-miterlimit", "font-size", "opacity",
}  # fmt: skip
_DROPPED = {"font-family", "id", "type"}
_DEFAULTS = {
    "stroke-dashoffset": "0", "stroke-linecap": "butt", "stroke-linejoin": "round", "text-anchor": "start",
    "stroke-width": "1", "opacity": "1", "fill-opacity": "1", "stroke-opacity": "1",
}  # fmt: skip
_OURS = {"#000000": style.LIGHT["ink"], "#ffffff": style.LIGHT["page"], **CYCLE}
_MANY = 100
"""Minimum number of uses of one marker that share the attributes of its style."""


def themed_svg(
    svg: str, *, title: str, alt: str, adapt: bool = False, under: str = "", steady: Collection[str] = ()
) -> str:
    """Rewrite an SVG that matplotlib wrote with `svg.fonttype` "none". A point of the figure becomes a CSS pixel.

    With `adapt`, colours outside the palette are lighter on dark pages; otherwise they do not change. `under` are
    elements below all others; `steady` are the colours of the palette that do not change with the page.
    """
    root = fromstring(svg[svg.index("<svg") :])
    names = _new_names(root)
    body = "".join(_written(child, names) for child in root)
    colours = [name for name, value in style.LIGHT.items() if f'="{value}"' in body]
    css = "".join(
        f'.{KIND} [{paint}="{style.LIGHT[name]}"]{{{paint}:{style.variable(name)}}}'
        for name in colours
        for paint in ("fill", "stroke")
        if f' {paint}="{style.LIGHT[name]}"' in body
    )
    painted = set(_PAINT.findall(body)) if adapt else set()
    others = sorted({colour for _, colour in painted} - set(style.LIGHT.values()))
    css += "".join(
        f'.{KIND} [{paint}="{colour}"]{{{paint}:var(--rosmini-{colour[1:]}, {colour})}}'
        for paint, colour in sorted(painted)
        if colour in others
    )
    width, height = (float(side) for side in root.attrib["viewBox"].split()[2:])
    light = style.declarations(style.LIGHT, list(steady)) if steady else None
    drawn = element("g", under + body, stroke_linejoin="round", style=light)
    return document(
        drawn, width=width, height=height, title=title, alt=alt, css=css, colours=colours, kind=KIND, others=others
    )


def _written(node: Element, names: dict[str, str], parent: str = "") -> str:
    """Return an element with its contents; groups without attributes are replaced by their contents."""
    tag = node.tag.rpartition("}")[2]
    if tag in ("metadata", "style"):
        return ""
    inner = escape(node.text or "") if tag in ("text", "tspan") else ""
    inner += _markers(node, names) or "".join(
        _written(child, names, tag) + (escape(child.tail or "") if inner else "") for child in node
    )
    attributes = dict(_attributes(node, tag, names))
    if tag == "path" and parent == "defs":
        # each use of a marker has its own colours, and rules do not reach the content of a use
        return element(tag, id=attributes["id"], d=attributes["d"]) if "id" in attributes else ""
    unseen = attributes.get("fill") == "none" and "stroke" not in attributes
    if (tag == "path" and unseen) or (tag in ("g", "defs") and not inner):
        return ""
    if tag == "g" and not attributes:
        return inner
    return element(tag, inner, **attributes)


def _markers(node: Element, names: dict[str, str]) -> str:
    """Return a group of many equal markers with their style stated once; empty for other groups."""
    uses = [dict(_attributes(child, "use", names)) for child in node if child.tag.rpartition("}")[2] == "use"]
    looks = {tuple((name, value) for name, value in use.items() if name not in ("href", "x", "y")) for use in uses}
    if len(uses) < _MANY or len(uses) < len(node) or len(looks) > 1:
        return ""
    places = (element("use", href=use["href"], x=use.get("x", "0"), y=use.get("y", "0")) for use in uses)
    return element("g", "".join(places), **dict(looks.pop()))


def _attributes(node: Element, tag: str, names: dict[str, str]) -> Iterator[tuple[str, str]]:
    if node.get("id") in names:
        yield "id", names[node.attrib["id"]]
    given = {name.rpartition("}")[2]: value for name, value in node.attrib.items() if name != "style"}
    for declaration in filter(None, (part.strip() for part in node.get("style", "").split(";"))):
        name, _, value = declaration.partition(":")
        given[name.strip()] = value.strip()
    if tag == "text":
        given.setdefault("fill", style.LIGHT["ink"])
        if font := _FONT.match(given.pop("font", "")):  # matplotlib before about 3.10 writes one attribute
            given["font-size"] = font["size"]
            given |= {"font-weight": font["weight"]} if font["weight"] else {}
            given |= {name: given.pop(name) for name in ("text-anchor", "fill") if name in given}  # the same order
    for name, value in given.items():
        if name in _DROPPED or _DEFAULTS.get(name) == value:
            continue
        if name == "transform" and value.startswith("rotate(-0 "):
            continue
        value = _OURS.get(value.lower(), value)
        if name == "href" or "url(#" in value:
            value = _REFERENCE.sub(lambda found: f"url(#{names[found[1]]})", value)
            value = f"#{names[value[1:]]}" if value[1:] in names else value
        elif name in _COORDINATES:
            value = _short(value)
        yield name, value


def _short(value: str) -> str:
    """Return coordinates with at most two decimals and without unnecessary spaces."""
    value = " ".join(_NUMBER.sub(_two_decimals, value).removesuffix("px").split())
    if value[:1] != "M":
        return value
    return _DOT.sub(r"M\1h0", re.sub(r" ?([A-Za-z]) ?", r"\1", value))


def _two_decimals(found: re.Match[str]) -> str:
    text = f"{Decimal(found[0]):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _new_names(root: Element) -> dict[str, str]:
    """Return, for each id in use, an id derived from the content of its element."""
    used = {found for node in root.iter() for found in _references(node)}
    names: dict[str, str] = {}
    for node in root.iter():
        identity = node.get("id", "")
        if identity in used:
            content = _written(node, names)
            names[identity] = "rm-" + hashlib.sha256(content.encode()).hexdigest()[:10]
    return names


def _references(node: Element) -> Iterator[str]:
    for name, value in node.attrib.items():
        if name.endswith("href") and value.startswith("#"):
            yield value[1:]
        yield from _REFERENCE.findall(value)


# -- the house style for figures that readers make ---------------------------------------------------------------------

_DEFAULT_SIZES = (10.0, 12.0)
"""matplotlib's default sizes of text and titles [pt]; one point becomes one CSS pixel, and 10 px are hard to read."""


def apply_house_style(figure: Figure) -> None:
    """Give the boxed axes of a figure the house style: no box, a faint grid, our ink and sizes.

    Axes without a box (in the house style, or because the reader removed it) stay as they are, and so does text whose
    size is not matplotlib's default.
    """
    boxed = [axes for axes in figure.axes if axes.axison and _is_boxed(axes)]
    if not boxed:
        return
    figure.patch.set_visible(False)
    for axes in boxed:
        _unbox(axes)
    for each in [*figure.legends, *filter(None, (axes.get_legend() for axes in boxed))]:
        each.get_frame().set_linewidth(0.0)
    _enlarge(figure)


def _is_boxed(axes: Axes) -> bool:
    sides = [axes.spines[side] for side in ("left", "right", "bottom", "top") if side in axes.spines]
    return len(sides) == 4 and all(side.get_visible() for side in sides)


def _unbox(axes: Axes) -> None:
    axes.patch.set_visible(False)
    axes.spines[:].set_visible(False)
    axes.set_axisbelow(True)
    axes.tick_params(which="both", bottom=False, left=False, labelcolor=LIGHT["muted"], labelsize=LABEL_SIZE)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_color(LIGHT["muted"])
    if not axes.images:
        axes.grid(visible=True, color=LIGHT["group-line"], alpha=0.3, linewidth=HAIRLINE)


def _enlarge(figure: Figure) -> None:
    from matplotlib.text import Text

    for words in figure.findobj(Text):
        if isinstance(words, Text) and words.get_fontsize() in _DEFAULT_SIZES:
            words.set_fontsize(LABEL_SIZE)
