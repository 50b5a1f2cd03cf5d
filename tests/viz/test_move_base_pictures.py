"""The inside of a `move_base` as a picture."""

import io
import xml.etree.ElementTree as ET

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def graph():
    said = io.StringIO()
    with Graph() as graph:
        console = {"stdout": said, "stderr": said}
        roslaunch("rosmini_sim", "navigation.launch", graph=graph, console=console, world="room", noise="0")
        graph.run(3.0)
        yield graph


def drawn(picture, kind):
    """The texts of all shapes of a kind."""
    root = ET.fromstring(picture.svg)
    groups = [group for group in root.iter(f"{SVG}g") if group.get("class") == kind]
    return sorted(" ".join("".join(line.itertext()) for line in group.iter(f"{SVG}text")) for group in groups)


def test_it_has_the_loaded_parts_and_the_nodes_around_them(graph):
    picture = graph.nodes["/move_base"].program.show(title="Figure 1: inside")
    assert "local planner dwa_local_planner/DWAPlannerROS" in drawn(picture, "rm-part")
    assert len(drawn(picture, "rm-part")) == 7
    # Twice: what it measures comes from above, what it is commanded goes down.
    assert drawn(picture, "rm-node").count("/simulator") == 2
    assert drawn(picture, "rm-edge").count("/scan") == 2
    lines = picture.text.splitlines()
    assert lines[0] == "Figure 1: inside: 7 parts"
    assert "  /map_server -> global_costmap: /map" in lines
    assert "  /robot_state_publisher -> transforms: /tf, /tf_static" in lines
    assert "  local planner -> /simulator: /cmd_vel" in lines
    assert "navfn/NavfnROS" in picture.alt
    assert picture.caption == "Figure 1: inside"


def test_a_goal_comes_from_its_topic_until_a_node_sends_one(graph):
    program = graph.nodes["/move_base"].program
    assert drawn(program.show(), "rm-topic") == ["/move_base/goal", "/move_base_simple/goal"]
    node = graph.node("clicker")
    node.publisher("move_base_simple/goal", message_class("geometry_msgs/PoseStamped"), queue_size=1)
    picture = program.show()
    assert drawn(picture, "rm-topic") == []
    assert "  /clicker -> states: /move_base_simple/goal" in picture.text.splitlines()
