"""The chapter Many TurtleBots: what it says of slips and counts holds."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest

from ...interop.conftest import SYSTEM_PYTHON, need_ros
from ...processes import run
from .conftest import all_printed

SLIP = """<launch><node pkg="gazebo_ros" type="spawn_model" name="spawn_urdf" arg="-urdf -model tb3_0"/></launch>"""

READ = """
import sys
import roslaunch.config, roslaunch.xmlloader
config, loader = roslaunch.config.ROSLaunchConfig(), roslaunch.xmlloader.XmlLoader()
loader.load(sys.argv[1], config, verbose=False)
print(*config.config_errors)
print([node.args for node in config.nodes])
"""


def test_nobody_of_those_who_changed_places_was_in_the_others_way(figures):
    """Both arrived, by the replay's own words."""
    (x, y), (other_x, other_y) = [
        map(float, found)
        for found in re.findall(r"^tb3_\d(?: \(burger\).*?)?: .*?end \((.*?), (.*?),", figures[1], re.MULTILINE)[:2]
    ]
    assert (x, y) == pytest.approx((3.0, 1.0), abs=0.2)
    assert (other_x, other_y) == pytest.approx((-3.0, 1.0), abs=0.2)


def test_the_slip_is_told_and_survived(cells):
    said = all_printed(cells)
    assert "unknown <node> attribute 'arg'; did you mean args?" in said
    assert "process[teleop_twist_keyboard_tb3_0-1]: started" in said


def test_real_roslaunch_says_of_the_slip_what_ours_says(tmp_path):
    need_ros(modules="roslaunch")
    file = tmp_path / "slip.launch"
    file.write_text(SLIP, encoding="utf-8")
    done = run([SYSTEM_PYTHON, "-c", READ, str(file)])
    said, arguments = done.stdout.splitlines()
    assert said == f"[{file}] unknown <node> attribute 'arg'"
    assert arguments == "['']"


def test_what_is_heard_grows_as_the_text_says(cells):
    rows = re.findall(r"(\d+) robots: +(\d+) own messages, +(\d+) transforms", all_printed(cells))
    assert len(rows) == 4
    for robots, own, transforms in rows:
        assert int(own) == 35 * int(robots)
        assert int(transforms) == 30 * int(robots) ** 2


def test_the_scans_of_the_nameless_come_in_turn(cells):
    (found,) = re.findall(r"ahead: (.*)", all_printed(cells))
    metres = [float(each) for each in found.split()]
    assert all(abs(a - b) > 0.5 for a, b in pairwise(metres))
