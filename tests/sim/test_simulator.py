"""The node: topics, rates, frames, commands, and what happens when something is wrong."""

import math
import sys
import threading
from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.angles import yaw_from_quaternion
from rosmini.core.graph import Graph
from rosmini.msgs import message_class, service_class
from rosmini.sim.engine import RobotGone
from rosmini.sim.models import BURGER, GRAVITY, UnknownModel
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Box, Obstacle, WorldError
from rosmini.sim.worlds import world

from ..processes import PATIENCE, run

Twist = message_class("geometry_msgs/Twist")
TOPICS = {
    "scan": "sensor_msgs/LaserScan",
    "odom": "nav_msgs/Odometry",
    "/tf": "tf2_msgs/TFMessage",
    "joint_states": "sensor_msgs/JointState",
    "imu": "sensor_msgs/Imu",
    "base_pose_ground_truth": "nav_msgs/Odometry",
}
RATES = {"scan": 5, "odom": 30, "/tf": 30, "joint_states": 30, "imu": 200, "base_pose_ground_truth": 30}


class Driver:
    """A node that listens to all topics and repeats a command ten times a second."""

    def __init__(self, graph, topics=tuple(TOPICS), namespace="/"):
        self.graph = graph
        self.node = graph.node("driver", namespace=namespace)
        self.heard = defaultdict(list)
        for topic in topics:
            self.node.subscriber(topic, message_class(TOPICS[topic]), self.heard[topic].append)
        self.command = Twist()
        self.publisher = self.node.publisher("cmd_vel", Twist, queue_size=1)

    def go(self, seconds, v=0.0, w=0.0):
        self.command.linear.x, self.command.angular.z = v, w
        for _ in range(round(seconds * 10)):
            self.publisher.publish(self.command)
            self.graph.run(0.1)


def start(graph, **options):
    """A simulator without noise, unless asked for."""
    parameters = {"noise": 0.0, **options.pop("parameters", {})}
    node = graph.node("simulator", namespace=options.pop("namespace", "/"))
    for name, value in parameters.items():
        node.set_param("~" + name, value)
    return Simulator(node, **options)


def seconds(message):
    return message.header.stamp.to_sec()


# -- topics ----------------------------------------------------------------------------------------------------------


def test_each_topic_has_its_type_its_rate_and_its_frames(graph):
    start(graph)
    driver = Driver(graph)
    graph.run(0.5)
    for messages in driver.heard.values():
        messages.clear()
    graph.run(4.0)
    assert {topic: len(messages) / 4 for topic, messages in driver.heard.items()} == RATES
    for topic, messages in driver.heard.items():
        if topic != "/tf":
            steps = np.diff([seconds(message) for message in messages])
            np.testing.assert_allclose(steps, 1 / RATES[topic], atol=1e-6)
    published = dict(graph.master.getTopicTypes("/test")[2])
    assert {name: published[name if name.startswith("/") else f"/{name}"] for name in TOPICS} == TOPICS
    assert published["/cmd_vel"] == "geometry_msgs/Twist"
    last = {topic: messages[-1] for topic, messages in driver.heard.items()}
    (transform,) = last["/tf"].transforms
    assert (last["scan"].header.frame_id, last["imu"].header.frame_id) == ("base_scan", "imu_link")
    for message, frame in ((last["odom"], "odom"), (transform, "odom"), (last["base_pose_ground_truth"], "map")):
        assert (message.header.frame_id, message.child_frame_id) == (frame, "base_footprint")
    assert last["joint_states"].name == ["wheel_left_joint", "wheel_right_joint"]


def test_the_scan_is_that_of_the_lds(graph):
    simulator = start(graph, world="arena", parameters={"x": 0.5, "y": 0.0, "yaw": 0.0})
    driver = Driver(graph)
    graph.run(0.45)
    scan = driver.heard["scan"][-1]
    assert (scan.angle_min, len(scan.ranges), len(scan.intensities)) == (0.0, 360, 0)
    assert scan.angle_increment == pytest.approx(math.radians(1))
    assert scan.angle_max == pytest.approx(math.radians(359))
    assert (scan.time_increment, scan.scan_time) == (pytest.approx(-0.2 / 360), pytest.approx(0.2))
    assert (scan.range_min, scan.range_max) == (pytest.approx(0.12), 3.5)
    assert scan.ranges[0] == pytest.approx(1.532)
    assert scan.ranges[90] == pytest.approx(2.0)
    assert scan.ranges[180] == pytest.approx(2.468)
    mine = simulator.last_scan()
    assert mine.header.stamp == scan.header.stamp
    np.testing.assert_array_equal(mine.ranges, scan.ranges)
    assert simulator.scan_pose == (0.5, 0.0, 0.0)


def test_where_all_beams_are_measured_at_once_there_is_no_time_between_them(graph):
    start(graph, parameters={"sweep": False})
    driver = Driver(graph)
    graph.run(0.45)
    assert str(driver.heard["scan"][-1].time_increment) == "0.0"  # and not -0.0, which tools would show


def test_what_is_too_far_is_infinite_or_zero(graph):
    simulator = start(graph, world="empty")
    graph.run(0.5)
    assert set(simulator.last_scan().ranges.tolist()) == {math.inf}
    zero = start(graph, namespace="/old", world="empty", parameters={"use_rep_117": False})
    graph.run(0.5)
    assert set(zero.last_scan().ranges.tolist()) == {0.0}


def test_covariances(graph):
    start(graph)
    driver = Driver(graph)
    graph.run(0.5)
    odom, imu = driver.heard["odom"][-1], driver.heard["imu"][-1]
    assert np.diag(odom.pose.covariance.reshape(6, 6)).tolist() == [1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3]
    assert np.count_nonzero(odom.pose.covariance) == 6
    assert np.diag(imu.orientation_covariance.reshape(3, 3)).tolist() == [0.0025] * 3
    assert np.diag(imu.angular_velocity_covariance.reshape(3, 3)).tolist() == [0.02] * 3
    assert np.diag(imu.linear_acceleration_covariance.reshape(3, 3)).tolist() == [0.04] * 3


def test_a_drive_is_told_alike_on_all_topics(graph):
    simulator = start(graph, world="arena")
    driver = Driver(graph)
    graph.run(0.1)
    driver.go(4.0, 0.1, 0.3)
    x, y, theta = simulator.truth()
    assert math.hypot(x, y) > 0.3
    truth, odom = driver.heard["base_pose_ground_truth"][-1], driver.heard["odom"][-1]
    (transform,) = driver.heard["/tf"][-1].transforms
    q = truth.pose.pose.orientation
    assert (truth.pose.pose.position.x, truth.pose.pose.position.y) == pytest.approx((x, y), abs=4e-3)
    assert yaw_from_quaternion(q.x, q.y, q.z, q.w) == pytest.approx(theta, abs=0.011)
    assert (odom.pose.pose.position.x, odom.pose.pose.position.y) == pytest.approx(
        (truth.pose.pose.position.x, truth.pose.pose.position.y), abs=1e-3
    )
    assert (transform.transform.translation.x, transform.transform.rotation.z) == (
        odom.pose.pose.position.x,
        odom.pose.pose.orientation.z,
    )
    assert (truth.twist.twist.linear.x, truth.twist.twist.angular.z) == pytest.approx((0.1, 0.3))
    assert (odom.twist.twist.linear.x, odom.twist.twist.angular.z) == pytest.approx((0.1, 0.3), abs=0.03)
    joints = driver.heard["joint_states"][-1]
    assert joints.velocity == pytest.approx([(0.1 - 0.024) / 0.033, (0.1 + 0.024) / 0.033], abs=0.06)
    assert joints.position[1] > joints.position[0] > 0
    imu = driver.heard["imu"][-1]
    assert imu.angular_velocity.z == pytest.approx(0.3)
    assert imu.linear_acceleration.x == pytest.approx(0.032 * 0.09)
    assert imu.linear_acceleration.y == pytest.approx(0.1 * 0.3)
    assert imu.linear_acceleration.z == pytest.approx(GRAVITY)
    q = imu.orientation
    assert yaw_from_quaternion(q.x, q.y, q.z, q.w) == pytest.approx(theta, abs=0.002)


def test_without_tf_nobody_publishes_it(graph):
    start(graph, parameters={"tf": False})
    assert "/tf" not in dict(graph.master.getTopicTypes("/test")[2])
    driver = Driver(graph)
    graph.run(1.0)
    assert driver.heard["/tf"] == []
    assert len(driver.heard["odom"]) > 20


# -- commands --------------------------------------------------------------------------------------------------------


def test_half_a_second_after_the_last_command_the_robot_stops(graph):
    simulator = start(graph, world="empty")
    driver = Driver(graph, topics=())
    graph.run(0.1)
    driver.go(0.1, 0.2)
    graph.run(5.0)
    assert simulator.truth()[0] == pytest.approx(0.2 * 0.5, abs=1e-6)


def test_without_a_timeout_a_command_holds(graph):
    simulator = start(graph, world="empty", parameters={"cmd_vel_timeout": 0.0})
    driver = Driver(graph, topics=())
    graph.run(0.1)
    driver.go(0.1, 0.2)
    graph.run(4.9)
    assert simulator.truth()[0] == pytest.approx(0.2 * 5 - 0.02, abs=1e-6)


@pytest.mark.parametrize(
    ("v", "w", "field"),
    [(math.nan, 0.0, "linear.x = nan"), (0.1, math.inf, "angular.z = inf"), (-math.inf, 0.1, "linear.x = -inf")],
)
def test_a_command_that_is_no_number_stops_the_robot_with_one_warning(graph, capsys, v, w, field):
    simulator = start(graph, world="empty")
    driver = Driver(graph)
    graph.run(0.1)
    driver.go(1.0, 0.2)
    driver.go(1.0, v, w)
    stopped = simulator.truth()
    assert stopped[0] == pytest.approx(0.2, abs=1e-6)
    assert stopped[2] == 0.0
    written = capsys.readouterr().err
    assert written.count("[WARN]") == 1
    assert f"/driver published {field} on /cmd_vel" in written
    driver.go(1.0, 0.2)
    assert simulator.truth()[0] > 0.35
    assert len(driver.heard["odom"]) >= 90


# -- noise -----------------------------------------------------------------------------------------------------------


def drive_with_noise(topics=tuple(TOPICS), *, seed=0, company=False, odometry="imu"):
    """What is heard on a drive through the room, in the messages' bytes."""
    with Graph(seed=seed) as graph:
        start(graph, parameters={"noise": 1.0, "odometry": odometry}, world="arena")
        if company:
            start(graph, namespace="/other", parameters={"noise": 1.0, "tf": False}, world="arena")
        driver = Driver(graph, topics)
        graph.run(0.1)
        driver.go(2.0, 0.2, 0.3)
        driver.go(1.0, -0.1, 1.0)
        return {
            topic: [type(message)._encode(message) for message in messages] for topic, messages in driver.heard.items()
        }


def test_another_seed_is_another_run():
    one, other = drive_with_noise(seed=1), drive_with_noise(seed=2)
    assert one["scan"] != other["scan"]
    assert one["base_pose_ground_truth"] != other["base_pose_ground_truth"]
    assert one["imu"] != other["imu"]
    assert one["odom"] != other["odom"]


def test_what_the_encoders_count_follows_from_the_commands_alone():
    one, other = (drive_with_noise(seed=seed, odometry="wheels") for seed in (1, 2))
    assert one["base_pose_ground_truth"] != other["base_pose_ground_truth"]
    assert one["odom"] == other["odom"]


def test_who_else_listens_or_drives_changes_nothing():
    every = drive_with_noise()
    assert drive_with_noise(topics=("scan", "odom"))["odom"] == every["odom"]
    accompanied = drive_with_noise(company=True)
    assert accompanied["scan"] == every["scan"]
    assert accompanied["imu"] == every["imu"]


# -- starting --------------------------------------------------------------------------------------------------------


def test_the_parameters_choose_the_world_and_the_place(graph):
    simulator = start(graph, parameters={"world": "arena", "x": 1.0, "y": -0.5, "yaw": 1.5, "model": "burger"})
    assert (simulator.world.name, simulator.model) == ("arena", BURGER)
    assert simulator.truth() == (1.0, -0.5, 1.5)


@pytest.mark.parametrize(
    ("parameters", "error", "message"),
    [
        ({"world": "roon"}, WorldError, "did you mean room"),
        ({"model": "burgr"}, UnknownModel, "did you mean burger"),
        ({"wrold": "room"}, ParameterError, r"did you mean ~world\?"),
        ({"noise": -1.0}, ParameterError, "at least 0"),
        ({"world": "arena", "x": 1.99}, WorldError, "the obstacle 'east wall' is in its way"),
    ],
)
def test_what_cannot_be_started_says_why_and_leaves_nothing(graph, parameters, error, message):
    before = graph.master.getSystemState("/test")[2][0]
    with pytest.raises(error, match=message):
        start(graph, parameters=parameters)
    topics = [name for name, _ in graph.master.getSystemState("/test")[2][0]]
    assert set(topics) <= {"/rosout", *(name for name, _ in before)}  # that of the node, which was there before
    graph.run(1.0)


# -- looking, placing, resetting, removing ---------------------------------------------------------------------------


@pytest.mark.parametrize("odometry", ["imu", "wheels"])
def test_place_moves_the_truth_and_not_the_wheels(graph, odometry):
    simulator = start(graph, world="arena", parameters={"odometry": odometry})
    driver = Driver(graph)
    graph.run(0.1)
    driver.go(1.0, 0.2)
    before = simulator.odometry
    simulator.place((-1.0, 1.0, 0.5))
    graph.run(0.2)
    assert simulator.truth() == (-1.0, 1.0, 0.5)
    x, y, theta = before
    felt = 0.5 if odometry == "imu" else 0.0  # an IMU feels that it is turned while it is carried
    assert simulator.odometry == pytest.approx((x, y, theta + felt), abs=3e-3)
    with pytest.raises(WorldError, match="'north wall'"):
        simulator.place((0.0, 2.0, 0.0))
    with pytest.raises(RobotGone, match="no robot 'tb3'"):
        simulator.truth("tb3")


def test_the_service_puts_the_robot_back(graph):
    simulator = start(graph, world="arena")
    driver = Driver(graph)
    graph.run(0.1)
    driver.go(2.0, 0.2, 0.5)
    reset = driver.node.service_client("reset_positions", service_class("std_srvs/Empty"))
    reset()
    graph.run(0.2)
    assert simulator.truth() == (0.0, 0.0, 0.0)
    assert simulator.odometry == (0.0, 0.0, 0.0)
    assert driver.heard["odom"][-1].pose.pose.position.x == 0.0
    driver.go(1.0, 0.2)
    assert simulator.truth()[0] == pytest.approx(0.18, abs=1e-6)


def test_a_removed_robot_leaves_the_graph_in_order(graph):
    simulator = start(graph)
    driver = Driver(graph)
    graph.run(0.5)
    simulator.remove()
    simulator.remove()
    graph.run(0.001)  # what was sent before arrives
    heard = {topic: len(messages) for topic, messages in driver.heard.items()}
    graph.run(2.0)
    assert {topic: len(messages) for topic, messages in driver.heard.items()} == heard
    topics = dict(graph.master.getSystemState("/test")[2][0])
    assert not set(topics) & {"/scan", "/odom", "/imu", "/tf", "/joint_states", "/base_pose_ground_truth"}
    for call in (simulator.truth, simulator.last_scan, simulator.reset, lambda: simulator.place((0, 0, 0))):
        with pytest.raises(RobotGone, match="'burger' is no longer in the world 'room': it was removed"):
            call()
    driver.go(0.2, 0.1)
    again = start(graph, namespace="/again")
    graph.run(0.5)
    assert again.last_scan() is not None


def test_after_the_nodes_shutdown_nothing_is_left(graph):
    simulator = start(graph)
    Driver(graph)
    graph.run(0.5)
    simulator.node.shutdown("the test wants it")
    assert graph.run(5.0).reason == "time"
    assert graph.scheduler.waiting() == ()
    with pytest.raises(RobotGone, match="the node /simulator was shut down"):
        simulator.truth()
    simulator.remove()


def test_before_the_first_revolution_there_is_no_scan(graph):
    assert start(graph).last_scan() is None


def test_another_thread_may_look_while_the_graph_is_driven(graph):
    simulator = start(graph, world="arena")
    driver = Driver(graph, topics=())
    graph.run(0.1)
    seen = []

    def look():
        seen.extend([simulator.truth(), simulator.last_scan()])

    driver.go(1.0, 0.2)
    thread = threading.Thread(target=look)
    thread.start()
    while thread.is_alive():
        driver.go(0.1, 0.2)
    thread.join()
    (x, _, _), scan = seen
    assert x >= 0.18 - 1e-6
    assert len(scan.ranges) == 360


# -- clocks and scripts ----------------------------------------------------------------------------------------------


def test_in_wall_time_it_runs_too():
    with Graph(simulated=False, rate=50.0) as graph:
        simulator = start(graph, world="arena")
        driver = Driver(graph, topics=("odom", "scan", "imu"))
        driver.publisher.wait_for_subscribers()
        graph.run(100.0, until=lambda: len(driver.heard["odom"]) > 0)
        driver.command.linear.x = 0.2
        # On a slow machine a command may be too old when it is heard.
        driver.node.timer(0.1, lambda _: driver.publisher.publish(driver.command))
        far = graph.run(10_000.0, until=lambda: len(driver.heard["scan"]) > 20 and simulator.truth()[0] > 0.1)
        assert far.reason == "condition"
        stamps = [seconds(message) for message in driver.heard["odom"]]
        assert stamps == sorted(stamps)
        assert len(driver.heard["imu"]) > len(driver.heard["odom"])


def test_a_computer_that_stalls_does_not_make_the_robot_jump():
    with Graph(simulated=False) as graph:
        start(graph, world="empty", parameters={"cmd_vel_timeout": 0.0})
        driver = Driver(graph, topics=("odom",))
        driver.publisher.wait_for_subscribers()
        driver.command.linear.x = 0.2
        driver.publisher.publish(driver.command)
        graph.run(PATIENCE, until=lambda: len(driver.heard["odom"]) > 2)
        graph.scheduler._mono_start -= 3_000_000_000  # the clock jumps on by 3 s
        count = len(driver.heard["odom"])
        graph.run(PATIENCE, until=lambda: len(driver.heard["odom"]) > count + 2)
        steps = np.diff([message.pose.pose.position.x for message in driver.heard["odom"]])
        assert steps.max() < 0.02


def test_importing_rosmini_loads_no_physics():
    code = "import rosmini, sys; sys.exit('rosmini.sim' in sys.modules or 'numba' in sys.modules)"
    assert run([sys.executable, "-c", code]).returncode == 0


def test_a_start_that_is_taken_is_named_with_the_arguments_that_move_it(graph, capsys):
    taken = world("arena").with_obstacles([Obstacle("crate", Box(0.5, 0.5))])
    taken = replace(taken, starts=((0.0, 0.0, 0.0),))
    simulator = start(graph, world=taken)
    assert simulator.world.blocked(simulator.truth(), BURGER.footprint) is None
    said = "".join(capsys.readouterr())
    assert said.count("the obstacle 'crate' is there") == 1
    assert "x:=, y:= and yaw:=" in said
    simulator.node.shutdown()
    with pytest.raises(WorldError, match=r"'crate' is in its way.*There is room at .*x:=, y:= and yaw:="):
        start(graph, world=taken, parameters={"x": 0.1, "y": 0.0})
