"""``import rospy`` in plain programs and in scripts."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

import pytest

import rosmini
from rosmini.ros.rospy import importer, modules

from ...processes import run


@pytest.fixture
def installed():
    rosmini.install(shadow=True)
    yield
    rosmini.uninstall()


def test_one_module_under_both_names(installed):
    for name, module in modules().items():
        assert import_module(name) is module, name
    import rospy
    from rospy.numpy_msg import numpy_msg
    from std_msgs.msg import String

    from rosmini.msgs.std_msgs.msg import String as Own

    assert rospy is rosmini.ros.rospy
    assert rospy.__spec__.name == "rosmini.ros.rospy"
    assert numpy_msg is rosmini.ros.rospy.numpy_msg.numpy_msg
    assert String is Own


def test_uninstalling_leaves_nothing(installed):
    import rospy

    assert rospy is rosmini.ros.rospy
    rosmini.uninstall()
    assert not importer.installed()
    assert not {name.partition(".")[0] for name in sys.modules} & {"rospy", "genpy", "roslib", "rosgraph"}
    assert "rosmini.ros.rospy" in sys.modules


@pytest.mark.parametrize(("shadow", "winner"), [(False, "real"), (True, "ours")])
def test_an_installed_ros_is_not_shadowed_unless_asked(tmp_path: Path, shadow: bool, winner: str):
    (tmp_path / "rospy").mkdir()
    (tmp_path / "rospy" / "__init__.py").write_text("WHO = 'real'\n", encoding="utf-8")
    program = f"""
import sys
sys.path.insert(0, {str(tmp_path)!r})
import rosmini
rosmini.install(shadow={shadow})
import rospy
print(getattr(rospy, "WHO", "ours"))
"""
    done = run([sys.executable, "-c", program])
    assert (done.stdout, done.stderr) == (f"{winner}\n", "")
