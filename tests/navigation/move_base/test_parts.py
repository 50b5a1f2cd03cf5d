"""What a running `move_base` is made of."""

import io

import pytest

from rosmini.core.graph import Graph
from rosmini.navigation.move_base.parts import RECOVERIES, STATES, TRANSFORMS, structure_of
from rosmini.navigation.nav_core import BaseGlobalPlanner
from rosmini.ros.launch import roslaunch


class Blind(BaseGlobalPlanner, plugin="test_parts/Blind"):
    """Needs no costmap."""

    def initialize(self, name, costmap):
        self.name = name

    def make_plan(self, start, goal):
        return [start, goal]


@pytest.fixture(scope="module")
def move_base():
    said = io.StringIO()
    with Graph() as graph:
        console = {"stdout": said, "stderr": said}
        roslaunch("rosmini_sim", "navigation.launch", graph=graph, console=console, world="room", noise="0")
        graph.run(3.0)
        yield graph.nodes["/move_base"].program


def parts(move_base):
    return {part.name: part for part in structure_of(move_base).parts}


def test_layers_and_planners_say_what_they_hear(move_base):
    found = parts(move_base)
    assert {name: part.subscribes for name, part in found.items()} == {
        STATES: {"/move_base/goal", "/move_base_simple/goal"},
        TRANSFORMS: {"/tf", "/tf_static"},
        "global_costmap": {"/map", "/scan"},
        "local_costmap": {"/scan"},
        "global planner": set(),
        "local planner": {"/odom"},
        RECOVERIES: set(),
    }
    heard = frozenset().union(*(part.subscribes for part in found.values()))
    assert heard <= set(move_base.node.subscriptions)
    assert {name for name, part in found.items() if part.publishes == {"/cmd_vel"}} == {"local planner", RECOVERIES}


def test_the_lines_name_what_is_loaded(move_base):
    found = parts(move_base)
    assert found["global planner"].lines == ("global planner", "navfn/NavfnROS")
    assert found["local_costmap"].lines[1:] == ("60 x 60 cells, frame odom", "obstacle_layer", "inflation_layer")
    assert found[RECOVERIES].lines[1:3] == ("1. conservative_reset", "2. rotate_recovery")
