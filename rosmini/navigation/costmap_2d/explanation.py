"""The cost of a cell, explained layer by layer."""

from __future__ import annotations

from collections.abc import Mapping

from .costmap import (
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    Costmap2D,
)

MEANINGS = {
    FREE_SPACE: "free",
    INSCRIBED_INFLATED_OBSTACLE: "in collision whatever the heading",
    LETHAL_OBSTACLE: "an obstacle",
    NO_INFORMATION: "unknown",
}


class CellCosts(dict[str, int | None]):
    """The cost of a cell in each layer, keyed by layer name, lowest first; None if the layer sets no cost.

    As text, one line describes the cell and one line each layer.
    """

    def __init__(
        self, grid: Costmap2D, mx: int, my: int, explanations: Mapping[str, tuple[int | None, str]]
    ) -> None:
        super().__init__({name: cost for name, (cost, _) in explanations.items()})
        self.cost = grid.cost(mx, my)
        """The cell's cost in the master grid."""
        self.cell = (mx, my)
        self.point = grid.map_to_world(mx, my)
        self._texts = {name: text for name, (_, text) in explanations.items()}

    def __str__(self) -> str:
        meaning = MEANINGS.get(self.cost, "near something")
        lines = [
            f"cell {self.cell} at ({self.point[0]:.2f}, {self.point[1]:.2f}) m costs {self.cost}: {meaning}"
        ]
        for name, cost in self.items():
            text = self._texts[name]
            shown = "nothing" if cost is None else str(cost)
            lines.append(f"  {name}: {shown}{f' ({text})' if text else ''}")
        return "\n".join(lines)
