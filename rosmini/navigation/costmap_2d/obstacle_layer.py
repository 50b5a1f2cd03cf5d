"""`costmap_2d::ObstacleLayer`: obstacles that sensors detect (http://wiki.ros.org/costmap_2d/hydro/obstacles)."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.geometry.poses import Pose

from .costmap import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D, fill
from .footprint import Footprint, placed
from .inflation import cell_distance
from .layer import Bounds, CostmapLayer, Window
from .observations import Observation
from .parameters import MAXIMUM, OVERWRITE, ObstacleConfig, ObstacleParameters
from .rays import compiled_clear_rays
from .sources import ObservationSource


class ObstacleLayer(CostmapLayer, plugin="costmap_2d::ObstacleLayer"):
    """Clears the cells along the rays of its sources, then marks the end points."""

    config: ClassVar[type[ObstacleConfig]] = ObstacleConfig
    settings_class: ClassVar[type[ObstacleParameters]] = ObstacleParameters

    def __init__(self) -> None:
        super().__init__()
        self.sources: list[ObservationSource] = []
        self._footprint: Footprint = np.zeros((0, 2))
        self._footprint_clearing = True
        self._max_height = 2.0
        self._combination = MAXIMUM

    def on_initialize(self) -> None:
        """Read the parameters and subscribe to the sources."""
        settings = self.settings = self.settings_class.read(self.node, self.namespace)
        tracks = settings.track_unknown_space
        tracks = self.layered.is_tracking_unknown if tracks is None else tracks
        self.grid.default = NO_INFORMATION if tracks else FREE_SPACE
        self.match_size()
        self.node.loginfo(f"    Subscribed to Topics: {settings.observation_sources}")
        for name in settings.observation_sources.split():
            self.sources.append(
                ObservationSource(self.node, self.buffer, f"{self.namespace}{name}/", name, self.layered.global_frame)
            )
        self._server = Server(self.node, self.config, self._reconfigure, namespace=self.namespace)

    def _reconfigure(self, config: Any, _: int) -> Any:
        self.is_enabled = config["enabled"]
        self._max_height = config["max_obstacle_height"]
        self._combination = config["combination_method"]
        self._footprint_clearing = config["footprint_clearing_enabled"]
        return config

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics of its sources."""
        return tuple(self.node.resolve(source.topic) for source in self.sources)

    def activate(self) -> None:
        """Subscribe to the sources again."""
        now = self.node.clock.now_ns()
        for source in self.sources:
            source.activate()
            source.observations.updated_ns = now

    def deactivate(self) -> None:
        """Unsubscribe from the topics of the sources."""
        for source in self.sources:
            source.deactivate()

    def reset(self) -> None:
        """Clear all obstacles, and subscribe to the sources again."""
        self.deactivate()
        self.costs[...] = self.grid.default
        self.activate()

    def update_bounds(self, robot: Pose, bounds: Bounds) -> None:
        """Clear and mark cells by the stored observations of all sources, and extend `bounds` to these cells."""
        if self.layered.is_rolling:
            self.roll(robot)
        self.use_extra_bounds(bounds)
        late = [source for source in self.sources if not source.is_current()]
        self.is_current = not late
        for source in self.sources:
            if source.settings.clearing:
                for observation in source.observations.observations():
                    self.clear(observation, bounds)
        for source in self.sources:
            if source.settings.marking:
                for observation in source.observations.observations():
                    self.mark(observation, bounds)
        self._footprint = np.zeros((0, 2))
        if self._footprint_clearing:
            self._footprint = placed(self.layered.footprint, robot)
            for x, y in self._footprint.tolist():
                bounds.touch(x, y)

    def roll(self, robot: Pose) -> tuple[int, int]:
        """Move the layer's grid with the robot; return the number of cells moved, (columns, rows)."""
        width, height = self.grid.size_m
        return self.grid.move_origin(robot[0] - width / 2, robot[1] - height / 2)

    def clear(self, observation: Observation, bounds: Bounds) -> None:
        """Clear the cells between the sensor and the observed points, and extend `bounds` to them."""
        grid = self.grid
        ox, oy, _ = observation.origin
        if grid.world_to_map(ox, oy) is None:
            self.warn_outside(f"({ox:.2f}, {oy:.2f})")
            return
        reach = cell_distance(observation.raytrace_range, grid.resolution)
        x0, y0, x1, y1 = compiled_clear_rays()(
            grid.costs, *grid.origin, grid.resolution, ox, oy, observation.points, reach, FREE_SPACE
        )
        bounds.touch_cells(grid, Window(x0, y0, x1 + 1, y1 + 1))

    def warn_outside(self, where: str) -> None:
        """Warn that a sensor is outside the costmap."""
        self.node.logwarn(
            f"The origin for the sensor at {where} is out of map bounds. So, the costmap cannot raytrace for it.",
            throttle=1.0,
        )

    def mark(self, observation: Observation, bounds: Bounds) -> None:
        """Mark the cells of the observed points as obstacles, and extend `bounds` to them."""
        points = self._near(observation)
        cells = np.floor((points[:, :2] - self.grid.origin) / self.grid.resolution).astype(np.int64)
        inside = (cells >= 0).all(axis=1) & (cells < (self.grid.width, self.grid.height)).all(axis=1)
        mx, my = cells[inside].T
        if len(mx):
            self.costs[my, mx] = LETHAL_OBSTACLE
            bounds.touch_cells(self.grid, Window(mx.min(), my.min(), mx.max() + 1, my.max() + 1))

    def _near(self, observation: Observation) -> Any:
        """Return the points (n, 3) that are near enough to the sensor and low enough to count as obstacles."""
        points = observation.points
        away = points - observation.origin
        near = (away * away).sum(axis=1) < observation.obstacle_range**2
        return points[near & (points[:, 2] <= self._max_height)]

    def update_costs(self, grid: Costmap2D, window: Window) -> None:
        """Clear the cells under the robot, and write the costs as `combination_method` specifies."""
        if len(self._footprint):
            fill(self.grid, self._footprint, FREE_SPACE)
        if self._combination == OVERWRITE:
            self.update_with_overwrite(grid, window)
        elif self._combination == MAXIMUM:
            self.update_with_max(grid, window)
