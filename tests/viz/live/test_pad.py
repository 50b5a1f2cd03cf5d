"""The pad's scripted twin on a graph: what it publishes, says, and does when there is nothing to drive."""

import pytest

from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.simulator import Simulator
from rosmini.viz.live.key_maps import TeleopError
from rosmini.viz.live.pad import TeleopPad


def test_a_key_publishes_at_once_and_then_every_tenth_of_a_second(graph, heard):
    pad = TeleopPad(graph)
    pad.press("w")
    graph.run(0.35)
    assert heard == [(0.0, 0.005, 0.0), (0.1, 0.01, 0.0), (0.2, 0.01, 0.0), (0.3, 0.01, 0.0)]


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


def test_a_pad_has_a_simulators_namespace_and_remappings(graph):
    simulator = Simulator(graph.node("simulator", namespace="/robot1", remappings={"cmd_vel": "drive"}))
    pad = TeleopPad(simulator)
    assert (pad.topic, pad.node.name) == ("/robot1/drive", "/robot1/teleop_pad")


def test_the_text_says_how_things_are(simulator, graph):
    pad = TeleopPad(simulator)
    pad.press("w", times=2)
    pad.press("a", times=3)
    graph.run(1.95)
    assert str(pad) == pad.text
    done = "wanted 0.02 m/s and 0.3 rad/s", "sent 0.02 m/s and 0.3 rad/s", "24 messages"
    for part in ("geometry_msgs/Twist on /cmd_vel", *done, pad.shown_robot.describe()):
        assert part in pad.text
    assert pad.shown_robot.describe().startswith("burger at (0.0")
    assert pad.shown_robot.describe().endswith("of 360 beams hit")


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
    with pytest.raises(TeleopError, match="The graph keeps running"):
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


@pytest.fixture
def two(graph):
    graph.master.setParam("/test", "/simulator/noise", 0.0)
    graph.master.setParam("/test", "/simulator/robots", 2)
    return Simulator(graph.node("simulator"))


def test_one_pad_drives_several_robots_one_at_a_time(two, graph):
    pad = two.pad()
    assert (pad.choices, pad.chosen, pad.topic) == (("tb3_0", "tb3_1"), "tb3_0", "/tb3_0/cmd_vel")
    stopped = []
    graph.node("listener").subscriber("/tb3_0/cmd_vel", Twist, lambda twist: stopped.append(twist.linear.x))
    pad.press("w", times=10)
    graph.run(1.0)
    pad.choose("tb3_1")
    assert (pad.chosen, pad.topic, pad.shown_robot.name) == ("tb3_1", "/tb3_1/cmd_vel", "tb3_1")
    graph.run(1.0)
    assert stopped[-1] == 0.0  # the first one stands
    rest, before = two.truth("tb3_0"), two.truth("tb3_1")
    pad.press("x", times=10)
    graph.run(2.0)
    assert two.truth("tb3_0") == rest
    assert two.truth("tb3_1")[:2] != pytest.approx(before[:2], abs=0.05)
    with pytest.raises(TeleopError, match=r"no robot 'tb3_2'.*tb3_"):
        pad.choose("tb3_2")
    assert pad.chosen == "tb3_1"


def test_on_a_graph_the_topics_that_are_heard_can_be_chosen(graph):
    heard = []
    for name in ("a", "b"):
        graph.node(name).subscriber(
            f"/{name}/cmd_vel", Twist, lambda twist, name=name: heard.append((name, twist.linear.x))
        )
    pad = TeleopPad(graph)
    assert pad.choices == ("/a/cmd_vel", "/b/cmd_vel", "/cmd_vel")
    pad.choose("/a/cmd_vel")
    pad.press("w")
    pad.choose("/b/cmd_vel")
    pad.press("w")
    graph.run(0.01)
    assert heard == [("a", 0.005), ("a", 0.0), ("b", 0.005)]
    with pytest.raises(
        TeleopError, match="no node subscribes to '/c/cmd_vel'; the pad can drive /a/cmd_vel, /b/cmd_vel"
    ):
        pad.choose("/c/cmd_vel")


def test_who_else_drives_is_known(graph):
    pad = TeleopPad(graph)
    assert pad.others == ()
    graph.node("autopilot").publisher("cmd_vel", Twist)
    assert pad.others == ("/autopilot",)


def test_the_keys_of_another_program(graph, heard):
    pad = TeleopPad(graph)
    pad.use("teleop_twist_keyboard")
    pad.press("u")
    graph.run(0.15)
    assert heard == [(0.0, 0.22, 1.0), (0.1, 0.22, 1.0)]
    pad.press("J")
    assert (pad.twist.linear.x, pad.twist.linear.y) == (0.0, 0.22)
    pad.press("5")  # any other key
    assert pad.twist == Twist()
    pad.use("turtlebot3_teleop_key")
    pad.press("w")
    assert (pad.keys, pad.twist.linear.x) == ("turtlebot3_teleop_key", 0.005)
    with pytest.raises(TeleopError, match="no program 'rviz' with keys"):
        pad.use("rviz")
