"""A grid of costs: arrays, and where they lie in the world.

| cost | name | what it means for the robot's centre |
|---|---|---|
| 0 | `FREE_SPACE` | as good as can be |
| 1 to 252 | | nearer to something, and for some headings in collision, if the footprint is not round |
| 253 | `INSCRIBED_INFLATED_OBSTACLE` | in collision whatever the heading |
| 254 | `LETHAL_OBSTACLE` | in an obstacle |
| 255 | `NO_INFORMATION` | unknown |

The values are those of http://wiki.ros.org/costmap_2d#Inflation.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.errors import RosminiError

FREE_SPACE = 0
INSCRIBED_INFLATED_OBSTACLE = 253
LETHAL_OBSTACLE = 254
NO_INFORMATION = 255

Costs = NDArray[np.uint8]
Ints = NDArray[np.int64]

LARGEST = 100_000_000
"""Cells of a costmap: a map of 10,000 x 10,000."""


class CostmapError(RosminiError, ValueError):
    """A costmap cannot be made as asked for; the message names the number or the parameter at fault."""


def shifted(cells: NDArray[Any], dx: int, dy: int, default: int) -> NDArray[Any]:
    """Cells (h, w) seen through a window that has moved by whole cells; what comes into it is `default`."""
    moved = np.full_like(cells, default)
    height, width = cells.shape
    if abs(dx) < width and abs(dy) < height:
        moved[max(0, -dy) : height - max(0, dy), max(0, -dx) : width - max(0, dx)] = cells[
            max(0, dy) : height - max(0, -dy), max(0, dx) : width - max(0, -dx)
        ]
    return moved


class Costmap2D:
    """Costs (h, w) of square cells; row 0 is at the bottom, column 0 at the left.

    `origin` (x, y) [m] is the lower left corner of cell (0, 0) in the costmap's frame. Cells are named (mx, my), column
    first, as in ROS; arrays are indexed [my, mx].
    """

    def __init__(
        self,
        width: int,
        height: int,
        resolution: float,
        origin: tuple[float, float] = (0.0, 0.0),
        default: int = FREE_SPACE,
    ) -> None:
        """Make one with all cells at cost `default`. Raises `CostmapError` for numbers that make no grid."""
        if not (math.isfinite(resolution) and resolution > 0):
            raise CostmapError(
                f"the resolution is {resolution}: it has to be the side of a cell in metres, above 0"
            )
        if width < 0 or height < 0 or width * height > LARGEST:
            raise CostmapError(
                f"a costmap of {width} x {height} cells: sides have to be 0 or more, and no more than {LARGEST:,} "
                "cells in all; take a coarser resolution or a smaller window"
            )
        if not all(map(math.isfinite, origin)):
            raise CostmapError(
                f"the origin of a costmap is {origin}: it has to be two finite numbers, in metres"
            )
        self.costs: Costs = np.full((height, width), default, dtype=np.uint8)
        self.resolution = float(resolution)
        self.origin = (float(origin[0]), float(origin[1]))
        self.default = default

    @classmethod
    def of(
        cls, costs: ArrayLike, resolution: float = 1.0, origin: tuple[float, float] = (0.0, 0.0)
    ) -> Costmap2D:
        """One with these costs (h, w), which are copied."""
        array = np.array(costs, dtype=np.uint8, order="C")
        if array.ndim != 2:
            raise CostmapError(f"costs have the shape {array.shape}: they have to be a table (rows, columns)")
        made = cls(0, 0, resolution, origin)
        made.costs = array
        return made

    def resize(self, width: int, height: int, resolution: float, origin: tuple[float, float]) -> None:
        """Give it another size [cells], resolution and origin [m], with all costs at the default.

        Raises as the constructor.
        """
        made = Costmap2D(width, height, resolution, origin, self.default)
        self.costs, self.resolution, self.origin = made.costs, made.resolution, made.origin

    def __repr__(self) -> str:
        return f"<Costmap2D: {self.width} x {self.height} cells of {self.resolution:g} m at {self.origin}>"

    @property
    def width(self) -> int:
        """Columns."""
        return int(self.costs.shape[1])

    @property
    def height(self) -> int:
        """Rows."""
        return int(self.costs.shape[0])

    @property
    def size_m(self) -> tuple[float, float]:
        """Width and height [m]."""
        return self.width * self.resolution, self.height * self.resolution

    def world_to_map(self, x: float, y: float) -> tuple[int, int] | None:
        """The cell (mx, my) of a point [m], or None if it is outside."""
        mx, my = self.world_to_map_no_bounds(x, y)
        return (mx, my) if 0 <= mx < self.width and 0 <= my < self.height else None

    def world_to_map_no_bounds(self, x: float, y: float) -> tuple[int, int]:
        """The cell (mx, my) of a point [m], in the lattice that goes on beyond the grid."""
        return (
            math.floor((x - self.origin[0]) / self.resolution),
            math.floor((y - self.origin[1]) / self.resolution),
        )

    def world_to_map_clamped(self, x: float, y: float) -> tuple[int, int]:
        """The cell (mx, my) of a point [m], or the nearest cell of the grid."""
        mx, my = self.world_to_map_no_bounds(x, y)
        return min(max(mx, 0), self.width - 1), min(max(my, 0), self.height - 1)

    def map_to_world(self, mx: float, my: float) -> tuple[float, float]:
        """The middle of a cell [m]."""
        return (
            self.origin[0] + (mx + 0.5) * self.resolution,
            self.origin[1] + (my + 0.5) * self.resolution,
        )

    def cost(self, mx: int, my: int) -> int:
        """The cost of a cell. Raises `IndexError` outside."""
        if not (0 <= mx < self.width and 0 <= my < self.height):
            raise IndexError(
                f"the cell ({mx}, {my}) is outside a costmap of {self.width} x {self.height} cells"
            )
        return int(self.costs[my, mx])

    def move_origin(self, x: float, y: float) -> tuple[int, int]:
        """Move the grid over its lattice so that its corner is as near (x, y) as whole cells allow; costs stay put.

        What comes into the grid has the default cost. Returns by how many cells it moved, (columns, rows).
        """
        dx = math.floor((x - self.origin[0]) / self.resolution)
        dy = math.floor((y - self.origin[1]) / self.resolution)
        if (dx, dy) == (0, 0):
            return 0, 0
        self.costs = shifted(self.costs, dx, dy, self.default)
        self.origin = (self.origin[0] + dx * self.resolution, self.origin[1] + dy * self.resolution)
        return dx, dy

    def show(self, **options: Any) -> Any:
        """A picture of the costs from above.

        Options, with what they are unless given:
            robot=None: its pose x [m], y [m], heading [rad]
            footprint=None: the robot's outline (n, 2) [m] in its base frame
            plan=None: a path (n, 2) [m]
            goal=None: a point or pose [m]
            window=None: only these cells are shown: first column, first row, and those behind the last
            scheme="costmap": or "safe", in colours that the colour-blind can tell
            name="costmap": of what it is, for the text form
            title=None: a caption under the picture, and the first words of its text form
        """
        from rosmini.core.graph.show import show

        return show("costmap", self, **options)

    def show_inflation(self, **options: Any) -> Any:
        """Show the obstacles and inflation around them, with sliders for its three numbers in the page.

        Options, with what they are unless given:
            inscribed_radius=0.105: of the robot [m]
            inflation_radius=0.55: up to which distance there are costs [m]
            cost_scaling_factor=10.0: how steeply they fall [1/m]
            window=None: only these cells are shown: first column, first row, and those behind the last
            title=None: a caption, and the first words of its text form
        """
        from rosmini.core.graph.show import show

        return show("inflation", self, **options)
