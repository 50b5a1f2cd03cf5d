"""A grid of costs and its position in the world.

| cost | name | meaning for the robot's centre |
|---|---|---|
| 0 | `FREE_SPACE` | free |
| 1 to 252 | | near an obstacle; in collision at some headings if the footprint is not round |
| 253 | `INSCRIBED_INFLATED_OBSTACLE` | in collision at any heading |
| 254 | `LETHAL_OBSTACLE` | inside an obstacle |
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

Cell = tuple[int, int]

MAX_CELLS = 100_000_000
"""Maximum number of cells in a costmap, such as a map of 10,000 x 10,000."""


class CostmapError(RosminiError, ValueError):
    """Raised for invalid costmap dimensions or parameters; the message names the invalid value."""


def shifted(cells: NDArray[Any], dx: int, dy: int, default: int) -> NDArray[Any]:
    """Return the cells (h, w) of a window moved by (dx, dy) whole cells; cells that enter it are `default`."""
    moved = np.full_like(cells, default)
    height, width = cells.shape
    if abs(dx) < width and abs(dy) < height:
        moved[max(0, -dy) : height - max(0, dy), max(0, -dx) : width - max(0, dx)] = cells[
            max(0, dy) : height - max(0, -dy), max(0, dx) : width - max(0, -dx)
        ]
    return moved


class Costmap2D:
    """A grid (h, w) of costs in square cells; row 0 is at the bottom, column 0 on the left.

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
        """Create a grid with all cells at cost `default`. Raises `CostmapError` for invalid dimensions."""
        if not (math.isfinite(resolution) and resolution > 0):
            raise CostmapError(
                f"the resolution is {resolution}: it must be the side of a cell in metres, greater than 0"
            )
        if width < 0 or height < 0 or width * height > MAX_CELLS:
            raise CostmapError(
                f"a costmap of {width} x {height} cells: both sides must be at least 0, and the total at most "
                f"{MAX_CELLS:,} cells; use a coarser resolution or a smaller window"
            )
        if not all(map(math.isfinite, origin)):
            raise CostmapError(f"the origin of a costmap is {origin}: it must be two finite numbers, in metres")
        self.costs: Costs = np.full((height, width), default, dtype=np.uint8)
        self.resolution = float(resolution)
        self.origin = (float(origin[0]), float(origin[1]))
        self.default = default

    @classmethod
    def of(cls, costs: ArrayLike, resolution: float = 1.0, origin: tuple[float, float] = (0.0, 0.0)) -> Costmap2D:
        """Return a costmap with a copy of these costs (h, w). Raises `CostmapError` for an array of another shape."""
        array = np.array(costs, dtype=np.uint8, order="C")
        if array.ndim != 2:
            raise CostmapError(
                f"costs have the shape {array.shape}: they must be a two-dimensional array (rows, columns)"
            )
        made = cls(0, 0, resolution, origin)
        made.costs = array
        return made

    def resize(self, width: int, height: int, resolution: float, origin: tuple[float, float]) -> None:
        """Change the size [cells], resolution and origin [m], and set all costs to the default.

        Raises `CostmapError` as the constructor does.
        """
        made = Costmap2D(width, height, resolution, origin, self.default)
        self.costs, self.resolution, self.origin = made.costs, made.resolution, made.origin

    def __repr__(self) -> str:
        return f"<Costmap2D: {self.width} x {self.height} cells of {self.resolution:g} m at {self.origin}>"

    @property
    def width(self) -> int:
        """Number of columns."""
        return int(self.costs.shape[1])

    @property
    def height(self) -> int:
        """Number of rows."""
        return int(self.costs.shape[0])

    @property
    def size_m(self) -> tuple[float, float]:
        """Width and height [m]."""
        return self.width * self.resolution, self.height * self.resolution

    @property
    def geometry(self) -> tuple[int, int, float, tuple[float, float]]:
        """Width and height [cells], resolution and origin [m]."""
        return self.width, self.height, self.resolution, self.origin

    def world_to_map(self, x: float, y: float) -> tuple[int, int] | None:
        """Return the cell (mx, my) that contains a point [m], or None if the point is outside the grid."""
        mx, my = self.world_to_map_no_bounds(x, y)
        return (mx, my) if 0 <= mx < self.width and 0 <= my < self.height else None

    def world_to_map_no_bounds(self, x: float, y: float) -> tuple[int, int]:
        """Return the cell (mx, my) that contains a point [m], as if the grid continued in all directions."""
        return (math.floor((x - self.origin[0]) / self.resolution), math.floor((y - self.origin[1]) / self.resolution))

    def world_to_map_clamped(self, x: float, y: float) -> tuple[int, int]:
        """Return the cell (mx, my) that contains a point [m], or the nearest cell of the grid."""
        mx, my = self.world_to_map_no_bounds(x, y)
        return min(max(mx, 0), self.width - 1), min(max(my, 0), self.height - 1)

    def map_to_world(self, mx: float, my: float) -> tuple[float, float]:
        """Return the centre of a cell [m]."""
        return (self.origin[0] + (mx + 0.5) * self.resolution, self.origin[1] + (my + 0.5) * self.resolution)

    def cost(self, mx: int, my: int) -> int:
        """Return the cost of a cell. Raises `IndexError` if it is outside the grid."""
        if not (0 <= mx < self.width and 0 <= my < self.height):
            raise IndexError(f"the cell ({mx}, {my}) is outside a costmap of {self.width} x {self.height} cells")
        return int(self.costs[my, mx])

    def move_origin(self, x: float, y: float) -> tuple[int, int]:
        """Move the grid by whole cells so that its origin is near (x, y); costs keep their position in the world.

        Cells that enter the grid get the default cost. Returns the number of cells moved, (columns, rows).
        """
        dx = math.floor((x - self.origin[0]) / self.resolution)
        dy = math.floor((y - self.origin[1]) / self.resolution)
        if (dx, dy) == (0, 0):
            return 0, 0
        self.costs = shifted(self.costs, dx, dy, self.default)
        self.origin = (self.origin[0] + dx * self.resolution, self.origin[1] + dy * self.resolution)
        return dx, dy


def outline_spans(cells: list[Cell]) -> dict[int, Cell]:
    """Return the lowest and highest row of a polygon's outline, keyed by column; `cells` (mx, my) hold the vertices.

    The edges are Bresenham lines, as in `rosmini.navigation.costmap_2d.rays`. For so few cells Python integers are
    faster than arrays.
    """
    spans: dict[int, Cell] = {}
    for (x0, y0), (x1, y1) in zip(cells, [*cells[1:], *cells[:1]], strict=True):
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        step_x, step_y = (1 if x1 >= x0 else -1), (1 if y1 >= y0 else -1)
        longer, shorter = max(dx, dy), min(dx, dy)
        aside = longer // 2
        for step in range(longer + 1):
            off = aside // longer if longer else 0
            x, y = (step, off) if dx >= dy else (off, step)
            x, y = x0 + step_x * x, y0 + step_y * y
            low, high = spans.get(x, (y, y))
            spans[x] = min(low, y), max(high, y)
            aside += shorter
    return spans


def fill(grid: Costmap2D, polygon: ArrayLike, cost: int) -> bool:
    """Set the cost of all cells in a convex polygon (n, 2) [m], including its outline.

    Returns False, and changes nothing, if a vertex is outside the grid.
    """
    cells = [grid.world_to_map(x, y) for x, y in np.asarray(polygon, dtype=np.float64).tolist()]
    inside = [cell for cell in cells if cell is not None]
    if not cells or len(inside) < len(cells):
        return False
    for column, (low, high) in outline_spans(inside).items():
        grid.costs[low : high + 1, column] = cost
    return True
