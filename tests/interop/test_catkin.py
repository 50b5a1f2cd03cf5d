"""What our catkin tools make, for real ROS; and what the real tools make, for ours."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from rosmini.core.packages import read_package
from rosmini.ros.catkin.project import read_project

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

need_ros("catkin_make", "catkin_create_pkg", "cmake", modules="rospy, genpy, std_msgs.msg")

TOOL = "catkin_create_pkg"
MESSAGES = """cmake_minimum_required(VERSION 3.0.2)
project(talk)
find_package(catkin REQUIRED COMPONENTS rospy std_msgs message_generation)
add_message_files(FILES Num.msg)
add_service_files(FILES Add.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS std_msgs message_runtime)
catkin_install_python(PROGRAMS scripts/hello.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
"""
SHOW = """
import io
from talk.msg import Num
from talk.srv import Add, AddRequest, AddResponse
message = Num(num=7, names=["a", "bc"])
message.header.frame_id = "map"
buffer = io.BytesIO()
message.serialize(buffer)
back = Num().deserialize(buffer.getvalue())
print(Num.__name__, Num._type, Num._md5sum, Num.__slots__, Num._slot_types)
print(buffer.getvalue().hex(), repr(str(back)))
print(Add._type, Add._md5sum, AddRequest._type, AddRequest._md5sum)
print(Add._request_class is AddRequest, AddResponse(5).sum)
"""


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    return {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_HOME": str(tmp_path / ".ros")}


def ours(env: dict[str, str], folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return run([sys.executable, "-m", "rosmini", *words], env=env, cwd=folder, check=True)


def fill(package: Path) -> None:
    for name, text in {
        "CMakeLists.txt": MESSAGES,
        "msg/Num.msg": "Header header\nint64 num\nstring[] names\nint8 MOST=9\n",
        "srv/Add.srv": "int64 a\nint64 b\n---\nint64 sum\n",
        "scripts/hello.py": "#!/usr/bin/env python3\nprint('hello', __name__)\n",
    }.items():
        (package / name).parent.mkdir(exist_ok=True)
        (package / name).write_text(text, encoding="utf-8")
    (package / "scripts/hello.py").chmod(0o755)


@pytest.mark.nightly
def test_one_workspace_built_by_both_gives_real_ros_the_same_messages(tmp_path: Path, env: dict[str, str]) -> None:
    for name in ("ours", "theirs"):
        (tmp_path / name / "src").mkdir(parents=True)
        ours(env, tmp_path / name, "catkin_init_workspace", "src")
        needs = ("std_msgs", "rospy", "message_generation", "message_runtime")
        ours(env, tmp_path / name / "src", "catkin_create_pkg", "talk", *needs)
        fill(tmp_path / name / "src/talk")
    ours(env, tmp_path / "ours", "catkin_make")
    run(["/usr/bin/catkin_make"], env=env, cwd=tmp_path / "theirs", check=True)
    shown = []
    for name in ("ours", "theirs"):
        line = f'. devel/setup.sh && exec {SYSTEM_PYTHON} -c "$0"'
        shown.append(run(["sh", "-c", line, SHOW], env=env, cwd=tmp_path / name, check=True).stdout)
        hello = run([tmp_path / name / "devel/lib/talk/hello.py"], env=env, check=True)
        assert hello.stdout == "hello __main__\n"
    assert shown[0] == shown[1] != ""
    made = [{str(path.relative_to(tmp_path / name / "devel")) for path in (tmp_path / name / "devel").rglob("*.py")}
            for name in ("ours", "theirs")]  # fmt: skip
    assert made[1] - made[0] == {"_setup_util.py"}


def test_each_refuses_what_the_other_built(tmp_path: Path, env: dict[str, str]) -> None:
    (tmp_path / "ws/src").mkdir(parents=True)
    ours(env, tmp_path / "ws", "catkin_make")
    real = run(["/usr/bin/catkin_make"], env=env, cwd=tmp_path / "ws")
    assert real.returncode != 0
    assert "rosmini catkin_make" in real.stdout + real.stderr
    (tmp_path / "other/src").mkdir(parents=True)
    run(["/usr/bin/catkin_make"], env=env, cwd=tmp_path / "other", check=True)
    done = run([sys.executable, "-m", "rosmini", "catkin_make"], env=env, cwd=tmp_path / "other")
    assert (done.returncode, "was made by 'catkin_make'" in done.stderr) == (1, True)


def test_the_same_files_are_created(tmp_path: Path, env: dict[str, str]) -> None:
    env |= {"USER": "ada", "LOGNAME": "ada"}
    words = ["talk", "std_msgs", "rospy", "roscpp", "message_generation", "message_runtime", "-l", "MIT", "-a", "Ada",
             "-m", "Max", "-V", "1.2.3", "-D", "to talk"]  # fmt: skip
    made = []
    for folder, tool in (("real", ["/usr/bin/catkin_create_pkg"]), ("ours", [sys.executable, "-m", "rosmini", TOOL])):
        (tmp_path / folder).mkdir()
        done = run([*tool, *words], env=env, cwd=tmp_path / folder, check=True)
        files = sorted(str(path.relative_to(tmp_path / folder)) for path in (tmp_path / folder).rglob("*"))
        package = replace(read_package(tmp_path / folder / "talk"), path=tmp_path)
        project = read_project(tmp_path / folder / "talk")
        names = [word.text for word in project.components]
        made.append((done.stdout.replace(folder, "FOLDER"), files, package, names, project.findings))
    assert made[0] == made[1]


def test_a_workspace_of_real_catkin_is_an_underlay(tmp_path: Path, env: dict[str, str]) -> None:
    for name in ("under", "over"):
        (tmp_path / name / "src").mkdir(parents=True)
    ours(env, tmp_path / "under/src", "catkin_create_pkg", "talk", "std_msgs", "message_generation", "message_runtime")
    fill(tmp_path / "under/src/talk")
    run(["/usr/bin/catkin_make"], env=env, cwd=tmp_path / "under", check=True)
    line = f'. under/devel/setup.sh; cd over; "{sys.executable}" -m rosmini catkin_make >/dev/null'
    run(["sh", "-c", line], env=env, cwd=tmp_path, check=True)
    line = ". over/devel/setup.sh; echo $ROS_PACKAGE_PATH; "
    line += f'{SYSTEM_PYTHON} -c "import talk.msg as t; print(t.Num._type)"'
    done = run(["sh", "-c", line], env=env | {"PATH": os.environ["PATH"]}, cwd=tmp_path, check=True)
    assert done.stdout == f"{tmp_path}/over/src:{tmp_path}/under/src\ntalk/Num\n"
