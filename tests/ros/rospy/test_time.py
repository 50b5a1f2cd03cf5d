"""Time, rates, timers, sleeping."""

from __future__ import annotations

import pytest

from rosmini.core import time
from rosmini.msgs.rosgraph_msgs.msg import Clock
from rosmini.ros import rospy


def test_the_clock_of_the_node(programs):
    def main():
        rospy.init_node("main")
        assert type(rospy.Time.now()) is type(rospy.get_rostime()) is rospy.Time
        start = rospy.Time.now()
        rospy.sleep(0.5)
        rospy.sleep(rospy.Duration(0.5))
        rospy.sleep(-1)
        rospy.rostime.wallsleep(0.1)
        return (rospy.Time.now() - start).to_sec(), rospy.get_time() - start.to_sec()

    for passed in programs(main):
        assert 1.1 - 1e-6 <= passed < 3


def test_simulated_time_is_exact(sim_programs):
    def main():
        rospy.init_node("main")
        rate = rospy.Rate(4)
        times = []
        for _ in range(3):
            rate.sleep()
            times.append(rospy.get_time())
        assert type(rate.sleep_dur) is rospy.Duration
        return times, rate.remaining().to_sec()

    assert sim_programs(main) == ([1000.25, 1000.5, 1000.75], 0.25)


@pytest.mark.parametrize(("rate", "caught"), [(0, ZeroDivisionError), (float("nan"), ValueError)])
def test_a_rate_that_is_none_raises_what_rospy_raises(sim_programs, rate, caught):
    def main():
        rospy.init_node("main")
        with pytest.raises(caught, match="a rate must be a positive number of turns a second, not"):
            rospy.Rate(rate)

    sim_programs(main)


def test_a_loop_that_polls_the_time_ends(programs):
    def main():
        rospy.init_node("main")
        start = rospy.Time.now().to_sec()
        turns = 0
        while rospy.Time.now().to_sec() - start < 0.5:
            turns += 1
        return turns

    assert programs(main) > 100


def test_a_loop_that_polls_is_shutdown_lets_others_run(programs):
    def main():
        rospy.init_node("main")
        rospy.Timer(rospy.Duration(0.2), lambda _: rospy.signal_shutdown(""), oneshot=True)
        while not rospy.is_shutdown():
            pass
        return True

    assert programs(main)


def test_sim_time_comes_from_the_clock_topic(programs, log):
    def clock():
        rospy.set_param("/use_sim_time", True)
        rospy.rostime.wallsleep(0.1)
        publisher = programs.graph.node("simulator", namespace="/").publisher("/clock", Clock)
        for tick in range(60):
            rospy.rostime.wallsleep(0.05)
            publisher.publish(time.Time(100 + tick))

    def main():
        rospy.set_param("/use_sim_time", True)
        rospy.init_node("main")
        zero = rospy.Time.now()
        assert not rospy.rostime.is_wallclock()
        rospy.sleep(3)
        rospy.loginfo("now")
        return zero, rospy.get_time()

    zero, later = programs(clock, main)
    assert zero.is_zero()
    assert 103 <= later < 160
    line = next(line for line in log.read().out.splitlines() if line.endswith(": now"))
    wall, simulated = line.removeprefix("[INFO] [").removesuffix("]: now").split(", ")
    assert float(wall) >= 1000
    assert float(simulated) == later


def test_a_clock_that_goes_back_is_an_error(programs):
    def clock():
        rospy.rostime.wallsleep(0.3)
        publisher = programs.graph.node("simulator").publisher("/clock", Clock)
        for second in (100, 101, 50):
            rospy.rostime.wallsleep(0.2)
            publisher.publish(time.Time(second))

    def main():
        rospy.set_param("/use_sim_time", True)
        rospy.init_node("main")
        with pytest.raises(rospy.ROSTimeMovedBackwardsException):
            rospy.sleep(10)

    programs(clock, main)


def test_a_script_without_a_node_can_set_the_time(sim_programs):
    def main():
        rostime = rospy.rostime
        found = [rostime.is_rostime_initialized(), rostime.is_wallclock()]
        rostime.set_rostime_initialized(True)
        found += [rostime.is_rostime_initialized(), rospy.get_time()]
        rostime._set_rostime(time.Time(42))
        found += [rospy.Time.now(), rospy.get_time(), rostime.is_wallclock()]
        rostime.switch_to_wallclock()
        found += [rostime.is_wallclock(), rospy.get_time()]
        rostime.set_rostime_initialized(False)
        with pytest.raises(rospy.ROSInitException):
            rospy.get_rostime()
        with pytest.raises(ValueError, match="Time"):
            rostime._set_rostime(42)
        return found

    assert sim_programs(main) == [False, True, True, 1000, rospy.Time(42), 42, False, True, 1000]
