"""Costs of frontiers, which determine where to drive next.

The formula is that of explore_lite: `potential_scale * distance * resolution - gain_scale * size * resolution`, with
the distance in metres and the size in cells. So the size in metres is weighed against the distance in metres times
the cell size: at the usual 0.05 m and a potential_scale of 3, a metre of distance counts as much as 0.15 m of size.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosmini.navigation.frontier_exploration.search import Frontier


@dataclass(frozen=True)
class Weights:
    """The weights of a frontier's distance and size, and its minimum size."""

    potential: float
    gain: float
    min_size: float
    """Minimum size [m]."""

    def cost(self, frontier: Frontier, resolution: float) -> float:
        """Return the cost of a frontier on a map with this cell size [m]; lower is better."""
        distance_cost = self.potential * frontier.min_distance * resolution
        return distance_cost - self.gain * frontier.size * resolution


def ranked(frontiers: Sequence[Frontier], weights: Weights, resolution: float) -> list[tuple[float, Frontier]]:
    """Return the cost and the frontier of each one with at least the minimum size, cheapest first."""
    large = [one for one in frontiers if one.size * resolution >= weights.min_size]
    return sorted(((weights.cost(one, resolution), one) for one in large), key=lambda pair: pair[0])
