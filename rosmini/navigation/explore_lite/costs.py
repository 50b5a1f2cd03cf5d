"""Which frontier is worth the way: costs of frontiers.

The formula is that of explore_lite: `potential_scale * distance * resolution - gain_scale * size * resolution`, with
the distance in metres and the size in cells. So the size in metres is weighed against the distance in metres times the
side of a cell: at the usual 0.05 m a potential_scale of 3 weighs a metre of way as much as 0.15 m of frontier.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosmini.navigation.frontier_exploration import Frontier


@dataclass(frozen=True)
class Weights:
    """What a frontier's distance and size count for, and how large it has to be."""

    potential: float
    gain: float
    min_size: float
    """[m]"""

    def cost(self, frontier: Frontier, resolution: float) -> float:
        """Of a frontier on a map whose cells have this side [m]; the less the better."""
        way = self.potential * frontier.min_distance * resolution
        return way - self.gain * frontier.size * resolution


def ranked(
    frontiers: Sequence[Frontier], weights: Weights, resolution: float
) -> list[tuple[float, Frontier]]:
    """Cost and frontier of those that are large enough, the cheapest first."""
    large = [one for one in frontiers if one.size * resolution >= weights.min_size]
    return sorted(((weights.cost(one, resolution), one) for one in large), key=lambda pair: pair[0])
