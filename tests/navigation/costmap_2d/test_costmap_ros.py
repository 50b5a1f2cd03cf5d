"""A costmap of a node: parameters, topics, rates, and the layers together."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.errors import ParameterError
from rosmini.core.plugins import PluginError
from rosmini.core.tf.rigid import from_yaw
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.costmap import CostmapError
from rosmini.navigation.costmap_2d.layer import Layer
from rosmini.navigation.nav_core import TransformMissing, pose_stamped
from rosmini.ros.rospy.aliases.point_cloud2 import create_cloud_xyz32

from .conftest import ROBOT, SOURCE, WINDOW, layers

BOTH = {"observation_sources": "scan", "scan": SOURCE}


def heard(stage, topic, kind):
    messages = []
    stage.graph.node("listener").subscriber(topic, message_class(kind), messages.append)
    return messages


def log(capfd):
    return "".join(capfd.readouterr())


def test_a_map_gives_a_costmap_its_size_and_its_costs(stage, capfd):
    stage.publish_map([[0, 100, -1], [0, 0, 50]], resolution=0.5, origin=(-1.0, 2.0))
    costmap = stage.costmap(plugins=layers("static"), track_unknown_space=True, **ROBOT)
    grid = costmap.grid
    assert (grid.width, grid.height, grid.resolution, grid.origin) == (3, 2, 0.5, (-1.0, 2.0))
    assert grid.costs.tolist() == [[0, 254, 255], [0, 0, 0]]
    said = log(capfd)
    for line in (
        'costmap: Using plugin "static"',
        "Requesting the map...",
        "Resizing costmap to 3 X 2 at 0.500000 m/pix",
        "Received a 3 X 2 map at 0.500000 m/pix",
    ):
        assert line in said


@pytest.mark.parametrize("costmap_tracks", [None, False, True])
@pytest.mark.parametrize("layer_tracks", [None, False, True])
def test_unknown_cells_of_a_map(stage, costmap_tracks, layer_tracks):
    """What the costmap says is copied into the layer; the layer's own default is to track unknown space."""
    stage.publish_map([[0, -1]])
    given = {} if costmap_tracks is None else {"track_unknown_space": costmap_tracks}
    layer = {} if layer_tracks is None else {"static": {"track_unknown_space": layer_tracks}}
    costmap = stage.costmap(plugins=layers("static"), **given, **layer, **ROBOT)
    tracks = next(one for one in (costmap_tracks, layer_tracks, True) if one is not None)
    assert costmap.grid.costs.tolist() == [[0, 255 if tracks else 0]]


def test_a_scan_marks_and_clears(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=BOTH, **WINDOW)
    stage.pose = (0.0, 0.0, 0.0)
    stage.scan([1.0] + [math.inf] * 3)
    there = costmap.grid.world_to_map(1.0, 0.0)
    assert costmap.grid.cost(*there) == 254
    assert (costmap.grid.costs == 254).sum() == 1
    stage.scan([1.5] + [math.inf] * 3)
    assert costmap.grid.cost(*there) == 0
    assert costmap.grid.cost(*costmap.grid.world_to_map(1.5, 0.0)) == 254


@pytest.mark.parametrize("is_valid", [False, True])
def test_a_beam_that_met_nothing_clears_if_inf_is_valid(stage, is_valid):
    source = {**SOURCE, "inf_is_valid": is_valid, "raytrace_range": 3.0}
    costmap = stage.costmap(
        plugins=layers("obstacles"), obstacles={"observation_sources": "scan", "scan": source}, **WINDOW
    )
    stage.scan([1.0] * 4)
    stage.scan([math.inf] * 4)
    assert (costmap.grid.costs == 254).any() == (not is_valid)


def test_what_is_too_far_is_no_obstacle_and_clears_only_so_far(stage):
    source = {**SOURCE, "obstacle_range": 0.8, "raytrace_range": 0.5}
    costmap = stage.costmap(
        plugins=layers("obstacles"), obstacles={"observation_sources": "scan", "scan": source}, **WINDOW
    )
    stage.scan([0.7] * 4)
    assert (costmap.grid.costs == 254).sum() == 4
    stage.scan([1.2] * 4)
    assert (costmap.grid.costs == 254).sum() == 4


def test_a_scan_waits_for_its_transform(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=BOTH, **WINDOW)
    stage.scan([1.0] * 4, frame="laser")
    assert not (costmap.grid.costs == 254).any()
    stage.fixed.send("base_link", "laser", (0.1, 0.0, 0.0))
    stage.graph.run(0.3)
    assert (costmap.grid.costs == 254).sum() == 4


@pytest.mark.parametrize(
    "wrong",
    [
        {"ranges": [math.nan] * 4},
        {"ranges": []},
        {"ranges": [0.0, -1.0, 1e9, -math.inf]},
        {"angle_increment": math.nan},
        {"angle_min": math.inf},
    ],
)
def test_a_scan_of_nonsense_marks_nothing_and_hangs_nothing(stage, wrong):
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=BOTH, **WINDOW)
    stage.scan(**{"ranges": [1.0] * 4, **wrong})
    assert not (costmap.grid.costs == 254).any()
    stage.scan([1.0] * 4)
    assert (costmap.grid.costs == 254).sum() == 4


@pytest.mark.parametrize("kind", ["PointCloud", "PointCloud2"])
def test_clouds_mark_between_the_heights(stage, kind):
    source = {"data_type": kind, "topic": "cloud", "min_obstacle_height": 0.1, "max_obstacle_height": 1.0}
    costmap = stage.costmap(
        plugins=layers("obstacles"), obstacles={"observation_sources": "cloud", "cloud": source}, **WINDOW
    )
    publisher = stage.robot.publisher("cloud", message_class(f"sensor_msgs/{kind}"))
    stage.graph.run(0.1)
    header = message_class("std_msgs/Header")(stamp=stage.robot.now(), frame_id="odom")
    points = [(1.0, 1.5, 0.05), (1.0, 1.5, 1.5), (0.5, 0.5, 0.5), (math.nan, 0.0, 0.5)]
    if kind == "PointCloud2":
        message = create_cloud_xyz32(header, points)
    else:
        point = message_class("geometry_msgs/Point32")
        message = message_class("sensor_msgs/PointCloud")(header, [point(*each) for each in points], [])
    publisher.publish(message)
    stage.graph.run(0.3)
    grid = costmap.grid
    assert [(mx, my) for my, mx in np.argwhere(grid.costs == 254)] == [grid.world_to_map(0.5, 0.5)]


def test_the_window_rolls_with_the_robot_and_obstacles_stay_where_they_are(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=BOTH, **WINDOW)
    stage.pose = (0.0, 0.0, 0.0)
    stage.scan([1.0] + [math.inf] * 3)
    stage.pose = (0.55, 0.25, 0.0)
    stage.graph.run(0.5)
    assert costmap.grid.origin == pytest.approx((-1.5, -1.8))
    assert [costmap.grid.map_to_world(mx, my) for my, mx in np.argwhere(costmap.grid.costs == 254)] == [
        pytest.approx((1.05, 0.05))
    ]


def test_updates_in_the_window_equal_a_full_recompute(stage):
    rng = np.random.default_rng(5)
    costmap = stage.costmap(
        plugins=layers("obstacles", "inflation"),
        obstacles=BOTH,
        inflation={"inflation_radius": 0.37, "cost_scaling_factor": 3.0},
        **{**WINDOW, "update_frequency": 0.0},
    )
    for _ in range(12):
        stage.pose = tuple(stage.pose + rng.uniform(-0.3, 0.3, 3))
        stage.graph.run(0.1)
        stage.scan(rng.uniform(0.2, 4.0, 24))
        costmap.update()
        found = costmap.grid.costs.copy()
        costmap.layered._whole = True
        costmap.update()
        assert (costmap.grid.costs == found).all()


def test_only_what_changed_is_computed_and_published(stage):
    stage.publish_map(np.zeros((60, 60)), resolution=0.1)
    stage.pose = (3.0, 3.0, 0.0)
    whole = heard(stage, "move_base/costmap/costmap", "nav_msgs/OccupancyGrid")
    parts = heard(stage, "move_base/costmap/costmap_updates", "map_msgs/OccupancyGridUpdate")
    costmap = stage.costmap(
        plugins=layers("static", "obstacles", "inflation"), obstacles=BOTH, publish_frequency=5.0, **ROBOT
    )
    stage.graph.run(0.5)
    whole.clear()
    parts.clear()
    stage.scan([1.0] + [math.inf] * 7, seconds=0.6)
    assert whole == []
    assert parts
    assert costmap.layered.window.xn - costmap.layered.window.x0 < 40
    kept = np.full((60, 60), 0, dtype=np.int8)
    for part in parts:
        kept[part.y : part.y + part.height, part.x : part.x + part.width] = np.array(part.data).reshape(
            part.height, part.width
        )
    published = np.array([0, *range(1, 99), 99, 100])
    assert kept.max() == 100
    assert set(np.unique(kept)) <= set(published.tolist())
    assert (kept == 100).sum() == (costmap.grid.costs == 254).sum() == 1


@pytest.mark.parametrize(("update", "publish", "expected"), [(10.0, 10.0, 10), (10.0, 2.0, 2), (5.0, 0.0, 0)])
def test_rates_are_those_of_graph_time(stage, update, publish, expected):
    parameters = {**WINDOW, "update_frequency": update, "publish_frequency": publish}
    stage.costmap(plugins=layers("obstacles"), always_send_full_costmap=True, **parameters)
    messages = heard(stage, "move_base/costmap/costmap", "nav_msgs/OccupancyGrid")
    stage.graph.run(0.35)
    messages.clear()
    stage.graph.run(1.0)
    assert len(messages) == expected


def test_the_published_footprint_moves_with_the_robot_and_a_topic_changes_it(stage):
    footprints = heard(stage, "move_base/costmap/footprint", "geometry_msgs/PolygonStamped")
    costmap = stage.costmap(
        plugins=layers("obstacles"),
        footprint="[[0.1, 0.1], [0.1, -0.1], [-0.1, -0.1], [-0.1, 0.1]]",
        footprint_topic="/shape",
        **{**WINDOW, "footprint_padding": 0.02},
    )
    stage.pose = (1.0, 2.0, math.pi / 2)
    stage.graph.run(0.5)
    corners = [(round(p.x, 3), round(p.y, 3)) for p in footprints[-1].polygon.points]
    assert corners == [(0.88, 2.12), (1.12, 2.12), (1.12, 1.88), (0.88, 1.88)]
    kind = message_class("geometry_msgs/Polygon")
    publisher = stage.robot.publisher("/shape", kind)
    publisher.wait_for_subscribers()
    point = message_class("geometry_msgs/Point32")
    publisher.publish(kind([point(x=0.3, y=0.3), point(x=0.3, y=-0.3), point(x=-0.3, y=0.0)]))
    stage.graph.run(0.1)
    assert len(costmap.footprint) == 3
    assert costmap.circumscribed_radius == pytest.approx(math.hypot(0.32, 0.32))
    publisher.publish(kind([point(), point()]))
    stage.graph.run(0.1)
    assert len(costmap.footprint) == 3


def test_a_footprint_is_looked_for_upwards(stage):
    stage.node.set_param("~footprint", [[0.2, 0.2], [0.2, -0.2], [-0.2, 0]])
    costmap = stage.costmap(
        plugins=layers("obstacles"), global_frame="odom", rolling_window=True, footprint_padding=0.0
    )
    assert costmap.footprint.tolist() == [[0.2, 0.2], [0.2, -0.2], [-0.2, 0.0]]
    assert stage.node.get_param("~costmap/footprint") == "[[0.2,0.2],[0.2,-0.2],[-0.2,0]]"


def test_without_a_footprint_the_radius_is_that_of_the_real_one(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), global_frame="odom", rolling_window=True)
    assert costmap.circumscribed_radius == pytest.approx(np.hypot(*costmap.footprint[2]))
    assert costmap.footprint[0].tolist() == pytest.approx([0.47, 0.0]), "with the padding"


@pytest.mark.parametrize(
    ("parameters", "error", "said"),
    [
        ({"footprint": [[0, 0], [1, 1]]}, ParameterError, "at least three points"),
        ({"resolution": -0.1}, ParameterError, "greater than 0"),
        ({"resolution": 0.0}, ParameterError, "greater than 0"),
        ({"width": 100_000, "resolution": 0.001}, CostmapError, "use a coarser resolution"),
        ({"plugins": "obstacles"}, ParameterError, "plugins"),
        ({"update_frequency": "fast"}, ParameterError, "update_frequency"),
        ({"plugins": [{"name": "x", "type": "costmap_2d::InflatonLayer"}]}, PluginError, "InflationLayer"),
        ({"obstacles": {"observation_sources": "a", "a": {"data_type": "Laser"}}}, ParameterError, "LaserScan"),
        ({"obstacles": {"observation_sources": "a", "a": {"obstacle_range": "far"}}}, ParameterError, "far"),
    ],
)
def test_wrong_parameters_are_refused_by_name(stage, parameters, error, said):
    with pytest.raises(error, match=said):
        stage.costmap(**{"plugins": layers("obstacles"), **WINDOW, **parameters})


def test_unknown_names_are_warned_of_with_the_nearest(stage, capfd):
    stage.costmap(
        plugins=layers("obstacles", "inflation"), updat_frequency=3.0, inflation={"inflation_radios": 0.3}, **WINDOW
    )
    said = log(capfd)
    assert "did you mean ~costmap/update_frequency" in said
    assert "did you mean ~costmap/inflation/inflation_radius" in said


def test_sides_are_whole_metres_as_in_ros(stage, capfd):
    costmap = stage.costmap(
        plugins=layers("obstacles"), global_frame="odom", rolling_window=True, width=5.5, height=3.0
    )
    assert (costmap.grid.width, costmap.grid.height) == (120, 60)
    assert "whole metres, using 6 m" in log(capfd)


def test_what_changes_while_it_runs(stage):
    from rosmini.core.dynamic_reconfigure import Client

    stage.publish_map(np.eye(40) * 100)
    costmap = stage.costmap(plugins=layers("static", "inflation"), update_frequency=10.0, **ROBOT)
    client = Client(stage.robot, "/move_base/costmap/inflation")
    few = (costmap.grid.costs > 0).sum()
    client.update_configuration({"inflation_radius": 1.2, "cost_scaling_factor": 1.0})
    stage.graph.run(0.3)
    assert (costmap.grid.costs > 0).sum() > few
    Client(stage.robot, "/move_base/costmap/static").update_configuration({"enabled": False})
    stage.graph.run(0.3)
    assert not costmap.grid.costs.any()
    Client(stage.robot, "/move_base/costmap").update_configuration({"robot_radius": 0.3})
    assert costmap.circumscribed_radius == pytest.approx(0.3)


def test_a_stopped_costmap_hears_nothing_until_it_is_started(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=BOTH, **WINDOW)
    costmap.stop()
    stage.scan([1.0] * 4)
    assert costmap.stopped
    assert not (costmap.grid.costs == 254).any()
    costmap.start()
    stage.scan([1.0] * 4)
    assert (costmap.grid.costs == 254).sum() == 4
    costmap.reset_layers()
    assert not costmap.grid.costs.any()


def test_it_is_current_while_its_sources_are(stage, capfd):
    source = {**SOURCE, "expected_update_rate": 0.5}
    costmap = stage.costmap(
        plugins=layers("obstacles"), obstacles={"observation_sources": "scan", "scan": source}, **WINDOW
    )
    stage.scan([1.0] * 4)
    assert costmap.is_current
    stage.graph.run(1.0)
    assert not costmap.is_current
    assert "The scan observation buffer has not been updated for" in log(capfd)


def test_poses_and_why_there_is_none(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), transform_tolerance=0.2, **WINDOW)
    stage.pose = (0.5, -0.25, 0.5)
    stage.graph.run(0.2)
    pose = costmap.robot_pose()
    assert (pose.header.frame_id, pose.pose.position.x, pose.pose.position.y) == ("odom", 0.5, -0.25)
    moved = costmap.to_global(pose_stamped("base_link", stage.node.now(), (1.0, 0.0, 0.0)))
    assert moved.pose.position.x == pytest.approx(0.5 + math.cos(0.5))
    with pytest.raises(TransformMissing, match="nowhere"):
        costmap.to_global(pose_stamped("nowhere", stage.node.now(), (1.0, 0.0, 0.0)))
    stage.tells.shutdown()
    stage.graph.run(1.0)
    with pytest.raises(TransformMissing, match="transform timeout"):
        costmap.robot_pose()
    assert not costmap.update()


def test_a_layer_of_ones_own_and_one_that_fails(stage, capfd):
    class Puddle(Layer, plugin="test_costmap_ros::Puddle"):
        def update_bounds(self, robot, bounds):
            del robot
            bounds.touch(1.0, 1.0)

        def update_costs(self, grid, window):
            mx, my = grid.world_to_map(1.0, 1.0)
            if window.has(mx, my):
                grid.costs[my, mx] = 77

    class Broken(Layer, plugin="test_costmap_ros::Broken"):
        def update_bounds(self, robot, bounds):
            raise ZeroDivisionError("by nothing")

        def update_costs(self, grid, window):
            raise AssertionError

    plugins = [{"name": name, "type": f"test_costmap_ros::{name.title()}"} for name in ("broken", "puddle")]
    costmap = stage.costmap(plugins=plugins, **WINDOW)
    assert costmap.grid.cost(*costmap.grid.world_to_map(1.0, 1.0)) == 77
    assert not costmap.is_current
    assert "the layer broken (Broken) failed" in log(capfd)


def test_it_survives_a_gap_of_tf_and_a_scan_from_the_past(stage):
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=BOTH, **WINDOW)
    stage.tells.shutdown()
    stage.scan([1.0] * 4, seconds=3.0)
    assert not (costmap.grid.costs == 254).any()
    timer = stage.robot.timer(0.02, lambda _: stage.moving.send_rigid("odom", "base_link", from_yaw(*stage.pose)))
    stage.graph.run(0.5)
    stage.scan([1.0] * 4)
    assert (costmap.grid.costs == 254).sum() == 4
    old = Time.from_sec(stage.robot.now().to_sec() - 60)
    stage.scan([1.5] * 4, header=message_class("std_msgs/Header")(stamp=old, frame_id="base_link"))
    assert (costmap.grid.costs == 254).sum() == 4
    assert timer.is_alive()
