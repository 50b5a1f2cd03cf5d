"""gzserver, gzclient and gazebo: arguments, worlds, time, and a client that uses Gazebo's topics only."""

import pytest

from rosmini.core.errors import ParameterError, ROSException, ScriptError
from rosmini.ros.scripts import rosrun
from rosmini.sim.gazebo.client import GazeboClient
from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.server import GazeboServer
from rosmini.sim.recorder import Recorder
from rosmini.sim.recording import RecordingError
from rosmini.sim.sdf import SdfError
from rosmini.sim.verbs.gz import Gz
from rosmini.sim.world import Box, Obstacle, World

from .conftest import DIFF_DRIVE, Bench, box, urdf

WORLD = """<sdf version="1.6"><world name="yard">
  <physics type="ode"><max_step_size>0.002</max_step_size><real_time_update_rate>500</real_time_update_rate></physics>
  <gravity>0 0 -1.6</gravity>
  <include><uri>model://ground_plane</uri></include>
  <model name="wall"><static>1</static><pose>3 0 0 0 0 0</pose><link name="link"><collision name="c">
    <pose>0 0 0.5 0 0 0</pose>
    <geometry><box><size>0.2 4 1</size></box></geometry></collision></link></model>
  <model name="crate"><pose>1 1 0.2 0 0 0.5</pose><link name="link"><inertial><mass>1.5</mass></inertial>
    <collision name="c">
    <geometry><box><size>0.4 0.4 0.4</size></box></geometry></collision></link></model>
</world></sdf>"""


def test_a_world_file_is_loaded(bench, tmp_path):
    path = tmp_path / "yard.world"
    path.write_text(WORLD, encoding="utf-8")
    there = bench(str(path))
    world = there.server.world
    assert world.name == "yard"
    assert list(world.models) == ["ground_plane", "wall", "crate"]
    assert (world.physics.time_step, world.physics.max_update_rate, world.engine.surface.gravity) == (0.002, 500.0, 1.6)
    assert there.pose("crate") == pytest.approx((1.0, 1.0, 0.5))
    assert there.pose("wall") == (3.0, 0.0, 0.0)
    assert world.models["wall"].static
    assert not world.models["crate"].static
    properties = there.call("get_model_properties", "gazebo_msgs/GetModelProperties", model_name="crate")
    assert properties.geom_names == ["c"]
    assert there.call("get_link_properties", "gazebo_msgs/GetLinkProperties", link_name="crate::link").mass == 1.5


def test_what_is_wrong_with_a_world_or_a_model_is_one_warning(bench, tmp_path, monkeypatch):
    said = []
    monkeypatch.setattr("rosmini.core.graph.node.Node.logwarn", lambda node, text: said.append(text))
    path = tmp_path / "yard.world"
    massless = WORLD.replace("<mass>1.5</mass>", "<mass>0</mass>")
    path.write_text(
        massless.replace("</world>", "\n<include><uri>model://none</uri></include></world>"), encoding="utf-8"
    )
    there = bench(str(path))
    assert list(there.server.world.models) == ["ground_plane", "wall", "crate"]
    (warning,) = said
    head, first, second = warning.splitlines()
    assert "'yard'" in head
    assert first.startswith(f"{path}:12: ") and "'none'" in first
    assert second.startswith(f"{path}:8: a mass")
    xml = "<sdf version='1.6'><model name='m'><link name='l'><inertial><mass>0</mass></inertial></link></model></sdf>"
    done = there.call("spawn_sdf_model", "gazebo_msgs/SpawnModel", model_xml=xml, model_name="m")
    assert done.success
    (other,) = said[1:]
    assert "'m'" in other and "\n<text>:1: a mass" in other


def test_a_world_goes_on_without_a_model_that_cannot_come(bench, tmp_path, capsys):
    path = tmp_path / "broken.world"
    driven = DIFF_DRIVE[DIFF_DRIVE.index("<plugin") : DIFF_DRIVE.index("</gazebo>")]
    model = f"<model name='cart'><link name='l'/>{driven}</model>"
    path.write_text(
        f"<sdf version='1.6'><world name='w'>{model}{box()[box().index('<model') : -6]}</world></sdf>", encoding="utf-8"
    )
    there = bench(str(path))
    assert list(there.server.world.models) == ["box"]
    assert "the model 'cart' has no joint 'left_wheel'" in capsys.readouterr().err


def test_worlds_are_looked_for_as_gzserver_does(bench, tmp_path, monkeypatch):
    (tmp_path / "worlds").mkdir()
    (tmp_path / "worlds" / "yard.world").write_text(WORLD, encoding="utf-8")
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", str(tmp_path))
    assert bench("worlds/yard.world").server.world.name == "yard"


def test_the_empty_world_is_the_default(graph):
    server = rosrun("gazebo_ros", "gzserver", graph=graph).instance()
    assert server.node.name == "/gazebo"
    assert list(server.world.models) == ["ground_plane"]


def test_worlds_that_are_none(graph, tmp_path):
    for name, said in (("romm", "did you mean room?"), ("worlds/none.world", "searched in")):
        with pytest.raises(GazeboError, match=said.replace("?", r"\?")):
            GazeboServer(graph.node("gazebo"), name)
    path = tmp_path / "broken.world"
    path.write_text("<sdf version='1.6'>\n<world name='w'><model/></world></sdf>", encoding="utf-8")
    with pytest.raises(SdfError, match=r"broken\.world:2"):
        GazeboServer(graph.node("gazebo"), str(path))
    path.write_text(box(), encoding="utf-8")
    with pytest.raises(GazeboError, match="spawn_model -sdf -file"):
        GazeboServer(graph.node("gazebo"), str(path))
    GazeboServer(graph.node("gazebo"), "empty")  # what failed left nothing behind


def test_arguments(graph):
    server = GazeboServer(graph.node("gazebo"), "-u", "--verbose", "-e", "ode", "room")
    assert server.world.paused
    for words, said in (
        (("--no-such",), "unrecognized arguments: --no-such"),
        (("-e", "od"), "there is no physics engine 'od'"),
    ):
        with pytest.raises(ScriptError, match=said):
            GazeboServer(graph.node("other"), "empty", *words)


def test_a_server_ends_after_so_many_steps(graph):
    server = GazeboServer(graph.node("gazebo"), "--iters", "500", "empty")
    graph.run(0.4)
    assert not server.node.is_shutdown()
    graph.run(0.2)
    assert server.node.is_shutdown()


def test_time_begins_at_zero_and_everybody_lives_on_it(bench):
    there = bench()
    assert there.node.get_param("/use_sim_time") is True
    late = there.graph.node("late")
    there.graph.run(1.0)
    assert late.clock.now_ns() == pytest.approx(1e9, abs=2e7)
    ticks = there.hear("/clock", "rosgraph_msgs/Clock")
    there.graph.run(1.0)
    assert len(ticks) in (99, 100)
    there.call("reset_simulation", "std_srvs/Empty")
    there.graph.run(0.5)
    assert late.clock.now_ns() == pytest.approx(5e8, abs=2e7)


def test_how_often_the_clock_ticks(graph):
    graph.master.setParam("/test", "/gazebo/pub_clock_frequency", 10)
    there = Bench(graph, "empty")
    ticks = there.hear("/clock", "rosgraph_msgs/Clock")
    graph.run(1.05)
    assert len(ticks) == 10
    graph.master.setParam("/test", "/other/pub_clock_frequency", -1)
    there.server.node.shutdown("enough")
    with pytest.raises(ParameterError, match="more than 0 Hz"):
        GazeboServer(graph.node("other"), "empty")


def test_rosminis_own_worlds_have_their_obstacles_as_models(bench):
    own = World(
        "own",
        (
            Obstacle("pillar", Box(0.4, 0.4), (2.0, 0.0, 0.0)),
            Obstacle("crate", Box(0.3, 0.3), (0.0, 2.0, 0.0), mass=1.0),
        ),
    )
    there = bench(world=own)
    assert there.pose("pillar") == (2.0, 0.0, 0.0)
    there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="pillar")
    there.spawn(urdf(), "robot", 2.0)  # the place is free now
    assert "robot" in there.server.world.models


def test_from_python_without_services(bench):
    there = bench()
    model = there.server.spawn(urdf(), "robot", (1.0, 2.0, 0.5), namespace="r")
    assert model.links == ("base_footprint", "left", "right")
    assert there.pose("robot") == pytest.approx((1.0, 2.0, 0.5))
    assert str(Gz(there.graph).run("model", "-m", "robot", "-p")).startswith("1.000000 2.000000")
    there.server.delete("robot")
    with pytest.raises(GazeboError, match="there is no model 'robot'"):
        there.pose("robot")


def test_a_client_shows_the_world_of_the_server(graph):
    server = rosrun("gazebo_ros", "gzserver", "room", graph=graph).instance()
    client = rosrun("gazebo_ros", "gzclient", graph=graph).instance()
    assert client.node.name == "/gazebo_gui"
    assert set(client.models) == set(server.world.models)
    assert server.master.info("/gazebo/room/pose/info").subscribers == ("gzclient /gazebo_gui",)
    there = Bench.__new__(Bench)
    there.graph, there.server, there.node = graph, server, graph.node("tester")
    there.spawn(urdf(), "robot")
    graph.run(0.0)
    assert "robot" in client.models
    there.drive("/cmd_vel", 0.2)
    graph.run(2.0)
    assert "robot at (0.3" in client.text
    there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="robot")
    graph.run(0.0)
    assert "robot" not in client.models


def test_a_client_without_a_server_says_so(graph):
    with pytest.raises(ROSException, match=r"no server runs at http://localhost:11345"):
        GazeboClient(graph.node("gazebo_gui"))
    with pytest.raises(ScriptError, match="there is no option --what"):
        GazeboClient(graph.node("gazebo_gui"), "--what")


def test_gazebo_is_both(graph):
    both = rosrun("gazebo_ros", "gazebo", "room", graph=graph).instance()
    assert both.node.name == "/gazebo"
    assert both.gui.node.name == "/gazebo_gui"
    both.node.shutdown("enough")
    assert both.gui.node.is_shutdown()


def test_a_recorder_learns_from_the_server_what_is_there_and_hears_how_it_moves(bench):
    there = bench()
    there.spawn(urdf(axle=0.1), "rover")
    there.spawn(box("crate", mass=1.0), "crate", 1.0)
    recorder = Recorder(there.graph, there.server)
    there.drive("/cmd_vel", 0.5)
    there.graph.run(4.0)
    recording = recorder.recording()
    x, *_ = there.server.truth("rover")
    assert recording.truth[-1][0] == pytest.approx(x + 0.1, abs=0.05)  # the middle of the axle
    crate = next(each for each in recording.things if each.obstacle.name == "crate")
    assert crate.poses[0][0] == 1.0
    assert crate.poses[-1] == pytest.approx(there.server.truth("crate"), abs=0.05)
    assert len(recording.scans)


def test_a_recorder_needs_a_robot(bench):
    there = bench()
    with pytest.raises(RecordingError, match="spawn"):
        Recorder(there.graph, there.server)
