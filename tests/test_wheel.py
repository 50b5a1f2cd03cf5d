"""The built wheel in an environment of its own: its assets are there, and a chapter runs with it."""

from __future__ import annotations

import os
import shutil
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

from .conftest import tool
from .processes import run as run_process

ROOT = Path(__file__).resolve().parents[1]
CHAPTER = ROOT / "notebooks" / "4_files/50_catkin.ipynb"
"""A chapter without pictures for which matplotlib is needed: the wheel alone has to do."""


def uv(*arguments: str | Path, cwd: Path = ROOT) -> None:
    """Run uv: from its cache if that has everything, else from the network."""
    find_uv_bin = tool("uv").find_uv_bin

    # The settings of the machine's own environment are not to be seen.
    environment = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
    said = ""
    for more in (["--offline"], []):
        done = run_process([find_uv_bin(), *arguments, *more], cwd=cwd, env=environment)
        if done.returncode == 0:
            return
        said += done.stderr
    pytest.fail(said)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    uv("build", "--wheel", "--out-dir", folder)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def python(wheel, tmp_path_factory):
    """The Python of an environment with the wheel, and what runs and compares a notebook."""
    folder = tmp_path_factory.mktemp("empty")
    pins = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["uv"]["constraint-dependencies"]
    (folder / "pins.txt").write_text("\n".join(pins), encoding="utf-8")
    uv("venv", "--python", sys.executable, folder / "env")
    found = folder / "env" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    uv("pip", "install", "--python", found, "-c", folder / "pins.txt", wheel, "pytest", "nbval", "ipykernel")
    return found


def run(python: Path, *arguments: str | Path, cwd: Path) -> str:
    kept = {"PATH", "HOME", "USERPROFILE", "SYSTEMROOT", "TEMP", "TMP", "TMPDIR", "APPDATA", "LOCALAPPDATA"}
    environment = {name: value for name, value in os.environ.items() if name.upper() in kept}
    done = run_process([python, *arguments], cwd=cwd, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_command_xacro_finds_packages_by_itself(python, tmp_path):
    burger = "$(find turtlebot3_description)/urdf/turtlebot3_burger.urdf.xacro"
    robot = f"<robot xmlns:xacro='http://ros.org/wiki/xacro'><xacro:include filename='{burger}'/></robot>"
    (tmp_path / "r.xacro").write_text(robot, encoding="utf-8")
    said = run(python.with_name("xacro" + python.suffix), "r.xacro", cwd=tmp_path)
    assert '<link name="base_scan">' in said
    script = "import xacro; print(xacro.process_file('r.xacro').toprettyxml())"
    assert '<link name="base_scan">' in run(python, "-c", script, cwd=tmp_path)


def test_the_wheel_contains_the_assets_and_stubs_but_no_tests(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    assets = {
        f"rosmini/_assets/{path.relative_to(ROOT / 'assets').as_posix()}" for path in (ROOT / "assets").rglob("*.msg")
    }
    assert "rosmini/_assets/ros/std_msgs/msg/String.msg" in assets
    stubs = {"rosmini/msgs/std_msgs/msg.pyi", "rosmini/msgs/std_srvs/srv.pyi"}
    assert {*assets, *stubs, "rosmini/_assets/core/rospy/package.xml"} <= names
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {
        "rosmini",
        "rosmini_ros",
        "ament_index_python",
    }
    assert not [name for name in names if name.endswith((".pyc", ".ipynb")) or "generate" in name]
    assert {name for name in names if name.count("/") == 2 and name.startswith("rosmini/book/")} == {
        "rosmini/book/__init__.py",
        "rosmini/book/checks.py",
        "rosmini/book/drives.py",
        "rosmini/book/grade.py",
        "rosmini/book/submission.py",
        "rosmini/book/trials.py",
    }


def test_it_finds_its_messages_there(python, tmp_path):
    code = (
        "import rosmini, rosmini.msgs as m; print(rosmini.__file__); print(m.message_class('std_msgs/String')._md5sum)"
    )
    where, md5 = run(python, "-c", code, cwd=tmp_path).splitlines()
    assert Path(where).is_relative_to(python.parents[1])
    assert md5 == "992ce8a1687cec8c8bd883ec73ca41d1"


@pytest.mark.parametrize("command", ["book", "lab", "bench"])
def test_a_command_says_what_is_missing_outside_a_checkout(python, tmp_path, command):
    done = run_process([python, "-m", "rosmini", command], cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr.startswith(
        f"rosmini {command}: the book's sources (book/_config.yml and notebooks/) are neither in "
    )
    assert "Traceback" not in done.stderr


@pytest.mark.nightly
def test_a_chapter_runs_with_it(python, tmp_path):
    chapter = shutil.copy(CHAPTER, tmp_path)
    run(python, "-m", "pytest", "-p", "no:cacheprovider", "--nbval", "--nbval-current-env", chapter, cwd=tmp_path)
