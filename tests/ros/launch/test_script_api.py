"""``import roslaunch`` in scripts."""

from __future__ import annotations

from pathlib import Path

import pytest

from rosmini.ros.scripts import run_source

from .workspace import make

SINGLE = """
import rospy, roslaunch
from roslaunch.scriptapi import ROSLaunch
rospy.init_node("starter")
node = roslaunch.core.Node("speaking", "talker.py", name="one", namespace="/robot1", remap_args=[("chatter", "news")])
launch = ROSLaunch()
try:
    launch.launch(node)
except roslaunch.RLException as error:
    print("refused:", error)
launch.start()
process = launch.launch(node)
rospy.sleep(1.0)
print("alive", process.is_alive(), [name for name, _ in rospy.get_published_topics() if "news" in name])
process.stop()
print("alive", process.is_alive(), process.exit_code)
launch.stop()
"""

FILES = """
import rospy, roslaunch
rospy.init_node("starter", anonymous=True)
uuid = roslaunch.rlutil.get_or_generate_uuid(None, False)
roslaunch.configure_logging(uuid)
words = ["speaking", "talk.launch", "word:=servus"]
file = roslaunch.rlutil.resolve_launch_arguments(words)[0]
parent = roslaunch.parent.ROSLaunchParent(uuid, [(file, words[2:])])
parent.start()
rospy.sleep(1.0)
print(rospy.get_param("/talker/greeting"), uuid == rospy.get_param("/run_id"))
parent.shutdown()
print("all over")
"""

TALK = """<arg name="word"/>
<node pkg="speaking" type="talker.py" name="talker"><param name="greeting" value="$(arg word)"/></node>"""


def test_a_single_node(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(make(tmp_path)))
    assert run_source(SINGLE, name="starter").status == 0
    out = capsys.readouterr().out
    assert "refused: please start ROSLaunch first" in out
    assert "alive True ['/robot1/news']" in out
    assert "alive False 0" in out


def test_launch_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(make(tmp_path, talk=TALK)))
    assert run_source(FILES, name="starter").status == 0
    out = capsys.readouterr().out
    assert "servus True" in out
    assert "all over" in out


def test_a_node_that_makes_no_sense_is_refused() -> None:
    from rosmini.ros.launch.script_api import Node

    with pytest.raises(ValueError, match="respawn and required"):
        Node("a", "b", respawn=True, required=True)
    with pytest.raises(ValueError, match="cannot contain a namespace"):
        Node("a", "b", name="c/d")
    with pytest.raises(ValueError, match="non-empty"):
        Node("", "b")
