"""Log functions: console, /rosout, throttling."""

from __future__ import annotations

import logging

import pytest

from rosmini.msgs.roscpp.srv import SetLoggerLevel
from rosmini.msgs.rosgraph_msgs.msg import Log
from rosmini.ros import rospy


def test_the_console_format_and_its_streams(sim_programs, log):
    def main():
        rospy.loginfo("too early")
        rospy.logwarn("early %d", 1)
        rospy.init_node("main")
        rospy.logdebug("hidden")
        rospy.loginfo("a %s and %d", "text", 2)
        rospy.logout("100%")
        rospy.loginfo("%(key)s", {"key": "by name"})
        rospy.logwarn("careful")
        rospy.logerr("wrong")
        rospy.logfatal("over")

    sim_programs(main)
    written = log.read()
    assert written.out.splitlines() == [
        "[INFO] [1000.000000]: a text and 2",
        "[INFO] [1000.000000]: 100%",
        "[INFO] [1000.000000]: by name",
    ]
    assert written.err.splitlines() == [
        "early 1",
        "[WARN] [1000.000000]: careful",
        "[ERROR] [1000.000000]: wrong",
        "[FATAL] [1000.000000]: over",
    ]


def test_log_level_of_init_node(sim_programs, log):
    def main(level):
        rospy.init_node(f"main{level}", log_level=level)
        rospy.logdebug("debug")
        rospy.logwarn("warn")

    sim_programs(lambda: main(rospy.DEBUG), lambda: main(rospy.ERROR))
    written = log.read()
    assert (written.out.count("debug"), written.err.count("warn")) == (1, 1)
    with pytest.raises(ValueError, match="log_level"):
        sim_programs(lambda: main(3))


def test_messages_go_to_rosout_with_their_place(programs):
    got = []
    programs.graph.node("console").subscriber("/rosout_agg", Log, got.append)

    def main():
        rospy.init_node("main")
        rospy.sleep(0.3)
        rospy.logerr("look here")
        rospy.sleep(0.3)

    programs(main)
    message = next(message for message in got if message.msg == "look here")
    assert (message.name, message.level, message.function) == ("/main", Log.ERROR, "main")
    assert message.file.endswith("test_logging.py")
    assert message.line == main.__code__.co_firstlineno + 3
    assert "/rosout" in message.topics


def test_handlers_of_the_logger_rosout_are_called(sim_programs):
    records = []

    class Keep(logging.Handler):
        def emit(self, record):
            records.append((record.name, record.levelname, record.getMessage(), record.funcName))

    handler = Keep(logging.WARNING)

    def main():
        logging.getLogger("rosout").addHandler(handler)
        rospy.init_node("main")
        rospy.loginfo("below the handler's level")
        rospy.logwarn("a %s", "text")
        rospy.logfatal("100%", logger_name="motor")

    try:
        sim_programs(main)
    finally:
        logging.getLogger("rosout").removeHandler(handler)
    assert records == [("rosout", "WARNING", "a text", "main"), ("rosout.motor", "CRITICAL", "100%", "main")]


def test_once_and_throttle_count_each_place_alone(sim_programs, log):
    def main():
        rospy.init_node("main")
        for count in range(10):
            rospy.loginfo_once("once %d", count)
            rospy.loginfo_throttle(0.5, "throttled %d", count)
            rospy.loginfo_throttle_identical(0.5, f"identical {count // 5}")
            rospy.loginfo_throttle(100, "rare")
            rospy.sleep(0.2)

    sim_programs(main)
    texts = [line.partition("]: ")[2] for line in log.read().out.splitlines()]
    assert texts.count("once 0") == 1
    assert [text for text in texts if text.startswith("throttled")] == [f"throttled {n}" for n in (0, 3, 6, 9)]
    assert [text for text in texts if text.startswith("identical")] == [f"identical {n}" for n in (0, 0, 1, 1, 1)]
    assert texts.count("rare") == 1


def test_programs_do_not_share_what_was_logged(sim_programs, log):
    def main():
        rospy.init_node("main", anonymous=True)
        rospy.logwarn_once("each of us")

    sim_programs(main, main)
    assert log.read().err.count("each of us") == 2


def test_options(sim_programs, log):
    def main():
        rospy.init_node("main")
        try:
            int("the reason")
        except ValueError:
            rospy.logerr("failed", exc_info=True)
        rospy.loginfo("named", logger_name="mine")
        rospy.loginfo("does not fit %d", "x")
        with pytest.raises(TypeError, match="colour"):
            rospy.loginfo("x", colour="red")

    sim_programs(main)
    written = log.read()
    assert "ValueError: invalid literal" in written.err
    assert "in main" in written.err
    assert "named" in written.out
    assert "does not fit %d" in written.out


def test_gates_in_both_clocks(programs, log):
    def main():
        rospy.init_node("main")
        for count in range(4):
            rospy.logwarn_once("once %d", count)
            rospy.logwarn_throttle(1000, "rare %d", count)
            rospy.logwarn_throttle(0.1, "each %d", count)
            rospy.logwarn_throttle_identical(1000, f"new {count // 2}")
            rospy.sleep(0.2)

    programs(main)
    texts = [line.partition("]: ")[2] for line in log.read().err.splitlines()]
    assert [text for text in texts if text.startswith(("once", "rare"))] == ["once 0", "rare 0"]
    assert [text for text in texts if text.startswith("each")] == [f"each {count}" for count in range(4)]
    assert [text for text in texts if text.startswith("new")] == ["new 0", "new 1"]


def test_levels_are_set_from_another_program(programs, log):
    def camera():
        rospy.init_node("camera")
        rospy.sleep(1.0)
        rospy.logdebug("seen")
        rospy.logdebug("unseen", logger_name="driver")
        rospy.logwarn("unseen", logger_name="driver")
        rospy.sleep(1.0)

    def reader():
        rospy.init_node("reader")
        rospy.wait_for_service("/camera/set_logger_level")
        set_level = rospy.ServiceProxy("/camera/set_logger_level", SetLoggerLevel)
        set_level("rosout", "DEBUG")
        set_level("rosout.driver", "ERROR")
        rospy.sleep(1.5)

    programs(camera, reader)
    written = log.read()
    assert "seen" in written.out
    assert "unseen" not in written.out + written.err
