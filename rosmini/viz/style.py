"""The house style: one palette for light and dark, one font stack, a few line widths.

The hues are those of Okabe and Ito, "Color Universal Design" (2008), distinguishable with every kind of colour vision
and in print; each is paired with a fill that keeps the contrast of text on it above 4.5:1. Pictures name colours by
CSS custom properties (`--rosmini-ink`), with the light colour as fallback, so they follow the theme of the page.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from colorsys import hls_to_rgb, rgb_to_hls
from types import MappingProxyType

FONT = '"Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif'
"""Fonts that are present on every system; none is downloaded."""

TEXT_SIZE = 13.0
LABEL_SIZE = 12.0
LINE_WIDTH = 1.4
HAIRLINE = 1.0

LIGHT: Mapping[str, str] = MappingProxyType(
    {
        "page": "#ffffff",
        "ink": "#1b2733",
        "muted": "#56636f",
        "line": "#5b6875",
        "node-fill": "#e3effa",
        "node-line": "#0067a8",
        "topic-fill": "#fdf3dc",
        "topic-line": "#a66d00",
        "group-fill": "#f4f6f8",
        "group-line": "#9aa5af",
        "label": "#7a4f00",
        "bad-fill": "#fdeae3",
        "bad-line": "#c04a00",
        "blue": "#0072b2",
        "orange": "#d97f00",
        "green": "#00865f",
        "vermilion": "#d55e00",
        "purple": "#b85c93",
        "sky": "#3a9bd9",
    }
)
DARK: Mapping[str, str] = MappingProxyType(
    {
        "page": "#14181e",
        "ink": "#e8edf2",
        "muted": "#a3afba",
        "line": "#93a1ae",
        "node-fill": "#16324a",
        "node-line": "#56b4e9",
        "topic-fill": "#3a2f14",
        "topic-line": "#e6b24a",
        "group-fill": "#1c222a",
        "group-line": "#5c6a77",
        "label": "#f0c566",
        "bad-fill": "#47241a",
        "bad-line": "#ff8f5c",
        "blue": "#56b4e9",
        "orange": "#e69f00",
        "green": "#2fc79a",
        "vermilion": "#ff8f5c",
        "purple": "#dd9dc0",
        "sky": "#8fd0f5",
    }
)
PRINT: Mapping[str, str] = MappingProxyType(
    {
        "blue": "#00263c",
        "vermilion": "#5f2a00",
        "green": "#005b41",
        "purple": "#9f457b",
        "orange": "#b56a00",
        "sky": "#399ad9",
    }
)
"""On paper the colours of lines have the same hues, but in steps of lightness (9 of CIE L*, 14 to 61), so that they
can also be distinguished without colour. The others are those of a light page."""
DARK_PAGES = (
    'html[data-theme="dark"]',  # the book (pydata and sphinx-book themes)
    'body[data-jp-theme-light="false"]',  # JupyterLab
    "body.vscode-dark",  # notebooks in Visual Studio Code
)


def variable(name: str) -> str:
    """Return the CSS value for a colour of the palette: `var(--rosmini-ink, #1b2733)`.

    Raises:
        KeyError: the palette has no such colour.

    """
    return f"var(--rosmini-{name}, {LIGHT[name]})"


def declarations(palette: Mapping[str, str], names: list[str] | None = None) -> str:
    """Return the custom properties of a palette, for use inside a rule; all of them, or the named ones."""
    return "".join(f"--rosmini-{name}:{palette[name]};" for name in names or palette)


def dark_of(colour: str) -> str:
    """Return the variant for dark pages of a colour `#rrggbb` outside the palette: the same hue, but bright enough."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    hue, lightness, saturation = rgb_to_hls(red, green, blue)
    lighter = hls_to_rgb(hue, max(lightness, 0.40 + 0.45 * lightness), saturation)
    return "#" + "".join(f"{round(255 * part):02x}" for part in lighter)


def hex_colour(parts: Iterable[int]) -> str:
    """Return red, green and blue, or with alpha, from 0 to 255, as `#rrggbb` or `#rrggbbaa`."""
    return "#" + "".join(f"{part:02x}" for part in parts)


def themed(selector: str, names: list[str], others: Iterable[str] = ()) -> str:
    """Return rules for the dark palette on dark pages, and for the background of a picture opened by itself.

    `others` are colours `#rrggbb` outside the palette that also become custom properties: `--rosmini-rrggbb`.

    `svg:root` matches only if the SVG is the document, so that the reader's system preference applies there, and on a
    page the page's own switch does.
    """
    dark = ",".join(f"{page} {selector}" for page in DARK_PAGES)
    dark_colours = declarations(DARK, names) + "".join(
        f"--rosmini-{colour[1:]}:{dark_of(colour)};" for colour in others
    )
    return (
        f"@media not print{{{dark}{{{dark_colours}}}}}"
        f"svg:root{{background:{LIGHT['page']}}}"
        f"@media screen and (prefers-color-scheme:dark){{"
        f"svg:root{{background:{DARK['page']};{dark_colours}}}}}"
    )
