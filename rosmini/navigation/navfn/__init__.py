"""navfn: a potential over the costmap, and a path that descends its gradient (http://wiki.ros.org/navfn)."""

from __future__ import annotations

from .by_hand import HandSearch
from .search import NavfnSearch, Search, show_steps
from .wave import HIGH

__all__ = ["HIGH", "HandSearch", "NavfnSearch", "Search", "show_steps"]
