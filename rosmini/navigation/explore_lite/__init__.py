"""Exploration by frontiers, greedily, on the map alone (http://wiki.ros.org/explore_lite).

`costs` says which frontier is the cheapest; the node keeps a map, and sends goals to move_base. Frontiers are found by
`rosmini.navigation.frontier_exploration.search`, as the original shares its search with that package.
"""

from __future__ import annotations

from .costs import Weights, ranked

__all__ = ["Weights", "ranked"]
