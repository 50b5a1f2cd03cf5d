"""RViz's window in three dimensions: what its page is sent, and what a hand does there."""

import math

import numpy as np
import pytest

from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.visualization_msgs.msg import InteractiveMarker, InteractiveMarkerControl
from rosmini.ros.interactive_markers import InteractiveMarkerServer
from rosmini.viz import ViewError
from rosmini.viz.rviz.window import RVizWindow


@pytest.fixture
def window():
    grid = OccupancyGrid(data=[0] * 1600)
    grid.header.frame_id = "map"
    grid.info.width = grid.info.height = 40
    grid.info.resolution, grid.info.origin.orientation.w = 0.1, 1.0
    with Graph() as graph:
        graph.node("map_server").publisher("/map", OccupancyGrid, latch=True).publish(grid)
        graph.run(0.1)
        made = RVizWindow(graph, fixed_frame="map")
        graph.run(0.5)
        made.set("fit")
        made.set("type", "Orbit (rviz)")
        made.markup(live=True)
        yield made
        made.close()


def pixel(window, *point):
    window.markup(live=True)
    (found,) = window._projection.pixels(np.array([point], dtype=float))
    return f"{found[0]:.3f} {found[1]:.3f}"


def test_a_view_that_turns_is_shown_by_a_viewer_in_a_page_that_lives_and_drawn_elsewhere(window):
    assert "rq-solid" in window.markup(live=True)
    assert "rosmini-rviz.js" in window.scripts
    still = window.html
    assert "<svg" in still
    assert "rq-solid" not in still
    window.set("type", "TopDownOrtho (rviz)")
    assert "<svg" in window.markup(live=True)
    assert window.news(whole=True) is None


def test_the_page_is_told_all_once_and_then_what_is_new(window):
    content, commands = window.news(whole=True)
    assert set(content) == {"type", "whole", "camera", "labels", "grips", "turns", "background", "size"}
    assert len(commands) > 5
    window.markup(live=True)
    assert window.news(whole=False) is None
    window.set("tool/2D Nav Goal")
    assert window.news(whole=False) == ({"type": "solid", "whole": False, "turns": False}, [])
    window.set("display/1", False)
    window.markup(live=True)
    content, commands = window.news(whole=False)
    assert (list(content), len(commands)) == (["type", "whole"], 1)


def test_the_view_turns_with_the_page_and_the_page_with_the_view(window):
    window.markup(live=True)
    window.set("view", "orbit 3 0.5 0.25 7.0 1.0 -2.0 0.0")
    view = window.scene.view
    assert (view["Yaw"], view["Pitch"], view["Distance"]) == (0.5, 0.25, 7.0)
    assert view["Focal Point"][:2] == pytest.approx((3.0, 0.0), abs=0.01)
    window.markup(live=True)
    content, _ = window.news(whole=False)
    assert content["camera"] == pytest.approx([3, 3.0, 0.0, 0.0, 0.5, 0.25, 7.0, 45.0], abs=0.01)
    window.set("tool/Focus Camera")
    for kind in ("press", "release"):
        window.set("view", f"{kind} {pixel(window, 1.0, 1.0, 0.0)}")
    assert window.scene.view["Focal Point"][:2] == pytest.approx((1.0, 1.0), abs=0.01)
    window.set("fit")
    assert window.scene.view["Focal Point"][:2] == pytest.approx((2.0, 2.0), abs=0.01)
    for errors in ("orbit 1 2 3", "orbit 1 2 3 4 5 6 nan", "orbit"):
        with pytest.raises(ViewError, match="a pointer action"):
            window.set("view", errors)


def test_a_goal_is_dragged_on_the_ground_as_the_eye_sees_it(window):
    goals = []
    window.graph.node("listener").subscriber("/move_base_simple/goal", PoseStamped, goals.append)
    window.graph.run(0.1)
    window.set("tool/2D Nav Goal")
    window.set("view", f"press {pixel(window, 1.0, 3.0, 0.0)}")
    window.set("view", f"move {pixel(window, 1.0, 2.0, 0.0)}")
    window.markup(live=True)
    _, commands = window.news(whole=True)
    assert any(b"rviz/tool/0" in each for each in commands)  # the arrow
    window.set("view", f"release {pixel(window, 1.0, 1.0, 0.0)}")
    window.graph.run(0.1)
    (goal,) = goals
    assert (goal.pose.position.x, goal.pose.position.y) == pytest.approx((1.0, 3.0), abs=0.01)
    assert 2 * math.atan2(goal.pose.orientation.z, goal.pose.orientation.w) == pytest.approx(-math.pi / 2, abs=0.01)


def test_an_interactive_marker_is_lifted_along_its_axis(window):
    server = InteractiveMarkerServer(window.graph.node("basic_controls"), "basic_controls")
    marker = InteractiveMarker(name="box", scale=1.0)
    marker.header.frame_id = "map"
    marker.pose.position.x = marker.pose.position.y = 2.0
    lift = InteractiveMarkerControl(name="lift", interaction_mode=InteractiveMarkerControl.MOVE_AXIS)
    lift.orientation.y, lift.orientation.w = -1.0, 1.0  # its x looks up
    marker.controls = [lift]
    server.insert(marker)
    server.applyChanges()
    display = window.scene.add("InteractiveMarkers", {"Update Topic": "/basic_controls/update"})
    window.graph.run(1.5)
    assert window.markup(live=True)
    content, _ = window.news(whole=False)
    assert content["grips"] == ["/meshcat/rviz/2"]
    window.set("view", f"press {pixel(window, 2.0, 2.0, 0.57)}")
    window.set("view", f"move {pixel(window, 2.0, 2.0, 1.27)}")
    assert display.handle("box").pose[:3, 3] == pytest.approx((2.0, 2.0, 0.7), abs=0.02)
    window.set("view", f"release {pixel(window, 2.0, 2.0, 1.27)}")
    window.graph.run(0.1)
    assert server.get("box").pose.position.z == pytest.approx(0.7, abs=0.02)


def test_a_browser_without_webgl_is_shown_a_drawing(window):
    window.set("view", "flat")
    assert "<svg" in window.markup(live=True)
    assert "WebGL" in window.text
