"""`rviz`: what RViz shows at this moment."""

import re

import pytest

from rosmini import Graph
from rosmini.core.errors import UsageError
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.viz.rviz.config import ConfigError
from rosmini.viz.rviz.picture import RvizView
from rosmini.viz.rviz.window import RVizWindow
from rosmini.viz.verbs.rqt import Shown
from rosmini.viz.verbs.rviz import TOOL
from rosmini.viz.view import ViewError


@pytest.fixture
def graph():
    with Graph() as made:
        robot = made.node("robot")
        scans = robot.publisher("scan", LaserScan)
        scan = LaserScan(ranges=[1.0], range_max=2.0)
        scan.header.frame_id = "odom"
        robot.timer(0.1, lambda _: scans.publish(scan))
        yield made


def test_it_listens_and_leaves(graph, tmp_path):
    before = graph.now().to_sec()
    result = TOOL.run("--still", "--duration", "1", "--title", "Figure 21.1", graph=graph)
    assert graph.now().to_sec() == pytest.approx(before + 1.0, abs=0.11)
    assert result.view.text.startswith("Figure 21.1: 2 displays, fixed frame odom")
    assert "Showing [1] points from [1] messages" in result.view.text
    assert isinstance(TOOL.run(graph=graph).view, RvizView)
    assert sorted(graph.nodes) == ["/robot", "/rosout"]
    TOOL.run("--still", "-o", str(tmp_path / "it.svg"), graph=graph)
    assert (tmp_path / "it.svg").read_text(encoding="utf-8").startswith("<svg")


def test_a_file_and_a_frame(graph, tmp_path):
    from rosmini.viz.rviz import Scene

    with Scene(graph, fixed_frame="map") as scene:
        scene.add("LaserScan", {"Topic": "/scan"}, name="Front laser")
        scene.save(tmp_path / "my.rviz")
    warned = []
    result = TOOL.run("-d", str(tmp_path / "my.rviz"), "-f", "odom", "--still", graph=graph, warn=warned.append)
    assert "fixed frame odom" in result.view.text
    assert "Front laser (rviz/LaserScan): Ok" in result.view.text
    assert warned == []
    text = (tmp_path / "my.rviz").read_text(encoding="utf-8").replace("Use rainbow", "Use unicorn")
    (tmp_path / "my.rviz").write_text(text, encoding="utf-8")
    TOOL.run("-d", str(tmp_path / "my.rviz"), graph=graph, warn=warned.append)
    (line,) = warned
    assert line.startswith("[WARN] my.rviz: ") and line.endswith("Front laser/Use unicorn")


def test_live_it_is_a_window_that_goes_on(graph):
    result = TOOL.run("--live", "-f", "odom", graph=graph)
    assert isinstance(result, Shown)
    window = result.view
    assert isinstance(window, RVizWindow)
    assert re.search(r"\b(19|20) messages received", window.text)
    graph.run(1.0)
    assert re.search(r"\b(29|30) messages received", window.text)
    assert "/rviz" in graph.nodes
    window.close()
    assert "/rviz" not in graph.nodes


def test_what_makes_no_sense(graph):
    with pytest.raises(ViewError, match="-d FILE"):
        TOOL.run("my.rviz", graph=graph)
    with pytest.raises(UsageError, match="--live"):
        TOOL.run("--live", "Grid", graph=graph)
    with pytest.raises(ConfigError, match=r"nowhere\.rviz"):
        TOOL.run("-d", "nowhere.rviz", graph=graph)
