"""The teleoperation pad in a real JupyterLab: real keys in Chromium drive a robot on a live graph in a real kernel."""

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


def mood(page, name):
    page.locator(f".rp-pill[data-mood='{name}']").wait_for()


def test_keys_buttons_and_a_busy_kernel(open_lab, jupyterlab):
    lab = open_lab(CELLS)
    page = lab.page
    lab.run(0)
    stage = page.locator(".rp-stage")
    stage.wait_for()
    assert "press a key to start" in page.locator(".rp-pill").inner_text()

    # Keys: the first one starts the graph. In command mode `a`, `x` and `d d` would change the notebook.
    stage.focus()
    for key in "wwwwwwwwwwaadd":
        page.keyboard.press(key)
    mood(page, "driving")
    page.locator(".rp-meter", has_text="0.10 m/s").wait_for()
    page.locator(".rp-meter", has_text="0.0 rad/s").wait_for()
    assert lab.cells.count() == len(CELLS)
    seconds, paints = page.locator(".rosmini-pad").evaluate(COUNT)
    print(f"{40 / seconds:.0f} frames/s of the pad, {paints / seconds:.0f} paints/s of the page")
    page.locator(".rp-log pre", has_text="x: 0.1\n").first.wait_for()
    lab.run(1)  # the focus leaves the pad, and the robot stops
    mood(page, "ready")
    lab.says(1, "live True heard 0.1")

    # A button stops it, too.
    stage.focus()
    page.keyboard.press("w")
    mood(page, "driving")
    page.locator("[data-key=s]").click()
    mood(page, "ready")
    lab.run(2)
    lab.says(2, "rest True 0.0")

    # A busy kernel: keys wait for nobody, and the page says so.
    lab.run(3)
    mood(page, "waiting")
    (jupyterlab[0] / "seen").touch()
    lab.says(3, "busy over")
    mood(page, "ready")

    # While a cell drives the graph, the pad works.
    lab.run(4)
    mood(page, "driving")
    stage.focus()
    page.keyboard.press("Space")
    lab.says(4, "stopped while a cell drives")

    # Whoever leaves the page stops the robot.
    stage.focus()
    page.keyboard.press("ArrowUp")
    mood(page, "driving")
    page.evaluate("window.dispatchEvent(new Event('blur'))")
    mood(page, "ready")

    # A page that falls silent: the kernel stops the robot.
    stage.focus()
    page.keyboard.press("w")
    mood(page, "driving")
    page.evaluate("document.querySelector('.rosmini-pad').kernel.tell = () => {}")
    mood(page, "ready")
    page.evaluate("delete document.querySelector('.rosmini-pad').kernel.tell")

    # The robot goes, the graph stays.
    lab.run(5)
    mood(page, "gone")
    assert "no longer in the world" in page.locator(".rp-pill").inner_text()
    lab.run(6)
    lab.says(6, "goes on True")


@pytest.mark.nightly
def test_a_pad_without_a_robot_and_a_kernel_that_restarts(open_lab):
    lab = open_lab(BLIND)
    page = lab.page
    lab.run(0)
    stage = page.locator(".rp-stage")
    stage.focus()
    page.keyboard.press("a")
    page.locator(".rp-log pre", has_text="z: 0.1").first.wait_for()
    lab.run(1)
    lab.says(1, "sent True")
    mood(page, "ready")

    page.locator("[data-command='notebook:restart-kernel'] , [title^='Restart the kernel']").first.click()
    page.locator(".jp-Dialog .jp-mod-accept").click()
    mood(page, "waiting")
    page.locator(".rp-pill", has_text="run the cell of this pad again").wait_for()
    lab.run(0)
    page.locator(".rp-pill", has_text="press a key").or_(page.locator(".rp-pill", has_text="live")).wait_for()
    lab.run(1)
    lab.says(1, "sent False")  # so the first cell has ended, and the pad is that of the new kernel
    stage.focus()
    page.keyboard.press("w")
    mood(page, "driving")
