"""The configurations of RViz that our launch files name: each is whole, and its displays are known."""

from __future__ import annotations

import pytest
import yaml

from assets.generate.rviz_files import FILES
from rosmini import Graph
from rosmini.core.packages import PackageIndex
from rosmini.viz.rviz import Config, Scene


@pytest.mark.parametrize("path", FILES)
def test_a_file_is_one_of_rviz(path):
    file = PackageIndex().resolve(f"package://{path}")
    tree = yaml.safe_load(file.read_text(encoding="utf-8"))
    assert set(tree) == {"Panels", "Visualization Manager", "Window Geometry"}
    manager = tree["Visualization Manager"]
    assert all(each["Class"].startswith("rviz/") for each in (*manager["Displays"], *manager["Tools"]))
    names = [each["Name"] for each in manager["Displays"]]
    assert len(set(names)) == len(names)
    with Graph() as graph, Scene(graph, Config.read(file)) as scene:
        assert scene.warning == ""
        assert scene.fixed_frame == FILES[path][0]
        assert [display.name for display in scene.displays] == names
