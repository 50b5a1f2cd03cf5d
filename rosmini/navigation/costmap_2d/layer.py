"""Layers of a costmap, each of which adds what it knows (http://wiki.ros.org/costmap_2d#Layer_Specifications).

A layer of one's own is a class with a name, and the parameter `plugins` of a costmap lists it:

    class Puddles(Layer, plugin="my_pkg::Puddles"):
        def update_bounds(self, robot, bounds):
            bounds.touch(1.0, 2.0)

        def update_costs(self, grid, window):
            cell = grid.world_to_map(1.0, 2.0)
            if cell and window.has(*cell):
                grid.costs[cell[1], cell[0]] = 254
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from rosmini.core.geometry.poses import Pose
from rosmini.core.plugins import Plugin

from .costmap import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D, Costs
from .footprint import Footprint

if TYPE_CHECKING:
    from rosmini.core.graph import Node
    from rosmini.core.tf import Buffer

FAR = 1e30
"""The bounds of nothing, and of everything."""


class Window(NamedTuple):
    """A rectangle of cells: columns `x0` to `xn - 1`, rows `y0` to `yn - 1`."""

    x0: int
    y0: int
    xn: int
    yn: int

    @property
    def is_empty(self) -> bool:
        """Whether no cell is in it."""
        return self.xn <= self.x0 or self.yn <= self.y0

    def has(self, mx: int, my: int) -> bool:
        """Whether a cell is in it."""
        return self.x0 <= mx < self.xn and self.y0 <= my < self.yn

    def fits(self, grid: Costmap2D) -> bool:
        """Whether all of it is in a grid."""
        return self.x0 >= 0 and self.y0 >= 0 and self.xn <= grid.width and self.yn <= grid.height

    def of(self, costs: Costs) -> Costs:
        """The part of a grid (h, w) that is in it, as a view."""
        return costs[self.y0 : self.yn, self.x0 : self.xn]


class Bounds:
    """The rectangle [m] of the costmap's frame in which costs may have changed; empty at first."""

    def __init__(self) -> None:
        self.min_x = self.min_y = FAR
        self.max_x = self.max_y = -FAR

    def __repr__(self) -> str:
        return f"<Bounds ({self.min_x:g}, {self.min_y:g}) to ({self.max_x:g}, {self.max_y:g})>"

    @property
    def is_empty(self) -> bool:
        """Whether nothing has changed."""
        return self.max_x < self.min_x or self.max_y < self.min_y

    def touch(self, x: float, y: float) -> None:
        """Let a point [m] be in it."""
        self.min_x, self.max_x = min(self.min_x, x), max(self.max_x, x)
        self.min_y, self.max_y = min(self.min_y, y), max(self.max_y, y)

    def touch_cells(self, grid: Costmap2D, window: Window) -> None:
        """Let cells be in it."""
        if not window.is_empty:
            self.touch(*grid.map_to_world(window.x0, window.y0))
            self.touch(*grid.map_to_world(window.xn - 1, window.yn - 1))

    def touch_all(self) -> None:
        """Let everything be in it."""
        self.touch(-FAR, -FAR)
        self.touch(FAR, FAR)

    def contains(self, other: Bounds) -> bool:
        """Whether all of another rectangle is in it."""
        return other.is_empty or (
            self.min_x <= other.min_x
            and self.min_y <= other.min_y
            and self.max_x >= other.max_x
            and self.max_y >= other.max_y
        )

    def copy(self) -> Bounds:
        """The same rectangle."""
        made = Bounds()
        made.min_x, made.min_y, made.max_x, made.max_y = self.min_x, self.min_y, self.max_x, self.max_y
        return made


class Master(Protocol):
    """What a layer knows of the costmap that it is in: a `LayeredCostmap`."""

    grid: Costmap2D
    """The master grid."""
    global_frame: str
    is_rolling: bool
    """Whether the grid moves with the robot."""
    is_tracking_unknown: bool
    """Whether a cell that no layer knows is unknown, not free."""
    footprint: Footprint
    """The robot's vertices (n, 2) [m], padded."""
    inscribed_radius: float
    circumscribed_radius: float

    def resize(
        self, width: int, height: int, resolution: float, origin: tuple[float, float], *, lock: bool = False
    ) -> None:
        """Give the master grid and its layers another size [cells], resolution and origin [m]."""


class Layer(Plugin, ABC):
    """The interface of layers."""

    name: str
    """As the costmap's `plugins` call it."""
    namespace: str
    """Of its parameters and topics, with `/` at its end: `~global_costmap/static_layer/`."""
    layered: Master
    """The costmap that it is a layer of."""
    node: Node
    buffer: Buffer
    is_enabled = True
    """A layer that is not enabled is not asked for anything."""
    is_current = True
    """Whether what it knows is recent enough to drive by."""

    def initialize(self, layered: Master, name: str, namespace: str, node: Node, buffer: Buffer) -> None:
        """Learn what it belongs to; called once."""
        self.layered, self.name, self.namespace, self.node, self.buffer = (
            layered,
            name,
            namespace,
            node,
            buffer,
        )
        self.on_initialize()

    def on_initialize(self) -> None:
        """Read parameters, subscribe to topics."""

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics, with their full names, from which it learns of the world."""
        return ()

    @abstractmethod
    def update_bounds(self, robot: Pose, bounds: Bounds) -> None:
        """Let every cell that it will change be in `bounds`. `robot`: its pose in the costmap's frame."""

    @abstractmethod
    def update_costs(self, grid: Costmap2D, window: Window) -> None:
        """Write costs into the master grid, in this window only."""

    def match_size(self) -> None:
        """Learn that the master grid has another size, resolution or origin."""

    def on_footprint_changed(self) -> None:
        """Learn that the robot has another footprint."""

    def activate(self) -> None:
        """Hear of the world again."""

    def deactivate(self) -> None:
        """Hear of the world no more."""

    def reset(self) -> None:
        """Forget what was learnt of the world."""

    def explain(self, mx: int, my: int) -> tuple[int | None, str]:
        """The cost that it gives to a cell of the master grid (None: it has nothing to say), and why, in words."""
        del mx, my
        return None, ""


class CostmapLayer(Layer):
    """A layer with costs of its own, in `grid`."""

    def __init__(self) -> None:
        self.grid = Costmap2D(0, 0, 1.0, default=NO_INFORMATION)
        self._extra: Bounds | None = None

    @property
    def costs(self) -> Costs:
        """Its costs (h, w)."""
        return self.grid.costs

    def match_size(self) -> None:
        """Take over size, resolution and origin of the master grid; the costs are lost."""
        master = self.layered.grid
        self.grid.resize(master.width, master.height, master.resolution, master.origin)

    def add_extra_bounds(self, min_x: float, min_y: float, max_x: float, max_y: float) -> None:
        """Let the next update take in a rectangle [m] in which something else has changed this layer's costs."""
        self._extra = self._extra or Bounds()
        self._extra.touch(min_x, min_y)
        self._extra.touch(max_x, max_y)

    def use_extra_bounds(self, bounds: Bounds) -> bool:
        """Take what was added into `bounds`; whether there was anything."""
        extra, self._extra = self._extra, None
        if extra is None:
            return False
        bounds.touch(extra.min_x, extra.min_y)
        bounds.touch(extra.max_x, extra.max_y)
        return True

    def clear_area(self, x0: int, y0: int, x1: int, y1: int, inside: bool = False) -> None:
        """Forget the cells strictly between columns `x0`, `x1` and rows `y0`, `y1` (`inside`), or all the others."""
        window = Window(max(x0 + 1, 0), max(y0 + 1, 0), min(x1, self.grid.width), min(y1, self.grid.height))
        if inside:
            if not window.is_empty:
                window.of(self.costs)[...] = NO_INFORMATION
        else:
            kept = None if window.is_empty else window.of(self.costs).copy()
            self.costs[...] = NO_INFORMATION
            if kept is not None:
                window.of(self.costs)[...] = kept
        if self.grid.costs.size:
            width, height = self.grid.size_m
            x, y = self.grid.origin
            self.add_extra_bounds(x, y, x + width, y + height)

    # -- ways to write its costs into the master grid -------------------------------------------------------------

    def update_with_max(self, grid: Costmap2D, window: Window) -> None:
        """Write the greater cost, where this layer knows one."""
        mine, master = window.of(self.costs), window.of(grid.costs)
        # Shifted by one the unknown, 255, is 0, and below everything.
        one = np.uint8(1)
        np.subtract(np.maximum(mine + one, master + one), one, out=master)

    def update_with_overwrite(self, grid: Costmap2D, window: Window) -> None:
        """Write its costs, where it knows one."""
        mine = window.of(self.costs)
        np.copyto(window.of(grid.costs), mine, where=mine != NO_INFORMATION)

    def update_with_true_overwrite(self, grid: Costmap2D, window: Window) -> None:
        """Write all its costs, unknown ones too."""
        np.copyto(window.of(grid.costs), window.of(self.costs))

    def explain(self, mx: int, my: int) -> tuple[int | None, str]:
        """Its own cost at a cell of the master grid; None where it knows nothing."""
        cell = self.grid.world_to_map(*self.layered.grid.map_to_world(mx, my))
        if cell is None:
            return None, "the cell is outside of what it covers"
        cost = self.grid.cost(*cell)
        if cost == NO_INFORMATION:
            return None, "unknown"
        return (
            cost,
            "free" if cost == FREE_SPACE else "an obstacle" if cost == LETHAL_OBSTACLE else f"cost {cost}",
        )
