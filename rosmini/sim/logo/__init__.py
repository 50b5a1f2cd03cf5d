"""Logo: a small Logo that drives turtles on paper, in turtlesim and on the floor.

>>> from rosmini.sim.logo import Logo
>>> Logo().run("print sentence [7 * 6 is] 7 * 6")
7 * 6 is 42

`reader` turns a program's text into expressions, and `interpreter` walks these. The primitives are in `words`, the
turtles in `turtles`.
"""

from __future__ import annotations

from .interpreter import Logo
from .values import LogoError, LogoStopped
from .words import Limits

__all__ = ["Limits", "Logo", "LogoError", "LogoStopped"]
