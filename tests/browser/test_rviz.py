"""RViz's window in a real page on loopback: a real mouse and real keys, without Jupyter."""

from __future__ import annotations

import time
from types import SimpleNamespace

import pytest

from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.widgets.loopback import PageServer
from rosmini.widgets.rqt.panel_link import PanelLink
from rosmini.widgets.rviz import RVizWindow

from ..processes import PATIENCE

pytestmark = pytest.mark.browser


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
        graph.run(0.1)
        made.set("fit")
        graph._live = SimpleNamespace(running=True, stop=lambda: None)  # this test drives it
        yield made
        made.close()


def test_a_goal_is_set_with_the_mouse_and_a_display_with_the_keyboard(chromium, watch, window):
    graph, goals = window.graph, []
    graph.node("listener").subscriber("/move_base_simple/goal", PoseStamped, goals.append)
    context = chromium.new_context(viewport={"width": 900, "height": 1100})
    page = context.new_page()
    watcher = watch(page)

    def until(condition) -> None:
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline
            graph.run(0.05)
            page.wait_for_timeout(5)

    with PageServer(PanelLink(window).widget, title="RViz") as server:
        page.goto(server.url)
        drawing = page.locator("[data-points] > svg")
        until(lambda: drawing.count() == 1 and page.locator(".rq-pill").inner_text() == "live")
        page.get_by_role("button", name="2D Nav Goal").click()
        until(lambda: window.tools.current.label == "2D Nav Goal")
        until(lambda: page.get_by_role("button", name="2D Nav Goal").get_attribute("aria-pressed") == "true")
        box = drawing.bounding_box()
        middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(*middle)
        page.mouse.down()
        page.mouse.move(middle[0], middle[1] - 60, steps=3)
        page.mouse.up()
        until(lambda: goals)
        place = goals[0].pose
        assert (place.position.x, place.position.y) == pytest.approx((2.0, 2.0), abs=0.05)
        assert place.orientation.z == pytest.approx(0.7071, abs=0.01)
        page.get_by_role("checkbox", name="/map").focus()
        page.keyboard.press("Space")
        until(lambda: not window.scene["/map"].enabled)
        until(lambda: drawing.locator("image").count() == 0)
        page.locator("[data-points]").focus()
        page.keyboard.press("n")
        until(lambda: window.tools.current.label == "Measure")
        context.close()
        assert [each for each in watcher.seen if not each.startswith(f"request: {server.url}")] == []
