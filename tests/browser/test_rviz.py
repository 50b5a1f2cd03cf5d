"""RViz's window in a real page on loopback: a real mouse and real keys, without Jupyter, from above and in 3D."""

import time
from types import SimpleNamespace

import numpy as np
import pytest

from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import PointStamped, PoseStamped, PoseWithCovarianceStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.visualization_msgs.msg import InteractiveMarker, InteractiveMarkerControl
from rosmini.ros.interactive_markers import InteractiveMarkerServer
from rosmini.viz.live.loopback import PageServer
from rosmini.viz.live.panel_link import PanelLink
from rosmini.viz.rviz.window import RVizWindow

from ..processes import PATIENCE

pytestmark = pytest.mark.browser

HEARD = {
    "/move_base_simple/goal": PoseStamped,
    "/initialpose": PoseWithCovarianceStamped,
    "/clicked_point": PointStamped,
}

VIEWER = "document.querySelector('.rq-solid').rosminiSolid.viewer"


@pytest.fixture
def window():
    grid = OccupancyGrid(data=[0] * 1600)
    grid.header.frame_id = "map"
    grid.info.width = grid.info.height = 40
    grid.info.resolution, grid.info.origin.orientation.w = 0.1, 1.0
    with Graph() as graph:
        graph.node("map_server").publisher("/map", OccupancyGrid, latch=True).publish(grid)
        server = InteractiveMarkerServer(graph.node("basic_controls"), "basic_controls")
        marker = InteractiveMarker(name="box", scale=1.0)
        marker.header.frame_id = "map"
        marker.pose.position.x = marker.pose.position.y = 1.0
        plane = InteractiveMarkerControl(name="plane", interaction_mode=InteractiveMarkerControl.MOVE_PLANE)
        plane.orientation.y = plane.orientation.w = 1.0
        marker.controls = [plane]
        server.insert(marker)
        server.applyChanges()
        dot = PointStamped()
        dot.header.frame_id, dot.point.x, dot.point.y = "map", 2.5, 3.5
        graph.node("dot").publisher("/dot", PointStamped, latch=True).publish(dot)
        graph.run(0.1)
        made = RVizWindow(graph, fixed_frame="map")
        graph.run(1.5)
        made.set("fit")
        graph._live = SimpleNamespace(running=True, stop=lambda: None)  # this test drives it
        yield made
        made.close()


class Hand:
    """A mouse and keys on the window's page, while the graph goes on."""

    def __init__(self, window, page):
        self.window, self.graph, self.page = window, window.graph, page
        self.heard = {topic: [] for topic in HEARD}
        for topic, kind in HEARD.items():
            window.graph.node("listener", anonymous=True).subscriber(topic, kind, self.heard[topic].append)

    def until(self, condition):
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline
            self.graph.run(0.05)
            self.page.wait_for_timeout(5)

    def take(self, label):
        button = self.page.get_by_role("button", name=label)
        button.click()
        self.until(lambda: button.get_attribute("aria-pressed") == "true")

    def at(self, x, y, z=0.0):
        """Where in the page a point of the map is seen."""
        (pixel,) = self.window._projection.pixels(np.array([[x, y, z]]))
        box = self.page.locator("[data-points] > svg, .rq-solid iframe").first.bounding_box()
        width, height = self.window._size
        return box["x"] + pixel[0] / width * box["width"], box["y"] + pixel[1] / height * box["height"]

    def drag(self, start, *ends):
        said = self.window._said
        self.page.mouse.move(*self.at(*start))
        self.page.mouse.down()
        self.until(lambda: self.window._is_pressed or self.window._said != said)
        for end in ends:
            self.page.mouse.move(*self.at(*end), steps=3)
        self.page.mouse.up()
        self.until(lambda: not self.window._is_pressed)

    def last(self, topic):
        self.until(lambda: self.heard[topic])
        return self.heard[topic].pop()


@pytest.fixture
def use(chromium, webgl, watch, window):
    """Open the window in a browser, use it, and see that the page had nothing to complain of."""

    def used(solid, act):
        context = (webgl if solid else chromium).new_context(viewport={"width": 900, "height": 1200})
        page = context.new_page()
        watcher = watch(page)
        hand = Hand(window, page)
        with PageServer(PanelLink(window).widget, title="RViz") as server:
            page.goto(server.url)
            drawing = page.locator("[data-points] > svg")
            hand.until(lambda: drawing.count() == 1 and page.locator(".rq-pill").inner_text() == "live")
            act(hand)
            context.close()
        assert [each for each in watcher.seen if not each.startswith(f"request: {server.url}")] == []

    return used


def publishing(hand):
    """2D Nav Goal, 2D Pose Estimate and Publish Point."""
    hand.take("2D Nav Goal")
    hand.drag((2.0, 2.0), (2.0, 3.0))
    goal = hand.last("/move_base_simple/goal").pose
    assert (goal.position.x, goal.position.y) == pytest.approx((2.0, 2.0), abs=0.05)
    assert goal.orientation.z == pytest.approx(0.7071, abs=0.01)
    hand.take("2D Pose Estimate")
    hand.drag((3.0, 1.0), (2.0, 1.0))
    found = hand.last("/initialpose").pose
    assert (found.pose.position.x, found.pose.position.y) == pytest.approx((3.0, 1.0), abs=0.05)
    assert abs(found.pose.orientation.z) == pytest.approx(1.0, abs=0.01)
    assert found.covariance[0] == 0.25
    hand.take("Publish Point")
    hand.drag((3.0, 2.5))
    point = hand.last("/clicked_point").point
    assert (point.x, point.y, point.z) == pytest.approx((3.0, 2.5, 0.0), abs=0.05)
    assert hand.window.tools.current.label == "Interact"


def looking(hand):
    """Measure, Select, and Interact with a marker."""
    window = hand.window
    hand.take("Measure")
    hand.drag((2.0, 2.0))
    hand.drag((3.0, 2.0))
    assert window.tools["Measure"].length == pytest.approx(1.0, abs=0.05)
    hand.take("Interact")
    display = window.scene["/basic_controls/update"]
    hand.drag((1.57, 1.0), (1.57, 2.0))
    assert display.handle("box").pose[:2, 3] == pytest.approx((1.0, 2.0), abs=0.05)
    hand.take("Select")
    hand.drag((2.1, 3.9), (2.9, 3.1))
    assert {each.display.name for each in window.selected} == {"/dot"}
    hand.until(lambda: "selected" in hand.page.locator(".rosmini-rqt").inner_text())


def test_each_tool_is_used_with_the_mouse_from_above_and_a_display_with_the_keyboard(use, window):
    def act(hand):
        page = hand.page
        publishing(hand)
        looking(hand)
        hand.take("Focus Camera")
        hand.drag((1.0, 3.0))
        assert (window.scene.view["X"], window.scene.view["Y"]) == pytest.approx((1.0, 3.0), abs=0.05)
        hand.until(lambda: window._projection.ground[:2] == pytest.approx((1.0, 3.0), abs=0.05))
        hand.take("Move Camera")
        hand.drag((1.0, 3.0), (2.0, 2.0))
        assert (window.scene.view["X"], window.scene.view["Y"]) == pytest.approx((0.0, 4.0), abs=0.1)
        page.get_by_role("checkbox", name="/map").focus()
        page.keyboard.press("Space")
        hand.until(lambda: not window.scene["/map"].enabled)
        hand.until(lambda: page.locator("[data-points] > svg image").count() == 0)
        page.locator("[data-points]").focus()
        page.keyboard.press("n")
        hand.until(lambda: window.tools.current.label == "Measure")

    use(False, act)


@pytest.mark.nightly
def test_in_three_dimensions_the_mouse_turns_the_scene_or_uses_the_tool(use, window):
    def act(hand):
        page = hand.page
        page.get_by_label("View").first.select_option("Orbit (rviz)")
        hand.until(lambda: page.locator("iframe[data-ready]").count())
        seen = "document.querySelector('.rq-solid').rosminiSolid.filled"
        hand.until(lambda: page.evaluate(seen))
        view = window.scene.view
        yaw, pitch = view["Yaw"], view["Pitch"]
        x, y = hand.at(3.0, 3.0)  # empty ground
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 60, y - 30, steps=4)
        page.mouse.up()
        hand.until(lambda: view["Yaw"] != yaw and view["Pitch"] < pitch)
        eye = "[camera.position.x, -camera.position.z, camera.position.y]"
        camera = f"(({{camera}}) => {eye})({VIEWER})"
        hand.until(
            lambda: np.allclose(
                page.evaluate(camera),
                view.viewpoint(window.scene.context).target + window._projection.distance * window._projection.axes[2],
                atol=0.02,
            )
        )
        distance = view["Distance"]
        page.mouse.wheel(0, -200)
        hand.until(lambda: view["Distance"] < 0.97 * distance)
        page.get_by_role("button", name="Show all").click()
        hand.until(lambda: view["Focal Point"][:2] == pytest.approx((2.0, 2.0), abs=0.3))
        hand.until(lambda: np.allclose(page.evaluate(camera), window._projection.eye, atol=0.02))
        publishing(hand)
        looking(hand)
        hand.take("Focus Camera")
        hand.drag((1.0, 3.0))
        hand.until(lambda: view["Focal Point"][:2] == pytest.approx((1.0, 3.0), abs=0.05))
        shown = f"globalThis.rosminiMeshcat.find({VIEWER}, '/meshcat/rviz/1').children.length"
        assert page.evaluate(shown) == 1
        page.get_by_role("checkbox", name="/map").click()
        hand.until(lambda: page.evaluate(shown) == 0)

    use(True, act)
