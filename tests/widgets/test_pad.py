"""The pad's scripted twin on a graph: what it publishes, says, and does when there is nothing to drive."""

from __future__ import annotations

import pytest

from rosmini import Graph
from rosmini.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.simulator import Simulator
from rosmini.widgets import Limits, TeleopError, TeleopPad


def test_a_key_publishes_at_once_and_then_every_tenth_of_a_second(graph, heard):
    pad = TeleopPad(graph)
    pad.press("w")
    graph.run(0.35)
    assert heard == [(0.0, 0.005, 0.0), (0.1, 0.01, 0.0), (0.2, 0.01, 0.0), (0.3, 0.01, 0.0)]


def test_a_second_key_begins_a_cycle_of_its_own(graph, heard):
    pad = TeleopPad(graph)
    pad.press("w")
    graph.run(0.04)
    pad.press("a")
    graph.run(0.15)
    assert heard == [(0.0, 0.005, 0.0), (0.04, 0.01, 0.05), (0.14, 0.01, 0.1)]


def test_several_presses_at_one_moment_are_several_messages(graph, heard):
    pad = TeleopPad(graph)
    pad.press("w", times=3)
    pad.press("right", 2)
    graph.run(0.05)
    assert heard == [
        (0.0, 0.005, 0.0), (0.0, 0.01, 0.0), (0.0, 0.015, 0.0), (0.0, 0.02, -0.05), (0.0, 0.025, -0.1),
    ]  # fmt: skip
    assert pad.sent == 5


def test_after_a_stop_it_is_silent(graph, heard):
    pad = TeleopPad(graph)
    pad.press("w", times=10)
    graph.run(1.0)
    heard.clear()
    pad.stop()
    report = graph.run()
    assert [entry[1:] for entry in heard] == [(0.0, 0.0)]
    assert report.reason == "drained"
    assert pad.twist == Twist()


def test_a_target_that_goes_back_to_zero_ends_with_a_zero(graph, heard):
    pad = TeleopPad(graph)
    pad.press("w")
    pad.press("w")
    graph.run(0.25)
    pad.press("x")
    pad.press("x")
    graph.run()
    assert [v for _, v, _ in heard[-3:]] == [0.01, 0.005, 0.0]


def test_the_robot_drives(simulator, graph):
    pad = TeleopPad(simulator)
    pad.press("w", times=20)
    graph.run(4.0)
    x, y, theta = simulator.truth()
    # the command rises to 0.1 m/s in twenty presses of one moment, and by 0.05 m/s a second to 0.2 from there
    assert x == pytest.approx(0.1 * 2 + 0.05 * 2**2 / 2 + 0.2 * 2, abs=0.02)
    assert (y, theta) == (pytest.approx(0, abs=1e-9), pytest.approx(0, abs=1e-9))
    pad.stop()
    graph.run(1.0)
    rest = simulator.truth()
    graph.run(1.0)
    assert simulator.truth() == rest


def test_its_command_does_not_run_out_while_it_drives(simulator, graph):
    pad = TeleopPad(simulator)
    pad.press("w")
    graph.run(20.0)  # the robot stops half a second after the last message
    assert simulator.truth()[0] == pytest.approx(0.2, abs=0.01)


def test_a_pad_has_a_simulators_namespace_and_remappings(graph):
    simulator = Simulator(graph.node("simulator", namespace="/robot1", remappings={"cmd_vel": "drive"}))
    pad = TeleopPad(simulator)
    assert (pad.topic, pad.node.name) == ("/robot1/drive", "/robot1/teleop_pad")


def test_the_limits_are_those_of_the_robot_unless_given(simulator, graph):
    assert TeleopPad(simulator).teleop.limits == Limits(0.22, 2.84)
    pad = TeleopPad(graph, name="slow", limits=Limits(0.05, 0.5))
    pad.press("w", times=30)
    assert pad.teleop.target == (0.05, 0.0)


def test_the_text_says_how_things_are(simulator, graph):
    pad = TeleopPad(simulator)
    pad.press("w", times=2)
    pad.press("a", times=3)
    graph.run(1.95)
    assert (
        str(pad)
        == pad.text
        == (
            "teleop_pad publishes geometry_msgs/Twist on /cmd_vel\n"
            "wanted 0.02 m/s and 0.3 rad/s; sent 0.02 m/s and 0.3 rad/s; 24 messages\n"
            f"{pad.sight.describe()}"
        )
    )
    assert pad.sight.describe().startswith("burger at (0.0")
    assert pad.sight.describe().endswith("of 360 beams hit")


def test_a_pad_before_the_first_scan_says_so(simulator):
    assert TeleopPad(simulator).text.endswith("burger at (0.00, 0.00, 0.0 deg) in room; no scan yet")


def test_reset_stops_and_puts_the_robot_back(simulator, graph):
    pad = TeleopPad(simulator)
    pad.press("w", times=10)
    graph.run(2.0)
    pad.reset()
    graph.run(1.0)
    assert simulator.truth() == pytest.approx((0, 0, 0), abs=1e-9)
    assert pad.teleop.at_rest


def test_a_removed_robot_is_said_clearly_and_the_graph_goes_on(simulator, graph):
    pad = TeleopPad(simulator)
    pad.press("w", times=5)
    graph.run(0.5)
    sent = pad.sent
    simulator.remove()
    assert graph.run(1.0).reason == "time"
    assert pad.sent == sent
    assert "nothing to drive: the robot 'burger' is no longer in the world 'room'" in pad.text
    with pytest.raises(TeleopError, match="nothing to drive: the robot 'burger' is no longer"):
        pad.press("w")
    with pytest.raises(TeleopError, match="The graph goes on"):
        pad.reset()
    assert graph.run(1.0).reason == "time"


def test_a_pad_whose_node_was_shut_down_says_so(graph):
    pad = TeleopPad(graph)
    pad.press("w")
    pad.node.shutdown("over")
    graph.run(1.0)
    assert pad.text.endswith("nothing to drive: the node /teleop_pad was shut down.")
    with pytest.raises(TeleopError, match="the node /teleop_pad was shut down"):
        pad.press("w")


def test_wrong_uses_are_refused(graph):
    with pytest.raises(TeleopError, match="not a str"):
        TeleopPad("burger")
    pad = TeleopPad(graph)
    with pytest.raises(TeleopError, match="no simulator"):
        pad.reset()
    with pytest.raises(TeleopError, match="not 0 times"):
        pad.press("w", times=0)
    with pytest.raises(TeleopError, match="no key 'q'"):
        pad.press("q")
    assert pad.sent == 0


def test_the_errors_are_rosminis():
    assert issubclass(TeleopError, RosminiError)


def test_the_first_message_is_not_lost(graph, heard):
    graph.node("late").subscriber("cmd_vel", Twist, lambda twist: None)
    pad = TeleopPad(graph)
    pad.press("w")
    graph.run(0.01)
    assert len(heard) == 1


def test_a_pad_needs_nobody_who_listens():
    with Graph() as graph:
        assert TeleopPad(graph).sent == 0


def test_a_pad_that_is_made_again_takes_the_place_of_the_first(simulator, graph, heard, capfd):
    first = TeleopPad(simulator)
    first.press("w")
    graph.run(0.25)
    second = TeleopPad(simulator)
    heard.clear()
    second.press("a")
    graph.run(0.15)
    assert [entry[1:] for entry in heard] == [(0.0, 0.05), (0.0, 0.1)]  # the first is silent
    assert "shut down" in first.text
    captured = capfd.readouterr()
    assert (captured.out, captured.err) == ("", "")
