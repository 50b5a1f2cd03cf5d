"""The scripts of `turtlesim_cleaner` and `turtle_teleop_key` on real rospy drive the turtle of our turtlesim."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from rosmini.core.packages import assets_dir
from rosmini.tools.main import main

from ..processes import run, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros, rosmaster

if TYPE_CHECKING:
    from collections.abc import Iterator

ROSMINI = [sys.executable, "-m", "rosmini"]
PACKAGES = assets_dir() / "ros"
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project(turtlesim)
find_package(catkin REQUIRED COMPONENTS message_generation)
add_message_files(DIRECTORY msg)
add_service_files(DIRECTORY srv)
generate_messages()
catkin_package()
"""


@pytest.fixture(scope="module")
def modules(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Where real Python finds `turtlesim.msg` and `turtlesim.srv`: our `catkin_make` builds them."""
    need_ros("rosmaster", modules="rospy, geometry_msgs.msg")
    workspace = tmp_path_factory.mktemp("ws")
    shutil.copytree(PACKAGES / "turtlesim", workspace / "src" / "turtlesim")
    (workspace / "src" / "turtlesim" / "CMakeLists.txt").write_text(CMAKE, encoding="utf-8")
    assert main(["catkin_make", "-C", str(workspace)]) == 0
    return str(workspace / "devel/lib/python3/dist-packages")


@pytest.fixture
def environment(modules: str, tmp_path: Path) -> Iterator[dict[str, str]]:
    """A real Master, at which our turtlesim is registered."""
    with rosmaster(tmp_path) as found:
        found["PYTHONPATH"] = modules
        ours = found | {"PYTHONPATH": ""}
        with start([*ROSMINI, "rosrun", "turtlesim", "turtlesim_node"], env=ours) as process:
            nodes = [*ROSMINI, "rosnode", "list"]
            wait_until(lambda: "/turtlesim\n" in run(nodes, env=ours).stdout, "/turtlesim", process)
            yield found


@pytest.mark.nightly
def test_real_rospy_drives_our_turtle(environment: dict[str, str]) -> None:
    def script(package: str, name: str, typed: str) -> str:
        path = next((PACKAGES / package).glob(f"*/{name}"))
        done = run([SYSTEM_PYTHON, path], env=environment, stdin=typed)
        assert done.returncode == 0, done.stdout + done.stderr
        return str(done.stdout)

    assert "moved 1.00 backward" in script("turtlesim_cleaner", "move.py", "2\n1\nn\n")
    said = script("turtlesim_cleaner", "gotogoal.py", "7\n7\n0.2\n")
    (x, y) = map(float, re.findall(r"at \((\d+\.\d+), (\d+\.\d+)\)", said)[0])
    assert abs(x - 7) <= 0.2 and abs(y - 7) <= 0.2
    assert "turned by 90 degrees" in script("turtlesim_cleaner", "rotate.py", "90\n90\nn\n")
    assert "Use arrow keys to move the turtle. 'q' to quit." in script("turtlesim", "turtle_teleop_key", "Aq")
