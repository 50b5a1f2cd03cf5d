"""Log functions: console, /rosout, throttling."""

from __future__ import annotations

import logging

import pytest

from rosmini.ros import rospy


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
