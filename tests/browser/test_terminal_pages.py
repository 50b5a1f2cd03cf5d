"""The pages of programs in a terminal: a real mouse and real keys in Chromium act on the graph of another process."""

import os
import re
import sys
from contextlib import ExitStack
from types import SimpleNamespace

import pytest

from ..processes import free_port, start, wait_until

pytestmark = pytest.mark.browser

ROSMINI = [sys.executable, "-m", "rosmini"]

LISTENER = """
from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.std_msgs.msg import String

graph = Graph(simulated=False)
graph.online()
node = graph.node("listener")
grid = OccupancyGrid(data=[0] * 1600)
grid.header.frame_id = "map"
grid.info.width = grid.info.height = 40
grid.info.resolution, grid.info.origin.orientation.w = 0.1, 1.0
node.publisher("/map", OccupancyGrid, latch=True).publish(grid)


def say(*words):
    print(*words, flush=True)


node.subscriber("/move_base_simple/goal", PoseStamped, lambda m: say("goal in", m.header.frame_id))
node.subscriber("/text", String, lambda m: say("text", m.data))
node.subscriber("/cmd_vel", Twist, lambda m: say("pad", m.linear.x))
node.subscriber("/turtle1/cmd_vel", Twist, lambda m: say("turtle", m.linear.x))
say("listening")
graph.run()
"""

PAGES = """
from rosmini.ros.net import connect
from rosmini.viz.live.pad import TeleopPad
from rosmini.viz.live.loopback import PageServer
from rosmini.viz.rqt.publisher import MessagePublisher

with connect() as graph:
    for live in (MessagePublisher(graph), TeleopPad(graph)):
        server = PageServer(live.link.widget, title=type(live).__name__)
        print(f"{server.title}: {server.url}", flush=True)
    graph.run()
"""

LAUNCH = """<launch>
<node pkg="rviz" type="rviz" name="rviz_of_a_launch_file" args="-f map"/>
<node pkg="turtlesim" type="turtlesim_node" name="turtlesim"/>
</launch>"""


@pytest.fixture(scope="module")
def terminals(tmp_path_factory):
    """Four programs on one Master: one that listens, `rosmini rviz`, a launch file, and a script with three pages."""
    folder = tmp_path_factory.mktemp("terminals")
    (folder / "pages.launch").write_text(LAUNCH, encoding="utf-8")
    env = os.environ | {
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
        "ROS_HOME": str(folder),
        "ROS_LOG_DIR": str(folder / "log"),
    }
    for variable in ("DISPLAY", "WAYLAND_DISPLAY", "PYTHONUNBUFFERED"):
        env.pop(variable, None)
    output = folder / "output"
    output.touch()

    def said(pattern):
        """Wait until one of the programs has written it."""
        found = []

        def there():
            found.extend(re.finditer(pattern, output.read_text(encoding="utf-8")))
            return bool(found)

        try:
            wait_until(there, pattern)
        except AssertionError as error:
            raise AssertionError(f"{error}; they wrote:\n{output.read_text(encoding='utf-8')}") from None
        return found[0].group()

    with ExitStack() as stack, output.open("ab") as file:

        def run(*words):
            stack.enter_context(start(words, env=env, stdout=file, stderr=file))

        run(sys.executable, "-c", LISTENER)
        said("listening")
        run(*ROSMINI, "rviz", "--no-browser")
        run(*ROSMINI, "roslaunch", folder / "pages.launch")
        run(sys.executable, "-c", PAGES)
        address = r"http://127\.0\.0\.1:\d+/[\w-]{20,}/"
        yield SimpleNamespace(said=said, url=lambda name: said(rf"(?m)^{name}: .*{address}").rpartition(" ")[2])


@pytest.fixture
def visit(terminals, tabs):
    """Open the page of a program."""
    with ExitStack() as stack:

        def opened(name):
            url = terminals.url(name)
            page, watcher = stack.enter_context(tabs.open({"width": 900, "height": 1200}))
            page.goto(url)

            def forget():
                watcher.end()
                watcher.seen[:] = [each for each in watcher.seen if not each.startswith(f"request: {url}")]

            stack.callback(forget)
            return page

        yield opened


def drag(page, thing):
    """Press the mouse in the middle of something, and release it 40 px to the right and 40 px above."""
    boxes = (thing.bounding_box() for _ in range(1000))  # none while the page replaces the picture
    box = next(box for box in boxes if box)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 40, y - 40, steps=3)
    page.mouse.up()


def set_goal(page):
    """Take the tool 2D Nav Goal, and drag an arrow in the picture."""
    picture = page.locator("[data-points] > svg")
    picture.wait_for()
    page.get_by_role("button", name="2D Nav Goal").click()
    page.locator("button[aria-pressed='true']", has_text="2D Nav Goal").wait_for()
    drag(page, picture)


def test_rosmini_rviz(visit, terminals):
    set_goal(visit("RViz"))
    terminals.said("goal in map")


def test_rviz_of_a_launch_file(visit, terminals):
    set_goal(visit("rviz_of_a_launch_file"))
    terminals.said("goal in map(?s:.)*goal in map")


def test_a_panel_of_rqt(visit, terminals):
    page = visit("MessagePublisher")
    page.locator("[data-key='topic']").fill("/text")
    page.keyboard.press("Enter")
    page.locator("[data-key='type']").fill("std_msgs/String")
    page.keyboard.press("Enter")
    page.locator("[data-key='add']").click()
    page.locator("[data-key='1/field/data']").fill("'hello'")
    page.keyboard.press("Enter")
    page.locator("[data-key='1/on']").click()
    terminals.said("text hello")


def test_a_pad(visit, terminals):
    page = visit("TeleopPad")
    page.locator(".rp-stage").focus()
    page.keyboard.press("w")
    terminals.said(r"pad 0\.01")


def test_turtlesim(visit, terminals):
    page = visit("turtlesim")
    page.locator(".rp-stage").focus()
    page.keyboard.press("ArrowUp")
    terminals.said(r"turtle 2\.0")
