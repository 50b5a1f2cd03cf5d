"""The view's scripted twin on the three simulators, and its messages with the page, which the test plays."""

import math

import numpy as np
import pytest

from rosmini import rosrun
from rosmini.core.errors import RosminiError
from rosmini.sim.gazebo.errors import UnknownEntity
from rosmini.sim.world import WorldError
from rosmini.viz.live.view_link import ViewLink
from rosmini.viz.view import ViewError

from .pages import Page

BOX = (
    '<sdf version="1.6"><model name="{name}"><link name="link"><inertial><mass>1</mass></inertial><collision '
    'name="c"><geometry>'
    "<box><size>0.4 0.4 0.4</size></box></geometry></collision></link>{more}</model></sdf>"
)
DRIVE = '<plugin name="drive" filename="libgazebo_ros_planar_move.so"/>'


@pytest.fixture
def stage(graph):
    return rosrun("stage_ros", "stageros", "package://stage_ros/world/boxes.world", graph=graph).instance()


@pytest.fixture
def four(graph):
    return rosrun(
        "stage_ros", "stageros", "package://stage_ros/world/willow-four-erratics.world", graph=graph
    ).instance()


@pytest.fixture
def server(graph):
    server = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
    server.spawn(BOX.format(name="crate", more=""), "crate", (1.0, 0.0, 0.0))
    server.spawn(BOX.format(name="mover", more=DRIVE), "mover", (-1.0, 0.0, 0.5))
    return server


def test_robots_of_stage_are_dragged_and_turned(four, graph):
    view = four.view()
    assert view.names == ("robot_0", "robot_1", "robot_2", "robot_3")
    view.drag("robot_1", (2.5, 1.5))
    view.turn("robot_1", math.pi / 2)
    graph.run(1.0)
    assert four.truth("robot_1") == pytest.approx((2.5, 1.5, math.pi / 2))
    assert four.truth("robot_0") == (0.0, 0.0, 0.0)
    view.drag("robot_1", (2.0, 1.5, 0.0))
    assert view.pose("robot_1") == (2.0, 1.5, 0.0)
    assert view.message == "robot_1 is at (2.00, 1.50, 0.0 deg)"


def test_a_dragged_robot_of_stage_forgets_its_command(stage, graph):
    stage.engine.command("robot_0", 0.3, 0.0)
    stage.view().drag("robot_0", (-2.0, 0.0))
    graph.run(1.0)
    assert stage.truth() == pytest.approx((-2.0, 0.0, 0.0), abs=1e-6)


def test_models_of_gazebo_are_dragged(server, graph):
    view = server.view()
    assert view.names == ("mover", "crate")
    view.drag("crate", (1.0, 1.0))
    view.turn("mover", -0.5)
    graph.run(0.5)
    assert server.truth("crate") == pytest.approx((1.0, 1.0, 0.0), abs=1e-6)
    assert server.truth("mover") == pytest.approx((-1.0, 0.0, -0.5), abs=1e-6)
    with pytest.raises(WorldError, match="'mover' is in its way"):
        view.drag("crate", (-1.0, 0.1))
    with pytest.raises(UnknownEntity, match="no model 'crat'"):
        server.drag("crat", (0.0, 0.0, 0.0))


def test_the_pose_of_a_model_is_that_of_its_origin_wherever_its_wheels_are(graph):
    wheels = "".join(
        f'<link name="{side}"><pose>0.1 {y} 0 0 0 0</pose><inertial><mass>0.1</mass></inertial></link>'
        f'<joint name="{side}_joint" type="revolute"><parent>link</parent><child>{side}</child><axis><xyz>0 1 '
        "0</xyz></axis></joint>"
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    drive = (
        '<plugin name="drive" '
        'filename="libgazebo_ros_diff_drive.so"><leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>'
        "<wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.1</wheelDiameter></plugin>"
    )
    server = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
    server.spawn(BOX.format(name="car", more=wheels + drive), "car", (0.0, 0.0, 0.0))
    view = server.view()
    assert server.axle("car") == pytest.approx((0.1, 0.0, 0.0))
    view.drag("car", (1.0, 2.0, math.pi / 2))
    assert server.truth("car") == pytest.approx((1.0, 2.0, math.pi / 2))
    assert view.pose("car") == pytest.approx((1.0, 2.0, math.pi / 2))
    assert server.engine.robot("car").pose == pytest.approx((1.0, 2.1, math.pi / 2))


def test_time_is_paused_and_stepped(stage, graph):
    view = stage.view()
    graph.run(1.0)
    view.pause()
    graph.run(1.0)
    assert stage.host.now == pytest.approx(1.0)
    view.step()
    view.step(0.5)
    assert (stage.host.now, view.paused) == (pytest.approx(1.6), True)
    assert view.text.startswith("Simulation of the world boxes: 1.60 s, paused\n")
    view.unpause()
    graph.run(1.0)
    assert stage.host.now == pytest.approx(2.6)
    view.step()
    assert view.paused
    with pytest.raises(RosminiError, match="positive number of seconds"):
        view.step(-1.0)


def test_the_text_says_where_all_is(stage):
    view = stage.view(title="Push the crates")
    assert str(view) == (
        "Push the crates: 0.00 s\n"
        "robot_0 (robot pusher): (-1.50, 0.00, 0.0 deg)\n"
        "crate_1 (thing that can be pushed): (0.50, 0.00, 0.0 deg)\n"
        "crate_2 (thing that can be pushed): (0.50, 1.20, 30.0 deg)\n"
        "crate_3 (thing that can be pushed): (1.80, -0.80, 10.0 deg)"
    )
    assert "The world boxes from above" in view.alt
    assert "can be dragged in a live notebook" in view.alt


def test_in_the_book_it_is_a_picture_of_how_things_stand(stage, monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    view = stage.view(title="Push the crates")
    before, _ = view._repr_mimebundle_()
    assert set(before) == {"text/plain", "text/html", "image/svg+xml"}
    assert before == stage.view(title="Push the crates")._repr_mimebundle_()[0]
    assert "<script" not in before["text/html"]
    assert "<figcaption>Push the crates</figcaption>" in before["text/html"]
    view.drag("robot_0", (-2.0, 0.0))
    assert view._repr_mimebundle_()[0]["text/html"] != before["text/html"]


def test_a_simulation_that_has_ended_is_said_so(stage, graph):
    view = stage.view()
    stage.node.shutdown("over")
    with pytest.raises(ViewError, match="the node /stageros was shut down"):
        view.drag("robot_0", (0.0, 0.0))
    assert "the simulation has ended" in view.text
    assert graph.run(1.0).reason == "time"


def page_of(view, *, live=True):
    page = Page(view.watch.node.graph, lambda clock: ViewLink(view, clock=clock))
    if live:
        page.live()
    return page


def test_a_drag_of_the_page_is_answered(stage):
    page = page_of(stage.view())
    page.say("drag", name="robot_0", to=[-1.0, 0.5, 0.1])
    page.graph.run(0.01)
    assert page.of("put") == [({"type": "put", "name": "robot_0", "text": "robot_0 is at (-1.00, 0.50, 5.7 deg)"}, [])]
    assert stage.truth() == (-1.0, 0.5, 0.1)
    poses = np.frombuffer(page.of("frame")[-1][1][0]).reshape(-1, 3)
    assert poses[0].tolist() == [-1.0, 0.5, 0.1]


@pytest.mark.parametrize(
    ("name", "to", "text"),
    [
        ("crate_1", [-1.5, 0.0, 0.0], "'robot_0' is in its way"),
        ("nobody", [0.0, 0.0, 0.0], "has nothing named 'nobody'"),
        ("robot_0", [None, 0.0], "is no place"),
        ("robot_0", None, "is no place"),
        ("robot_0", [math.inf, 0.0, 0.0], "both finite"),
    ],
)
def test_what_is_refused_changes_nothing(stage, name, to, text):
    page = page_of(stage.view())
    page.say("drag", name=name, to=to)
    page.graph.run(0.01)
    ((content, _),) = page.of("refused")
    assert content["name"] == name
    assert text in content["text"]
    assert page.of("put") == []
    assert stage.truth() == (-1.5, 0.0, 0.0)


def test_frames_come_while_it_runs_and_somebody_looks(stage):
    page = page_of(stage.view())
    stage.watchdog.bases.clear()
    page.say("hello")
    stage.engine.command("robot_0", 0.2, 0.0)
    page.run(1.0)
    page.sent.clear()
    page.run(1.0)
    frames = page.of("frame")
    assert 27 <= len(frames) <= 34
    looks = [buffers[1] for content, buffers in frames if content["scans"]]
    assert 8 <= len(looks) <= 11
    beams = stage.model.laser.beams
    look = np.frombuffer(looks[-1], dtype=np.float32)
    assert len(look) == 3 + beams
    assert look[:3] == pytest.approx(stage.truth(), abs=0.1)
    page.run(4.0, beats=False)
    page.sent.clear()
    page.run(1.0, beats=False)
    assert page.sent == []


def test_what_comes_and_goes_is_told(simulator):
    page = page_of(simulator.view())
    page.say("hello")
    page.run(0.1)
    page.sent.clear()
    simulator.spawn("second", pose=(1.0, 1.0, 0.0))
    page.run(0.1)
    (content, (scans,)) = page.of("scene")[-1]
    assert [body["name"] for body in content["data"]["bodies"]] == ["burger", "second", "crate"]
    assert len(scans) == 4 * 2 * (3 + 360)


def test_a_run_with_nothing_left_to_do_ends_though_a_page_looks(stage):
    page = page_of(stage.view())
    page.say("hello")
    page.run(0.2)
    page.graph._live = None
    stage.view().pause()
    for _ in range(3):
        page.wall += 0.25
        page.graph.scheduler.call_soon_threadsafe(lambda: page.link._take("beat", {}))
        assert page.graph.run().reason == "drained"


def test_a_still_graph_is_said_so_and_an_action_makes_it_live(stage):
    page = page_of(stage.view(), live=False)
    page.say("hello")
    page.say("beat")
    assert {content["type"] for content, _ in page.sent} == {"still"}
    page.say("pause")
    assert page.lives == 1
    page.graph.run(0.1)
    assert stage.host.paused


def test_an_ended_simulation_is_told(stage):
    page = page_of(stage.view())
    page.say("hello")
    page.run(0.1)
    stage.node.shutdown("over")
    page.run(0.1)
    page.say("drag", name="robot_0", to=[0.0, 0.0, 0.0])
    assert "was shut down" in page.of("gone")[-1][0]["text"]
