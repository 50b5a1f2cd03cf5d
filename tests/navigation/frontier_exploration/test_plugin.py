"""The layer: a boundary in a costmap, and its two services."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.core.errors import ServiceException
from rosmini.core.tf import TransformListener
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS
from rosmini.navigation.nav_core import pose_stamped

LAYERS = [
    {"name": "static", "type": "costmap_2d::StaticLayer"},
    {"name": "explore_boundary", "type": "frontier_exploration::BoundedExploreLayer"},
]


class Bounded:
    """A costmap with the layer, and clients of its services."""

    def __init__(self, stage, **parameters):
        self.graph, self.node = stage.graph, stage.graph.node("explorer")
        given = {"resize_to_boundary": False, "explore_clear_space": False, **parameters}
        self.node.set_param(
            "~explore_costmap",
            {"plugins": LAYERS, "track_unknown_space": True, "robot_radius": 0.1, "explore_boundary": given},
        )
        self.buffer = TransformListener(self.node).buffer
        self.costmap = Costmap2DROS("explore_costmap", self.buffer, self.node)
        self.layer = self.costmap.layers[1]
        client = stage.graph.node("asker")
        self.clouds = []
        label = "/explorer/explore_costmap/explore_boundary/"
        client.subscriber(f"{label}frontiers", message_class("sensor_msgs/PointCloud2"), self.clouds.append)
        self._update = client.service_client(
            f"{label}update_boundary_polygon", service_class("frontier_exploration/UpdateBoundaryPolygon")
        )
        self._next = client.service_client(
            f"{label}get_next_frontier", service_class("frontier_exploration/GetNextFrontier")
        )

    def bound(self, *points, frame="map"):
        polygon = message_class("geometry_msgs/PolygonStamped")()
        polygon.header.frame_id = frame
        polygon.polygon.points = [message_class("geometry_msgs/Point32")(x=x, y=y) for x, y in points]
        self._update(polygon)

    def next(self, x, y):
        p = self._next(pose_stamped("map", Time(0), (x, y, 0.0))).next_frontier.pose.position
        return round(p.x, 3), round(p.y, 3)


@pytest.fixture
def bounded(stage):
    stage.know(0.5, 0.5, 2.0, 2.0)
    return Bounded(stage, frontier_travel_point="closest")


def test_frontiers_inside_of_a_boundary(bounded, stage):
    bounded.bound((0.7, 0.7), (2.5, 0.7), (2.5, 1.5), (0.7, 1.5))
    assert bounded.next(1.05, 1.05) == (2.05, 1.05), "the only side that is open to the unknown"
    assert (bounded.costmap.grid.costs == 254).sum() == 2 * 19 + 2 * 7, "the cells of the edges"
    stage.know(2.0, 0.5, 3.0, 2.0)
    stage.graph.run(0.5)
    with pytest.raises(ServiceException, match="No valid frontiers found"):
        bounded.next(1.05, 1.05)


@pytest.mark.parametrize(
    ("point", "wanted"),
    [("closest", (2.05, 0.85)), ("closet", (2.05, 0.85)), ("middle", (2.05, 1.05)), ("centroid", (2.05, 1.05))],
)
def test_which_point_of_a_frontier(stage, point, wanted):
    stage.know(0.5, 0.5, 2.0, 2.0)
    bounded = Bounded(stage, frontier_travel_point=point)
    bounded.bound((0.7, 0.7), (2.5, 0.7), (2.5, 1.5), (0.7, 1.5))
    assert bounded.next(0.95, 0.85) == wanted


def test_without_a_vertex_the_costmap_is_the_area(bounded):
    bounded.bound()
    assert bounded.next(1.05, 1.45) in {(0.45, 1.45), (1.05, 2.05)}
    edge = np.concatenate([bounded.costmap.grid.costs[0], bounded.costmap.grid.costs[:, -1]])
    assert (edge == 254).all()


def test_the_cloud_marks_the_one_that_is_chosen(bounded):
    bounded.bound((0.0, 0.7), (3.0, 0.7), (3.0, 1.5), (0.0, 1.5))
    bounded.graph.run(0.2)
    bounded.next(1.75, 1.05)
    bounded.graph.run(0.2)
    rows = np.frombuffer(bytes(bounded.clouds[-1].data), dtype="<f4").reshape(-1, 4)
    assert sorted(rows[:, 3].tolist()) == [50.0, 100.0]
    assert rows[rows[:, 3] == 100.0][0, 0] == pytest.approx(2.05)
    assert bounded.clouds[-1].header.frame_id == "map"


def test_the_costmap_takes_the_size_of_the_boundary(stage):
    stage.know(0.5, 0.5, 2.0, 2.0)
    bounded = Bounded(stage, resize_to_boundary=True)
    bounded.bound((0.7, 0.7), (2.5, 0.7), (2.5, 1.5), (0.7, 1.5))
    assert (bounded.costmap.grid.width, bounded.costmap.grid.height) == (19, 9)
    assert bounded.costmap.grid.origin == pytest.approx((0.7, 0.7))


def test_known_space_is_explored_again(stage):
    stage.know(0.0, 0.0, 4.0, 3.0)
    bounded = Bounded(stage, explore_clear_space=True)
    bounded.bound((0.7, 0.7), (2.5, 0.7), (2.5, 1.5), (0.7, 1.5))
    stage.graph.run(0.5)
    grid = bounded.costmap.grid
    assert grid.cost(*grid.world_to_map(1.0, 1.0)) == 255


@pytest.mark.parametrize(
    ("points", "frame", "text"),
    [
        ([(1, 1), (2, 2)], "map", "a polygon of 2 vertices has no area"),
        ([(1, 1), (2, 2), (2, 1), (1, 2)], "map", "edges after vertices 1 and 3"),
        ([(50, 50), (51, 50), (51, 51)], "map", r"from \(50.00, 50.00\) to \(51.00, 51.00\), does not overlap"),
        ([(1, 1), (2, 1), (2, 2)], "moon", "Couldn't transform from map to moon"),
    ],
)
def test_boundaries_that_are_none(bounded, stage, points, frame, text):
    with pytest.raises(ServiceException, match=text):
        bounded.bound(*points, frame=frame)
    assert stage.logs[-1].level == 8
    bounded.bound((0.7, 0.7), (2.5, 0.7), (2.5, 1.5), (0.7, 1.5))
    assert bounded.next(1.05, 1.05) == (2.05, 1.05), "and the next one is taken"
