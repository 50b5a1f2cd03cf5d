"""A pad that drives turtles: the scripted twin, and what its page is told."""

import json
import math

import pytest

from rosmini import rosrun
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.viz.live.key_maps import TeleopError
from rosmini.viz.live.pad import TeleopPad
from rosmini.viz.live.page import pad_data

from .test_live import page_of


@pytest.fixture
def sim(graph):
    return rosrun("turtlesim", "turtlesim_node", graph=graph).instance()


@pytest.fixture
def heard(graph, sim):
    """What turtle1 is sent."""
    found = []
    graph.node("listener").subscriber("/turtle1/cmd_vel", Twist, lambda t: found.append((t.linear.x, t.angular.z)))
    return found


def test_a_key_is_one_message_which_the_turtle_follows_for_a_second(sim, graph, heard):
    pad = sim.pad()
    assert (pad.topic, pad.keys, pad.chosen) == ("/turtle1/cmd_vel", "turtle_teleop_key", "turtle1")
    pad.press("up")
    graph.run(0.5)
    assert not pad.teleop.at_rest
    graph.run(1.5)
    assert (heard, pad.teleop.at_rest) == ([(2.0, 0.0)], True)
    turtle = sim.turtles["turtle1"]
    assert turtle.x == pytest.approx(5.544445 + 2.0, abs=0.04)
    pad.press("left")
    pad.stop()
    assert heard[1:] == []  # in one moment, and its node has a queue of one
    graph.run(0.1)
    assert turtle.theta == 0.0
    assert pad.text.splitlines()[2].startswith("turtle1 at (7.5")


def test_several_turtles_and_the_keys_of_other_programs(sim, graph):
    sim.spawn(2.0, 2.0, math.pi / 2)
    pad = TeleopPad(sim, robot="turtle2")
    pad.use("teleop_twist_keyboard")
    assert pad.choices == ("turtle1", "turtle2")
    pad.press("i")
    graph.run(2.0)  # it goes on, since the message is sent again
    assert sim.turtles["turtle2"].y == pytest.approx(3.0, abs=0.05)
    pad.press("J")
    graph.run(1.0)
    assert sim.turtles["turtle2"].x == pytest.approx(1.5, abs=0.05)  # to its left
    pad.choose("turtle1")
    assert (pad.topic, pad.teleop.at_rest) == ("/turtle1/cmd_vel", True)
    graph.run(0.1)
    before = sim.turtles["turtle2"].x
    graph.run(0.5)
    assert sim.turtles["turtle2"].x == before
    with pytest.raises(TeleopError, match=r"no turtle 'turtle3' in the window of /turtlesim; .*turtle"):
        pad.choose("turtle3")


def test_a_turtle_that_was_killed_is_said_clearly_and_the_graph_goes_on(sim, graph):
    pad = sim.pad()
    pad.press("up")
    sim._kill(type("Request", (), {"name": "turtle1"}))
    assert graph.run(0.5).reason == "time"
    assert "nothing to drive: the turtle 'turtle1' is no longer in the window of /turtlesim" in pad.text
    with pytest.raises(TeleopError, match="The graph keeps running"):
        pad.press("up")
    with pytest.raises(TeleopError, match="there are: none"):
        sim.pad("turtle1")


def test_reset_is_the_window_s_service(sim, graph):
    pad = sim.pad()
    pad.press("up")
    graph.run(1.5)
    pad.reset()
    graph.run(0.1)
    assert sim.turtles["turtle1"].x == pytest.approx(5.544445)
    assert sim.frame.paper.count == 0


def test_a_border_blocks(sim, graph):
    pad = sim.pad()
    pad.use("teleop_twist_keyboard")
    pad.press("i")
    graph.run(2.0)
    assert not pad.turtle.blocked
    graph.run(15.0)
    assert pad.turtle.blocked
    assert pad.turtle.sample_pose()[0] == pytest.approx(11.088889)


def test_its_page_knows_the_window_and_is_sent_what_is_new(sim, graph):
    pad = sim.pad()
    data = json.loads(json.dumps(pad_data(pad)))
    assert (data["scene"], data["turtle"]["name"], data["turtle"]["pose_topic"]) == (None, "turtle1", "/turtle1/pose")
    assert [table["name"] for table in data["maps"]][-1] == "turtle_teleop_key"
    page = page_of(pad)
    page.say("key", key="ArrowUp")
    page.run(0.5)
    windows = [content["window"] for content, _ in page.frames() if "window" in content]
    strokes = [len(window["strokes"]) for window in windows]
    assert sum(strokes) == windows[-1]["next"] == sim.frame.paper.count > 20
    assert max(strokes) <= 5  # each of them is sent once
    page.sent.clear()
    page.say("hello")  # a page that was opened later gets all
    page.run(0.1)
    assert page.frames()[0][0]["window"]["first"] == 0
    assert len(page.frames()[0][0]["window"]["strokes"]) > 20
    page.say("reset")
    page.run(0.2)
    assert page.frames()[-1][0]["window"]["clears"] == 1
