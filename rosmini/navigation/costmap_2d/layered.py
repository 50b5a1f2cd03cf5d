"""A costmap in layers (http://wiki.ros.org/costmap_2d): what changed is found, reset, and written layer by layer."""

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
    """The master grid and its layers, which are asked in order.

    `report(layer, error)` is told of a layer that fails: the others go on, and the costmap is not current.
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
        self.is_tracking_unknown = track_unknown_space
        self.grid = Costmap2D(0, 0, 1.0, default=NO_INFORMATION if track_unknown_space else FREE_SPACE)
        self.layers: list[Layer] = []
        self.footprint: Footprint = np.zeros((0, 2))
        """The vertices (n, 2) [m] in the robot's base frame, padded."""
        self.inscribed_radius, self.circumscribed_radius = radii(self.footprint)
        self.is_size_locked = False
        """Whether a map has set the size, which parameters then do not change."""
        self.is_initialized = False
        """Whether an update has been made."""
        self.window = Window(0, 0, 0, 0)
        """The cells that the last update computed."""
        self._report = report
        self._failed: set[Layer] = set()
        self._enabled: list[Layer] = []
        self._whole = True

    def add(self, layer: Layer) -> None:
        """Take a layer on top of the others."""
        self.layers.append(layer)

    @property
    def is_current(self) -> bool:
        """Whether every layer that is enabled knows enough to drive by."""
        return not self._failed and all(layer.is_current for layer in self.layers if layer.is_enabled)

    def resize(
        self, width: int, height: int, resolution: float, origin: tuple[float, float], *, lock: bool = False
    ) -> None:
        """Give the master grid and its layers another size [cells], resolution and origin [m]; costs are lost."""
        self.is_size_locked = self.is_size_locked or lock
        self.grid.resize(width, height, resolution, origin)
        self._whole = True
        for layer in self.layers:
            layer.match_size()

    def set_footprint(self, footprint: ArrayLike) -> None:
        """Take the robot's footprint (n, 2) [m], padded already."""
        self.footprint = np.asarray(footprint, dtype=np.float64).reshape(-1, 2)
        self.inscribed_radius, self.circumscribed_radius = radii(self.footprint)
        for layer in self.layers:
            layer.on_footprint_changed()

    def reset(self) -> None:
        """Forget all costs, in the layers too."""
        self.grid.costs[...] = self.grid.default
        self._whole = True
        for layer in self.layers:
            layer.reset()

    def update_map(self, robot: Pose) -> Window:
        """Bring the master grid up to date for a robot at this pose; returns the cells that were computed.

        Where a rolling window has moved, where layers were switched on or off and after a reset it is all of them: else
        inflation from what was outside, or is no longer there, would be wrong at the edges.
        """
        if self.is_rolling and self._roll(robot) != (0, 0):
            self._whole = True
        if not self.layers:
            return self.window
        enabled = [layer for layer in self.layers if layer.is_enabled]
        self._whole = self._whole or enabled != self._enabled
        self._enabled = enabled
        self._failed.clear()
        bounds = Bounds()
        for layer in enabled:
            self._guarded(layer, partial(self._update_bounds, layer, robot, bounds))
        if self._whole:
            bounds.touch_all()
            self._whole = False
        self.window = window = self._cells(bounds)
        if window.is_empty:
            return window
        window.of(self.grid.costs)[...] = self.grid.default
        for layer in enabled:
            self._guarded(layer, partial(layer.update_costs, self.grid, window))
        self.is_initialized = True
        return window

    def _roll(self, robot: Pose) -> tuple[int, int]:
        width, height = self.grid.size_m
        return self.grid.move_origin(robot[0] - width / 2, robot[1] - height / 2)

    def _update_bounds(self, layer: Layer, robot: Pose, bounds: Bounds) -> None:
        before = bounds.copy()
        layer.update_bounds(robot, bounds)
        if not bounds.contains(before):
            said = f"the bounds were {before}, and are {bounds} after it: a layer may only widen them"
            bounds.touch(before.min_x, before.min_y)
            bounds.touch(before.max_x, before.max_y)
            raise RosminiError(f"Illegal bounds change, the offending layer is {layer.name}: {said}")

    def _guarded(self, layer: Layer, step: Callable[[], object]) -> None:
        try:
            step()
        except Exception as error:
            if self._report is None:
                raise
            self._failed.add(layer)
            self._report(layer, error)

    def _cells(self, bounds: Bounds) -> Window:
        """The cells of the master grid that have a point in the bounds."""
        grid = self.grid
        if bounds.is_empty or not grid.costs.size:
            return Window(0, 0, 0, 0)
        x0, y0 = grid.world_to_map_no_bounds(bounds.min_x, bounds.min_y)
        xn, yn = grid.world_to_map_no_bounds(bounds.max_x, bounds.max_y)
        return Window(max(x0, 0), max(y0, 0), min(xn + 1, grid.width), min(yn + 1, grid.height))
