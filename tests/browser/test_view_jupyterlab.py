"""The view of a simulation in a real JupyterLab: a mouse in Chromium drags robots on a live graph in a kernel."""

import math
import re

import pytest

pytestmark = pytest.mark.browser

CELLS = [
    """
from rosmini import Graph, rosrun
graph = Graph()
stage = rosrun("stage_ros", "stageros", "package://stage_ros/world/boxes.world", graph=graph).instance()
view = stage.view()
view
""",
    "print('live', graph.is_live, [round(part, 1) for part in stage.truth()])",
    "view.drag('crate_2', (0.5, 1.5)); print('by a script')",
    "print('stands', stage.host.paused, view.message)",
]


@pytest.fixture
def lab(open_in_lab, chromium):
    page = chromium.new_page(viewport={"width": 1280, "height": 1600})
    page.goto(open_in_lab(CELLS))
    page.locator(".jp-Notebook .jp-CodeCell").nth(len(CELLS) - 1).wait_for()
    page.locator("#jp-main-statusbar", has_text="| Idle").wait_for()
    yield page
    page.close()


def run(page, number):
    cell = page.locator(".jp-Notebook .jp-CodeCell").nth(number)
    cell.locator(".jp-InputArea-editor").click()
    page.keyboard.press("Control+Enter")
    cell.locator(".jp-InputPrompt", has_text=re.compile(r"\[[*\d]+\]")).first.wait_for()


def says(page, number, text):
    cell = page.locator(".jp-Notebook .jp-CodeCell").nth(number)
    cell.locator(".jp-OutputArea-output", has_text=text).first.wait_for()


def middle(page, name):
    box = page.locator(f".rv-thing[data-name='{name}']").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, name, dx, dy):
    """By so many metres."""
    (ax, ay), (bx, by) = middle(page, "robot_0"), middle(page, "crate_1")
    scale = math.dist((ax, ay), (bx, by)) / page.evaluate(
        "(([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]))(document.querySelector('.rosmini-view').kernel.state.poses)"
    )
    x, y = middle(page, name)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 5, y + 5)
    page.mouse.move(x + dx * scale, y - dy * scale)
    page.mouse.up()


def test_a_robot_is_dragged(lab, shared_tmp):
    page = lab
    try:
        run(page, 0)
        page.locator(".rv-pill", has_text="the graph stands still").wait_for()
        drag(page, "robot_0", 1.0, -1.0)
        page.locator(".rv-message", has_text="robot_0 is at (-0.").wait_for()
        page.locator(".rv-pill[data-mood='running']").wait_for()
        page.screenshot(path=shared_tmp / "view_jupyterlab.png")
        run(page, 1)
        says(page, 1, "live True [-0.5, -1.0, 0.0]")

        # What a script drags is seen.
        run(page, 2)
        says(page, 2, "by a script")
        page.locator(".rv-thing[aria-label*='crate_2'][aria-label*='y 1.50 m']").wait_for()

        # Refused: it snaps back.
        before = middle(page, "crate_1")
        drag(page, "crate_1", -1.0, -1.0)
        page.locator(".rv-message.rv-bad", has_text="in its way").wait_for()
        page.wait_for_function("document.querySelector('.rv-refused') !== null")
        page.locator(".rv-thing[aria-label*='crate_1'][aria-label*='x 0.50 m, y 0.00 m']").wait_for()
        assert middle(page, "crate_1") == pytest.approx(before, abs=1)

        # Keys do not run or change cells of the notebook.
        page.locator(".rv-thing[data-name='robot_0']").focus()
        page.keyboard.press("ArrowLeft")
        page.locator(".rv-thing[aria-label*='robot_0'][aria-label*='x -0.6']").wait_for()
        assert page.locator(".jp-Notebook .jp-CodeCell").count() == len(CELLS)

        page.locator(".rv-bar button", has_text="Pause").click()
        page.locator(".rv-bar button", has_text="Run").wait_for()
        run(page, 3)
        says(page, 3, "stands True time stands")
    finally:
        page.screenshot(path=shared_tmp / "view_jupyterlab_end.png")
