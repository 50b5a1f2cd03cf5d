"""RViz's window: what a hand or keys do on it, on a running graph."""

import io
import math

import numpy as np
import pytest

from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import PointStamped, PoseStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.ros.launch import roslaunch
from rosmini.viz import ViewError
from rosmini.viz.rqt.parts import Drawing, Rows
from rosmini.viz.rviz.config import Config
from rosmini.viz.rviz.views import PIXELS
from rosmini.viz.rviz.window import RVizWindow


def grid(side=40):
    message = OccupancyGrid(data=[0] * side * side)
    message.header.frame_id = "map"
    message.info.width = message.info.height = side
    message.info.resolution, message.info.origin.orientation.w = 0.1, 1.0
    return message


@pytest.fixture
def graph():
    with Graph() as made:
        node = made.node("map_server")
        node.publisher("/map", OccupancyGrid, latch=True).publish(grid())
        made.run(0.1)
        yield made


@pytest.fixture
def window(graph):
    made = RVizWindow(graph, fixed_frame="map")
    graph.run(0.5)
    made.set("fit")
    yield made
    made.close()


def listen(graph, topic, kind):
    heard = []
    graph.node("listener", anonymous=True).subscriber(topic, kind, heard.append)
    graph.run(0.1)
    return heard


def place(window, x, y):
    window.parts()
    return window._projection.pixels(np.array([[x, y, 0.0]]))[0]


def pixel(window, x, y):
    return "{:.1f} {:.1f}".format(*place(window, x, y))


def scale(window):
    """Pixels for a metre; those of a thousand kilometres, as each place is rounded."""
    return (place(window, 1e6, 0.0)[0] - place(window, 0.0, 0.0)[0]) / 1e6


def test_a_goal_is_published_where_a_hand_drags(graph, window):
    goals = listen(graph, "/move_base_simple/goal", PoseStamped)
    window.set("tool/2D Nav Goal")
    window.set("view", f"press {pixel(window, 1.0, 2.0)}")
    window.set("view", f"move {pixel(window, 1.5, 2.0)}")
    window.set("view", f"release {pixel(window, 1.0, 3.0)}")
    graph.run(0.1)
    (goal,) = goals
    assert goal.header.frame_id == "map"
    assert (goal.pose.position.x, goal.pose.position.y) == pytest.approx((1.0, 2.0), abs=0.02)
    assert 2 * math.atan2(goal.pose.orientation.z, goal.pose.orientation.w) == pytest.approx(math.pi / 2, abs=0.02)
    assert window.tools.current.label == "Interact"
    assert "Setting goal" in window.text


def test_a_point_is_taken_of_what_is_drawn_and_not_of_empty_ground(graph, window):
    points = listen(graph, "/clicked_point", PointStamped)
    window.set("view", "key u")
    assert window.tools.current.label == "Publish Point"
    for kind in ("press", "release"):
        window.set("view", f"{kind} {pixel(window, -0.15, 2.0)}")
    graph.run(0.1)
    assert points == []
    assert window.tools.current.label == "Publish Point"
    for kind in ("press", "release"):
        window.set("view", f"{kind} {pixel(window, 1.5, 2.5)}")
    graph.run(0.1)
    (found,) = points
    assert (found.point.x, found.point.y) == pytest.approx((1.5, 2.5), abs=0.02)


def test_what_a_hand_takes_hold_of_follows_it_however_often_it_tells(graph, window):
    window.set("tool/Move Camera")
    start = place(window, 1.0, 3.0)
    window.set("view", f"press {start[0]:.1f} {start[1]:.1f}")
    for part in (0.25, 0.5, 0.5, 0.8):
        window.set("view", f"move {start[0] + part * 100:.1f} {start[1]:.1f}")
    window.set("view", f"release {start[0] + 100:.1f} {start[1]:.1f}")
    assert place(window, 1.0, 3.0) == pytest.approx(start + (100, 0), abs=0.3)


def test_the_camera_follows_a_drag_and_zooms_around(graph, window):
    before = pixel(window, 2.0, 2.0)
    window.set("tool/Move Camera")
    end = pixel(window, 3.0, 2.0)
    window.set("view", f"press {before}")
    window.set("view", f"move {end}")
    window.set("view", f"release {end}")
    first = scale(window)
    assert place(window, 2.0, 2.0) - [float(part) for part in before.split()] == pytest.approx([first, 0.0], abs=0.5)
    window.set("closer")
    assert scale(window) == pytest.approx(1.25 * first)
    window.set("view", "wheel 1 10 10")
    assert scale(window) == pytest.approx(first)


def test_displays_are_switched_and_say_how_they_are(graph, window):
    (table,) = [part for part in window.parts() if isinstance(part, Rows)]
    names = [row.cells[0] for row in table.rows]
    assert "/map" in names
    number = names.index("/map")
    assert "Map received" in table.rows[number].cells[2]
    window.set(f"display/{number}", False)
    graph.run(0.1)
    (table,) = [part for part in window.parts() if isinstance(part, Rows)]
    assert table.rows[number].cells[2] == "off"
    (drawing,) = [part for part in window.parts() if isinstance(part, Drawing)]
    assert "<image" not in drawing.markup


def test_select_lists_what_is_in_the_rectangle(graph, window):
    window.set("tool/Select")
    window.set("view", "press 0 0")
    window.set("view", "move 10000 10000")
    window.set("view", "release 10000 10000")
    assert [each.display.name for each in window.selected] == ["Grid"]
    assert "Grid (rviz/Grid)" in window.text


def test_what_is_no_movement_is_refused(window):
    for errors in ("press", "press 1", "press a b", "press nan 1", "fly 1 2", "", "key", "wheel 1 2"):
        with pytest.raises(ViewError):
            window.set("view", errors)
    window.set("view", "key F12")


def test_keys_move_a_cross_that_the_mouse_takes_away(window):
    window.set("view", "key ArrowRight")
    assert len(window._tool_primitives()) == 2
    window.set("view", "press 10 10")
    assert window._tool_primitives() == []


def test_a_window_takes_the_place_of_the_one_before_it_and_leaves_nothing(graph):
    first = RVizWindow(graph)
    second = RVizWindow(graph)
    assert first.gone
    assert second.node.name == "/rviz"
    second.close()
    state = graph.ask_as("/test").ask("getSystemState")
    assert "/rviz" not in {node for side in state for _, nodes in side for node in nodes}


def test_the_view_follows_what_comes_until_a_hand_is_on_it(graph):
    window = RVizWindow(graph, fixed_frame="map")
    before = scale(window)
    graph.run(0.5)
    after = scale(window)
    assert after > 1.5 * before  # the map has come, and is smaller than the grid
    window.set("closer")
    graph.run(0.5)
    assert scale(window) == pytest.approx(1.25 * after)
    window.close()


def test_the_view_of_a_file_is_kept(graph):
    view = {"Class": "rviz/TopDownOrtho", "Scale": 90.0, "X": 2.0, "Y": 1.0}
    config = Config()
    window = RVizWindow(graph, config.with_parts([], config.options(), view), fixed_frame="map")
    before = scale(window), pixel(window, 2.0, 1.0)
    graph.run(0.5)
    assert (scale(window), pixel(window, 2.0, 1.0)) == before
    assert before[0] == pytest.approx(90.0 * window._size[0] / PIXELS)
    window.close()


def test_the_plans_and_costmaps_of_a_move_base_that_starts_later_are_shown():
    said = io.StringIO()
    with Graph() as graph:
        window = RVizWindow(graph)
        graph.run(0.5)
        (table,) = (part for part in window.parts() if isinstance(part, Rows))
        grid_row = table.rows[0]
        console = {"stdout": said, "stderr": said}
        roslaunch("rosmini_sim", "navigation.launch", graph=graph, console=console, world="room", noise="0")
        graph.run(1.5)
        (table,) = (part for part in window.parts() if isinstance(part, Rows))
        names = [row.cells[0] for row in table.rows]
        assert names.count("/scan") == 1
        assert {f"/move_base/{each}_costmap/costmap" for each in ("global", "local")} < set(names)
        plans = {"/move_base/NavfnROS/plan", "/move_base/DWAPlannerROS/local_plan"}
        assert plans < set(names)
        goal = PoseStamped()
        goal.header.frame_id, goal.pose.orientation.w = "map", 1.0
        goal.pose.position.x, goal.pose.position.y = 1.0, 0.5
        publisher = graph.node("goals").publisher("/move_base_simple/goal", PoseStamped)
        graph.run(0.5)
        publisher.publish(goal)
        graph.run(2.0)
        window.parts()
        assert all(window.scene[each].message_count for each in plans)
        window.set(grid_row.cells[1].key, False)  # the maps that came between have not moved the controls
        assert not window.scene["Grid"].enabled
        window.close()
