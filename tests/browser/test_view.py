"""The view of a simulation in a page: real pointer and key events, with the kernel's side in this process."""

import base64
import math
from pathlib import Path
from types import SimpleNamespace

import pytest

from rosmini import Graph, rosrun
from rosmini.sim.simulator import Simulator
from rosmini.viz.embed import STATIC
from rosmini.viz.live.view_link import SCRIPTS, ViewLink

from ..processes import wait_until

pytestmark = pytest.mark.browser

BRIDGE = """(data) => {
  const bytes = (text) => {
    const all = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new DataView(all.buffer);
  };
  globalThis.outbox = [];
  const model = {
    get: () => ({...data, scans: bytes(data.scans)}),
    on: (_, hear) => { model.hear = hear; },
    off: () => {},
    send: (content) => outbox.push(content),
  };
  globalThis.deliver = (messages) => {
    for (const [content, buffers] of messages) model.hear(content, buffers.map(bytes));
  };
  globalThis.leave = rosminiViewKernel.render({ model, el: document.getElementById("view") });
}"""


def text_of(data):
    return base64.b64encode(data).decode()


class Viewed:
    """A page with a view, and the simulation behind it. Nothing passes between them but in `pump`."""

    def __init__(self, page, view, *, live=True):
        self.page, self.view = page, view
        self.graph = view.watch.node.graph
        self.wall = 100.0
        self.graph.live = self.live
        if live:
            self.live()
        self.link = ViewLink(view, clock=lambda: self.wall)
        self.sent = []
        self.link.widget.send = lambda content, buffers=None: self.sent.append((content, buffers or []))
        page.clock.install(time=0)
        data = self.link.widget.data
        page.evaluate(BRIDGE, {**data, "scans": text_of(data["scans"])})
        self.pump()
        wait_until(self.is_fitted, "drawing as wide as the page leaves it")

    def is_fitted(self):
        """Whether the drawing has the width of its element: on a busy machine it learns that some frames later."""
        return bool(
            self.page.evaluate(
                "(canvas) => canvas.width === Math.round(canvas.clientWidth * devicePixelRatio)",
                self.page.query_selector(".rosmini-view canvas, #view canvas"),
            )
        )

    def live(self):
        self.graph._live = SimpleNamespace(running=True, stop=lambda: None)

    def pump(self, seconds=0.05):
        """Let the page's messages arrive, time go on, and the answers arrive."""
        for content in self.page.evaluate("outbox.splice(0)"):
            self.link.receive(self.link.widget, content, [])
        self.graph.run(seconds)
        self.wall += seconds
        messages = [[content, [text_of(b) for b in buffers]] for content, buffers in self.sent]
        self.sent.clear()
        self.page.evaluate("deliver", messages)
        self.page.clock.run_for(round(1000 * seconds))  # the page paints

    def thing(self, name):
        return self.page.locator(f".rv-thing[data-name='{name}']")

    def middle(self, name):
        box = self.thing(name).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    @property
    def scale(self):
        """Pixels a metre: from two things whose places are known."""
        (a, b), c = self.view.names[:2], self.view.pose
        (ax, ay), (bx, by) = self.middle(a), self.middle(b)
        return math.dist((ax, ay), (bx, by)) / math.dist(c(a)[:2], c(b)[:2])

    def drag(self, name, dx, dy):
        """Press, move and release the mouse: so many metres."""
        x, y = self.middle(name)
        scale = self.scale
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + dx * scale / 2, y - dy * scale / 2)
        self.page.mouse.move(x + dx * scale, y - dy * scale)
        self.page.mouse.up()

    @property
    def message(self):
        return self.page.locator(".rv-message").inner_text()

    @property
    def clock(self):
        return self.page.locator(".rv-clock").inner_text()


@pytest.fixture
def show(chromium, watch, tmp_path):
    """Open a page with a view; in the end it has to have said, raised and fetched nothing."""
    opened = []

    def open_page(view, *, theme="light", live=True, **options):
        scripts = "".join(f'<script src="{(STATIC / name).as_uri()}"></script>' for name in SCRIPTS)
        page_file = Path(tmp_path, f"{len(opened)}.html")
        page_file.write_text(
            f'<!DOCTYPE html><html lang="en" data-theme="{theme}"><meta charset="utf-8"><title>view</title>'
            f'<link rel="icon" href="data:,"><body style="margin:16px"><a href="#a" id="before">before</a>'
            f'<div id="view"></div>{scripts}',
            encoding="utf-8",
        )
        context = chromium.new_context(**({"viewport": {"width": 900, "height": 1000}} | options))
        page = context.new_page()
        opened.append((context, watch(page)))
        page.goto(page_file.as_uri())
        return Viewed(page, view, live=live)

    yield open_page
    for context, watcher in opened:
        context.close()
        assert watcher.seen == []


@pytest.fixture
def stage():
    with Graph() as graph:
        yield rosrun("stage_ros", "stageros", "package://stage_ros/world/boxes.world", graph=graph).instance()


@pytest.fixture
def simulator():
    with Graph() as graph:
        graph.master.setParam("/test", "/simulator/noise", 0.0)
        graph.master.setParam("/test", "/simulator/world", "arena")
        simulator = Simulator(graph.node("simulator"))
        simulator.spawn("second", pose=(1.0, -1.0, 0.0))
        yield simulator


def test_a_robot_is_dragged_with_the_mouse(show, stage, shared_tmp):
    viewed = show(stage.view())
    viewed.page.screenshot(path=shared_tmp / "view_light.png")
    x, y, heading = stage.truth()
    viewed.drag("robot_0", 1.0, 0.5)
    viewed.page.screenshot(path=shared_tmp / "view_dragged.png")
    assert stage.truth() == (x, y, heading)  # nothing has been told yet
    viewed.pump()
    assert stage.truth() == pytest.approx((x + 1.0, y + 0.5, heading), abs=0.02)
    assert viewed.message == viewed.view.message
    assert viewed.message.startswith("robot_0 is at (-0.")
    viewed.pump()
    assert f"x {stage.truth()[0]:.2f} m" in viewed.thing("robot_0").get_attribute("aria-label")


def test_an_occupied_place_is_refused_and_the_thing_snaps_back(show, stage, shared_tmp):
    viewed = show(stage.view())
    before, seen = stage.engine.pose("crate_1"), viewed.middle("crate_1")
    viewed.drag("crate_1", -2.0, 0.0)  # onto the robot
    viewed.page.clock.run_for(50)
    assert viewed.middle("crate_1")[0] < seen[0] - 100
    viewed.pump()
    viewed.pump()
    assert stage.engine.pose("crate_1") == before
    assert viewed.middle("crate_1") == pytest.approx(seen, abs=0.5)
    assert "the robot 'robot_0' is in its way" in viewed.message
    viewed.page.screenshot(path=shared_tmp / "view_refused.png")
    viewed.drag("crate_1", 0.0, 2.6)  # into the wall
    viewed.pump()
    assert "the obstacle 'room (2)' is in its way" in viewed.message
    assert stage.engine.pose("crate_1") == before


def test_shift_and_drag_the_handle_and_the_wheel_turn_it(show, simulator):
    viewed = show(simulator.view())
    page, mouse = viewed.page, viewed.page.mouse
    x, y = viewed.middle("second")
    page.keyboard.down("Shift")
    mouse.move(x + 10, y)
    mouse.down()
    mouse.move(x + 20, y - 20)
    mouse.move(x, y - 30)
    mouse.up()
    page.keyboard.up("Shift")
    viewed.pump()
    assert simulator.truth("second") == pytest.approx((1, -1, math.pi / 2), abs=0.02)
    viewed.pump()
    box = page.locator(".rv-handle").bounding_box()
    hx, hy = box["x"] + 11, box["y"] + 11
    assert (hx, hy) == pytest.approx((x, hy), abs=1)  # where it looks: up
    mouse.move(hx, hy)
    mouse.down()
    mouse.move(x - 30, y - 30)
    mouse.move(x - 60, y)
    mouse.up()
    viewed.pump()
    assert simulator.truth("second")[2] == pytest.approx(math.pi, abs=0.02)
    mouse.move(x, y)
    mouse.wheel(0, 100)
    viewed.page.wait_for_function("outbox.length > 0")
    viewed.pump()
    assert simulator.truth("second")[2] == pytest.approx(math.pi - math.pi / 12, abs=0.02)


def test_keys_reach_a_robot_and_move_it(show, simulator):
    viewed = show(simulator.view())
    page = viewed.page
    page.locator(".rv-thing").first.focus()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.dataset.name") == "second"
    for key in ("ArrowRight", "ArrowRight", "ArrowUp", "Alt+ArrowUp", "Shift+ArrowLeft"):
        page.keyboard.press(key)
    viewed.pump()
    assert simulator.truth("second") == pytest.approx((1.2, -0.89, math.pi / 12), abs=1e-6)
    assert page.locator(".rv-help").inner_text().startswith("Tab to a robot or a box")
    page.keyboard.press("Escape")
    assert page.evaluate("document.activeElement.dataset.name") is None


def test_escape_lets_go(show, simulator):
    viewed = show(simulator.view())
    x, y = viewed.middle("second")
    viewed.page.mouse.move(x, y)
    viewed.page.mouse.down()
    viewed.page.mouse.move(x + 90, y - 90)
    viewed.page.keyboard.press("Escape")
    viewed.page.mouse.up()
    viewed.pump()
    assert simulator.truth("second") == (1.0, -1.0, 0.0)
    assert viewed.middle("second") == pytest.approx((x, y), abs=0.5)


def test_a_finger_drags_too(show, simulator):
    viewed = show(simulator.view(), has_touch=True, viewport={"width": 390, "height": 844})
    (x, y), scale = viewed.middle("second"), viewed.scale
    session = viewed.page.context.new_cdp_session(viewed.page)
    for kind, points in (
        ("touchStart", [(x, y)]),
        ("touchMove", [(x - 20, y)]),
        ("touchMove", [(x - 50, y)]),
        ("touchEnd", []),
    ):
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": a, "y": b} for a, b in points]})
    viewed.pump()
    assert simulator.truth("second") == pytest.approx((1.0 - 50 / scale, -1.0, 0.0), abs=0.03)


def test_time_is_paused_stepped_and_goes_on(show, simulator):
    viewed = show(simulator.view())
    button = viewed.page.locator(".rv-bar button")
    assert button.all_inner_texts() == ["Pause", "Step 0.1 s", "Back to the start"]
    viewed.pump(0.5)
    button.nth(0).click()
    viewed.pump()
    viewed.pump()
    stood = simulator.host.now
    assert simulator.host.paused
    assert viewed.clock == f"{stood:.1f} s, paused"
    assert button.nth(0).inner_text() == "Run"
    button.nth(1).click()
    viewed.pump()
    assert simulator.host.now == pytest.approx(stood + 0.1)
    button.nth(0).click()
    viewed.pump(1.0)
    assert simulator.host.now == pytest.approx(stood + 1.1, abs=0.06)
    viewed.drag("second", -0.4, 0.0)
    viewed.pump()
    assert simulator.truth("second") != (1.0, -1.0, 0.0)
    button.nth(2).click()
    viewed.pump()
    assert simulator.truth("second") == (1.0, -1.0, 0.0)


def test_what_comes_and_goes_is_seen(show, simulator):
    viewed = show(simulator.view())
    names = "[...document.querySelectorAll('.rv-thing')].map((each) => each.dataset.name)"
    assert viewed.page.evaluate(names) == ["burger", "second"]
    simulator.spawn("third", pose=(-1.0, -1.0, 0.0))
    simulator.delete("second")
    viewed.pump(0.2)
    viewed.pump(0.2)
    assert viewed.page.evaluate(names) == ["burger", "third"]
    simulator.node.shutdown("over")
    viewed.page.clock.run_for(300)
    viewed.pump(0.2)
    viewed.pump(0.2)
    assert viewed.page.locator(".rv-pill").inner_text() == "ended"
    assert "the node /simulator was shut down" in viewed.message


def test_a_graph_that_stands_still_is_said_so_and_started_by_a_drag(show, simulator):
    viewed = show(simulator.view(), live=False)
    assert viewed.page.locator(".rv-pill").inner_text() == "the graph stands still"
    assert viewed.page.locator(".rv-bar button").first.inner_text() == "Start"
    viewed.drag("second", -0.4, 0.0)
    viewed.pump()
    assert simulator.truth("second")[0] == pytest.approx(0.6, abs=0.02)
    viewed.pump()
    assert viewed.page.locator(".rv-pill").inner_text() == "running"


def test_it_is_dark_on_dark_pages(show, stage, shared_tmp):
    viewed = show(stage.view(), theme="dark")
    viewed.page.screenshot(path=shared_tmp / "view_dark.png")
    assert (
        viewed.page.locator(".rosmini-view").evaluate("(e) => getComputedStyle(e).backgroundColor") == "rgb(20, 24, 30)"
    )
