"""What every simulation can do: the same contract for the simulator, Stage and Gazebo's server."""

import pytest

from rosmini.core.errors import RosminiError
from rosmini.msgs import message_class
from rosmini.sim.engine import RobotGone
from rosmini.sim.gazebo.server import GazeboServer
from rosmini.sim.simulator import Simulator
from rosmini.sim.stage.node import Stageros
from rosmini.sim.world import Box, Obstacle, World, WorldError

from .gazebo.conftest import box, urdf

STAGE = """position( name "robot" size [0.3 0.3 0.2] pose [0 0 0 0] ranger( sensor( range [0 8] fov 180 samples 91 ) ) )
model( name "crate" gripper_return 1 mass 2 size [0.4 0.4 0.4] pose [1 0 0 0] )
"""


def simulator(graph, _):
    crate = Obstacle("crate", Box(0.4, 0.4), (1.0, 0.0, 0.0), mass=2.0)
    return Simulator(graph.node("sim"), world=World("yard", (crate,), starts=((0.0, 0.0, 0.0),)))


def stageros(graph, folder):
    (folder / "yard.world").write_text(STAGE, encoding="utf-8")
    return Stageros(graph.node("sim"), str(folder / "yard.world"))


def gzserver(graph, _):
    server = GazeboServer(graph.node("sim"), "empty")
    server.spawn(urdf(), "robot")
    server.spawn(box(), "crate", (1.0, 0.0, 0.0))
    return server


@pytest.fixture(params=[simulator, stageros, gzserver])
def sim(request, graph, tmp_path):
    make = request.param
    return make(graph, tmp_path)


def drive(graph, v, seconds):
    """Repeat a command, as Stage and TurtleBot3 want it."""
    node = graph.nodes.get("/driver") or graph.node("driver")
    publisher = node.publisher("/cmd_vel", message_class("geometry_msgs/Twist"))
    publisher.wait_for_subscribers()
    message = publisher.message_class()
    message.linear.x = v
    for _ in range(round(10 * seconds)):
        publisher.publish(message)
        graph.run(0.1)


def test_time_is_paused_stepped_and_goes_on(sim, graph):
    heard = []
    sim.host.on_time.append(lambda: heard.append(sim.paused))
    graph.run(0.5)
    assert sim.now == pytest.approx(0.5)
    sim.pause()
    sim.pause()
    graph.run(1.0)
    assert (sim.paused, sim.now) == (True, pytest.approx(0.5))
    sim.step(0.3)
    assert (sim.paused, sim.now) == (True, pytest.approx(0.8))
    sim.unpause()
    graph.run(0.2)
    assert sim.now == pytest.approx(1.0)
    sim.step(0.1)  # a step pauses
    assert sim.paused
    assert heard == [True, True, False, True, True]
    for seconds in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(RosminiError):
            sim.step(seconds)


def test_time_goes_faster(sim, graph):
    assert sim.speed == 1.0
    sim.speed = 2.0
    graph.run(1.0)
    assert (sim.speed, sim.now) == (pytest.approx(2.0), pytest.approx(2.0))
    with pytest.raises(RosminiError):
        sim.speed = -1.0


def test_robots_and_things_are_where_they_were_put(sim, graph):
    sim.place((0.0, 1.0, 0.5))
    assert sim.truth() == pytest.approx((0.0, 1.0, 0.5))
    sim.drag("crate", (2.0, -1.0, 0.25))
    graph.run(0.5)
    assert sim.truth("crate") == pytest.approx((2.0, -1.0, 0.25))
    with pytest.raises(WorldError):
        sim.place((2.0, -1.0, 0.0))
    for name in ("crat", "nobody"):
        with pytest.raises(RosminiError, match=name):
            sim.truth(name)
        with pytest.raises(RosminiError, match=name):
            sim.drag(name, (0.0, 0.0, 0.0))
    sim.reset()
    assert sim.truth() == pytest.approx((0.0, 0.0, 0.0))
    assert sim.truth("crate") == pytest.approx((1.0, 0.0, 0.0))


def test_a_robot_moves_sees_and_reckons(sim, graph):
    scans = []
    topic = "/base_scan" if isinstance(sim, Stageros) else "/scan"
    graph.node("eyes").subscriber(topic, message_class("sensor_msgs/LaserScan"), scans.append)
    drive(graph, 0.2, 1.0)
    graph.run(0.31)  # no scan is on its way
    moved = sim.truth()[0]
    assert 0.05 < moved < 0.35
    assert sim.odometry[0] == pytest.approx(moved, abs=0.02)
    assert list(sim.last_scan().ranges) == list(scans[-1].ranges)
    assert sim.scan_poses.shape[1] == 3
    assert 0.0 < sim.scan_pose[0] <= moved + 1e-9


def test_it_is_shown(sim):
    for shown in (sim.show(), sim.show3d()):
        assert shown.text
    assert "cmd_vel" in sim.pad().topic


def test_a_robot_is_removed_where_the_program_can(sim, graph):
    if isinstance(sim, Stageros):
        with pytest.raises(RosminiError, match="its world file says"):
            sim.delete("robot")
        return
    name = "burger" if isinstance(sim, Simulator) else "robot"
    sim.delete(name)
    graph.run(0.5)
    with pytest.raises(RosminiError, match=name):
        sim.truth(name)
    assert "cmd_vel" not in str(graph.master.getSystemState("/me")[2][1])


def test_after_the_nodes_end_everything_says_so(sim):
    sim.node.shutdown("enough")
    for action in (sim.truth, sim.pause, sim.reset, sim.last_scan):
        with pytest.raises(RobotGone, match="the node /sim was shut down"):
            action()
