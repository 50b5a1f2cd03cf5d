"""Parameter files from before layers, in the shape of ROBOTIS's and navigation_stage's: which layers come of them."""

from __future__ import annotations

import pytest
import yaml

from .conftest import layers

ROBOTIS_COMMON = """
obstacle_range: 3.0
raytrace_range: 3.5
footprint: [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]
inflation_radius: 1.0
cost_scaling_factor: 3.0
map_type: costmap
observation_sources: scan
scan: {sensor_frame: base_link, data_type: LaserScan, topic: scan, marking: true, clearing: true}
"""
ROBOTIS_GLOBAL = """
global_frame: map
robot_base_frame: base_link
update_frequency: 10.0
publish_frequency: 10.0
transform_tolerance: 0.5
static_map: true
"""
STAGE_COMMON = """
map_type: costmap
transform_tolerance: 0.2
obstacle_range: 2.5
raytrace_range: 3.0
inflation_radius: 0.55
observation_sources: base_scan
base_scan: {data_type: LaserScan, expected_update_rate: 0.4, observation_persistence: 0.0,
  marking: true, clearing: true, max_obstacle_height: 0.4, min_obstacle_height: 0.08}
footprint: [[-0.325, -0.325], [-0.325, 0.325], [0.325, 0.325], [0.46, 0.0], [0.325, -0.325]]
"""
STAGE_GLOBAL = """
global_frame: /map
robot_base_frame: base_link
update_frequency: 5.0
publish_frequency: 0.0
static_map: true
rolling_window: false
"""


def tree(costmap):
    return [(layer.name, type(layer).plugin_name) for layer in costmap.layers]


def made(stage, *texts, **more):
    parameters = {}
    for text in texts:
        parameters.update(yaml.safe_load(text))
    return stage.costmap(**{**parameters, **more})


def test_robotis_global_costmap(stage, capfd):
    stage.publish_map([[0] * 40] * 40)
    costmap = made(stage, ROBOTIS_COMMON, ROBOTIS_GLOBAL)
    assert tree(costmap) == [
        ("static_layer", "costmap_2d/StaticLayer"),
        ("obstacle_layer", "costmap_2d/ObstacleLayer"),
        ("inflation_layer", "costmap_2d/InflationLayer"),
    ]
    said = "".join(capfd.readouterr())
    assert 'costmap: Parameter "plugins" not provided, loading pre-Hydro parameters' in said
    assert "has no parameter" not in said
    source = costmap.layers[1].sources[0]
    assert (source.topic, source.obstacle_range, source.raytrace_range) == ("scan", 3.0, 3.5)
    assert (costmap.layers[2].radius, costmap.layers[2].cost_scaling_factor) == (1.0, 3.0)
    assert costmap.inscribed_radius == pytest.approx(0.051)
    node = stage.node
    assert not node.has_param("~costmap/obstacle_range")
    assert node.get_param("~costmap/obstacle_layer/obstacle_range") == 3.0
    assert [entry["name"] for entry in node.get_param("~costmap/plugins")] == [
        "static_layer",
        "obstacle_layer",
        "inflation_layer",
    ]


def test_navigation_stage_global_costmap(stage, capfd):
    stage.publish_map([[0] * 40] * 40)
    costmap = made(stage, STAGE_COMMON, STAGE_GLOBAL)
    assert [name for name, _ in tree(costmap)] == ["static_layer", "obstacle_layer", "inflation_layer"]
    assert costmap.global_frame == "map"
    assert "leading slash" in "".join(capfd.readouterr())
    settings = costmap.layers[1].sources[0].settings
    assert (settings.min_obstacle_height, settings.max_obstacle_height) == (0.08, 0.4)
    assert settings.expected_update_rate == 0.4


def test_with_plugins_the_old_names_are_unused_and_said_so(stage, capfd):
    stage.costmap(
        plugins=layers("inflation"), global_frame="odom", rolling_window=True, static_map=False, map_type="voxel"
    )
    said = "".join(capfd.readouterr())
    for name in ("static_map", "map_type"):
        assert f'costmap: Pre-Hydro parameter "{name}" unused since "plugins" is provided' in said


def test_a_layer_takes_over_what_the_costmap_has(stage):
    costmap = stage.costmap(
        plugins=layers("obstacles", "inflation"),
        global_frame="odom",
        rolling_window=True,
        inflation_radius=0.8,
        inflation={"inflation_radius": 0.3, "cost_scaling_factor": 4.0},
    )
    inflation = costmap.layers[1]
    assert (inflation.radius, inflation.cost_scaling_factor) == (0.8, 4.0)
    assert stage.node.has_param("~costmap/inflation_radius")
