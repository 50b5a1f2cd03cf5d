"""The view's scripted twin on the three simulators, and its messages with the page, which the test plays."""

from __future__ import annotations

import math
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from rosmini import Graph, rosrun
from rosmini.core.errors import RosminiError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.engine import RobotGone
from rosmini.sim.gazebo.errors import UnknownEntity
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import WorldError
from rosmini.viz.live.simulation_view import SimulationView
from rosmini.viz.live.view_link import ViewLink
from rosmini.viz.view import ViewError

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


# -- the twin
# ------------------------------------------------------------------------------------------------------------


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


def test_boxes_of_stage_are_dragged_and_can_still_be_pushed(stage, graph):
    view = stage.view()
    view.drag("crate_1", (-0.9, 0.0))
    driver = graph.node("driver").publisher("cmd_vel", Twist, queue_size=1)
    twist = Twist()
    twist.linear.x = 0.3
    for _ in range(20):
        driver.publish(twist)
        graph.run(0.1)
    assert view.pose("crate_1")[0] > -0.8


@pytest.mark.parametrize(
    ("to", "what"),
    [
        ((-1.5, 0.0), "the robot 'robot_0' is in its way"),
        ((0.5, 1.2), "crate 'crate_2'|'crate_2' is in its way"),
        ((-3.05, 0.0), r"'room \(3\)' is in its way"),
        ((-1.5, 1.5), "'post_1' is in its way"),
    ],
)
def test_an_occupied_place_is_refused(stage, to, what):
    view = stage.view()
    with pytest.raises(WorldError, match=what):
        view.drag("crate_1", to)
    assert view.pose("crate_1") == (0.5, 0.0, 0.0)
    assert view.text.splitlines()[-1] == f"last: {view.message}"


def test_a_robot_is_not_put_onto_another_or_into_a_wall(four):
    view = four.view()
    for to in ((2.0, 0.0), (1000.0, math.nan)):
        with pytest.raises(RosminiError, match=r"'robot_1' is in its way|both finite"):
            view.drag("robot_0", to)
    assert four.truth() == (0.0, 0.0, 0.0)


def test_a_dragged_robot_of_stage_forgets_its_command(stage, graph):
    stage.engine.command("robot_0", 0.3, 0.0)
    stage.view().drag("robot_0", (-2.0, 0.0))
    graph.run(1.0)
    assert stage.truth() == pytest.approx((-2.0, 0.0, 0.0), abs=1e-6)


def test_a_robot_of_stage_has_its_name_in_the_file_too(four):
    view = four.view()
    view.drag("era2", (2.5, 1.5))
    assert view.message == "robot_1 is at (2.50, 1.50, 0.0 deg)"
    assert view.pose("robot_1") == view.pose("era2") == (2.5, 1.5, 0.0)


def test_time_of_gazebo_is_stopped_as_its_services_do_it(server, graph):
    heard: list = []
    server.host.on_time.append(lambda: heard.append(server.world.paused))
    view = server.view()
    view.pause()
    graph.run(1.0)
    before = server.world.now
    view.step()
    assert server.world.now == pytest.approx(before + 0.1)
    view.unpause()
    assert heard == [True, True, False]
    with pytest.raises(RosminiError, match="not 0 times"):
        view.step(1e-9)


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


def test_robots_and_boxes_of_the_simulator_are_dragged(simulator, graph):
    view = simulator.view()
    assert view.names == ("burger", "crate")
    view.drag("burger", (1.0, -1.0))
    view.drag("crate", (0.0, -1.0, 1.0))
    graph.run(0.2)
    assert simulator.truth() == (1.0, -1.0, 0.0)
    assert simulator.engine.pose("crate") == pytest.approx((0.0, -1.0, 1.0))
    view.reset()
    assert simulator.truth() == (0.0, 0.0, 0.0)


def test_names_that_cannot_be_dragged_are_said(simulator):
    view = simulator.view()
    with pytest.raises(ViewError, match="nothing named 'burgr' that can be dragged; did you mean burger"):
        view.drag("burgr", (0.0, 0.0))
    with pytest.raises(RobotGone, match="is fixed in the world 'room'"):
        simulator.drag(next(o.name for o in simulator.world.obstacles if o.fixed), (0.0, 0.0, 0.0))
    with pytest.raises(ViewError, match="give x and y"):
        view.drag("burger", (1.0,))
    with pytest.raises(ViewError, match="a finite heading"):
        view.turn("burger", math.inf)


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


def test_a_look_changes_nothing():
    def ends(view: bool) -> tuple:
        with Graph(seed=3) as graph:
            simulator = Simulator(graph.node("simulator"), world="house")
            link = ViewLink(simulator.view()) if view else None
            simulator.engine.command("burger", 0.2, 0.3)
            for _ in range(40):
                graph.run(0.05)
                if link is not None:
                    assert link.view.text
                    link._measure()
                    link._data()
            return (*simulator.truth(), *simulator.last_scan().ranges)

    assert ends(view=True) == ends(view=False)


def test_only_a_running_simulation_is_viewed(graph):
    with pytest.raises(ViewError, match="not a Graph"):
        SimulationView(graph)


def test_a_simulation_that_has_ended_is_said_so(stage, graph):
    view = stage.view()
    stage.node.shutdown("over")
    with pytest.raises(ViewError, match="the node /stageros was shut down"):
        view.drag("robot_0", (0.0, 0.0))
    assert "the simulation has ended" in view.text
    assert graph.run(1.0).reason == "time"


# -- the page
# ------------------------------------------------------------------------------------------------------------


class Page:
    """A page of a view: says what it is told to, and keeps what it is sent."""

    def __init__(self, view: SimulationView, *, live: bool = True) -> None:
        self.graph, self.wall, self.lives = view.watch.node.graph, 100.0, 0
        self.sent: list = []
        self.graph.live = self.live
        if live:
            self.live()
        self.link = ViewLink(view, clock=lambda: self.wall)
        self.link.widget.send = lambda content, buffers=None: self.sent.append((content, buffers or []))

    def live(self) -> None:
        self.lives += 1
        self.graph._live = SimpleNamespace(running=True, stop=lambda: None)

    def say(self, kind: str, **more) -> None:
        self.link.receive(self.link.widget, {"type": kind, **more}, [])

    def run(self, seconds: float, *, beats: bool = True) -> None:
        for i in range(round(seconds * 100)):
            if beats and i % 25 == 0:
                self.say("beat")
            self.wall += 0.01
            self.graph.run(0.01)

    def of(self, kind: str) -> list:
        return [(content, buffers) for content, buffers in self.sent if content["type"] == kind]


def test_a_drag_of_the_page_is_answered(stage):
    page = Page(stage.view())
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
    page = Page(stage.view())
    page.say("drag", name=name, to=to)
    page.graph.run(0.01)
    ((content, _),) = page.of("refused")
    assert content["name"] == name
    assert text in content["text"]
    assert page.of("put") == []
    assert stage.truth() == (-1.5, 0.0, 0.0)


def test_frames_come_while_it_runs_and_somebody_looks(stage):
    page = Page(stage.view())
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
    page = Page(simulator.view())
    page.say("hello")
    page.run(0.1)
    page.sent.clear()
    simulator.spawn("second", pose=(1.0, 1.0, 0.0))
    page.run(0.1)
    (content, (scans,)) = page.of("scene")[-1]
    assert [body["name"] for body in content["data"]["bodies"]] == ["burger", "second", "crate"]
    assert len(scans) == 4 * 2 * (3 + 360)


def test_a_run_with_nothing_left_to_do_ends_though_a_page_looks(stage):
    page = Page(stage.view())
    page.say("hello")
    page.run(0.2)
    page.graph._live = None
    stage.view().pause()
    for _ in range(3):
        page.wall += 0.25
        page.graph.scheduler.call_soon_threadsafe(lambda: page.link._take("beat", {}))
        assert page.graph.run().reason == "drained"


def test_a_still_graph_is_said_so_and_an_action_makes_it_live(stage):
    page = Page(stage.view(), live=False)
    page.say("hello")
    page.say("beat")
    assert {content["type"] for content, _ in page.sent} == {"still"}
    page.say("pause")
    assert page.lives == 1
    page.graph.run(0.1)
    assert stage.host.paused


def test_an_ended_simulation_is_told(stage):
    page = Page(stage.view())
    page.say("hello")
    page.run(0.1)
    stage.node.shutdown("over")
    page.run(0.1)
    page.say("drag", name="robot_0", to=[0.0, 0.0, 0.0])
    assert "was shut down" in page.of("gone")[-1][0]["text"]


def test_without_anywidget_the_twin_works_and_the_page_says_what_to_install(stage, monkeypatch):
    for name in ("page_link", "view_link", "live"):
        monkeypatch.delitem(sys.modules, f"rosmini.viz.live.{name}", raising=False)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    view = stage.view()
    view.drag("robot_0", (-1.0, 0.0))
    with pytest.raises(ViewError, match=r"needs anywidget.*pip install anywidget"):
        _ = view.link
