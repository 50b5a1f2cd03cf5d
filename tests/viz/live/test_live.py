"""What goes between a pad and its page, with the page played by the test and the wall's clock set by it."""

import sys
import threading
from urllib.request import urlopen

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.simulator import Simulator
from rosmini.viz.live.key_maps import TeleopError
from rosmini.viz.live.live import Link
from rosmini.viz.live.loopback import PageServer
from rosmini.viz.live.pad import TeleopPad

from .pages import Page


def page_of(pad):
    return Page(pad.graph, lambda clock: Link(pad, clock=clock))


@pytest.fixture
def pad(simulator):
    return TeleopPad(simulator)


@pytest.fixture
def page(pad):
    return page_of(pad)


def test_a_key_of_the_page_does_what_the_twin_does(page, pad, heard):
    page.say("key", key="w")
    page.say("key", key="ArrowLeft")
    page.run(0.05)
    assert [entry[1:] for entry in heard] == [(0.005, 0.0), (0.01, 0.05)]
    assert pad.sent == 2


def test_the_first_key_makes_the_graph_live(page):
    page.say("hello")
    assert page.lives == 0
    page.say("key", key="w")
    assert page.lives == 1
    page.say("key", key="w")
    page.say("start")
    assert page.lives == 1


def test_a_graph_that_cannot_be_live_says_why(pad, page):
    def refuse():
        raise RosminiError("a live graph needs an event loop")

    pad.graph.live = refuse
    page.say("key", key="w")
    assert [content for content, _ in page.sent] == [{"type": "refused", "text": "a live graph needs an event loop"}]
    page.run(0.1, beats=False)
    assert pad.sent == 0


def test_a_graph_that_a_program_drives_needs_no_event_loop(pad, page, graph):
    def refuse():
        raise RosminiError("a live graph needs an event loop")

    pad.graph.live = refuse
    graph.node("program").timer(0.1, lambda _: page.say("key", key="w"), oneshot=True)
    graph.run(0.5)
    assert pad.teleop.command == (0.01, 0.0)
    assert "refused" not in page.kinds()


def test_a_pad_is_served_as_a_page_on_loopback(pad):
    with PageServer(pad.link.widget, title="Drive on /cmd_vel") as server, urlopen(server.url) as answer:
        assert "<title>Drive on /cmd_vel</title>" in answer.read().decode()


def test_frames_are_few_while_nothing_moves_and_end_when_nobody_looks(page):
    page.say("start")
    page.run(1.0)
    page.sent.clear()
    page.run(2.0)
    assert 8 <= len(page.frames()) <= 21  # the scans, five a second, and a sign of life between
    page.run(4.0, beats=False)
    page.sent.clear()
    page.run(1.0, beats=False)
    assert page.frames() == []
    page.run(0.5)  # the page is back
    assert page.frames() != []


def test_a_frame_holds_what_is_wanted_and_sent_and_where_the_robot_is(page, pad, simulator):
    page.say("key", key="w")
    page.say("key", key="a")
    page.run(1.05)
    content, numbers = page.frames()[-1]
    assert numbers[:4].tolist() == [0.01, 0.1, 0.01, 0.1]
    assert numbers[4:] == pytest.approx(simulator.truth(), abs=5e-3)
    assert (content["at_rest"], content["blocked"], content["sent"]) == (False, False, pad.sent)
    messages = [message for content, _ in page.frames() for message in content["messages"]]
    assert messages[:3] == [[0.005, 0.0], [0.01, 0.05], [0.01, 0.1]]


def test_scans_come_with_the_poses_that_their_beams_were_taken_from(page, simulator):
    page.say("key", key="a")
    page.run(1.15)
    scans = [buffers[1] for content, buffers in page.sent if content.get("scan")]
    assert len(scans) == 5
    last = np.frombuffer(scans[-1], dtype=np.float32)
    assert last[:360] == pytest.approx(np.asarray(simulator.last_scan().ranges, dtype=np.float32))
    poses = last[360:].reshape(360, 3)
    assert poses == pytest.approx(simulator.scan_poses)
    assert np.ptp(poses[:, 2]) > 0.005  # it turned while the laser swept


def test_without_a_word_from_the_page_the_robot_stops(page, pad):
    page.say("key", key="w")
    page.run(3.0)
    assert pad.teleop.command == (0.01, 0.0)
    page.run(0.7, beats=False)
    assert pad.teleop.command == (0.01, 0.0)
    page.run(0.4, beats=False)
    assert pad.teleop.at_rest
    assert pad.twist.linear.x == 0.0


def test_a_page_that_loses_the_focus_stops_the_robot(page, pad, heard):
    page.say("key", key="w")
    page.run(0.5)
    page.say("stop")
    page.run(0.5)
    assert heard[-1][1:] == (0.0, 0.0)
    count = pad.sent
    page.say("stop")  # at rest already: nothing to say
    page.run(0.2)
    assert pad.sent == count


def test_a_removed_robot_is_told_to_the_page_and_the_graph_goes_on(page, pad, simulator):
    page.say("key", key="w")
    page.run(0.5)
    simulator.remove()
    page.run(0.5)
    gone = [content for content, _ in page.sent if content["type"] == "gone"]
    assert "the robot 'burger' is no longer in the world 'room'" in gone[0]["text"]
    page.say("key", key="w")
    page.run(0.5)
    assert page.graph.run(1.0).reason == "time"


def test_a_page_that_opens_later_gets_the_way_so_far(page, pad, graph):
    page.say("key", key="w")
    for _ in range(15):
        page.say("key", key="w")
    page.run(5.0)
    page.say("hello")
    page.run(0.1)
    (trail,) = (buffers[0] for content, buffers in page.sent if content["type"] == "trail")
    points = np.frombuffer(trail, dtype=np.float32).reshape(-1, 2)
    steps = np.hypot(*np.diff(points, axis=0).T)
    assert len(points) > 10
    assert (steps >= 0.0199).all()
    assert steps.max() < 0.03


def test_the_page_sees_what_the_robot_pushes(page, simulator):
    crate = next(obstacle for obstacle in simulator.world.obstacles if obstacle.movable)
    x, y, _ = crate.pose
    simulator.place((x - 0.3, y, 0.0))
    page.say("start")
    page.run(0.3)
    for _ in range(20):
        page.say("key", key="w")
    page.run(1.0)
    page.sent.clear()
    page.run(1.0)
    shapes = [content["pushed"] for content, _ in page.frames() if "pushed" in content]
    assert len(shapes) > 10
    middle = np.mean(shapes[-1][0]["points"], axis=0)
    assert middle == pytest.approx(simulator.engine.obstacles()[0].pose[:2], abs=0.01)
    assert middle[0] > x + 0.05
    assert page.link.widget.data["scene"]["shapes"][-1]["colour"] == crate.colour


def test_a_wrong_key_from_a_page_changes_nothing(page, pad):
    page.say("key", key="q")
    page.say("key")
    page.run(0.1)
    assert pad.sent == 0
    assert "no key 'q'" in next(content["text"] for content, _ in page.sent if content["type"] == "refused")
    assert page.frames() != []


def test_pages_speak_from_any_thread(page, pad):
    thread = threading.Thread(target=page.say, args=("key",), kwargs={"key": "w"})
    thread.start()
    thread.join()
    page.run(0.05)
    assert pad.sent == 1


def test_without_anywidget_the_twin_works_and_the_page_says_what_to_install(graph, monkeypatch):
    for name in ("jupyter_widget", "page_link", "live"):
        monkeypatch.delitem(sys.modules, f"rosmini.viz.live.{name}", raising=False)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    pad = TeleopPad(graph)
    pad.press("w")
    with pytest.raises(TeleopError, match=r"needs anywidget.*pip install anywidget"):
        _ = pad.link


def test_a_page_steers_chooses_keys_and_learns_who_else_drives(graph):
    graph.node("autopilot").publisher("cmd_vel", Twist)
    page = page_of(pad := TeleopPad(graph))
    page.say("keys", name="teleop_twist_keyboard")
    page.say("key", key="J")
    page.run(0.2)
    content, _ = page.frames()[-1]
    assert (content["keys"], content["speed"]) == ("teleop_twist_keyboard", [0.22, 1.0])
    assert content["others"] == ["/autopilot"]
    assert [0.0, 0.0, 0.22, 0.0] in [message for frame, _ in page.frames() for message in frame["messages"]]
    page.say("steer", linear=0.1, angular="left")
    page.say("steer", linear=0.1, angular=-1)
    page.run(0.2)
    assert pad.teleop.command == (0.1, -1.0)
    page.run(1.2, beats=False)
    assert pad.teleop.at_rest  # its dead man's second


def test_a_page_chooses_another_robot(graph):
    graph.master.setParam("/test", "/simulator/robots", 2)
    pad = Simulator(graph.node("simulator")).pad()
    page = page_of(pad)
    assert page.link.widget.data["choices"] == ["tb3_0", "tb3_1"]
    page.say("key", key="w")
    page.run(0.5)
    page.say("choose", name="tb3_1")
    page.run(0.5)
    ((content, buffers),) = [sent for sent in page.sent if sent[0]["type"] == "pad"]
    assert (content["data"]["chosen"], content["data"]["topic"]) == ("tb3_1", "/tb3_1/cmd_vel")
    assert content["data"]["pose"] == pytest.approx(pad.shown_robot.truth(), abs=1e-3)
    assert len(buffers[0]) == 4 * 360
    page.say("choose", name="nobody")
    page.run(0.1)
    assert any("no robot 'nobody'" in sent.get("text", "") for sent, _ in page.sent)
    assert pad.chosen == "tb3_1"


def test_a_turtle_that_comes_or_goes_is_told_to_the_page_that_is_open(graph):
    sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
    graph.run(0.1)
    page = page_of(sim.pad())
    page.say("hello")
    page.run(0.3)
    name = sim.spawn(2.0, 3.0, 0.0)
    page.run(0.3)
    told = [content["choices"] for content, _ in page.frames() if "choices" in content]
    assert told == [["turtle1"], ["turtle1", name]]
    page.say("choose", name=name)
    page.run(0.3)
    ((content, _),) = [sent for sent in page.sent if sent[0]["type"] == "pad"]
    assert content["data"]["topic"] == f"/{name}/cmd_vel"
