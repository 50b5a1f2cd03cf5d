"""Logo: a small, complete Logo that drives turtles, on paper, in turtlesim and on the floor.

>>> from rosmini.logo import Logo
>>> Logo().run("print sentence [7 * 6 is] 7 * 6")
7 * 6 is 42

A program's text becomes lines of words and lists (`reader`), these become instructions (`compiler`), which a machine
without recursion runs (`machine`). What it drives is a `Flock` of turtles (`turtles`). The words are in `primitives`.
"""

from __future__ import annotations

from .errors import LogoError, LogoStopped
from .interpreter import Logo
from .machine import Limits
from .turtles import Flock, Paper, Turtle

__all__ = ["Flock", "Limits", "Logo", "LogoError", "LogoStopped", "Paper", "Turtle"]
