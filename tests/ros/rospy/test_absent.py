"""Imports of modules of ROS that rosmini does not have."""

from __future__ import annotations

import importlib
import io
import re
import sys

import pytest

import rosmini
from rosmini.ros.rospy.absent import AbsentModule, absent_module
from rosmini.ros.rospy.importer import homes
from rosmini.ros.scripts import run_source

IMPORTS = {
    "import cv_bridge": "no module 'cv_bridge'",
    "from cv_bridge import CvBridge": r"numpy\.frombuffer\(msg\.data, numpy\.uint8\)\.reshape\(msg\.height, "
    r"msg\.width, -1\)",
    "from cv_bridge.boost import x": "no module 'cv_bridge'",
    "from dynamic_reconfigure.parameter_generator_catkin import *": "catkin_make",
    "import PyKDL as kdl": "tf.transformations",
    "import roslaunch.scriptapi": "in a launch file",
    "from roslaunch.parent import ROSLaunchParent": "in a launch file",
    "from rospy.impl import tcpros": "public functions",
    "import genmsg.msgs": "_md5sum",
    "from rospy_message_converter import message_converter": "yaml.safe_load",
}


@pytest.fixture(autouse=True)
def _not_installed(monkeypatch):
    """As if no real one were there."""
    monkeypatch.setattr(sys, "path", [entry for entry in sys.path if "dist-packages" not in entry])


@pytest.mark.parametrize("line", IMPORTS)
def test_scripts_are_told_what_to_do_instead(line):
    err = io.StringIO()
    assert run_source(line, stderr=err).status == 1
    assert "AbsentModule: rosmini has no module" in err.getvalue()
    assert re.search(IMPORTS[line], err.getvalue()), err.getvalue()


@pytest.mark.parametrize("line", IMPORTS)
def test_so_are_programs(line):
    rosmini.install()
    try:
        with pytest.raises(ModuleNotFoundError, match=IMPORTS[line]):
            exec(line, {})
    finally:
        rosmini.uninstall()


def test_who_asks_first_gets_the_error_that_python_would_give():
    source = "try:\n    import cv_bridge\nexcept ImportError:\n    print('without')"
    out = io.StringIO()
    assert run_source(source, stdout=out, prefix=False).status == 0
    assert out.getvalue() == "without\n"


def test_an_installed_one_wins(tmp_path, monkeypatch):
    (tmp_path / "cv_bridge.py").write_text("HERE = True", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    out = io.StringIO()
    assert run_source("import cv_bridge; print(cv_bridge.HERE)", stdout=out, prefix=False).status == 0
    assert out.getvalue() == "True\n"
    rosmini.install()
    try:
        assert importlib.import_module("cv_bridge").HERE
    finally:
        rosmini.uninstall()
        sys.modules.pop("cv_bridge")


def test_what_is_there_is_not_said_to_be_absent():
    assert [name for name in [*homes(), "numpy", "rosgraph"] if absent_module(name)] == []
    assert isinstance(absent_module("smach.state"), AbsentModule)
    assert absent_module("smach.state").name == "smach.state"
