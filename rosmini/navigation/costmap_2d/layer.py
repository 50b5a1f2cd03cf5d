"""The interface of costmap layers (http://wiki.ros.org/costmap_2d#Layer_Specifications).

To write a layer, derive a class with a plugin name and add it to the costmap's parameter `plugins`:

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
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rosmini.core.geometry.poses import Pose
from rosmini.core.plugins import Plugin

from .costmap import NO_INFORMATION, Costmap2D, Costs

if TYPE_CHECKING:
    from rosmini.core.graph import Node
    from rosmini.core.tf import Buffer

    from .layered import LayeredCostmap

FAR = 1e30
"""Coordinate of empty (inverted) and unlimited bounds."""


class Window(NamedTuple):
    """A rectangle of cells: columns `x0` to `xn - 1`, rows `y0` to `yn - 1`."""

    x0: int
    y0: int
    xn: int
    yn: int

    @property
    def is_empty(self) -> bool:
        """True if the window contains no cell."""
        return self.xn <= self.x0 or self.yn <= self.y0

    def has(self, mx: int, my: int) -> bool:
        """Return whether the window contains this cell."""
        return self.x0 <= mx < self.xn and self.y0 <= my < self.yn

    def fits(self, grid: Costmap2D) -> bool:
        """Return whether the window lies completely inside a grid."""
        return self.x0 >= 0 and self.y0 >= 0 and self.xn <= grid.width and self.yn <= grid.height

    def united(self, other: Window | None) -> Window:
        """Return the smallest window that contains both; `other` may be None."""
        if other is None:
            return self
        low = min(self.x0, other.x0), min(self.y0, other.y0)
        return Window(*low, max(self.xn, other.xn), max(self.yn, other.yn))

    def view(self, costs: Costs) -> Costs:
        """Return the window's part of a grid (h, w), as a view."""
        return costs[self.y0 : self.yn, self.x0 : self.xn]


class Bounds:
    """The rectangle [m] in the costmap's frame where costs may have changed; initially empty."""

    def __init__(self) -> None:
        self.min_x = self.min_y = FAR
        self.max_x = self.max_y = -FAR

    def __repr__(self) -> str:
        return f"<Bounds ({self.min_x:g}, {self.min_y:g}) to ({self.max_x:g}, {self.max_y:g})>"

    @property
    def is_empty(self) -> bool:
        """True if no cell has changed."""
        return self.max_x < self.min_x or self.max_y < self.min_y

    def touch(self, x: float, y: float) -> None:
        """Extend the bounds to include a point [m]."""
        self.min_x, self.max_x = min(self.min_x, x), max(self.max_x, x)
        self.min_y, self.max_y = min(self.min_y, y), max(self.max_y, y)

    def touch_cells(self, grid: Costmap2D, window: Window) -> None:
        """Extend the bounds to include the cells of a window."""
        if not window.is_empty:
            self.touch(*grid.map_to_world(window.x0, window.y0))
            self.touch(*grid.map_to_world(window.xn - 1, window.yn - 1))

    def touch_all(self) -> None:
        """Make the bounds unlimited."""
        self.touch(-FAR, -FAR)
        self.touch(FAR, FAR)

    def contains(self, other: Bounds) -> bool:
        """Return whether other bounds are empty or completely inside these."""
        return other.is_empty or (
            self.min_x <= other.min_x
            and self.min_y <= other.min_y
            and self.max_x >= other.max_x
            and self.max_y >= other.max_y
        )

    def copy(self) -> Bounds:
        """Return a copy."""
        made = Bounds()
        made.min_x, made.min_y, made.max_x, made.max_y = self.min_x, self.min_y, self.max_x, self.max_y
        return made


class Layer(Plugin, ABC):
    """The base class of all layers. Subclasses define `update_bounds` and `update_costs`."""

    name: str
    """The layer's name in the costmap's `plugins`."""
    namespace: str
    """The namespace of its parameters and topics, with a trailing `/`: `~global_costmap/static_layer/`."""
    layered: LayeredCostmap
    """The costmap that the layer belongs to."""
    node: Node
    buffer: Buffer
    is_enabled = True
    """A disabled layer takes no part in updates."""
    is_current = True
    """True if the layer's data is recent enough for safe driving."""

    def initialize(self, layered: LayeredCostmap, name: str, namespace: str, node: Node, buffer: Buffer) -> None:
        """Attach the layer to its costmap; called once."""
        self.layered, self.name, self.namespace, self.node, self.buffer = (layered, name, namespace, node, buffer)
        self.on_initialize()

    def on_initialize(self) -> None:
        """Read parameters and subscribe to topics."""

    @property
    def topics(self) -> tuple[str, ...]:
        """The resolved names of the topics that the layer subscribes to."""
        return ()

    @abstractmethod
    def update_bounds(self, robot: Pose, bounds: Bounds) -> None:
        """Extend `bounds` to every cell that the layer will change; `robot` is the pose in the costmap's frame."""

    @abstractmethod
    def update_costs(self, grid: Costmap2D, window: Window) -> None:
        """Write costs into the master grid, inside this window only."""

    def match_size(self) -> None:
        """React to a change in the size, resolution or origin of the master grid."""

    def on_footprint_changed(self) -> None:
        """React to a new robot footprint."""

    def activate(self) -> None:
        """Subscribe to the layer's topics again."""

    def deactivate(self) -> None:
        """Unsubscribe from the layer's topics."""

    def reset(self) -> None:
        """Discard all data received so far."""


class CostmapLayer(Layer):
    """A layer that stores costs, in `grid`."""

    def __init__(self) -> None:
        self.grid = Costmap2D(0, 0, 1.0, default=NO_INFORMATION)
        self._extra: Bounds | None = None

    @property
    def costs(self) -> Costs:
        """The layer's costs (h, w)."""
        return self.grid.costs

    def match_size(self) -> None:
        """Adopt the size, resolution and origin of the master grid; the costs are lost."""
        master = self.layered.grid
        self.grid.resize(master.width, master.height, master.resolution, master.origin)

    def add_extra_bounds(self, min_x: float, min_y: float, max_x: float, max_y: float) -> None:
        """Include in the next update a rectangle [m] in which other code has changed this layer's costs."""
        self._extra = self._extra or Bounds()
        self._extra.touch(min_x, min_y)
        self._extra.touch(max_x, max_y)

    def use_extra_bounds(self, bounds: Bounds) -> bool:
        """Move the extra bounds, if there are any, into `bounds`; return True if there were any."""
        extra, self._extra = self._extra, None
        if extra is None:
            return False
        bounds.touch(extra.min_x, extra.min_y)
        bounds.touch(extra.max_x, extra.max_y)
        return True

    def clear_area(self, x0: int, y0: int, x1: int, y1: int, inside: bool = False) -> None:
        """Set the cells outside a rectangle to unknown or, with `inside`, those in it.

        The rectangle contains columns `x0 + 1` to `x1 - 1` and rows `y0 + 1` to `y1 - 1`.
        """
        window = Window(max(x0 + 1, 0), max(y0 + 1, 0), min(x1, self.grid.width), min(y1, self.grid.height))
        if inside:
            if not window.is_empty:
                window.view(self.costs)[...] = NO_INFORMATION
        else:
            kept = None if window.is_empty else window.view(self.costs).copy()
            self.costs[...] = NO_INFORMATION
            if kept is not None:
                window.view(self.costs)[...] = kept
        if self.grid.costs.size:
            width, height = self.grid.size_m
            x, y = self.grid.origin
            self.add_extra_bounds(x, y, x + width, y + height)

    # -- writing costs into the master grid -----------------------------------------------------------------------

    def update_with_max(self, grid: Costmap2D, window: Window) -> None:
        """Write the greater of both costs where this layer's cost is known."""
        mine, master = window.view(self.costs), window.view(grid.costs)
        # Adding 1 turns unknown, 255, into 0, which is less than every known cost.
        one = np.uint8(1)
        np.subtract(np.maximum(mine + one, master + one), one, out=master)

    def update_with_overwrite(self, grid: Costmap2D, window: Window) -> None:
        """Write this layer's costs where they are known."""
        mine = window.view(self.costs)
        np.copyto(window.view(grid.costs), mine, where=mine != NO_INFORMATION)

    def update_with_true_overwrite(self, grid: Costmap2D, window: Window) -> None:
        """Write all of this layer's costs, including unknown ones."""
        np.copyto(window.view(grid.costs), window.view(self.costs))
