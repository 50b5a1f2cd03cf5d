"""The turtle of a static page: real keys drive it as the node's, and its messages are shown as they are sent."""

import math
import shutil
import time
from types import SimpleNamespace

import pytest

from rosmini import Graph, rosrun
from rosmini.msgs.turtlesim.msg import Pose
from rosmini.sim.turtlesim.frame import Frame
from rosmini.sim.turtlesim.turtle import START, STEP_S, single
from rosmini.viz.embed import STATIC
from rosmini.viz.live.loopback import PageServer
from rosmini.viz.live.page import pad_data

from ..processes import PATIENCE
from .test_pad import Pad, document

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with the pad as the book has it, and its data."""
    folder = tmp_path_factory.mktemp("turtle")
    (folder / "_static").mkdir()
    for script in STATIC.glob("*.js"):
        shutil.copy(script, folder / "_static")
    with pytest.MonkeyPatch.context() as patch, Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        graph.run(0.1)
        patch.setenv("ROSMINI_DISPLAY", "book")
        pad = sim.pad()
        html = pad.html
        (folder / "turtle.html").write_text(document(html, root="./"), encoding="utf-8")
        return folder / "turtle.html", pad_data(pad), html


@pytest.fixture
def pad(chromium, watch, made):
    context = chromium.new_context(viewport={"width": 900, "height": 1000})
    page = context.new_page()
    watcher = watch(page)
    yield Pad(page, made[0].as_uri())
    context.close()
    assert watcher.seen == []


PIXEL = "([x, y]) => [...document.querySelector('.rp-sight canvas').getContext('2d').getImageData(x, y, 1, 1).data]"

DRIVE = [
    ((2.0, 0.0, 0.0), 80), ((0.0, 0.0, 2.0), 40), ((2.0, 0.0, 2.0), 20), ((1.0, 1.5, -1.0), 90), ((0.0, 0.0, 0.0), 3),
    ((-6.0, 0.0, 0.4), 70), ((-6.0, 0.0, 0.4), 70), ((0.3, 0.0, 40.0), 70),
]  # fmt: skip
"""Ahead, to the left [m/s], turning [rad/s], and so many updates; walls are hit."""


def test_the_motion_is_that_of_the_node(pad, made):
    frame = Frame()
    turtle = frame.spawn(*START)
    ours, now = [], 0.0
    for command, updates in DRIVE:
        turtle.command(*command)
        for _ in range(updates):
            now += STEP_S
            frame.step(now)
            ours.append((turtle.x, turtle.y, turtle.theta, turtle.linear_velocity, turtle.angular_velocity))
    theirs, strokes = pad.page.evaluate(
        """([data, drive]) => {
          const turtle = new rosminiTurtle.Turtle(data), found = [];
          let now = 0;
          for (const [[linear, sideways, angular], updates] of drive) {
            turtle.command(linear, angular, sideways);
            for (let i = 0; i < updates; i += 1) {
              now += data.step;
              turtle.update(now);
              found.push([...turtle.pose, Math.hypot(...turtle.speed), turtle.turning]);
            }
          }
          return [found, turtle.window.strokes];
        }""",
        [made[1]["turtle"], DRIVE],
    )
    assert len(theirs) == len(ours)
    for mine, its in zip(ours, theirs, strict=True):
        assert its == pytest.approx(mine, abs=1e-9)
    assert any(x == 0.0 or y == 0.0 for x, y, *_ in ours)  # it was at a wall
    assert len(strokes) == frame.paper.count
    assert [row[4:] for row in strokes[:3]] == [row[4:] for row in frame.state()["strokes"][:3]]


def poses(pad):
    rows = pad.page.locator(".rp-poses").inner_text().splitlines()[:-1]
    return {name: float(value) for name, value in (row.split(": ") for row in rows)}


def test_keys_drive_the_turtle_and_both_messages_are_shown(pad, made):
    pad.stage.focus()
    first = Pose(x=single(START[0]), y=single(START[1]))
    assert pad.page.locator(".rp-poses pre").text_content() == f"{first}\n---"
    pad.page.keyboard.press("ArrowUp")
    pad.run(0.5)
    assert "x: 2.0" in pad.message
    assert pad.mood == "driving"
    assert poses(pad)["linear_velocity"] == 2.0
    pad.run(1.5)
    assert pad.mood == "ready"
    assert poses(pad)["x"] == pytest.approx(START[0] + 2.0, abs=0.05)
    pad.page.keyboard.press("ArrowLeft")
    pad.run(2.0)
    assert poses(pad)["theta"] == pytest.approx(2.0, abs=0.05)
    assert pad.page.locator(".rp-command em").inner_text() == "2 messages"  # a key is a message, and no more
    # What was drawn is in the picture: the pen's colour left of where the turtle turned.
    assert pad.page.evaluate(PIXEL, [round(2 * 45 * 6.4), round(2 * 45 * 5.544445)]) == [179, 184, 255, 255]
    pad.page.get_by_text("Reset").click()
    pad.run(0.2)
    assert poses(pad)["x"] == pytest.approx(START[0])
    assert math.isclose(poses(pad)["theta"], 0.0)


def test_a_wall_is_hit_and_told(pad):
    pad.page.get_by_label("Keys of").select_option("teleop_twist_keyboard")
    pad.run(0.1)
    pad.keys("qqqqqqqqqqqqqqi")
    pad.run(4.0)
    assert pad.mood == "blocked"
    assert pad.note.startswith("Oh no! I hit the wall! (Clamping from [x=11.1")
    pad.page.keyboard.press("Escape")
    pad.run(0.5)
    assert pad.mood == "ready"


def test_a_page_on_loopback_drives_the_node_s_turtle(chromium, watch):
    """The live form, which JupyterLab has, too: what the node draws is in the page's picture."""
    context = chromium.new_context(viewport={"width": 900, "height": 1000})
    page = context.new_page()
    watcher = watch(page)
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        graph.run(0.1)
        graph._live = SimpleNamespace(running=True, stop=lambda: None)  # this test drives it
        pad = sim.pad()

        def until(condition):
            deadline = time.monotonic() + PATIENCE
            while not condition():
                assert time.monotonic() < deadline, watcher.seen
                graph.run(0.05)
                page.wait_for_timeout(5)

        with PageServer(pad.link.widget, title="turtles") as server:
            page.goto(server.url)
            page.locator(".rp-stage").focus()
            page.keyboard.press("ArrowUp")
            turtle = sim.turtles["turtle1"]
            until(lambda: turtle.x > 7.4)
            until(lambda: "x: 2.0" in page.locator(".rp-log").first.inner_text())
            until(lambda: page.locator(".rp-poses").inner_text().startswith(f"x: {turtle.x:.3f}"))
            assert page.evaluate(PIXEL, [round(2 * 45 * 6.4), round(2 * 45 * 5.544445)]) == [179, 184, 255, 255]
            assert not page.get_by_label("Drive", exact=True).is_visible()
            sim.spawn(2.0, 2.0, 0.0)
            until(lambda: page.get_by_label("Drive", exact=True).is_visible())
            page.get_by_label("Drive", exact=True).select_option("turtle2")
            until(lambda: pad.chosen == "turtle2")
            until(lambda: page.locator(".rp-command", has_text="/turtle2/cmd_vel").count() == 1)
            until(lambda: page.locator(".rp-held").count() == 1)
            graph.run(0.1)  # the pad's new publisher and the turtle find one another: one key is one message
            page.keyboard.press("ArrowLeft")
            until(lambda: sim.turtles["turtle2"].theta > 1.9)
            context.close()
            assert [each for each in watcher.seen if not each.startswith(f"request: {server.url}")] == []


def test_what_a_page_says_comes_in_its_order(chromium):
    """A pad that is replaced says stop; a key after that moved the turtle no farther if its request came first."""
    page = chromium.new_context().new_page()
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        held, names = [], []
        with PageServer(sim.pad().link.widget, title="turtles") as server:
            page.goto(server.url)
            page.locator(".rp-stage").wait_for()
            page.route("**/say", lambda route: held.append(route))  # noqa: PLW0108 (Playwright asks how many it takes)
            page.evaluate("""() => {
                const { kernel } = document.querySelector('.rosmini-pad');
                for (const name of ['first', 'second']) kernel.tell({ type: 'keys', name });
            }""")
            deadline = time.monotonic() + PATIENCE
            while "first" not in names or "second" not in names:
                assert time.monotonic() < deadline, names
                page.wait_for_timeout(100)
                if held:
                    route = held.pop()  # the youngest of those that wait
                    names.append(route.request.post_data_json.get("name"))
                    route.continue_()
            assert [name for name in names if name] == ["first", "second"]
            page.context.close()


def test_the_book_form_is_small(made):
    assert len(made[2]) < 20_000
    assert "127.0.0.1" not in made[2]
