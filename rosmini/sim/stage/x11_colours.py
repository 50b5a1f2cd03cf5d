"""Colours in Stage's files: X11's names (`rgb.txt`), mostly those of the web, and numbered greys and shades."""

from __future__ import annotations

import re

from rosmini.core.errors import Hints

DIFFERENT = {"gray": "#bebebe", "green": "#00ff00", "maroon": "#b03060", "purple": "#a020f0"}
"""X11's values of names with another value on the web; gray covers grey too."""

ONLY_X11 = {"lightgoldenrod": "#eedd82", "violetred": "#d02090", "navyblue": "#000080"}

SHADES = {"1": 255, "2": 238, "3": 205, "4": 139}
"""Brightness of the numbered shades, out of 255."""

_SHADE = re.compile(r"([a-z]+)([1-4])")
_GREY = re.compile(r"gray(\d{1,3})")


def _names() -> dict[str, str]:
    from PIL import ImageColor  # loaded late, because not every world has named colours

    web = {name: value for name, value in ImageColor.colormap.items() if isinstance(value, str)}
    return {**web, **ONLY_X11, **DIFFERENT}


def colour(name: str) -> str | None:
    """Return the colour "#rrggbb" of a name, ignoring case and spaces; None if it is unknown."""
    plain = name.lower().replace(" ", "").replace("grey", "gray")
    names = _names()
    if plain in names:
        return names[plain][:7]
    grey = _GREY.fullmatch(plain)
    if grey is not None and int(grey[1]) <= 100:
        return rgb(*([int(grey[1]) / 100] * 3))
    shade = _SHADE.fullmatch(plain)
    if shade is not None and shade[1] in names:
        full = names[shade[1]]
        parts = [int(full[i : i + 2], 16) * SHADES[shade[2]] / 255**2 for i in (1, 3, 5)]
        return rgb(*parts)
    return None


def suggestion(name: str, hint: Hints) -> str:
    """Return a hint to a colour with a similar name; `hint` limits the number of names that are looked up."""
    return hint(name.lower(), _names())


def rgb(red: float, green: float, blue: float) -> str:
    """Return the colour with these parts, each 0 to 1."""
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, part))):02x}" for part in (red, green, blue))
