"""The chapter Many TurtleBots: what it says of names, slips and rates holds."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest

from ...interop.conftest import SYSTEM_PYTHON, need_ros
from ...processes import run
from .conftest import all_printed, printed

SLIP = """<launch><node pkg="gazebo_ros" type="spawn_model" name="spawn_urdf" arg="-urdf -model tb3_0"/></launch>"""

READ = """
import sys
import roslaunch.config, roslaunch.xmlloader
config, loader = roslaunch.config.ROSLaunchConfig(), roslaunch.xmlloader.XmlLoader()
loader.load(sys.argv[1], config, verbose=False)
print(*config.config_errors)
print([node.args for node in config.nodes])
"""


def test_two_robots_change_places(figures):
    (x, y), (other_x, other_y) = [
        map(float, found)
        for found in re.findall(r"^tb3_\d(?: \(burger\).*?)?: .*?end \((.*?), (.*?),", figures[1], re.MULTILINE)[:2]
    ]
    assert (x, y) == pytest.approx((-0.5, 1.0), abs=0.2)
    assert (other_x, other_y) == pytest.approx((-3.0, 1.0), abs=0.2)


def test_the_scans_of_the_nameless_come_in_turn(cells):
    metres = [float(each) for each in re.findall(r"\d\.\d+", printed(cells, "/scan/ranges[0]"))]
    assert len(metres) == 4
    assert all(abs(a - b) > 0.5 for a, b in pairwise(metres))


def test_roslaunch_warns_of_the_slip_and_real_roslaunch_does(cells, tmp_path):
    assert "unknown <node> attribute 'arg'; did you mean args?" in all_printed(cells)
    need_ros(modules="roslaunch")
    file = tmp_path / "slip.launch"
    file.write_text(SLIP, encoding="utf-8")
    done = run([SYSTEM_PYTHON, "-c", READ, str(file)])
    said, arguments = done.stdout.splitlines()
    assert said == f"[{file}] unknown <node> attribute 'arg'"
    assert arguments == "['']"


def test_transforms_come_thirty_times_a_second(cells):
    assert "average rate: 30.000" in printed(cells, "hz -w 30")
