"""A costmap made of layers (http://wiki.ros.org/costmap_2d): each update resets the changed area and rewrites it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose

from .costmap import FREE_SPACE, NO_INFORMATION, Costmap2D
from .footprint import Footprint, radii
from .layer import Bounds, Layer, Window


class LayeredCostmap:
    """The master grid and its layers, which update it in order.

    If a layer fails, `report(layer, error)` is called, the other layers go on, and the costmap is not current.
    """

    def __init__(
        self,
        global_frame: str,
        *,
        rolling_window: bool = False,
        track_unknown_space: bool = False,
        report: Callable[[Layer, Exception], object] | None = None,
    ) -> None:
        self.global_frame = global_frame
        self.is_rolling = rolling_window
        """True if the grid moves with the robot."""
        self.is_tracking_unknown = track_unknown_space
        """True if cells that no layer knows are unknown, not free."""
        self.grid = Costmap2D(0, 0, 1.0, default=NO_INFORMATION if track_unknown_space else FREE_SPACE)
        self.layers: list[Layer] = []
        self.footprint: Footprint = np.zeros((0, 2))
        """The padded footprint's vertices (n, 2) [m] in the robot's base frame."""
        self.inscribed_radius, self.circumscribed_radius = radii(self.footprint)
        self.is_size_locked = False
        """True once a map has set the size; parameters can then no longer change it."""
        self.is_initialized = False
        """True once an update has completed."""
        self.window = Window(0, 0, 0, 0)
        """The cells computed in the last update."""
        self._report = report
        self._failed: set[Layer] = set()
        self._enabled: list[Layer] = []
        self._needs_full_update = True

    def add(self, layer: Layer) -> None:
        """Add a layer on top of the others."""
        self.layers.append(layer)

    @property
    def is_current(self) -> bool:
        """True if the data of every enabled layer is recent enough for safe driving."""
        return not self._failed and all(layer.is_current for layer in self.layers if layer.is_enabled)

    def resize(
        self, width: int, height: int, resolution: float, origin: tuple[float, float], *, lock: bool = False
    ) -> None:
        """Change the size [cells], resolution and origin [m] of the master grid and its layers; costs are lost."""
        self.is_size_locked = self.is_size_locked or lock
        self.grid.resize(width, height, resolution, origin)
        self._needs_full_update = True
        for layer in self.layers:
            layer.match_size()

    def set_footprint(self, footprint: ArrayLike) -> None:
        """Set the robot's padded footprint (n, 2) [m]."""
        self.footprint = np.asarray(footprint, dtype=np.float64).reshape(-1, 2)
        self.inscribed_radius, self.circumscribed_radius = radii(self.footprint)
        for layer in self.layers:
            layer.on_footprint_changed()

    def reset(self) -> None:
        """Clear all costs, including those in the layers."""
        self.grid.costs[...] = self.grid.default
        self._needs_full_update = True
        for layer in self.layers:
            layer.reset()

    def update_map(self, robot: Pose) -> Window:
        """Update the master grid for a robot at this pose, and return the window of cells that were computed.

        All cells are computed when a rolling window has moved, when a layer was switched on or off, and after a reset;
        otherwise the inflation at the edges would miss obstacles that appeared, or keep those that are gone.
        """
        if self.is_rolling and self._roll(robot) != (0, 0):
            self._needs_full_update = True
        if not self.layers:
            return self.window
        enabled = [layer for layer in self.layers if layer.is_enabled]
        self._needs_full_update = self._needs_full_update or enabled != self._enabled
        self._enabled = enabled
        self._failed.clear()
        bounds = Bounds()
        for layer in enabled:
            self._run_step(layer, partial(self._update_bounds, layer, robot, bounds))
        if self._needs_full_update:
            bounds.touch_all()
            self._needs_full_update = False
        self.window = window = self._cells(bounds)
        if window.is_empty:
            return window
        window.view(self.grid.costs)[...] = self.grid.default
        for layer in enabled:
            self._run_step(layer, partial(layer.update_costs, self.grid, window))
        self.is_initialized = True
        return window

    def _roll(self, robot: Pose) -> tuple[int, int]:
        width, height = self.grid.size_m
        return self.grid.move_origin(robot[0] - width / 2, robot[1] - height / 2)

    def _update_bounds(self, layer: Layer, robot: Pose, bounds: Bounds) -> None:
        before = bounds.copy()
        layer.update_bounds(robot, bounds)
        if not bounds.contains(before):
            change = f"it changed the bounds from {before} to {bounds}, but a layer may only widen them"
            bounds.touch(before.min_x, before.min_y)
            bounds.touch(before.max_x, before.max_y)
            raise RosminiError(f"Illegal bounds change, the offending layer is {layer.name}: {change}")

    def _run_step(self, layer: Layer, step: Callable[[], object]) -> None:
        try:
            step()
        except Exception as error:
            if self._report is None:
                raise
            self._failed.add(layer)
            self._report(layer, error)

    def _cells(self, bounds: Bounds) -> Window:
        """Return the window of cells in the master grid that the bounds touch."""
        grid = self.grid
        if bounds.is_empty or not grid.costs.size:
            return Window(0, 0, 0, 0)
        x0, y0 = grid.world_to_map_no_bounds(bounds.min_x, bounds.min_y)
        xn, yn = grid.world_to_map_no_bounds(bounds.max_x, bounds.max_y)
        return Window(max(x0, 0), max(y0, 0), min(xn + 1, grid.width), min(yn + 1, grid.height))
