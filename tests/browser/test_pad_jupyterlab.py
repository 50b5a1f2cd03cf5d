"""The teleoperation pad in a real JupyterLab: real keys in Chromium drive a robot on a live graph in a real kernel."""

import re

import pytest

pytestmark = pytest.mark.browser

CELLS = [
    """
from pathlib import Path
from rosmini import Graph, rosrun
from rosmini.msgs.geometry_msgs.msg import Twist
graph = Graph()
sim = rosrun("rosmini_sim", "simulator", "_noise:=0.0", graph=graph).instance()
heard = []
_ = graph.node("listener").subscriber("cmd_vel", Twist, lambda t: heard.append((t.linear.x, t.angular.z)))
pad = sim.pad()
pad
""",
    "print('live', graph.is_live, 'heard', max(v for v, _ in heard),)",
    "print('rest', pad.teleop.at_rest, pad.twist.linear.x)",
    "while not Path('seen').exists(): pass\nprint('busy over')",
    "pad.press('w'); graph.run(until=lambda: pad.teleop.at_rest); print('stopped while a cell drives')",
    "sim.remove(); print('removed')",
    "print('goes on', graph.is_live)",
]

BLIND = [
    """
from rosmini import Graph
from rosmini.viz.live.pad import TeleopPad
graph = Graph()
pad = TeleopPad(graph)
graph.live()
pad
""",
    "print('sent', pad.sent > 1)",
]

# Wait for 40 frames from the kernel; how many seconds they took, and how often the canvas was painted meanwhile.
COUNT = """async (section) => {
  const kernel = section.kernel, begin = kernel.frames, since = performance.now();
  let paints = 0;
  while (kernel.frames < begin + 40) {
    paints += 1;
    await new Promise(requestAnimationFrame);
  }
  return [(performance.now() - since) / 1000, paints];
}"""


class Lab:
    """JupyterLab in a page, with the notebook open and its kernel idle."""

    def __init__(self, page, address, cells):
        self.page = page
        page.goto(address)
        self.cells = page.locator(".jp-Notebook .jp-CodeCell")
        self.cells.nth(len(cells) - 1).wait_for()
        page.locator("#jp-main-statusbar", has_text="| Idle").wait_for()

    def run(self, number):
        cell = self.cells.nth(number)
        cell.locator(".jp-InputArea-editor").click()
        self.page.keyboard.press("Control+Enter")
        cell.locator(".jp-InputPrompt", has_text=re.compile(r"\[[*\d]+\]")).first.wait_for()

    def says(self, number, text):
        self.cells.nth(number).locator(".jp-OutputArea-output", has_text=text).first.wait_for()

    def mood(self, mood):
        self.page.locator(f".rp-pill[data-mood='{mood}']").wait_for()


@pytest.fixture
def open_lab(open_in_lab, chromium):
    page = chromium.new_page(viewport={"width": 1280, "height": 1500})
    yield lambda cells: Lab(page, open_in_lab(cells), cells)
    page.close()


def test_keys_buttons_and_a_busy_kernel(open_lab, jupyterlab, shared_tmp):
    lab = open_lab(CELLS)
    page = lab.page
    try:
        lab.run(0)
        stage = page.locator(".rp-stage")
        stage.wait_for()
        assert "press a key to start" in page.locator(".rp-pill").inner_text()
        page.screenshot(path=shared_tmp / "pad_begin.png")

        # Keys: the first one starts the graph. In command mode `a`, `x` and `d d` would change the notebook.
        stage.focus()
        for key in "wwwwwwwwwwaadd":
            page.keyboard.press(key)
        lab.mood("driving")
        page.locator(".rp-meter", has_text="0.10 m/s").wait_for()
        page.locator(".rp-meter", has_text="0.0 rad/s").wait_for()
        assert lab.cells.count() == len(CELLS)
        seconds, paints = page.locator(".rosmini-pad").evaluate(COUNT)
        print(f"{40 / seconds:.0f} frames/s of the pad, {paints / seconds:.0f} paints/s of the page")
        page.screenshot(path=shared_tmp / "pad_jupyterlab.png")
        page.locator(".rp-log pre", has_text="x: 0.1\n").first.wait_for()
        lab.run(1)  # the focus leaves the pad, and the robot stops
        lab.mood("ready")
        lab.says(1, "live True heard 0.1")

        # A button stops it, too.
        stage.focus()
        page.keyboard.press("w")
        lab.mood("driving")
        page.locator("[data-key=s]").click()
        lab.mood("ready")
        lab.run(2)
        lab.says(2, "rest True 0.0")

        # A busy kernel: keys wait for nobody, and the page says so.
        lab.run(3)
        lab.mood("waiting")
        page.screenshot(path=shared_tmp / "pad_waiting.png")
        (jupyterlab[0] / "seen").touch()
        lab.says(3, "busy over")
        lab.mood("ready")

        # While a cell drives the graph, the pad works.
        lab.run(4)
        lab.mood("driving")
        stage.focus()
        page.keyboard.press("Space")
        lab.says(4, "stopped while a cell drives")

        # Whoever leaves the page stops the robot.
        stage.focus()
        page.keyboard.press("ArrowUp")
        lab.mood("driving")
        page.evaluate("window.dispatchEvent(new Event('blur'))")
        lab.mood("ready")

        # A page that falls silent: the kernel stops the robot.
        stage.focus()
        page.keyboard.press("w")
        lab.mood("driving")
        page.evaluate("document.querySelector('.rosmini-pad').kernel.tell = () => {}")
        lab.mood("ready")
        page.evaluate("delete document.querySelector('.rosmini-pad').kernel.tell")

        # The robot goes, the graph stays.
        lab.run(5)
        lab.mood("gone")
        assert "no longer in the world" in page.locator(".rp-pill").inner_text()
        page.screenshot(path=shared_tmp / "pad_gone.png")
        lab.run(6)
        lab.says(6, "goes on True")
    finally:
        page.screenshot(path=shared_tmp / "pad_end.png")


@pytest.mark.nightly
def test_a_pad_without_a_robot_and_a_kernel_that_restarts(open_lab, shared_tmp):
    lab = open_lab(BLIND)
    page = lab.page
    try:
        lab.run(0)
        stage = page.locator(".rp-stage")
        stage.focus()
        page.keyboard.press("a")
        page.locator(".rp-log pre", has_text="z: 0.1").first.wait_for()
        lab.run(1)
        lab.says(1, "sent True")
        lab.mood("ready")

        page.locator("[data-command='notebook:restart-kernel'] , [title^='Restart the kernel']").first.click()
        page.locator(".jp-Dialog .jp-mod-accept").click()
        lab.mood("waiting")
        page.locator(".rp-pill", has_text="run the cell of this pad again").wait_for()
        lab.run(0)
        page.locator(".rp-pill", has_text="press a key").or_(page.locator(".rp-pill", has_text="live")).wait_for()
        lab.run(1)
        lab.says(1, "sent False")  # so the first cell has ended, and the pad is that of the new kernel
        stage.focus()
        page.keyboard.press("w")
        lab.mood("driving")
    finally:
        page.screenshot(path=shared_tmp / "pad_restarted.png")
