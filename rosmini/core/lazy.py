"""Packages that are imported when they are first used: ``from rosmini.core.lazy import np``.

The graph, its commands, turtlesim and Logo need none of them for most of their work, and they are large: a page that
runs in the browser would have to download them.
"""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import TYPE_CHECKING, Any

__all__ = ["np"]


class LazyModule(ModuleType):
    """A module that is imported when its first attribute is read. From then on it is an ordinary module."""

    def __getattr__(self, name: str) -> Any:
        vars(self).update(vars(importlib.import_module(self.__name__)))
        self.__class__ = ModuleType  # type: ignore[assignment]
        return getattr(self, name)


if TYPE_CHECKING:
    import numpy as np
else:
    np = LazyModule("numpy")
