"""What goes wrong with expressions."""

from __future__ import annotations

from rosmini.errors import RosminiError

__all__ = ["ExpressionError", "NotAllowed", "cut"]

SHOWN = 60
"""So many characters of an expression an error quotes."""


class ExpressionError(RosminiError):
    """An expression is not one, or it failed; ``__cause__`` is what Python said."""

    has_spot = False
    """Whether the message names the part of the expression already."""


class NotAllowed(ExpressionError):
    """An expression uses what a confined one may not use, or would cost more than it may."""


def cut(text: str) -> str:
    """A text, cut if it is long."""
    return text if len(text) <= SHOWN else text[: SHOWN - 3] + "..."
