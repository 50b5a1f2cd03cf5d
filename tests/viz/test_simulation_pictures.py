"""The picture of a running simulation, with the simulator itself."""

import math
import re

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.engine import RobotGone
from rosmini.sim.simulator import Simulator
from rosmini.viz import style
from rosmini.viz.simulation_pictures import simulation_picture

Twist = message_class("geometry_msgs/Twist")


@pytest.fixture
def graph():
    with Graph(seed=1) as graph:
        yield graph


def drive(graph, linear, angular, duration):
    """Repeat a command, as whoever drives a TurtleBot3 does."""
    node = graph.node("driver")
    publisher = node.publisher("cmd_vel", Twist)
    command = Twist()
    command.linear.x, command.angular.z = linear, angular
    timer = node.timer(0.1, lambda _: publisher.publish(command))
    graph.run(duration)
    timer.shutdown()
    node.shutdown()


def test_a_simulation_shows_the_robot_where_it_is_and_its_last_scan(graph):
    simulator = Simulator(graph.node("simulator"))
    before = simulation_picture(simulator)
    assert before.text.splitlines()[1] == "burger: pose (0.00, 0.00, 0.0 deg)"
    assert "scan" not in before.text
    drive(graph, 0.2, 0.0, 3.0)
    view = simulation_picture(simulator, title="Now")
    x, y, _ = simulator.truth()
    assert view.text.splitlines()[0].startswith("Now: 4.16 x 3.66 m")
    assert f"burger: pose ({x:.2f}, {y:.2f}, " in view.text
    assert 0.4 < x < 0.61
    assert re.search(r"scan: 3\d\d of 360 beams hit, nearest 0\.\d\d m", view.text)
    assert simulator.show().html == simulation_picture(simulator).html


def test_while_the_robot_turns_the_scan_stays_where_it_was_taken(graph):
    simulator = Simulator(graph.node("simulator"))
    drive(graph, 0.0, 2.0, 2.15)
    assert abs(simulator.truth()[2] - simulator.scan_pose[2]) > 0.1
    xs = re.findall(r"M(\S+) (\S+?)h0", simulation_picture(simulator).svg)
    # the south wall's face lies at y = -0.6: the hits on it are in one row however the robot is turned
    ys = np.array([float(y) for _, y in xs])
    lowest = ys[ys > ys.max() - 8]
    assert len(lowest) > 40
    assert np.std(lowest) < 2.0


def test_a_removed_robot_is_an_error_that_says_so(graph):
    simulator = Simulator(graph.node("simulator"))
    simulator.remove()
    with pytest.raises(RobotGone):
        simulation_picture(simulator)


def test_all_robots_are_drawn_with_their_names(graph):
    simulator = Simulator(graph.node("simulator"), model="burger")
    simulator.spawn("tb3_1", "waffle", (2.05, 1.22, math.pi))
    drive(graph, 0.2, 0.0, 2.0)
    view = simulation_picture(simulator)
    assert "tb3_1 (waffle): pose (2.05, 1.22, 180.0 deg)" in view.text
    assert "Beside it there is tb3_1 at x 2.05 m, y 1.22 m." in view.alt
    assert ">tb3_1</text>" in view.svg and f'fill="{style.LIGHT["green"]}"' in view.svg
