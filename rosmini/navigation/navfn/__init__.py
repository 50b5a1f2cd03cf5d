"""navfn: a potential over the costmap, and a path that descends its gradient (http://wiki.ros.org/navfn)."""

from __future__ import annotations

from .search import NavfnSearch, Search
from .wave import HIGH

__all__ = ["HIGH", "NavfnSearch", "Search"]
