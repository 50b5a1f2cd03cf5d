"""`frontier_exploration::BoundedExploreLayer`: a boundary in a costmap, and the frontiers inside it.

Under the costmap's name it offers the services `explore_boundary/update_boundary_polygon` and `explore_boundary/
get_next_frontier`, and the topic `explore_boundary/frontiers`, a cloud in which the chosen frontier has intensity 100
and the others 50.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.errors import ServiceRefused
from rosmini.core.geometry.polygons import Floats
from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.core.parameters import parameter
from rosmini.core.tf import Buffer, TransformException
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.navigation.costmap_2d.costmap import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D
from rosmini.navigation.costmap_2d.footprint import points_of
from rosmini.navigation.costmap_2d.layer import Bounds, CostmapLayer, Window
from rosmini.navigation.costmap_2d.parameters import LayerConfig
from rosmini.navigation.costmap_2d.rays import line_cells
from rosmini.navigation.nav_core.clouds import point_cloud
from rosmini.navigation.nav_core.poses import planar_transform, pose_stamped

from .polygon import polygon_error
from .search import MAX_FAILURES, Blacklist, Frontier, find_frontiers, formatted_points

CLOSEST, MIDDLE, CENTROID = "closest", "middle", "centroid"
"""Values of `frontier_travel_point`."""
TIMEOUT = 10.0
"""Maximum time to wait for a transform, and for the boundary to be drawn [s]."""
ROUNDING = 1e-3
"""Points are 32-bit floats: a boundary must reach into a cell by at least this fraction of a cell [cells]."""
POLL_PERIOD = 0.1
"""Interval between checks whether the boundary is drawn [s]."""
OTHER_INTENSITY, CHOSEN_INTENSITY = 50.0, 100.0
"""Intensities of the frontiers in the cloud."""


@dataclass(frozen=True)
class BoundedExploreParameters(LayerConfig):
    """Parameters of `frontier_exploration::BoundedExploreLayer`."""

    explore_clear_space: bool = parameter(
        True, "whether all cells inside the boundary are unknown initially, so that known space is explored again"
    )
    resize_to_boundary: bool = parameter(True, "whether the costmap gets the size of the boundary")
    frontier_travel_point: str = parameter(CLOSEST, "the point of a frontier to drive to")


def points_in_frame(buffer: Buffer, frame: str, source: str, points: Floats) -> Floats:
    """Return points (n, 2) [m], given in the frame `source`, in `frame`.

    Raises `TransformException` if the transform is not known within `TIMEOUT`.
    """
    if source.lstrip("/") == frame:
        return points
    found = buffer.lookup_transform(frame, source.lstrip("/"), Time(0), TIMEOUT)
    return transform_points(planar_transform(found), points)


class BoundedExploreLayer(CostmapLayer, plugin="frontier_exploration::BoundedExploreLayer"):
    """Draws an impassable boundary into the costmap, and chooses the nearest frontier.

    The layer may come before or after the map and sensor layers. It marks the boundary as lethal and, with
    `explore_clear_space`, all other cells without an obstacle as unknown. Unlike the original it rejects boundaries
    that enclose no area.
    """

    def on_initialize(self) -> None:
        """Read the parameters and offer the services."""
        node, namespace = self.node, self.namespace
        self.settings = BoundedExploreParameters.read(node, namespace)
        self.grid.default = NO_INFORMATION if self.settings.explore_clear_space else FREE_SPACE
        self.boundary: Floats | None = None
        """The vertices (n, 2) [m] in the costmap's frame; None without a boundary."""
        self.frontiers: list[Frontier] = []
        """The frontiers found last."""
        self.given_up = Blacklist()
        """Goals that could not be reached."""
        self._is_drawn = False
        self._has_changed = False
        self.match_size()
        self._cloud = node.publisher(f"{namespace}frontiers", message_class("sensor_msgs/PointCloud2"), queue_size=5)
        self._cloud.expect_nobody()
        for name, kind, handler in (
            ("update_boundary_polygon", "UpdateBoundaryPolygon", self._update_boundary),
            ("get_next_frontier", "GetNextFrontier", self._next_frontier),
        ):
            node.service(f"{namespace}{name}", service_class(f"frontier_exploration/{kind}"), handler)
        self._server = Server(node, LayerConfig, self._reconfigure, namespace=namespace)

    def _reconfigure(self, config: Any, _: int) -> Any:
        self.is_enabled = config["enabled"]
        return config

    # -- the boundary --------------------------------------------------------------------------------------------

    def _update_boundary(self, request: Any) -> Any:
        """Set the boundary; without vertices it is the costmap's edge."""
        stamped = request.explore_boundary
        vertices = points_of(stamped.polygon)
        problem = polygon_error(vertices) if len(vertices) else None
        if problem is not None:
            raise self._refusal(problem)
        try:
            vertices = points_in_frame(self.buffer, self.layered.global_frame, stamped.header.frame_id, vertices)
        except TransformException as error:
            raise self._refusal(
                f"Couldn't transform from {self.layered.global_frame} to {stamped.header.frame_id}: {error}"
            ) from error
        master = self.layered.grid
        if not len(vertices):
            vertices = _edge(master)
        elif self.settings.resize_to_boundary:
            low, high = vertices.min(axis=0), vertices.max(axis=0)
            width, height = (int(side) for side in np.ceil((high - low) / master.resolution - ROUNDING))
            self.layered.resize(width + 1, height + 1, master.resolution, (float(low[0]), float(low[1])))
        elif not _overlaps(vertices, _edge(master)):
            raise self._refusal(
                f"the boundary, {_span(vertices)}, does not overlap the costmap, {_span(_edge(master))}"
            )
        self.boundary = vertices
        self._is_drawn, self._has_changed = False, True
        return []

    def _refusal(self, text: str) -> ServiceRefused:
        self.node.logerr(text)
        return ServiceRefused(text)

    def reset(self) -> None:
        """Remove the boundary and the frontiers, and forget the goals that could not be reached."""
        self.boundary, self.frontiers = None, []
        self.given_up.points.clear()
        self._is_drawn, self._has_changed = False, True
        self.costs[...] = self.grid.default

    def match_size(self) -> None:
        """Adopt the costmap's size, after which the boundary must be redrawn."""
        super().match_size()
        self._is_drawn = False

    def update_bounds(self, robot: Pose, bounds: Bounds) -> None:
        """Make the bounds unlimited at the first update after the boundary has changed."""
        del robot
        self.use_extra_bounds(bounds)
        if self._has_changed:
            self._has_changed = False
            bounds.touch_all()

    def update_costs(self, grid: Costmap2D, window: Window) -> None:
        """Write the boundary and, with `explore_clear_space`, unknown cells; lethal obstacles are not overwritten."""
        if self.boundary is None:
            return
        if not self._is_drawn:
            self._draw(self.boundary)
        self._is_drawn = True
        mine, master = window.view(self.costs), window.view(grid.costs)
        np.copyto(master, mine, where=(master != LETHAL_OBSTACLE) & ((mine == LETHAL_OBSTACLE) | (mine > master)))

    def _draw(self, boundary: Floats) -> None:
        """Draw the edges of `boundary` (n, 2) [m] as obstacles; vertices outside the costmap are moved to its edge."""
        self.costs[...] = self.grid.default
        cells = [self.grid.world_to_map_clamped(x, y) for x, y in boundary.tolist()]
        for (x0, y0), (x1, y1) in zip(cells, [*cells[1:], cells[0]], strict=True):
            columns, rows = line_cells(x0, y0, x1, y1)
            self.costs[rows, columns] = LETHAL_OBSTACLE

    # -- frontiers -----------------------------------------------------------------------------------------------

    def _next_frontier(self, request: Any) -> Any:
        """Return the next goal for a robot at the requested pose; refuse the request if no frontier is left."""
        start = request.start_pose
        self._wait_until_drawn()
        p = start.pose.position
        try:
            here = points_in_frame(
                self.buffer, self.layered.global_frame, start.header.frame_id, np.array([[p.x, p.y]])
            )
        except TransformException as error:
            raise self._refusal(
                f"Couldn't transform from {self.layered.global_frame} to {start.header.frame_id}: {error}"
            ) from error
        x, y = here[0].tolist()
        try:
            self.frontiers = find_frontiers(self.layered.grid, x, y)
        except IndexError as error:
            raise self._refusal(f"Robot out of costmap bounds, cannot search for frontiers: {error}") from error
        # A single cell is noise in the map.
        self.frontiers = [one for one in self.frontiers if one.size > 1]
        resolution = self.layered.grid.resolution
        left = [
            (self.given_up.count(self._travel_point(one), resolution), one.min_distance, one) for one in self.frontiers
        ]
        tries, _, chosen = min(left, key=lambda each: each[:2], default=(MAX_FAILURES, 0.0, None))
        if chosen is None or tries >= MAX_FAILURES:
            raise ServiceRefused("No valid frontiers found, exploration complete" + self.given_up_text)
        self._publish(chosen)
        px, py = self._travel_point(chosen)
        yaw = math.atan2(py - y, px - x)
        return {"next_frontier": pose_stamped(self.layered.global_frame, self.node.now(), (px, py, yaw))}

    @property
    def given_up_text(self) -> str:
        """Text to append to a message when exploration ends: the positions of the latest frontiers, all given up.

        Empty if there are no frontiers.
        """
        if not self.frontiers:
            return ""
        return f"; {len(self.frontiers)} were given up, at {formatted_points(map(self._travel_point, self.frontiers))}"

    def _wait_until_drawn(self) -> None:
        for _ in range(round(TIMEOUT / POLL_PERIOD)):
            if self._is_drawn:
                return
            self.node.sleep(POLL_PERIOD)
        raise self._refusal(f"no boundary has been drawn within {TIMEOUT:g} s: call update_boundary_polygon first")

    def _travel_point(self, frontier: Frontier) -> tuple[float, float]:
        name = self.settings.frontier_travel_point
        if name == CENTROID:
            return frontier.centroid
        if name == MIDDLE:
            return frontier.middle
        if name != CLOSEST:
            self.node.logerr(f"Invalid 'frontier_travel_point' parameter {name!r}, falling back to 'closest'")
        return frontier.initial

    def _publish(self, chosen: Frontier) -> None:
        rows = [(*one.initial, 0.0, CHOSEN_INTENSITY if one is chosen else OTHER_INTENSITY) for one in self.frontiers]
        names = ("x", "y", "z", "intensity")
        self._cloud.publish(point_cloud(self.layered.global_frame, self.node.now(), names, rows))


def _edge(grid: Costmap2D) -> Floats:
    """Return the corners (4, 2) of a grid [m]."""
    (x, y), (width, height) = grid.origin, grid.size_m
    return np.array([(x, y), (x, y + height), (x + width, y + height), (x + width, y)])


def _overlaps(a: Floats, b: Floats) -> bool:
    """Return whether the bounding rectangles of two sets of points (n, 2) overlap."""
    return bool((a.min(axis=0) < b.max(axis=0)).all() and (b.min(axis=0) < a.max(axis=0)).all())


def _span(points: Floats) -> str:
    """Return the bounding rectangle of points (n, 2) as text."""
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    return f"from ({x0:.2f}, {y0:.2f}) to ({x1:.2f}, {y1:.2f})"
