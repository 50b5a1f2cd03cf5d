"""The node `stage_ros/stageros`: topics, frames, rates, motion, sensors and services, as stage_ros has them."""

import math
import sys
from collections import defaultdict
from itertools import pairwise

import numpy as np
import pytest

from rosmini.core.errors import ParameterError, ScriptError
from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.core.graph import Graph
from rosmini.msgs import message_class, service_class
from rosmini.sim.engine import RobotGone
from rosmini.sim.stage.errors import StageError
from rosmini.sim.stage.node import Stageros

from ...processes import run

Twist = message_class("geometry_msgs/Twist")
TYPES = {
    "odom": "nav_msgs/Odometry",
    "base_pose_ground_truth": "nav_msgs/Odometry",
    "base_scan": "sensor_msgs/LaserScan",
    "image": "sensor_msgs/Image",
    "depth": "sensor_msgs/Image",
    "camera_info": "sensor_msgs/CameraInfo",
    "tf": "tf2_msgs/TFMessage",
    "clock": "rosgraph_msgs/Clock",
}
LASER = "ranger( sensor( range [0 30] fov 270 samples 541 ) pose [0.05 0 -0.1 0] )"
ROBOT = f"position( size [0.35 0.35 0.25] {LASER} %s )"


def type_of(topic):
    return TYPES[topic.rpartition("/")[2].rstrip("_0123456789")]


class Bench:
    """A stageros in a graph, and a node that listens and commands."""

    def __init__(self, graph, path, *options, **parameters):
        self.graph = graph
        node = graph.node("stageros")
        for name, value in parameters.items():
            node.set_param(f"~{name}", value)
        self.stage = Stageros(node, *options, path)
        self.node = graph.node("driver")
        self.heard = defaultdict(list)
        self.publishers = {}

    def listen(self, *topics):
        for topic in topics:
            self.node.subscriber(topic, message_class(type_of(topic)), self.heard[topic].append)

    def command(self, v=0.0, w=0.0, vy=0.0, topic="cmd_vel"):
        if topic not in self.publishers:
            self.publishers[topic] = self.node.publisher(topic, Twist, queue_size=1)
            self.publishers[topic].wait_for_subscribers()
        message = Twist()
        message.linear.x, message.linear.y, message.angular.z = v, vy, w
        self.publishers[topic].publish(message)

    def go(self, seconds, v=0.0, w=0.0, vy=0.0, topic="cmd_vel"):
        for _ in range(round(seconds * 10)):
            self.command(v, w, vy, topic)
            self.graph.run(0.1)

    @property
    def topics(self):
        return {
            topic: kind
            for topic, kind in self.graph.master.getPublishedTopics("/test", "")[2]
            if not topic.startswith("/rosout")
        }


@pytest.fixture
def graph():
    with Graph(seed=3) as graph:
        yield graph


@pytest.fixture
def bench(graph, tmp_path):
    def make(text, *options, **parameters):
        path = tmp_path / "a.world"
        path.write_text(text, encoding="utf-8")
        return Bench(graph, str(path), *options, **parameters)

    return make


def pose_of(message):
    p, q = message.pose.pose.position, message.pose.pose.orientation
    return (p.x, p.y, yaw_from_quaternion(q.x, q.y, q.z, q.w))


# ---- names ----


def test_several_robots_have_a_namespace_and_frames_with_a_prefix_each(bench):
    ours = bench(ROBOT % 'name "a"' + ROBOT % "pose [2 0 0 0]")
    names = {"odom", "base_pose_ground_truth", "base_scan"}
    assert set(ours.topics) == {f"/robot_{i}/{name}" for i in (0, 1) for name in names} | {"/tf", "/clock"}
    assert list(ours.stage.robots) == ["robot_0", "robot_1"]
    assert ours.stage.robot("a") is ours.stage.robots["robot_0"]
    own = {"odom": "odom", "base_scan": "base_laser_link", "base_pose_ground_truth": "base_pose_ground_truth"}
    ours.listen("tf", *(f"/robot_1/{topic}" for topic in own))
    ours.graph.run(0.15)
    frames = {(t.header.frame_id, t.child_frame_id) for t in ours.heard["tf"][0].transforms}
    chain = ["robot_1/odom", "robot_1/base_footprint", "robot_1/base_link", "robot_1/base_laser_link"]
    assert {f for f in frames if f[0].startswith("robot_1")} == set(pairwise(chain))
    for topic, frame in own.items():
        assert ours.heard[f"/robot_1/{topic}"][0].header.frame_id == f"robot_1/{frame}"


def test_models_names_with_u(bench):
    ours = bench(ROBOT % 'name "a"' + ROBOT % "pose [2 0 0 0]", "-u", "-g")
    assert {topic.split("/")[1] for topic in ours.topics} == {"a", "robot_1", "tf", "clock"}


def test_several_sensors_of_a_kind_are_numbered(bench):
    ours = bench(f"position( {LASER} {LASER} )")
    sensors = {"base_scan_0", "base_scan_1"}
    assert {topic[1:] for topic in ours.topics} == sensors | {"odom", "base_pose_ground_truth", "tf", "clock"}
    ours.listen("base_scan_1", "tf")
    ours.graph.run(0.25)
    assert ours.heard["base_scan_1"][0].header.frame_id == "base_laser_link_1"
    frames = {(t.header.frame_id, t.child_frame_id) for t in ours.heard["tf"][0].transforms}
    assert frames == {("odom", "base_footprint"), ("base_footprint", "base_link"), ("base_link", "base_laser_link_0"),
        ("base_link", "base_laser_link_1")}  # fmt: skip


# ---- time ----


def test_one_robot_has_plain_names_and_publishes_all_once_a_step_with_the_same_stamps(bench):
    ours = bench("interval_sim 50\n" + ROBOT % "")
    topics = ("odom", "base_pose_ground_truth", "base_scan", "tf", "clock")
    assert ours.topics == {f"/{topic}": type_of(topic) for topic in topics}
    ours.listen(*topics)
    ours.graph.run(1.02)
    expected = [50 * i for i in range(1, 21)]
    for topic in topics:
        stamps = [
            m.clock if topic == "clock" else m.transforms[0].header.stamp if topic == "tf" else m.header.stamp
            for m in ours.heard[topic]
        ]
        assert [round(stamp.to_sec() * 1000) for stamp in stamps] == expected, topic
    assert ours.node.get_param("/use_sim_time") is True


def test_pause_and_speed(bench):
    ours = bench("speedup 4\n" + ROBOT % "")
    ours.listen("clock")
    ours.graph.run(1.01)
    assert len(ours.heard["clock"]) == 40
    ours.stage.speed = 1.0
    ours.graph.run(1.0)
    assert len(ours.heard["clock"]) == 50
    ours.stage.pause()
    ours.graph.run(1.0)
    assert len(ours.heard["clock"]) == 50


@pytest.mark.parametrize(("interval", "ticks"), [(100, 10), (50, 10), (200, 10)])
def test_without_a_window_it_takes_ten_steps_a_second_whatever_the_speedup(bench, interval, ticks):
    ours = bench(f"speedup 4\ninterval_sim {interval}\n" + ROBOT % "", "-g")
    ours.listen("clock")
    ours.graph.run(1.01)
    assert len(ours.heard["clock"]) == ticks
    assert ours.stage.now == pytest.approx(1.01 * interval / 100)


def test_notes_come_once_with_their_number(bench):
    laser = "ranger( sensor( range [0 8] samples 9 fov 90 ) sensor( range [0 4] ) )"
    robots = "".join(
        f"position( pose [{i} 0 0 0] acceleration_bounds [0 1 0 1 0 1 0 90] fiducial() {laser} )" for i in range(20)
    )
    notes = bench(robots).stage.file.notes
    assert len(notes) == 2
    for note, times in zip(notes, (20, 20), strict=True):
        assert note.endswith(f"({times} times in this world)")
    assert "a.world:1: a fiducial is not simulated" in notes[0]
    assert "has 2 sensors" in notes[1]


def test_it_ends_at_its_quit_time(bench):
    ours = bench("quit_time 1\npaused 1\n" + ROBOT % "")
    ours.listen("clock")
    ours.graph.run(3.0)
    assert ours.stage.node.is_shutdown()
    assert len(ours.heard["clock"]) == 10
    with pytest.raises(RobotGone, match="was shut down"):
        ours.stage.truth()


# ---- motion ----


def test_a_differential_base_goes_along_an_arc(bench):
    ours = bench(ROBOT % "pose [1 2 0 90]")
    ours.listen("odom", "base_pose_ground_truth")
    ours.go(2.0, v=0.5, w=0.5, vy=9.0)
    # a quarter of a turn to the left is a circle of 1 m radius about (0, 2)
    expected = (math.cos(1.0), 2 + math.sin(1.0), math.pi / 2 + 1.0)
    assert ours.stage.truth() == pytest.approx(expected, abs=1e-9)
    # localization "gps" is the default: odometry is the truth
    assert pose_of(ours.heard["odom"][-1]) == pytest.approx(pose_of(ours.heard["base_pose_ground_truth"][-1]))
    twist = ours.heard["odom"][-1].twist.twist
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == (0.5, 0.0, 0.5)
    truth = ours.heard["base_pose_ground_truth"][-1].twist.twist
    heading = math.pi / 2 + 0.5 * 1.95  # in the middle of the last step
    chord = 0.5 * math.sin(0.025) / 0.025
    assert (truth.linear.x, truth.linear.y) == pytest.approx((chord * math.cos(heading), chord * math.sin(heading)),
        abs=1e-9)  # fmt: skip


def test_an_omnidirectional_base_goes_anywhere(bench):
    ours = bench(ROBOT % 'drive "omni" pose [0 0 0 90]')
    ours.go(2.0, v=0.1, vy=0.3)
    assert ours.stage.truth() == pytest.approx((-0.6, 0.2, math.pi / 2), abs=1e-9)


def test_bounds_cut_a_command(bench):
    ours = bench(ROBOT % "velocity_bounds [-0.2 0.4 0 0 0 0 -45 45]")
    ours.listen("odom")
    for command, told in ((9.0, 0.4), (-9.0, -0.2)):
        ours.go(0.3, v=command, w=command)
        twist = ours.heard["odom"][-1].twist.twist
        assert twist.linear.x == pytest.approx(told)
        assert abs(twist.angular.z) == pytest.approx(math.pi / 4)


def test_odometry_with_errors_drifts_by_its_equation(bench):
    ours = bench(ROBOT % 'pose [1 1 0 0] localization "odom" odom_error [0.08 0 0 4]')
    ours.listen("odom")
    ours.go(4.0, v=0.5, w=0.4)
    ours.graph.run(0.1)
    ex, _, ea = ours.stage.robot().base.reckoning.errors
    v, w = 0.5 * (1 + ex), 0.4 * (1 + ea)
    turned = w * 4.1  # the last command holds until the watchdog: 4.1 s were told at the last step
    last = pose_of(ours.heard["odom"][-1])
    time = ours.heard["odom"][-1].header.stamp.to_sec()
    turned = w * time
    assert abs(ex) > 0.001 < abs(ea)
    assert last == pytest.approx((v / w * math.sin(turned), v / w * (1 - math.cos(turned)), turned), abs=1e-9)


def test_a_robot_stops_when_it_is_told_nothing(bench):
    ours = bench(ROBOT % "")
    ours.listen("odom")
    ours.command(v=0.5)
    ours.command(v=0.5)
    ours.graph.run(0.1)
    ours.command(v=0.5)
    ours.graph.run(3.0)
    moving = [m.header.stamp.to_sec() for m in ours.heard["odom"] if m.twist.twist.linear.x]
    assert moving == pytest.approx([0.1, 0.2])
    assert ours.stage.truth()[0] == pytest.approx(0.5 * (moving[-1] + 0.1))


def test_the_watchdog_is_one_for_all(bench):
    ours = bench(ROBOT % "" + ROBOT % "pose [0 2 0 0]")
    ours.go(0.1, v=0.2, topic="/robot_1/cmd_vel")
    ours.go(2.0, v=0.5, topic="/robot_0/cmd_vel")
    assert ours.stage.truth("robot_1")[0] > 0.3
    ours.graph.run(1.0)
    before = ours.stage.truth("robot_1")
    ours.graph.run(1.0)
    assert ours.stage.truth("robot_1") == before


def test_without_a_watchdog_it_goes_on(bench):
    ours = bench(ROBOT % "", base_watchdog_timeout=0.0)
    ours.go(0.2, v=0.5)
    ours.graph.run(1.8)
    assert ours.stage.truth()[0] > 0.89


def test_crates_are_pushed_and_walls_hold(graph):
    ours = Bench(graph, "package://stage_ros/world/boxes.world")
    ours.go(4.0, v=0.5)
    crate = next(each for each in ours.stage.engine.obstacles() if each.name == "crate_1")
    assert crate.pose[0] > 0.8
    ours.go(6.0, v=0.5)
    x, y, _ = ours.stage.truth("pusher")
    assert x < 3.0
    assert abs(y) < 0.5
    ours.node.service_client("reset_positions", service_class("std_srvs/Empty"))()
    assert ours.stage.truth() == (-1.5, 0.0, 0.0)
    assert next(each for each in ours.stage.engine.obstacles() if each.name == "crate_1").pose == (0.5, 0.0, 0.0)


# ---- lasers ----


def test_ranges_are_exact_and_what_is_not_hit_is_at_the_largest(bench):
    ours = bench(f"{ROBOT % ''}\nmodel( size [1 20 1] pose [3 0 0 0] )")
    ours.listen("base_scan")
    ours.graph.run(0.15)
    (scan,) = ours.heard["base_scan"]
    assert (scan.angle_min, scan.angle_max) == pytest.approx((-0.75 * math.pi, 0.75 * math.pi))
    assert len(scan.ranges) == len(scan.intensities) == 541
    assert scan.angle_increment == pytest.approx(1.5 * math.pi / 540)
    angles = scan.angle_min + np.arange(541) * scan.angle_increment
    ranges, bright = np.array(scan.ranges), np.array(scan.intensities)
    ahead = np.abs(angles) < math.radians(70)
    assert ranges[ahead] == pytest.approx(2.45 / np.cos(angles[ahead]), rel=1e-6)
    behind = np.abs(angles) > math.radians(100)
    assert (ranges[behind] == 30.0).all()
    assert (bright[ahead] == 1).all()
    assert (bright[behind] == 0).all()


def test_what_is_too_near_has_its_range_all_the_same(bench):
    ours = bench(
        "position( size [0.4 0.4 0.4] ranger( sensor( range [1 5] ) pose [0 0 -0.2 0] ) )\nmodel( pose [0.8 0 0 0] )"
    )
    ours.listen("base_scan")
    ours.graph.run(0.15)
    scan = ours.heard["base_scan"][0]
    assert (scan.range_min, list(scan.ranges)) == (1.0, pytest.approx([0.6]))
    assert (scan.angle_min, scan.angle_max, scan.angle_increment) == (0, 0, 0)


def test_noise_has_the_distribution_that_the_file_says(bench):
    sensor = "sensor( range [0 30] fov 10 samples 2001 noise [0.05 0.1 0] )"
    ours = bench(f"position( ranger( {sensor} pose [0 0 -0.5 0] ) )\nmodel( size [1 50 3] pose [4.5 0 0 0] )")
    ours.listen("base_scan")
    ours.graph.run(0.55)
    scans = [np.array(m.ranges) for m in ours.heard["base_scan"]]
    angles = np.linspace(-1, 1, 2001) * math.radians(5)
    exact = 4.0 / np.cos(angles)
    errors = np.concatenate([scan - exact for scan in scans])
    # a normal part and an even one of up to a tenth of the range: their variances add
    expected = math.sqrt(0.05**2 + (4.0 * 0.1) ** 2 / 3)
    assert errors.std() == pytest.approx(expected, rel=0.03)
    assert abs(errors.mean()) < 4 * expected / math.sqrt(len(errors))


@pytest.mark.parametrize(("z", "seen"), [(-0.1, True), (0.0, False)])
def test_robots_see_one_another_if_their_lasers_are_low(bench, z, seen):
    robot = (
        f"position( size [0.4 0.4 0.25] ranger( sensor( range [0 30] fov 0 samples 1 ) pose [0 0 {z} 0] ) "
        "pose [%d 0 0 0] )\n"
    )
    ours = bench(robot % 0 + robot % 3)
    ours.listen("/robot_0/base_scan", "/robot_1/base_scan")
    ours.graph.run(0.15)
    assert list(ours.heard["/robot_0/base_scan"][0].ranges) == pytest.approx([2.8 if seen else 30.0])
    assert list(ours.heard["/robot_1/base_scan"][0].ranges) == [30.0]


# ---- frames ----


def test_where_the_laser_is(bench):
    ours = bench("position( size [0.4 0.4 0.3] ranger( sensor( ) pose [0.1 -0.05 0.02 90] ) )")
    ours.listen("tf")
    ours.graph.run(0.15)
    laser = next(t for t in ours.heard["tf"][0].transforms if t.child_frame_id == "base_laser_link")
    place, turn = laser.transform.translation, laser.transform.rotation
    assert (place.x, place.y, place.z) == pytest.approx((0.1, -0.05, 0.32))
    assert yaw_from_quaternion(turn.x, turn.y, turn.z, turn.w) == pytest.approx(math.pi / 2)


# ---- by hand, and what is wrong ----


def test_a_robot_that_has_no_room_names_its_line(bench):
    with pytest.raises(StageError, match=r"a\.world:2: no robot can be placed at \(0\.00, 0\.00\).*model:0"):
        bench("model( )\nposition( )")


@pytest.mark.parametrize(
    ("second", "words"), [("a", "there is a robot 'a' in the world"), ("b c", "a space is not allowed")]
)
def test_names_that_cannot_be_namespaces_are_told(bench, second, words):
    with pytest.raises(StageError, match=rf"a\.world:2: (.|\n)*{words}"):
        bench(f'position( name "a" )\nposition( name "{second}" pose [2 0 0 0] )', "-u")


@pytest.mark.parametrize(("arguments", "words"), [((), "needs one world file, not 0"), (("a", "b"), "not 2"),
    (("-x", "a"), "knows no option -x")])  # fmt: skip
def test_wrong_arguments_are_answered_with_the_usage(graph, arguments, words):
    with pytest.raises(ScriptError, match=words) as caught:
        Stageros(graph.node("stageros"), *arguments)
    assert "Usage: stageros [-g] [-u] <worldfile>" in str(caught.value)


def test_wrong_parameters(bench, capsys):
    bench(ROBOT % "", base_watchdog_timout=1.0)
    assert "~base_watchdog_timeout" in capsys.readouterr().err
    with pytest.raises(ParameterError, match="base_watchdog_timeout"):
        bench(ROBOT % "", base_watchdog_timeout="never")


def test_a_world_without_robots_goes_on(bench):
    ours = bench("model( )")
    ours.listen("clock")
    ours.graph.run(0.35)
    assert len(ours.heard["clock"]) == 3
    with pytest.raises(RobotGone, match="has no robots"):
        ours.stage.truth()


# ---- scripts ----

SCRIPT = """
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan

rospy.init_node("stopper")
velocity = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    scan = rospy.wait_for_message("base_scan", LaserScan)
    ahead = scan.ranges[len(scan.ranges) // 2]
    if ahead < 0.5:
        break
    command = Twist()
    command.linear.x = 0.4
    velocity.publish(command)
    rate.sleep()
odom = rospy.wait_for_message("odom", Odometry)
print("stopped at %.1f after %.0f s" % (odom.pose.pose.position.x, rospy.get_time()))
"""


def test_rosmini_run(tmp_path):
    (tmp_path / "stopper.py").write_text(SCRIPT, encoding="utf-8")
    world = "package://stage_ros/world/willow-erratic.world"
    command = [
        sys.executable, "-m", "rosmini", "run", "stage_ros/stageros", world, "+", str(tmp_path / "stopper.py"),
    ]  # fmt: skip
    done = run(command)
    assert "stopped at 2.8" in done.stdout, done.stdout + done.stderr


def test_time_begins_when_all_is_there(tmp_path, monkeypatch):
    from rosmini.sim.engine import Engine

    taken = Engine.scan

    def slow(*args, **options):
        graph.scheduler._mono_start -= 3600 * 10**9  # it takes an hour
        return taken(*args, **options)

    monkeypatch.setattr(Engine, "scan", slow)
    (tmp_path / "w.world").write_text(ROBOT % "", encoding="utf-8")
    with Graph(simulated=False) as graph:
        there = Stageros(graph.node("stageros"), str(tmp_path / "w.world"))
        assert there.host.now < 1800.0
