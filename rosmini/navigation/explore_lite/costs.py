"""Which frontier is worth the way: costs of frontiers, and a list of those that were given up.

The formula is that of explore_lite: `potential_scale * distance * resolution - gain_scale * size * resolution`, with
the distance in metres and the size in cells. So the size in metres is weighed against the distance in metres times the
side of a cell: at the usual 0.05 m a potential_scale of 3 weighs a metre of way as much as 0.15 m of frontier.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rosmini.navigation.frontier_exploration import Frontier

Point = tuple[float, float]

TOLERANCE = 5
"""Goals nearer than so many cells, along both axes, to one that was given up count as given up."""


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


@dataclass
class Blacklist:
    """Goals that were given up [m]."""

    points: list[Point] = field(default_factory=list)

    def has(self, point: Point, resolution: float) -> bool:
        """Whether a point is next to one of them."""
        reach = TOLERANCE * resolution
        return any(abs(point[0] - x) < reach and abs(point[1] - y) < reach for x, y in self.points)
