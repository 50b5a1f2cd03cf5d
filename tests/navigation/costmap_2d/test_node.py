"""The package's nodes, started as roslaunch starts them."""

from __future__ import annotations

import numpy as np

from rosmini.core.plugins import Plugin
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.node import Costmap2DNode, VoxelCloud, VoxelMarkers, voxel_points

from .conftest import layers


def voxel_grid():
    message = message_class("costmap_2d/VoxelGrid")()
    message.header.frame_id = "odom"
    message.size_x, message.size_y, message.size_z = 2, 1, 2
    message.resolutions.x = message.resolutions.y = 0.1
    message.resolutions.z = 0.5
    message.origin.x = 1.0
    message.data = [0b01 | 0b10 << 16 | 0b10, 0]
    return message


def test_a_costmap_alone(stage):
    node = stage.graph.node("costmap_node")
    node.set_param(
        "~costmap",
        {"plugins": layers("inflation"), "global_frame": "odom", "rolling_window": True, "width": 2, "height": 2},
    )
    program = Costmap2DNode(node)
    assert program.costmap.grid.costs.shape == (40, 40)
    assert "/costmap_node/costmap/costmap" in node.publications
    assert issubclass(type(program.costmap.layers[0]), Plugin)


def test_voxels_by_their_bits():
    marked, unknown = voxel_points(voxel_grid())
    assert np.allclose(marked, [(1.05, 0.05, 0.75)])
    assert np.allclose(unknown, [(1.05, 0.05, 0.25)])


def test_markers_and_clouds(stage):
    graph = stage.graph
    VoxelMarkers(graph.node("markers"))
    VoxelCloud(graph.node("cloud"))
    seen = {}
    listener = graph.node("listener")
    for topic, kind in (
        ("visualization_marker", "visualization_msgs/Marker"),
        ("voxel_marked_cloud", "sensor_msgs/PointCloud"),
        ("voxel_unknown_cloud", "sensor_msgs/PointCloud"),
    ):
        listener.subscriber(topic, message_class(kind), seen.setdefault(topic, []).append)
    publisher = stage.robot.publisher("voxel_grid", message_class("costmap_2d/VoxelGrid"))
    publisher.wait_for_subscribers(2)
    graph.run(0.1)
    publisher.publish(voxel_grid())
    graph.run(0.1)
    assert [len(messages) for messages in seen.values()] == [1, 1, 1]
    marker = seen["visualization_marker"][0]
    assert (marker.type, marker.ns, marker.scale.z) == (6, "/markers", 0.5)
    assert [round(point.z, 3) for point in marker.points] == [0.75]
