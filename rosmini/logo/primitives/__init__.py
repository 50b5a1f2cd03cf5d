"""Logo's own words: one row each, with its inputs, its short forms and what it does, in tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .arithmetic import ARITHMETIC
from .control import CONTROL
from .data import DATA
from .drawing import DRAWING
from .templates import TEMPLATES

if TYPE_CHECKING:
    from rosmini.logo.compiler import Primitive

TABLES: dict[str, tuple[Primitive, ...]] = {
    "turtles": DRAWING,
    "control": (*CONTROL, *TEMPLATES),
    "words and lists": DATA,
    "arithmetic": ARITHMETIC,
}
"""All words, as a manual has them."""

PRIMITIVES: dict[str, Primitive] = {
    name: primitive
    for table in TABLES.values()
    for primitive in table
    for name in (primitive.name, *primitive.short)
}
"""All words, by all their names."""

__all__ = ["PRIMITIVES", "TABLES"]
