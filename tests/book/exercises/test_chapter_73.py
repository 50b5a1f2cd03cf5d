"""Chapter 73: its figures are numbered; what it says of launch files, counts and defaults holds."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from defusedxml import ElementTree

from book.tools import notebooks
from rosmini.packages import assets_dir

from ...interop.conftest import SYSTEM_PYTHON, need_ros
from ...processes import run
from .conftest import assert_figures_are_numbered

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "73_many_turtlebots.ipynb"
LAUNCH = assets_dir() / "ros" / "turtlebot3_gazebo" / "launch" / "two_turtlebot3.launch"

FIGURES = ("rqt_graph(graph", "tf_tree(", ".show(", "world_picture(\n", "plot(\n", ".replay(")

SLIP = """<launch><node pkg="gazebo_ros" type="spawn_model" name="spawn_urdf" arg="-urdf -model tb3_0"/></launch>"""

READ = """
import sys
import roslaunch.config, roslaunch.xmlloader
config, loader = roslaunch.config.ROSLaunchConfig(), roslaunch.xmlloader.XmlLoader()
loader.load(sys.argv[1], config, verbose=False)
print(*config.config_errors)
print([node.args for node in config.nodes])
"""


@pytest.fixture(scope="module")
def chapter():
    return notebooks.read(CHAPTER)


@pytest.fixture(scope="module")
def prose(chapter):
    return "\n\n".join(cell.source for cell in chapter.cells if cell.cell_type == "markdown")


@pytest.fixture(scope="module")
def code(chapter):
    return [cell.source for cell in chapter.cells if cell.cell_type == "code"]


def printed(chapter) -> str:
    """All that its cells print."""
    return "".join(
        output.text
        for cell in chapter.cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if output.output_type == "stream"
    )


def test_every_figure_is_numbered_in_order():
    assert_figures_are_numbered(CHAPTER.stem, FIGURES)


def test_a_page_holds_few_moving_pictures(code):
    text = "".join(code)
    assert sum(text.count(word) for word in (".show3d(", ".replay(", ".replay3d(")) == 1
    assert CHAPTER.stat().st_size < 1_500_000


def test_the_words_of_the_launch_file_are_those_that_the_cells_use(code):
    root = ElementTree.parse(LAUNCH).getroot()
    defaults = {arg.get("name"): arg.get("default") for arg in root.findall("arg")}
    text = "\n".join(code)
    groups = root.findall("group")
    assert len(groups) == 2
    for robot, group in zip(("first_tb3", "second_tb3"), groups, strict=True):
        x, y = (defaults[f"{robot}_{axis}_pos"] for axis in "xy")
        assert f'start_group("{defaults[robot]}", {x}, {y})' in text
        spawn, teleop = (group.find(f"node[@name='{name}']") for name in ("spawn_urdf", "teleop"))
        assert spawn.get("args").startswith(f"-urdf -model $(arg {robot}) -x ")
        assert teleop.find("remap").attrib == {"from": "cmd_vel", "to": f"/$(arg {robot})/cmd_vel"}
    state = groups[0].find("node[@name='robot_state_publisher']")
    assert {p.get("name"): p.get("value") for p in state} == {
        "publish_frequency": "50.0",
        "tf_prefix": "$(arg first_tb3)",
    }
    assert '"_publish_frequency:=50.0", f"_tf_prefix:={robot}"' in text


def test_real_roslaunch_says_of_the_slip_what_the_text_says(prose, tmp_path):
    need_ros(modules="roslaunch")
    (warning,) = re.findall(r"roslaunch warns, `(.*?)`,", prose)
    file = tmp_path / "slip.launch"
    file.write_text(SLIP, encoding="utf-8")
    done = run([SYSTEM_PYTHON, "-c", READ, str(file)])
    said, arguments = done.stdout.splitlines()
    assert said == f"[{file}] {warning}"
    assert arguments == "['']"


def test_what_is_heard_grows_as_the_text_says(chapter):
    rows = re.findall(r"(\d+) robots: +(\d+) own messages, +(\d+) transforms", printed(chapter))
    assert len(rows) == 6
    for robots, own, transforms in rows:
        assert int(own) == 35 * int(robots)
        assert int(transforms) == 30 * int(robots) ** 2


def test_the_careful_ones_touch_nobody_and_the_bold_ones_do(chapter, prose):
    text = printed(chapter)
    bold, careful = text.split("who touched whom:")[1:]
    assert len(re.findall(r"^    \('tb3_\d', 'tb3_\d'\)$", bold, re.MULTILINE)) == 5
    assert "five pairs within a minute" in prose
    assert careful.startswith(" []\n")


def test_one_future_is_the_same_and_the_other_is_not(chapter, prose):
    text = printed(chapter)
    assert "the same future: True" in text
    when = [int(s) for s in re.findall(r"goes another way after (\d+) s", text)]
    assert len(when) == 9
    assert f"after {max(when)} seconds nobody drives as it did" in prose
