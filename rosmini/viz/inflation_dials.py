"""A costmap whose inflation is turned in the page: radius, scaling and the robot's size, and what the costs become."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d.costmap import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D
from rosmini.navigation.costmap_2d.inflation import cell_distance, cost_table, inflate
from rosmini.navigation.costmap_2d.layer import Window
from rosmini.viz.costmap_pictures import cells_of, costmap_picture, published, shares
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_colours import colours_of
from rosmini.viz.moving_view import MovingView
from rosmini.viz.view import ViewError

LARGEST = 400
"""So many cells a side are in a page, at most."""
CONTROLS = 250
"""The height of the dials and the curve, about [px]."""


def inflation_dials(
    grid: Costmap2D,
    *,
    inscribed_radius: float = 0.105,
    inflation_radius: float = 0.55,
    cost_scaling_factor: float = 10.0,
    window: Sequence[int] | None = None,
    title: str | None = None,
) -> InflationDials:
    """Show the obstacles of a costmap, and around them what inflation by the numbers beside it makes of the rest.

    Args:
        grid: the costs, of which obstacles (254) and unknown cells (255) are taken, and nothing else.
        inscribed_radius: of the robot [m].
        inflation_radius: up to which distance there are costs [m].
        cost_scaling_factor: how steeply they fall [1/m].
        window: show these cells only: first column, first row, and the ones behind the last.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: it is no costmap, or too large.

    """
    cells = cells_of(grid, window)
    height, width = cells.values.shape
    if max(height, width) > LARGEST:
        raise ViewError(
            f"the costmap has {width} x {height} cells: with dials, {LARGEST} a side are shown at most; give window="
        )
    kept = np.isin(cells.values, (LETHAL_OBSTACLE, NO_INFORMATION))
    base = Costmap2D.of(np.where(kept, cells.values, FREE_SPACE), cells.resolution, cells.origin[:2])
    return InflationDials(base, inscribed_radius, inflation_radius, cost_scaling_factor, title)


class InflationDials(MovingView):
    """What `inflation_dials` gives; its image shows the costs by the numbers that were given."""

    scripts = ("rosmini-canvas.js", "rosmini-inflation.js")
    call = "rosminiInflation.mount"
    usual_name = "inflation"

    def __init__(
        self, base: Costmap2D, inscribed: float, radius: float, scaling: float, title: str | None
    ) -> None:
        self._base, self.title = base, title
        self._inscribed, self._radius, self._scaling = inscribed, radius, scaling
        reach = cell_distance(radius, base.resolution)
        self.inflated = Costmap2D.of(base.costs, base.resolution, base.origin)
        """The costs by these numbers."""
        table = cost_table(reach, base.resolution, inscribed, scaling)
        inflate(self.inflated.costs, Window(0, 0, base.width, base.height), reach, table)
        self._picture = costmap_picture(self.inflated, name="inflation", title=title)

    @property
    def text(self) -> str:
        """The numbers, and what they make of the cells."""
        return (
            f"{self.name}: {self._base.width} x {self._base.height} cells of "
            f"{self._base.resolution:g} m\ninflation_radius {self._radius:g} m, cost_scaling_factor {self._scaling:g}, "
            f"inscribed radius {self._inscribed:g} m\n{', '.join(shares(self.inflated.costs))}"
        )

    @property
    def alt(self) -> str:
        """The same in a sentence or two."""
        _, numbers, parts = self.text.split("\n")
        return f"A costmap from above, inflated with {numbers}. Of its cells are {parts}."

    @property
    def svg(self) -> str:
        """The still picture."""
        return self._picture.svg or ""

    @property
    def height(self) -> int:
        """With the controls, about [CSS px]."""
        return round(min(WIDTH * self._base.height / self._base.width, 480)) + CONTROLS

    @property
    def data(self) -> dict[str, Any]:
        """What the page's script gets: the cells in runs, the upper row first, colours by cost, and the numbers."""
        return {
            "size": [self._base.width, self._base.height],
            "resolution": self._base.resolution,
            "origin": list(self._base.origin),
            "runs": runs(self._base.costs[::-1]),
            "colours": colours_of("costmap")[published(np.arange(256, dtype=np.uint8))].tobytes(),
            "inscribed": self._inscribed,
            "radius": self._radius,
            "scaling": self._scaling,
        }


def runs(costs: NDArray[np.uint8]) -> bytes:
    """Cells row by row as pairs of bytes: a cost, and how often it comes, 255 times at most."""
    flat = costs.ravel()
    starts = np.flatnonzero(np.r_[True, flat[1:] != flat[:-1]])
    pairs = bytearray()
    for cost, count in zip(flat[starts].tolist(), np.diff(np.r_[starts, flat.size]).tolist(), strict=True):
        whole, rest = divmod(count, 255)
        pairs += bytes((cost, 255)) * whole + (bytes((cost, rest)) if rest else b"")
    return bytes(pairs)
