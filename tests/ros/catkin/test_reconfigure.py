"""Modules that catkin_make makes of ``.cfg`` files."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rosmini.ros.scripts import ScriptSpec, run_scripts

from .conftest import Bench

PYTHON = "lib/python3/dist-packages"
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project(drive)
find_package(catkin REQUIRED COMPONENTS rospy dynamic_reconfigure)
generate_dynamic_reconfigure_options(cfg/Drive.cfg)
catkin_package(CATKIN_DEPENDS rospy)
"""
CFG = """#!/usr/bin/env python3
PACKAGE = "drive"
from dynamic_reconfigure.parameter_generator_catkin import *

gen = ParameterGenerator()
gears = gen.enum([gen.const("Low", int_t, 1, "slow"), gen.const("High", int_t, 2, "fast")], "Gears")
gen.add("gear", int_t, 1, "The gear", 1, 1, 2, edit_method=gears)
limits = gen.add_group("Limits", type="collapse", state=True)
limits.add("speed", double_t, 2, "Greatest speed, in m/s", 0.2, 0.0)
limits.add("name", str_t, 4, "A 'name'", "wheels")
exit(gen.generate(PACKAGE, "drive", "Drive"))
"""
SCRIPT = """#!/usr/bin/env python3
import rospy
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.server import Server
from drive.cfg import DriveConfig
{more}
seen = []

def changed(config, level):
    seen.append((config.gear, config["speed"], level))
    return config

rospy.init_node("drive")
server = Server(DriveConfig, changed)
client = Client("drive", timeout=5)
client.update_configuration({{"gear": DriveConfig.Drive_High, "speed": -3.0}})
print(seen, DriveConfig.all_level)
"""


def drive(bench: Bench, *, messages: bool = False) -> Path:
    """A package with a .cfg file, and a script that uses it."""
    folder = bench.package("drive", "dynamic_reconfigure")
    cmake = CMAKE
    if messages:
        cmake = cmake.replace("dynamic_reconfigure)", "dynamic_reconfigure std_msgs message_generation)")
        calls = "add_message_files(FILES Num.msg)\ngenerate_messages(DEPENDENCIES std_msgs)\n"
        cmake = cmake.replace("catkin_package", f"{calls}catkin_package")
    else:
        (folder / "msg/Num.msg").unlink()
    (folder / "srv/Add.srv").unlink()
    bench.write("drive", "CMakeLists.txt", cmake)
    bench.write("drive", "cfg/Drive.cfg", CFG).chmod(0o755)
    more = "from drive.msg import Num; assert Num(num=3).num == 3" if messages else ""
    bench.write("drive", "scripts/talker.py", SCRIPT.format(more=more)).chmod(0o755)
    return folder


@pytest.mark.parametrize("messages", [False, True])
def test_a_script_offers_what_the_file_describes(
    bench: Bench, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, messages: bool
) -> None:
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    folder = drive(bench, messages=messages)
    assert bench.make().status == 0
    path = str(folder / "scripts/talker.py")
    assert run_scripts([ScriptSpec(path)], stdin="", prefix=False).status == 0
    assert capsys.readouterr().out == "[(1, 0.2, -1), (2, 0.0, 3)] 7\n"


def test_a_changed_file_is_made_again_and_one_that_is_gone_is_removed(bench: Bench) -> None:
    drive(bench)
    bench.make()
    made = bench.base / "devel" / PYTHON / "drive/cfg/DriveConfig.py"
    assert "'default': 0.2" in made.read_text(encoding="utf-8")
    assert bench.make().fresh == ["drive"]
    bench.change("drive", "cfg/Drive.cfg", "0.2, 0.0", "0.3, 0.0")
    assert bench.make().built == ["drive"]
    assert "'default': 0.3" in made.read_text(encoding="utf-8")
    bench.change("drive", "CMakeLists.txt", "generate_dynamic_reconfigure_options(cfg/Drive.cfg)\n", "")
    bench.make()
    assert not made.parent.exists()


@pytest.mark.parametrize(
    ("file", "old", "new", "place", "message"),
    [
        ("cfg/Drive.cfg", "gen = P", "import os\ngen = P", "cfg/Drive.cfg:5: error", "import os is not understood"),
        ("cfg/Drive.cfg", "0.2, 0.0", "'a'", "cfg/Drive.cfg:9: error", "parameter speed has the type double"),
        ("cfg/Drive.cfg", "0.2, 0.0", "0.2, 1", "cfg/Drive.cfg:9: warning", "servers begin with 1.0"),
        ("cfg/Drive.cfg", '"Drive"', '"Driver"', "cfg/Drive.cfg:11: warning", "makes DriverConfig"),
        ("CMakeLists.txt", "Drive.cfg", "Drivee.cfg", "CMakeLists.txt:4: error", "did you mean Drive.cfg?"),
        ("CMakeLists.txt", "cfg/Drive.cfg", "../x.cfg", "CMakeLists.txt:4: error", "outside the package"),
        ("CMakeLists.txt", " dynamic_reconfigure)", ")", "CMakeLists.txt:4: warning", "dynamic_reconfigure is missing"),
        (
            "CMakeLists.txt",
            "generate_dynamic",
            "catkin_package()\ngenerate_dynamic",
            "CMakeLists.txt:5: error",
            "comes after catkin_package(); move it before",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong(bench: Bench, file: str, old: str, new: str, place: str, message: str) -> None:
    folder = drive(bench)
    bench.change("drive", file, old, new)
    (folder / "cfg/Drive.cfg").chmod(0o755)
    report = bench.make()
    found = [str(each) for each in report.findings if message in str(each)]
    assert [each.startswith(f"{folder / place}: ") for each in found] == [True], report.findings
    assert report.failed == (["drive"] if "error" in place else [])


@pytest.mark.skipif(os.name == "nt", reason="there are no run bits")
def test_a_file_without_its_run_bit_is_told_as_a_robot_needs_it(bench: Bench) -> None:
    folder = drive(bench)
    (folder / "cfg/Drive.cfg").chmod(0o644)
    (finding,) = bench.make().findings
    assert finding.message.endswith(f"chmod +x {folder / 'cfg/Drive.cfg'}")
