"""The obstacle layer with several sources, and with ones that keep what they saw."""

from __future__ import annotations

import math

import pytest

from rosmini.msgs import message_class

from .conftest import SOURCE, WINDOW, layers

NOTHING = [math.inf] * 3


def lethal(costmap):
    return int((costmap.grid.costs == 254).sum())


def cloud(stage, topic="cloud"):
    """What publishes points of the frame odom, at this moment."""
    kind, point = message_class("sensor_msgs/PointCloud"), message_class("geometry_msgs/Point32")
    publisher = stage.robot.publisher(topic, kind)
    stage.graph.run(0.1)

    def send(*points):
        header = message_class("std_msgs/Header")(stamp=stage.robot.now(), frame_id="odom")
        publisher.publish(kind(header, [point(*each) for each in points], []))
        stage.graph.run(0.3)

    return send


def test_sources_of_several_kinds_mark_together(stage):
    sources = {"observation_sources": "scan cloud", "scan": SOURCE, "cloud": {"data_type": "PointCloud"}}
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=sources, **WINDOW)
    send = cloud(stage)
    stage.scan([0.8] * 4)
    send((0.45, 0.45, 0.5), (1.65, 1.65, 0.5))
    assert lethal(costmap) == 6


def test_one_source_may_clear_what_another_marked_and_all_clear_before_one_marks(stage):
    clears = {"data_type": "LaserScan", "topic": "scan", "marking": False, "clearing": True}
    marks = {"data_type": "PointCloud", "topic": "cloud", "marking": True, "clearing": False}
    sources = {"observation_sources": "marks clears", "marks": marks, "clears": clears}
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=sources, **WINDOW)
    stage.pose = (0.0, 0.0, 0.0)
    send = cloud(stage)
    send((1.0, 0.0, 0.5))
    assert lethal(costmap) == 1
    stage.scan([1.5, *NOTHING], seconds=0.5)
    assert lethal(costmap) == 1, "the newest cloud still shows it"
    send((0.0, 1.0, 0.5))
    there = costmap.grid.world_to_map(1.0, 0.0)
    assert costmap.grid.cost(*there) == 0
    assert lethal(costmap) == 1


def test_a_late_source_is_told_though_another_is_on_time(stage, capfd):
    late = {"data_type": "PointCloud", "topic": "cloud", "expected_update_rate": 0.5}
    sources = {"observation_sources": "scan late", "scan": {**SOURCE, "expected_update_rate": 0.5}, "late": late}
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=sources, **WINDOW)
    for _ in range(4):
        stage.scan([1.0] * 4)
    assert not costmap.is_current
    said = "".join(capfd.readouterr())
    assert "The cloud observation buffer has not been updated" in said
    assert "The scan observation buffer has not been updated" not in said
    cloud(stage)()
    stage.scan([1.0] * 4)
    assert costmap.is_current


@pytest.mark.parametrize(("persistence", "stays"), [(0.0, False), (2.0, True)])
def test_what_a_source_saw_marks_as_long_as_it_persists(stage, persistence, stays):
    source = {**SOURCE, "observation_persistence": persistence}
    sources = {"observation_sources": "scan", "scan": source}
    costmap = stage.costmap(plugins=layers("obstacles"), obstacles=sources, **WINDOW)
    stage.pose = (0.0, 0.0, 0.0)
    stage.scan([1.0, *NOTHING])
    there = costmap.grid.world_to_map(1.0, 0.0)
    stage.scan([1.5, *NOTHING], seconds=0.5)
    assert (costmap.grid.cost(*there) == 254) == stays
    stage.graph.run(3.0)
    assert (costmap.grid.cost(*there) == 254) == stays, "as in costmap_2d only a newer message ends it"
    stage.scan([1.5, *NOTHING], seconds=0.5)
    assert costmap.grid.cost(*there) == 0
    assert lethal(costmap) == 1
