"""Colours of Stage's files: X11's names (`rgb.txt`), nearly those of the web, and numbered greys and shades."""

from __future__ import annotations

import re

from rosmini.core.errors import Hints

DIFFERENT = {"gray": "#bebebe", "green": "#00ff00", "maroon": "#b03060", "purple": "#a020f0"}
"""What X11 means by a name that means something else on the web; grey is gray."""

ONLY_X11 = {"lightgoldenrod": "#eedd82", "violetred": "#d02090", "navyblue": "#000080"}

SHADES = {"1": 255, "2": 238, "3": 205, "4": 139}
"""Of how bright a numbered shade is, of 255."""

_SHADE = re.compile(r"([a-z]+)([1-4])")
_GREY = re.compile(r"gray(\d{1,3})")


def _names() -> dict[str, str]:
    from PIL import ImageColor  # loaded late: not every world has colours by name

    web = {name: value for name, value in ImageColor.colormap.items() if isinstance(value, str)}
    return {**web, **ONLY_X11, **DIFFERENT}


def colour(name: str) -> str | None:
    """The colour "#rrggbb" of a name, in which case and spaces do not matter; None for one that is unknown."""
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
    """The words that name a colour like this one; `hint` limits how many names are looked up."""
    return hint(name.lower(), _names())


def rgb(red: float, green: float, blue: float) -> str:
    """The colour of these parts, each 0 to 1."""
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, part))):02x}" for part in (red, green, blue))
