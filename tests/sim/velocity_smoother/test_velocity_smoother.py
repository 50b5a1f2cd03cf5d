"""Commands that jump become commands that a robot can follow."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import ParameterError, RosminiError
from rosmini.msgs import message_class, service_class
from rosmini.sim.velocity_smoother.node import VelocitySmootherNode
from rosmini.sim.velocity_smoother.smoother import Limits, VelocitySmoother, towards

Twist = message_class("geometry_msgs/Twist")
speed = st.floats(-2.0, 2.0)


@given(speed, speed, speed, speed, st.floats(0.01, 1.0), st.floats(0.01, 3.0), st.floats(0.5, 3.0))
def test_no_step_is_larger_than_the_limits_and_its_direction_is_kept(v, w, tv, tw, av, aw, factor):
    limits = Limits(accel_v=av, accel_w=aw, decel_factor=factor)
    nv, nw = towards((v, w), (tv, tw), limits, 0.05)
    hardest = max(factor, 1.0) * 0.05
    assert abs(nv - v) <= av * hardest + 1e-12
    assert abs(nw - w) <= aw * hardest + 1e-12
    # on the straight line from the last to the target
    assert (nv - v) * (tw - w) == pytest.approx((nw - w) * (tv - v), abs=1e-9)
    assert min(v, tv) - 1e-12 <= nv <= max(v, tv) + 1e-12


def test_braking_is_harder_by_the_factor():
    limits = Limits(accel_v=0.5, decel_factor=2.0)
    assert towards((0.0, 0.0), (1.0, 0.0), limits, 0.1)[0] == pytest.approx(0.05)
    assert towards((1.0, 0.0), (0.5, 0.0), limits, 0.1)[0] == pytest.approx(0.9)
    assert towards((1.0, 0.0), (0.0, 0.0), limits, 0.1)[0] == pytest.approx(0.9)
    # still rolling back, by the odometry: that is braking too
    assert towards((0.0, 0.0), (1.0, 0.0), limits, 0.1, (-0.5, 0.0))[0] == pytest.approx(0.1)


def run(smoother, commands, seconds, begin=10.0):
    """What comes out if `commands(t)` comes in at 10 Hz."""
    told = []
    for i in range(round(seconds / smoother.period)):
        t = begin + i * smoother.period
        if i % 2 == 0 and commands(t) is not None:
            smoother.command(*commands(t), t)
        told.append(smoother.step(t))
    return told


def test_a_jump_becomes_a_ramp_of_the_right_slope():
    told = run(VelocitySmoother(Limits(accel_v=0.5)), lambda t: (0.4, 0.0), 1.0)
    assert [v for v, _ in told][:16] == pytest.approx([0.025 * (i + 1) for i in range(16)])
    assert {v for v, _ in told[16:]} == {0.4}


def test_an_input_that_ends_stops_the_robot_and_then_all_is_quiet():
    smoother = VelocitySmoother(Limits(accel_v=1.0))
    told = run(smoother, lambda t: (0.2, 0.0) if t < 11.0 else None, 3.0)
    ended = next(i for i, out in enumerate(told) if i > 20 and out is not None and out[0] < 0.2)
    assert 10.0 + ended * 0.05 == pytest.approx(10.9 + 0.3 + 0.05, abs=0.051)
    assert told[-1] is None
    assert smoother.output == (0.0, 0.0)
    assert not smoother.active


def test_with_feedback_it_starts_from_the_robots_own_speed():
    smoother = VelocitySmoother(Limits(accel_v=0.5), feedback="commands")
    run(smoother, lambda t: (0.0, 0.0), 0.5)
    smoother.measured = (0.6, 0.0)
    smoother.command(0.8, 0.0, 10.5)
    assert smoother.step(10.5) == (pytest.approx(0.625), 0.0)


def test_periods_and_feedbacks_are_checked():
    with pytest.raises(RosminiError, match="positive"):
        VelocitySmoother(period=0.0)
    with pytest.raises(RosminiError, match="one of none, odometry, commands"):
        VelocitySmoother(feedback="sonar")


class Ears:
    """What comes out of a smoother, and the way in."""

    def __init__(self, graph, **parameters):
        node = graph.node("velocity_smoother")
        for name, value in parameters.items():
            node.set_param("~" + name, value)
        self.smoother = VelocitySmootherNode(node)
        self.node = graph.node("driver")
        self.heard = []
        self.node.subscriber("velocity_smoother/smooth_cmd_vel", Twist, lambda m: self.heard.append(m.linear.x))
        self.publisher = self.node.publisher("velocity_smoother/raw_cmd_vel", Twist, queue_size=1)
        self.graph = graph
        graph.run(0.1)

    def go(self, seconds, v):
        message = Twist()
        message.linear.x = v
        for _ in range(round(seconds * 10)):
            self.publisher.publish(message)
            self.graph.run(0.1)


def test_the_node_publishes_ramps_at_its_frequency(graph):
    ears = Ears(graph, accel_lim_v=0.5, frequency=50.0)
    ears.go(1.0, 0.2)
    assert len(ears.heard) == pytest.approx(50, abs=2)
    steps = [b - a for a, b in zip(ears.heard, ears.heard[1:], strict=False)]
    assert max(steps) == pytest.approx(0.01)
    assert ears.heard[-1] == 0.2
    graph.run(2.0)
    assert ears.heard[-1] == 0.0
    count = len(ears.heard)
    graph.run(1.0)
    assert len(ears.heard) == count


def test_limits_change_while_it_runs(graph):
    ears = Ears(graph)
    change = ears.node.service_client(
        "velocity_smoother/set_parameters", service_class("dynamic_reconfigure/Reconfigure")
    )
    double = message_class("dynamic_reconfigure/DoubleParameter")
    config = message_class("dynamic_reconfigure/Config")(doubles=[double(name="speed_lim_v", value=0.1)])
    change(config)
    ears.go(1.0, 0.5)
    assert ears.heard[-1] == pytest.approx(0.1)


def test_what_is_no_number_stops_with_one_warning(graph, capsys):
    ears = Ears(graph)
    ears.go(1.0, 0.2)
    ears.go(1.0, math.nan)
    assert ears.heard[-1] == 0.0
    assert capsys.readouterr().err.count("must be a finite number") == 1


def test_it_hears_the_robots_odometry(graph):
    ears = Ears(graph, robot_feedback=1)
    odometry = message_class("nav_msgs/Odometry")
    publisher = ears.node.publisher("velocity_smoother/odometry", odometry)
    publisher.wait_for_subscribers()
    message = odometry()
    message.twist.twist.linear.x = 0.7
    publisher.publish(message)
    ears.go(0.1, 0.9)
    assert ears.heard[0] == pytest.approx(0.725)


def test_an_unknown_kind_of_feedback_is_none(graph, capsys):
    Ears(graph, robot_feedback=3)
    assert "Invalid robot feedback type (3)" in capsys.readouterr().err
    with pytest.raises(ParameterError, match="robot_feedback"):
        Ears(graph, robot_feedback="odometry")
