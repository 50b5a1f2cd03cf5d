"""The time of a simulated world in a graph: when devices are due, and how time stands, goes on and begins again."""

from fractions import Fraction

import numpy as np
import pytest

from rosmini.core.errors import CallbackError, RosminiError
from rosmini.sim.engine import Engine
from rosmini.sim.host import Device, Host
from rosmini.sim.models import BURGER
from rosmini.sim.world import World


class Bell(Device):
    """Notes when it rings."""

    def __init__(self, host, name, rate, *, order=100, sleepy=False, action=None):
        super().__init__(host, name, rate)
        self.action = action
        self.order = order
        self.always = not sleepy
        self.ears = 0
        self.rung = []
        self.stamps = []
        self.closed = 0

    def wanted(self):
        return self.ears > 0

    def due(self, stamp, number, /):
        self.rung.append((round(self.host.now, 6), number))
        self.stamps.append(stamp)
        if self.action is not None:
            self.action(number)

    def close(self):
        self.closed += 1


def make(graph, **options):
    engine = Engine(World("empty"), lambda _: np.random.default_rng(0), noise=0.0)
    return Host(graph.node("world"), engine, **options)


def times(bell):
    return [when for when, _ in bell.rung]


def test_a_device_is_due_at_its_rate_from_the_first_period_on(graph):
    host = make(graph)
    bell = host.add(Bell(host, "bell", 4.0))
    graph.run(1.05)
    assert bell.rung == [(0.25, 1), (0.5, 2), (0.75, 3), (1.0, 4)]
    begin = graph.now().to_nsec() - 1_050_000_000
    assert [s * 10**9 + ns - begin for s, ns in bell.stamps] == [250_000_000 * k for k in (1, 2, 3, 4)]


def test_rates_that_are_no_whole_nanoseconds_do_not_drift(graph):
    host = make(graph, from_zero=True)
    bell = host.add(Bell(host, "bell", 30.0))
    graph.run(100.01)
    assert len(bell.stamps) == 3000
    for k, (secs, nsecs) in enumerate(bell.stamps, 1):
        assert abs(secs * 10**9 + nsecs - Fraction(k * 10**9, 30)) <= Fraction(1, 2)


def test_devices_of_one_rate_are_due_together_whenever_they_came(graph):
    host = make(graph)
    first = host.add(Bell(host, "first", 10.0))
    graph.run(0.234)
    second = host.add(Bell(host, "second", 10.0))
    graph.run(0.3)
    assert times(first) == [0.1, 0.2, 0.3, 0.4, 0.5]
    assert second.rung == [(0.3, 1), (0.4, 2), (0.5, 3)]


def test_what_is_due_together_comes_in_its_order(graph):
    host = make(graph)
    heard = []
    for name, rate, order in (("c", 10.0, 7), ("a", 5.0, 1), ("d", 10.0, 7), ("b", 10.0, 3)):
        host.add(Bell(host, name, rate, order=order, action=lambda _, name=name: heard.append(name)))
    graph.run(0.25)
    assert heard == ["b", "c", "d", "a", "b", "c", "d"]


def test_nobody_is_woken_for_what_nobody_wants_but_its_samples_are_counted(graph):
    host = make(graph)
    host.add(Bell(host, "drive", 10.0))
    unit = host.add(Bell(host, "imu", 200.0, sleepy=True))
    before = graph.scheduler.now_ns()
    graph.run(0.999)
    assert unit.rung == []
    unit.ears = 1
    graph.run(0.05)
    assert unit.rung == [(round(1.0 + 0.005 * k, 6), 200 + k) for k in range(1, 10)]
    assert graph.scheduler.now_ns() - before == 1_049_000_000


def test_steps_let_all_happen_at_one_instant_of_the_graph(graph):
    host = make(graph, from_zero=True, paused=True)
    fast, slow = host.add(Bell(host, "fast", 10.0)), host.add(Bell(host, "slow", 5.0))
    robot = host.engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    host.engine.command("burger", 0.2, 0.0)
    before = graph.now()
    host.step(0.55)
    assert graph.now() == before
    assert host.now == pytest.approx(0.55)
    assert fast.stamps == [(0, k * 100_000_000) for k in range(1, 6)]
    assert slow.stamps == [(0, 200_000_000), (0, 400_000_000)]
    assert robot.pose[0] == pytest.approx(0.2 * 0.55 - 0.02)
    host.step(0.05)
    assert fast.rung[-1] == (0.6, 6)
    host.unpause()
    graph.run(0.11)
    assert fast.rung[-1] == (0.7, 7)


def test_time_begins_again_and_devices_count_on(graph):
    host = make(graph, from_zero=True)
    bell = host.add(Bell(host, "bell", 10.0))
    graph.run(0.25)
    host.reset_time()
    assert host.now == 0.0
    assert (host.stamp.secs, host.stamp.nsecs) == (0, 0)
    graph.run(0.25)
    assert bell.rung == [(0.1, 1), (0.2, 2), (0.1, 3), (0.2, 4)]
    assert bell.stamps[2:] == [(0, 100_000_000), (0, 200_000_000)]
    assert host.engine.now == pytest.approx(0.45, abs=0.06)


def test_stamps_from_zero_do_not_wait_for_a_clock_topic(graph):
    graph.master.setParam("/test", "/use_sim_time", True)
    host = make(graph, from_zero=True)
    bell = host.add(Bell(host, "bell", 10.0))
    graph.run(0.35)
    assert bell.stamps == [(0, 100_000_000), (0, 200_000_000), (0, 300_000_000)]


def test_a_device_that_fails_is_told_and_the_others_go_on(graph, capsys):
    host = make(graph)
    bad = host.add(Bell(host, "bad", 10.0, action=lambda _: 1 / 0))
    good = host.add(Bell(host, "good", 20.0))
    with pytest.raises(CallbackError, match="ZeroDivisionError"):
        graph.run(0.11)
    count = len(good.rung)
    host.remove(bad)
    graph.run(0.5)
    assert len(good.rung) >= count + 9
    capsys.readouterr()


def test_devices_may_come_and_go_while_others_are_served(graph):
    host = make(graph)
    first, last = host.add(Bell(host, "first", 10.0)), host.add(Bell(host, "last", 10.0))
    late = []

    def change(number):
        if number == 2:
            host.remove(first)
            late.append(host.add(Bell(host, "late", 10.0)))
            late.append(host.add(Bell(host, "fast", 40.0)))
        if number == 4:
            host.remove(changing)

    changing = host.add(Bell(host, "changing", 10.0, order=1, action=change))
    graph.run(0.65)
    assert times(last) == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    assert times(first)[:1] == [0.1]
    assert len(first.rung) <= 2
    assert late[0].rung == [(0.3, 1), (0.4, 2), (0.5, 3), (0.6, 4)]
    assert times(late[1])[:3] == [0.225, 0.25, 0.275]


def test_names_and_rates_are_checked(graph):
    host = make(graph)
    bell = host.add(Bell(host, "burger/imu", 10.0))
    with pytest.raises(RosminiError, match="'burger/imu' already"):
        host.add(Bell(host, "burger/imu", 20.0))
    for rate in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(RosminiError, match="rate of 'x'"):
            Bell(host, "x", rate)
    assert host.device("burger/imu") is bell
    with pytest.raises(RosminiError, match="did you mean burger/imu"):
        host.device("burger/inu")


def test_what_is_removed_is_closed_once_and_not_due_any_more(graph):
    host = make(graph)
    bell, other = host.add(Bell(host, "bell", 10.0)), host.add(Bell(host, "other", 10.0))
    graph.run(0.15)
    host.remove(bell)
    host.remove(bell)
    graph.run(0.2)
    assert (times(bell), bell.closed) == ([0.1], 1)
    assert times(other) == [0.1, 0.2, 0.3]
    host.remove(other)
    assert host.devices == ()
