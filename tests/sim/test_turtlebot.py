"""A TurtleBot3's odometry: what its heading comes from, and how it drifts."""

import math

import numpy as np
import pytest

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.angles import normalize_angle, yaw_from_quaternion
from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.engine.odometry import Odometry
from rosmini.sim.models import BURGER
from rosmini.sim.simulator import Simulator, SimulatorParameters

Twist = message_class("geometry_msgs/Twist")
KINDS = {
    "odom": "nav_msgs/Odometry",
    "imu": "sensor_msgs/Imu",
    "/tf": "tf2_msgs/TFMessage",
    "sensor_state": "turtlebot3_msgs/SensorState",
}


class Bench:
    """A robot, commands for it, and what it says."""

    def __init__(self, graph, **parameters):
        self.graph = graph
        node = graph.node("simulator")
        for name, value in {"world": "empty", "cmd_vel_timeout": 0.0, "board": True, **parameters}.items():
            node.set_param("~" + name, value)
        self.simulator = Simulator(node)
        self.node = graph.node("bench")
        self.heard = {topic: [] for topic in KINDS}
        for topic, kind in KINDS.items():
            self.node.subscriber(topic, message_class(kind), self.heard[topic].append)
        self.publisher = self.node.publisher("cmd_vel", Twist, queue_size=1)
        self.zero = self.node.publisher("reset", message_class("std_msgs/Empty"))
        graph.run(0.05)

    def go(self, seconds, v=0.0, w=0.0):
        command = Twist()
        command.linear.x, command.angular.z = v, w
        self.publisher.publish(command)
        self.graph.run(seconds)

    def headings(self, topic):
        """By stamp [ns]."""
        found = {}
        for message in self.heard[topic]:
            q = message.orientation if topic == "imu" else message.pose.pose.orientation
            found[message.header.stamp.to_nsec()] = yaw_from_quaternion(q.x, q.y, q.z, q.w)
        return found

    @property
    def off(self):
        """By how much the heading of odometry is off, which counts from where the robot started [rad]."""
        turned = self.simulator.truth()[2] - self.simulator.robot().robot.start[2]
        return float(normalize_angle(self.simulator.odometry[2] - turned))


def test_the_heading_of_odometry_is_the_one_that_the_imu_tells(graph):
    bench = Bench(graph)
    for v, w in ((0.2, 0.7), (-0.1, -2.5), (0.0, 0.0), (0.1, 2.8)):
        bench.go(2.0, v, w)
    odom, imu = bench.headings("odom"), bench.headings("imu")
    both = sorted(odom.keys() & imu.keys())
    assert len(both) > 70  # ten times a second both are told at the same instant
    off = normalize_angle(np.array([odom[at] - imu[at] for at in both]))
    assert np.abs(off).max() < 1e-9
    assert abs(bench.off) > 1e-3


def test_the_way_is_that_of_the_ticks_along_the_heading_of_the_imu(graph):
    bench = Bench(graph)
    bench.go(1.0, 0.2, 1.0)
    bench.go(1.0, 0.1, -2.0)
    counted = Odometry(BURGER)
    states = {each.header.stamp.to_nsec(): each for each in bench.heard["sensor_state"]}
    before = 0.0
    for message in bench.heard["odom"]:
        stamp = message.header.stamp.to_nsec()
        heading = bench.headings("odom")[stamp]
        state = states[stamp]
        counted.update(state.left_encoder, state.right_encoder, 1 / 30, heading - before)
        before = heading
        position, twist = message.pose.pose.position, message.twist.twist
        assert (position.x, position.y) == pytest.approx(counted.pose[:2], abs=1e-9)
        assert (twist.linear.x, twist.angular.z) == pytest.approx((counted.v, counted.w), abs=1e-8)
    assert math.hypot(*counted.pose[:2]) > 0.05


def test_a_heading_goes_round_without_a_jump(graph):
    bench = Bench(graph, noise=0.0)
    bench.go(10.0, 0.1, 2.0)
    assert bench.simulator.odometry[2] == pytest.approx(
        bench.simulator.truth()[2], abs=0.07
    )  # told up to a 30th of a second ago
    assert bench.simulator.odometry[2] > 6 * math.pi
    rates = [message.twist.twist.angular.z for message in bench.heard["odom"]]
    assert max(rates) < 2.1


def test_wheels_that_slip_against_a_wall_turn_nothing_but_the_odometry_of_wheels():
    """One wheel at a wall: the robot stands, and both wheels spin, in opposite directions."""
    off = {}
    for odometry in ("imu", "wheels"):
        with Graph() as graph:
            bench = Bench(graph, noise=0.0, world="arena", x=1.85, y=0.0, yaw=0.4, odometry=odometry)
            bench.go(3.0, 0.2)
            bench.go(1.0, 0.2, 1.0)
            bench.go(0.5)
            off[odometry] = abs(bench.off)
    assert off["imu"] < 1e-3
    assert off["wheels"] > 0.1


def errors(odometry, seconds, v, w, seeds):
    found = []
    for seed in seeds:
        with Graph(seed=seed) as graph:
            bench = Bench(graph, odometry=odometry, board=False)
            bench.heard.clear()
            bench.go(seconds, v, w)
            found.append(bench.off)
    return np.array(found)


@pytest.mark.nightly
def test_a_robot_that_stands_drifts_by_its_gyroscope_and_not_by_its_wheels():
    off = errors("imu", 10.0, 0.0, 0.0, range(12))
    step = BURGER.unit.gyro_step * 10.0
    # uniform between none and one step of the converter, and a walk that is much smaller
    assert off.mean() == pytest.approx(step / 2, abs=4 * step / math.sqrt(12 * 12))
    assert -0.15 * step < off.min() and off.max() < 1.2 * step
    assert not errors("wheels", 10.0, 0.0, 0.0, range(2)).any()


@pytest.mark.nightly
def test_the_error_of_turns_is_that_of_the_scale_or_of_the_distance_of_the_wheels():
    turned = 4.0 * 2.0
    imu = errors("imu", 4.0, 0.0, 2.0, range(16)) - BURGER.unit.gyro_step * 2.0
    assert imu.std() == pytest.approx(
        math.hypot(BURGER.unit.gyro_scale * turned, BURGER.unit.gyro_step * 4 / math.sqrt(12)), rel=0.5
    )
    wheels = errors("wheels", 4.0, 0.0, 2.0, range(16))
    assert wheels.std() == pytest.approx(BURGER.errors.separation * turned, rel=0.5)


@pytest.mark.nightly
def test_reset_calibrates_the_gyroscope_and_sets_odometry_to_zero(graph):
    bench = Bench(graph)
    bench.go(3.0, 0.1, 0.5)
    bench.zero.publish()  # while it turns, so that this turn is rest from then on
    bench.graph.run(0.05)
    assert abs(bench.simulator.odometry[2]) < 0.01
    bench.graph.run(2.0)
    assert abs(bench.simulator.odometry[2]) < 0.05
    bench.go(1.0)
    bench.zero.publish()
    bench.graph.run(2.0)
    assert abs(bench.simulator.odometry[2]) < 3 * BURGER.unit.gyro_step
    odom, imu = bench.headings("odom"), bench.headings("imu")
    last = max(odom.keys() & imu.keys())
    assert abs(imu[last] - odom[last]) > 0.1  # the IMU's own heading goes on


def test_another_source_is_an_error_that_names_it(graph):
    with pytest.raises(ParameterError, match=r"odometry.* is 'wheel'; did you mean wheels"):
        Bench(graph, odometry="wheel")
    row = next(row for row in SimulatorParameters.table() if row[0] == "~odometry")
    assert row[2:4] == ("imu", "imu, wheels")
