"""What a notebook saves as a package, built by real catkin and run by real roslaunch and rospy."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rosmini.notebook.package import NotebookPackage
from rosmini.notebook.saving import save

from ..processes import run
from .conftest import need_ros

need_ros("catkin_make", "roslaunch", "cmake", modules="rospy, genpy, std_msgs.msg")

TALKER = """#!/usr/bin/env python3
import rospy
from notebook.msg import Num
from notebook.srv import Add, AddResponse

rospy.init_node("talker")
service = rospy.Service("add", Add, lambda request: AddResponse(request.a + request.b))
pub = rospy.Publisher("numbers", Num, queue_size=1, latch=True)
pub.publish(Num(num=7))
rospy.spin()
"""
LISTENER = """#!/usr/bin/env python3
import rospy
from notebook.msg import Num
from notebook.srv import Add

rospy.init_node("listener")
heard = rospy.wait_for_message("numbers", Num)
rospy.wait_for_service("add")
print("heard", heard.num, "sum", rospy.ServiceProxy("add", Add)(3, 4).sum, flush=True)
"""
LAUNCH = """<launch>
  <node pkg="notebook" type="talker.py" name="talker"/>
  <node pkg="notebook" type="listener.py" name="listener" output="screen" required="true"/>
</launch>
"""


@pytest.fixture
def package(monkeypatch: pytest.MonkeyPatch) -> Iterator[NotebookPackage]:
    made = NotebookPackage()
    made.write("scripts", "talker.py", TALKER, may_run=True)
    made.write("scripts", "listener.py", LISTENER, may_run=True)
    made.write("launch", "both.launch", LAUNCH)
    made.write("msg", "Num.msg", "std_msgs/Header header\nint64 num\n")
    made.write("srv", "Add.srv", "int64 a\nint64 b\n---\nint64 sum\n")
    yield made
    made.close()


@pytest.mark.nightly
def test_real_catkin_builds_it_and_real_roslaunch_runs_it(
    package: NotebookPackage, tmp_path: Path, master: dict[str, str]
) -> None:
    source = tmp_path / "ws" / "src"
    source.mkdir(parents=True)
    save(package.folder, source / "notebook")
    env = {**master, "PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_HOME": str(tmp_path / ".ros")}
    run(["catkin_make", "-j1"], cwd=source.parent, env=env, check=True)
    words = ["sh", "-c", ". devel/setup.sh && exec roslaunch notebook both.launch"]
    ran = run(words, cwd=source.parent, env=env)
    assert "heard 7 sum 7" in ran.stdout, ran.stdout + ran.stderr
