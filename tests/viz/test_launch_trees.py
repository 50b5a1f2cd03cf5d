"""The plan of a launch as a picture."""

from __future__ import annotations

import re
from pathlib import Path

from rosmini.ros.launch import Plan, read
from rosmini.viz import launch_tree

SHAPES = Path(__file__).parents[1] / "ros" / "launch" / "data" / "shapes"


def shown(plan: Plan) -> list[str]:
    """The texts of the picture, in order."""
    return re.findall(r"<text[^>]*>([^<]*)</text>", str(launch_tree(plan).svg))


def test_files_nodes_remappings_and_parameters_are_there() -> None:
    plan = read(SHAPES / "slam.launch", args={"set_base_frame": "base"})
    texts = shown(plan)
    for text in (
        "slam.launch",
        "/base_to_laser",
        "tf/static_transform_publisher",
        "slam_gmapping.launch",
        "/turtlebot3_slam_gmapping",
        "~base_frame",
        "&#x27;base&#x27;",
        "/use_sim_time",
        "True",
    ):
        assert any(text in found or text.replace("&#x27;", "'") in found for found in texts), (text, texts)
    assert texts.index("slam.launch") < texts.index("slam_gmapping.launch")


def test_what_is_overridden_says_so() -> None:
    plan = read(text='<launch><param name="a" value="1"/><param name="a" value="2"/></launch>')
    assert shown(plan) == ["&lt;text&gt;", "/a", "1", "overridden", "/a", "2"]


def test_a_plan_shows_itself() -> None:
    plan = read(
        text='<launch><group ns="r"><node pkg="p" type="t" name="n"><remap from="a" to="b"/></node></group></launch>'
    )
    picture = plan.show(title="Figure 1")
    assert picture.text == plan.text()
    assert picture.alt == "Tree of a launch: 1 node, 0 parameters in 1 file. /r/n (p/t)"
    assert "→ b" in shown(plan)
    assert launch_tree(plan).svg == launch_tree(plan).svg
