"""The tests of launch files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from rosmini.core.markup import parse_file
from rosmini.tools.main import main

from .workspace import make

HEARS = """#!/usr/bin/env python3
import sys
import unittest
import rospy
import rostest
from std_msgs.msg import String

class TestTalker(unittest.TestCase):
    def test_a_word_comes(self):
        rospy.init_node("hears")
        self.assertEqual(rospy.wait_for_message("chatter", String, timeout=5.0).data, rospy.get_param("~word"))

    def test_b_is_wrong(self):
        self.assertEqual(1 + 1, rospy.get_param("~two"))

    @unittest.skip("not today")
    def test_c_is_skipped(self):
        pass

if __name__ == "__main__":
    rostest.rosrun("speaking", "hears", TestTalker, sys.argv)
"""

FILE = """<launch>
<arg name="two" default="2"/>
<node pkg="speaking" type="talker.py" name="talker"/>
<test test-name="hears" pkg="speaking" type="hears.py">
  <param name="word" value="hello"/>
  <param name="two" value="$(arg two)"/>
</test>
<test test-name="ends" pkg="speaking" type="ending.py" args="1 0"/>
</launch>
"""


OWN = """<launch>
<arg name="hz" default="10"/> <arg name="silent" default="/news"/> <arg name="width" default="0.5"/>
<arg name="srv" default="rospy_tutorials/AddTwoInts"/>
<node pkg="rospy_tutorials" type="talker.py" name="talker"/>
<node pkg="rospy_tutorials" type="add_two_ints_server.py" name="adder"/>
<param name="robot/width" value="0.5"/>
<test test-name="rate" pkg="rostest" type="hztest" name="rate">
  <param name="topic" value="chatter"/> <param name="hz" value="$(arg hz)"/> <param name="hzerror" value="0.5"/>
  <param name="test_duration" value="3.0"/> <param name="check_intervals" value="true"/>
</test>
<test test-name="silence" pkg="rostest" type="hztest" name="silence">
  <param name="topic" value="$(arg silent)"/> <param name="hz" value="0"/> <param name="test_duration" value="1"/>
  <param name="wait_time" value="1"/>
</test>
<test test-name="param" pkg="rostest" type="paramtest" name="param">
  <param name="param_name_target" value="/robot/width"/> <param name="param_value_expected" value="$(arg width)"/>
  <param name="wait_time" value="2"/>
</test>
<test test-name="publish" pkg="rostest" type="publishtest" name="publish">
  <rosparam subst_value="true">
    topics: [{name: /chatter, timeout: 5}, {name: $(arg silent), timeout: 1, negative: true}]
  </rosparam>
</test>
<test test-name="advertise" pkg="rostest" type="advertisetest" name="advertise">
  <rosparam subst_value="true">
    topics: [{name: /chatter, type: std_msgs/String}, {name: $(arg silent), timeout: 1, negative: true}]
    services: [{name: /add_two_ints, type: $(arg srv)}]
  </rosparam>
</test>
</launch>
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    source = make(tmp_path)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(source))
    package = source / "speaking"
    (package / "scripts" / "hears.py").write_text(HEARS, encoding="utf-8")
    (package / "launch" / "talk.test").write_text(FILE, encoding="utf-8")
    return package


@pytest.mark.usefixtures("folder")
def test_tests_pass(tmp_path: Path, capsys: Any) -> None:
    file = tmp_path / "results.xml"
    assert main(["test", "speaking", "talk.test", "--results", str(file)]) == 0
    out = capsys.readouterr().out
    assert "[speaking.rosunit-hears/test_a_word_comes][passed]" in out
    assert "[speaking.rosunit-hears/test_c_is_skipped][skipped]: not today" in out
    assert "[speaking.rosunit-ends/ends][passed]" in out
    assert out.endswith("SUMMARY\n * RESULT: SUCCESS\n * TESTS: 4\n * ERRORS: 0\n * FAILURES: 0\n")
    root = parse_file(file)
    assert [(root.get(name)) for name in ("tests", "failures", "errors", "skipped")] == ["4", "0", "0", "1"]
    assert [case.get("name") for case in root.all("testcase")][-1] == "ends"


WIRE = """#!/usr/bin/env python3
import os, subprocess, sys, unittest, xmlrpc.client
import rosgraph, rospy, rostest

TOOL = [sys.executable, "-m", "rosmini", "rostopic"]

class TestWire(unittest.TestCase):
    def setUp(self):
        rospy.init_node("hears")


    def test_a_tool_hears_a_node(self):
        tool = subprocess.Popen([*TOOL, "echo", "-n", "1", "/chatter"], stdout=subprocess.PIPE, text=True)
        self.assertIn("hello", tool.communicate()[0])


    def test_the_api_of_a_node(self):
        master = rosgraph.Master("/hears")
        self.assertEqual(master.master_uri, os.environ["ROS_MASTER_URI"])
        with xmlrpc.client.ServerProxy(rosgraph.get_master_uri()) as proxy:
            self.assertEqual(proxy.getPid("/hears")[0], 1)
        with xmlrpc.client.ServerProxy(master.lookupNode("/talker")) as proxy:
            self.assertEqual(proxy.getPublications("/hears")[0], 1)

    def test_the_release(self):
        self.assertEqual(os.environ["ROS_DISTRO"], rospy.get_param("/rosdistro").strip())

    def test_no_clock_without_a_simulator(self):
        self.assertFalse(rospy.has_param("/use_sim_time"))
        self.assertNotIn(["/clock", "rosgraph_msgs/Clock"], rospy.get_published_topics())

rostest.rosrun("speaking", "hears", TestWire, sys.argv)
"""


def test_tests_have_a_master_that_other_processes_reach(folder: Path, monkeypatch: Any, capsys: Any) -> None:
    (folder / "scripts" / "hears.py").write_text(WIRE, encoding="utf-8")
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:9")
    status = main(["test", "speaking", "talk.test"])
    out = capsys.readouterr().out
    assert status == 0, out
    assert " * TESTS: 5\n" in out
    assert os.environ["ROS_MASTER_URI"] == "http://localhost:9"


CLOCK = """#!/usr/bin/env python3
import sys, unittest
import rosgraph, rospy, rostest
from nav_msgs.msg import Odometry

class TestClock(unittest.TestCase):
    def test_the_clock(self):
        rospy.init_node("reads_the_clock")
        stamp = rospy.wait_for_message("/odom", Odometry).header.stamp
        self.assertAlmostEqual(stamp.to_sec(), rospy.get_time(), delta=0.1)
        publishers = dict(rosgraph.Master("/test").getSystemState()[0])
        self.assertEqual(publishers["/clock"], ["/gazebo"])

rostest.rosrun("speaking", "clock", TestClock, sys.argv)
"""


def test_a_simulator_publishes_the_time_of_a_test(folder: Path, capsys: Any) -> None:
    (folder / "scripts" / "hears.py").write_text(CLOCK, encoding="utf-8")
    file = folder / "launch" / "clock.test"
    world = (
        '<include file="$(find turtlebot3_gazebo)/launch/turtlebot3_empty_world.launch">'
        '<arg name="model" value="burger"/></include>'
    )
    test = '<test test-name="clock" pkg="speaking" type="hears.py"/>'
    file.write_text(f"<launch>{world}{test}</launch>", encoding="utf-8")
    status = main(["test", str(file)])
    assert status == 0, capsys.readouterr().out


@pytest.mark.usefixtures("folder")
def test_a_test_fails(capsys: Any) -> None:
    assert main(["test", "speaking", "talk.test", "two:=3"]) == 1
    out = capsys.readouterr().out
    assert "[speaking.rosunit-hears/test_b_is_wrong][FAILURE]: Traceback" in out
    assert "AssertionError: 2 != 3" in out
    assert " * RESULT: FAIL\n * TESTS: 4\n * ERRORS: 0\n * FAILURES: 1\n" in out


@pytest.mark.parametrize(
    ("attributes", "said"),
    [
        ('type="talker.py" time-limit="2"', "[FAILURE]: the test did not end within its time limit of 2 s"),
        ('type="ending.py" args="1 3"', "ended with exit status 3, and wrote no results"),
        ('type="endign.py"', "[ERROR]: speaking/endign.py could not be started"),
    ],
)
def test_what_goes_wrong_is_told(folder: Path, capsys: Any, attributes: str, said: str) -> None:
    file = folder / "launch" / "wrong.test"
    file.write_text(f'<launch><test test-name="x" pkg="speaking" {attributes}/></launch>', encoding="utf-8")
    assert main(["test", str(file)]) == 1
    assert said in capsys.readouterr().out


def test_a_file_without_tests_is_told(folder: Path, capsys: Any) -> None:
    file = folder / "launch" / "none.test"
    file.write_text("<launch/>", encoding="utf-8")
    assert main(["test", str(file)]) == 1
    assert "there is no <test> in" in capsys.readouterr().err


def test_the_tests_that_rostest_brings_pass(tmp_path: Path, capsys: Any) -> None:
    """Its nodes hztest, paramtest, publishtest and advertisetest, with the parameters of a public file."""
    file = tmp_path / "own.test"
    file.write_text(OWN, encoding="utf-8")
    assert main(["test", str(file)]) == 0
    assert "RESULT: SUCCESS\n * TESTS: 6\n" in capsys.readouterr().out


def test_the_tests_that_rostest_brings_fail(tmp_path: Path, capsys: Any) -> None:
    file = tmp_path / "own.test"
    file.write_text(OWN, encoding="utf-8")
    words = ("hz:=20", "silent:=/chatter", "width:=0.6", "srv:=std_srvs/Empty")
    assert main(["test", str(file), *words]) == 1
    out = capsys.readouterr().out
    assert "RESULT: FAIL\n * TESTS: 6\n * ERRORS: 0\n * FAILURES: 6\n" in out
    for said in (
        "an interval of 0.100 s, 0.051 s at most",
        "a message came on /chatter",
        "0.5 != 0.6 : the parameter /robot/width",
        "topic /chatter: a message came",
        "/chatter is offered",
        "'rospy_tutorials/AddTwoInts' != 'std_srvs/Empty'",
    ):
        assert said in out
