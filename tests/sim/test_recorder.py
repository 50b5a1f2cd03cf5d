"""The recorder writes down what the messages say, whoever publishes them."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rosmini.core.errors import CallbackError
from rosmini.core.geometry.angles import quaternion_from_yaw
from rosmini.core.geometry.errors import GeometryError
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.scripts import rosrun
from rosmini.sim.models import BURGER, LidarModel
from rosmini.sim.recorder import Recorder
from rosmini.sim.recording import RecordingError
from rosmini.sim.world import World
from rosmini.viz.beams import beams_of

LaserScan = message_class("sensor_msgs/LaserScan")
Odometry = message_class("nav_msgs/Odometry")
Twist = message_class("geometry_msgs/Twist")
BEAMS = 8
ROBOT = replace(
    BURGER, name="test robot", lidar=LidarModel("test laser", (-0.03, 0.0, 0.17), BEAMS, 5.0, 0.1, 3.5, 0.01)
)
WORLD = World("void")


class FakeRobot:
    """Publishes what it is told; odometry a frame of its own, (10, 0, 0) off."""

    def __init__(self, graph, namespace="/"):
        self.graph = graph
        self.node = graph.node("fake", namespace=namespace)
        self.truth = self.node.publisher("base_pose_ground_truth", Odometry)
        self.odom = self.node.publisher("odom", Odometry)
        self.scan = self.node.publisher("scan", LaserScan)
        self.command = self.node.publisher("cmd_vel", Twist)
        graph.run(0.01)

    def say(self, publisher, x, y, yaw, stamp=None):
        message = Odometry()
        message.header.stamp = self.graph.now() if stamp is None else stamp
        message.pose.pose.position.x, message.pose.pose.position.y = x, y
        q = message.pose.pose.orientation
        q.x, q.y, q.z, q.w = quaternion_from_yaw(yaw)
        publisher.publish(message)

    def be(self, x, y, yaw):
        self.say(self.truth, x, y, yaw)
        self.say(self.odom, x - 10, y, yaw)

    def see(self, ranges, **changes):
        message = LaserScan(
            angle_min=0.0, angle_max=2 * math.pi, angle_increment=2 * math.pi / BEAMS, range_min=0.1, range_max=3.5
        )  # fmt: skip
        message.header.stamp = self.graph.now()
        message.ranges = list(ranges)
        for name, value in changes.items():
            setattr(message, name, value)
        self.scan.publish(message)

    def drive(self, linear, angular):
        message = Twist()
        message.linear.x, message.angular.z = linear, angular
        self.command.publish(message)


@pytest.fixture
def recorder(graph):
    return Recorder(graph, world=WORLD, model=ROBOT)


@pytest.fixture
def robot(graph, recorder):
    return FakeRobot(graph)


def test_truth_and_odometry_are_recorded_at_the_times_of_their_headers(graph, robot, recorder):
    for i in range(4):
        robot.be(i, 2 * i, 0.1 * i)
        graph.run(0.5)
    run = recorder.recording()
    np.testing.assert_allclose(run.times, [0, 0.5, 1, 1.5])
    np.testing.assert_allclose(run.truth, [(i, 2 * i, 0.1 * i) for i in range(4)], atol=1e-12)
    np.testing.assert_allclose(run.odom, [(i - 10, 2 * i, 0.1 * i) for i in range(4)], atol=1e-12)
    assert run.drift().position.max() < 1e-12
    assert (run.world, run.model) == (WORLD, ROBOT)
    assert recorder.node.name == "/recorder"


def test_odometry_is_interpolated_at_the_times_of_the_truth(graph, robot, recorder):
    robot.say(robot.truth, 0, 0, 0, Time(1.0))  # odometry is not known yet
    robot.say(robot.odom, 2, 0, 3.0, Time(2.0))
    robot.say(robot.truth, 1, 0, 0, Time(2.25))
    robot.say(robot.truth, 2, 0, 0, Time(2.5))
    robot.say(robot.odom, 4, 0, -3.0, Time(3.0))
    robot.say(robot.truth, 3, 0, 0, Time(3.5))  # nor here
    graph.run(0.1)
    run = recorder.recording()
    assert run.times.tolist() == [0, 0.25]
    assert run.truth[:, 0].tolist() == [1, 2]
    half = 3.0 + (2 * math.pi - 6.0) / 2
    np.testing.assert_allclose(run.odom, [(2.5, 0, (3 + half) / 2), (3, 0, half)])


def test_a_command_that_came_before_the_first_pose_counts_from_the_begin(graph, robot, recorder):
    robot.drive(0.1, 0.0)
    graph.run(1.0)
    robot.drive(0.2, -1.0)
    graph.run(1.0)
    robot.be(0, 0, 0)
    graph.run(0.5)
    robot.drive(0.0, 0.5)
    robot.drive(math.nan, 0.5)
    graph.run(0.5)
    robot.be(1, 0, 0)
    graph.run(0.1)
    np.testing.assert_allclose(recorder.recording().commands, [(0, 0.2, -1), (0.5, 0, 0.5)])


def test_scans_begin_ahead_and_what_is_no_hit_or_too_near_is_infinite(graph, robot, recorder):
    robot.see([9] * BEAMS)  # before the run
    graph.run(0.1)
    robot.be(0, 0, 0)
    robot.see([0.0, 0.05, 0.5, 3.5, 3.6, math.nan, math.inf, -math.inf])
    graph.run(0.2)
    robot.see(range(1, 9), angle_min=-math.pi, range_max=20.0)
    graph.run(0.1)
    run = recorder.recording()
    inf = math.inf
    np.testing.assert_allclose(run.scan_times, [0, 0.2])
    np.testing.assert_allclose(run.scans, [[inf, -inf, 0.5, 3.5, inf, inf, inf, -inf], [5, 6, 7, 8, 1, 2, 3, 4]])


@pytest.mark.parametrize(
    ("ranges", "changes", "message"),
    [
        ([1.0] * 5, {}, "a scan has 5 ranges, but the test laser has 8 beams"),
        ([1.0] * 8, {"angle_increment": 0.1}, "goes on by 0.100000 rad"),
        ([1.0] * 8, {"angle_min": 0.3}, "begins at 0.3000 rad"),
    ],
)
def test_scans_of_another_laser_are_refused(graph, robot, recorder, ranges, changes, message):
    robot.be(0, 0, 0)
    robot.see(ranges, **changes)
    graph.run(0.1)
    with pytest.raises(RecordingError, match=message):
        recorder.recording()


def test_an_increment_that_is_one_beam_off_is_a_whole_turn_too(graph, robot, recorder):
    robot.be(0, 0, 0)
    robot.see(range(1, 9), angle_increment=2 * math.pi / (BEAMS - 1), range_max=20.0)
    graph.run(0.1)
    assert recorder.recording().scans.tolist() == [list(range(1, 9))]


def test_with_nothing_recorded_the_error_says_what_to_run(graph, recorder):
    with pytest.raises(
        RecordingError, match=r"no message on /base_pose_ground_truth, nobody publishes it; .*/odom.*graph.run\("
    ):
        recorder.recording()
    robot = FakeRobot(graph)
    robot.say(robot.truth, 0, 0, 0)
    graph.run(0.1)
    with pytest.raises(RecordingError, match=r"yet: no message on /odom, /fake publishes it\. Let"):
        recorder.recording()
    robot.say(robot.odom, 0, 0, 0, Time(1.0))
    graph.run(0.1)
    with pytest.raises(RecordingError, match="no time in common"):
        recorder.recording()


def test_clear_begins_a_new_run_and_stop_keeps_the_old_one(graph, robot, recorder):
    robot.be(0, 0, 0)
    graph.run(1.0)
    recorder.clear()
    with pytest.raises(RecordingError):
        recorder.recording()
    robot.be(5, 0, 0)
    graph.run(1.0)
    recorder.stop()
    recorder.stop()
    robot.be(6, 0, 0)
    graph.run(1.0)
    assert recorder.recording().truth.tolist() == [[5, 0, 0]]
    assert "/recorder" not in graph.nodes
    recorder.clear()
    with pytest.raises(RecordingError, match="before the recorder was stopped"):
        recorder.recording()


def test_a_clock_that_goes_back_begins_a_new_run(graph, robot, recorder, capsys):
    robot.say(robot.truth, 0, 0, 0, Time(9.0))
    robot.say(robot.odom, 0, 0, 0, Time(9.0))
    graph.run(0.1)
    robot.say(robot.truth, 1, 0, 0, Time(2.0))
    robot.say(robot.odom, 1, 0, 0, Time(2.0))
    graph.run(0.1)
    assert recorder.recording().truth.tolist() == [[1, 0, 0]]
    assert "went back by 7.000 s" in capsys.readouterr().err


def test_messages_without_a_stamp_count_from_when_they_arrive(graph, robot, recorder):
    for x in range(3):
        robot.say(robot.truth, x, 0, 0, Time(0))
        robot.say(robot.odom, x, 0, 0, Time(0))
        graph.run(1.0)
    np.testing.assert_allclose(recorder.recording().times, [0, 1, 2])


def test_a_robot_in_a_namespace_is_recorded_there(graph):
    simulator = SimpleNamespace(world=WORLD, model=ROBOT)
    recorder = Recorder(graph, simulator, namespace="/robot1")
    robot = FakeRobot(graph, namespace="/robot1")
    robot.be(1, 0, 0)
    graph.run(0.1)
    assert recorder.recording().truth.tolist() == [[1, 0, 0]]
    assert recorder.node.name == "/robot1/recorder"
    for part in ("/robot1/recorder", "1 base_pose_ground_truth", "1 odom", "0 scan", "0 cmd_vel"):
        assert part in repr(recorder)


def test_a_recorder_has_to_know_world_and_robot(graph):
    with pytest.raises(RecordingError, match=r"Recorder\(graph, simulator\)"):
        Recorder(graph, world=WORLD)


def test_without_a_simulator_it_finds_the_one_that_runs(graph):
    simulator = rosrun("rosmini_sim", "simulator", "_world:=room", graph=graph).instance()
    assert graph.nodes["/simulator"].program is simulator
    recorder = Recorder(graph)
    graph.run(1.0)
    assert recorder.recording().world.name == "room"
    rosrun("rosmini_sim", "simulator", "__ns:=other", graph=graph).instance()
    with pytest.raises(RecordingError, match=r"2 simulations run in this graph \(/simulator, /other/simulator\)"):
        Recorder(graph, name="second")


def test_a_pose_without_an_orientation_is_an_error_at_the_message(graph, robot, recorder):
    robot.truth.publish(Odometry())
    with pytest.raises(CallbackError) as caught:
        graph.run(0.1)
    assert isinstance(caught.value.__cause__, GeometryError)


FAN = "position( size [0.4 0.4 0.25] {0} ) model( pose [2 0 0 0] size [0.2 4 1] )"


def stage_run(graph, tmp_path, laser):
    """A second of a robot of Stage that stands 1.8 m before the middle of a wall."""
    (tmp_path / "fan.world").write_text(FAN.format(laser), encoding="utf-8")
    stage = rosrun("stage_ros", "stageros", tmp_path / "fan.world", graph=graph).instance()
    recorder = Recorder(graph, stage, scan="base_scan")
    graph.run(1.0)
    return recorder.recording()


def test_a_laser_that_looks_ahead_only_is_recorded_beam_by_beam(graph, tmp_path):
    laser = "ranger( pose [0.1 0 0 0] sensor( range [0 5] fov 90 samples 3 ) )"
    run = stage_run(graph, tmp_path, laser)
    assert run.scans.shape == (len(run.scan_times), 3)
    np.testing.assert_allclose(run.scans[-1], [1.8 * math.sqrt(2), 1.8, 1.8 * math.sqrt(2)], atol=1e-5)
    beams = beams_of(run.scans[-1], run.model.laser)
    np.testing.assert_allclose(beams.points(), [[1.8, -1.8], [1.8, 0], [1.8, 1.8]], atol=1e-5)
    assert run.replay3d().extra["scan"]["step"] == pytest.approx(math.pi / 2)
    assert run.replay3d().extra["scan"]["start"] == pytest.approx(-math.pi / 4)


def test_a_robot_without_a_laser_is_recorded_without_scans(graph, tmp_path):
    run = stage_run(graph, tmp_path, "")
    assert run.scans.shape == (0, 0)
    assert "0 scans" in run.show().text
