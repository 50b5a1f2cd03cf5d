"""Layers, zoom and runs side by side in a real browser."""

import numpy as np
import pytest

from rosmini.sim.logo import Logo
from rosmini.viz.replay.grids import Grid, Grids
from rosmini.viz.replay.layers import Scans, Shape, Shapes, Stroke, Strokes
from rosmini.viz.replay.player import replay
from rosmini.viz.replay.run import Body, Run

pytestmark = pytest.mark.browser

PLAYER = ".rosmini-replay[data-state=paused]"
# The colour of a canvas at a place in metres, by the view that the player draws with.
LOOK = """([which, x, y]) => {
  const canvas = document.querySelectorAll(".rosmini-replay canvas")[which];
  const {view} = globalThis.seen.get(canvas);
  const at = [view.x(x), view.y(y)].map((place) => Math.round(place * view.ratio));
  return [...canvas.getContext("2d").getImageData(...at, 1, 1).data].slice(0, 3);
}"""
# Remember the last view of each canvas: what the scale bar, which is drawn last, is given.
SPY = """() => {
  globalThis.seen = new Map();
  const draw = rosminiCanvas.scaleBar;
  rosminiCanvas.scaleBar = (view, ...unit) => {
    draw(view, ...unit);
    seen.set(view.context.canvas, {view});
  };
}"""


def run(name):
    """Ten seconds: a map that grows, a stroke, a plan, a laser, and a robot that drives along x."""
    times = np.linspace(0.0, 10.0, 21)
    first = np.full((40, 60), 255, dtype=np.uint8)
    first[5:20, 5:20] = 0
    grown = first.copy()
    grown[5:35, 5:55] = 0
    grown[30, 5:55] = 100
    grids = tuple(Grid(cells, 0.1, (-1.0, -1.0, 0.0)) for cells in (first, grown))
    poses = np.column_stack([0.3 * times, np.zeros(21), np.zeros(21)])
    plan = Shape("line", np.array([(0.0, 0.5), (3.0, 0.5)]), "#00ff00")
    line = np.column_stack([0.3 * times, np.full(21, -0.5)])
    ranges = np.full((1, 8), 1.0)
    return Run(
        name,
        0.0,
        10.0,
        (Body("robot", times, poses),),
        (
            Grids("/map", np.array([0.0, 5.0]), grids),
            Scans("/scan", np.array([0.4]), np.zeros((1, 3)), ranges, 0.0, 0.8, 3.0),
            Shapes("/plan", np.array([2.0, 8.0]), ((plan,), ())),
            Strokes("/pen", (Stroke(times, line, "#ff00ff", 4.0, until=9.0),)),
        ),
        bounds=(-1.0, -1.0, 5.0, 3.0),
    )


@pytest.fixture(scope="module")
def page(chromium, tmp_path_factory):
    """One page with a player of one run, and below it one of two; much room around, so that it can be scrolled."""
    folder = tmp_path_factory.mktemp("layers")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSMINI_DISPLAY", "live")
        views = [replay(run("alone")), replay(run("a"), run("b"), names=("before", "after"))]
        body = "".join(view.html for view in views)
    (folder / "page.html").write_text(
        f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>t</title><body>{body}'
        '<div style="height:3000px"></div></body></html>',
        encoding="utf-8",
    )
    context = chromium.new_context(viewport={"width": 900, "height": 800})
    page = context.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto((folder / "page.html").as_uri())
    page.wait_for_function("document.querySelectorAll('.rosmini-replay[data-state=paused]').length === 2")
    page.evaluate(SPY)
    yield page
    context.close()
    assert errors == []


def painted(page):
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def scrub(page, time, which=0):
    page.locator(".rosmini-replay input[type=range]").nth(which).evaluate(
        """(slider, time) => { slider.value = time;
        for (const name of ["input", "change"]) slider.dispatchEvent(new Event(name, {bubbles: true})); }""",
        time,
    )
    painted(page)


def colour(page, x, y, canvas=0):
    page.locator(".rosmini-replay canvas").nth(canvas).scroll_into_view_if_needed()
    painted(page)
    return tuple(page.evaluate(LOOK, [canvas, x, y]))


def is_near(found, wanted):
    return all(abs(one - other) < 25 for one, other in zip(found, wanted, strict=True))


UNKNOWN = (155, 172, 170)  # grey green, 0.7 opaque, on a white page


def test_layers_show_their_moment_forwards_and_backwards(page):
    player = page.locator(".rosmini-replay").first
    names = player.locator("label").all_inner_texts()
    assert [name.strip() for name in names] == ["robot", "/map", "/scan", "/plan", "/pen"]
    for _ in range(2):  # a map that is a difference to the one before has to be right after going back, too
        scrub(page, 1.0)
        assert is_near(colour(page, 3.55, 1.55), UNKNOWN), "not seen yet"
        assert not is_near(colour(page, 1.5, 0.5), (0, 255, 0)), "the plan comes later"
        scrub(page, 6.0)
        assert is_near(colour(page, 3.55, 1.55), (255, 255, 255)), "the map has grown"
        assert is_near(colour(page, 3.55, 2.05), (77, 77, 77)), "a wall, 0.7 opaque"
        assert is_near(colour(page, 1.5, 0.5), (0, 255, 0))
        assert is_near(colour(page, 1.2, -0.5), (255, 0, 255)), "the stroke has come so far"
        assert not is_near(colour(page, 2.5, -0.5), (255, 0, 255)), "and no further"
    scrub(page, 9.5)
    assert not is_near(colour(page, 1.5, 0.5), (0, 255, 0)), "the plan is empty again"
    assert not is_near(colour(page, 1.2, -0.5), (255, 0, 255)), "the stroke is wiped"


def test_the_laser_is_there_at_the_start_and_a_layer_can_be_switched_off(page):
    scrub(page, 0.0)
    lit = colour(page, 0.9, 0.05)
    page.locator(".rosmini-replay").first.get_by_role("checkbox", name="/scan").uncheck()
    assert colour(page, 0.9, 0.05) != lit
    page.locator(".rosmini-replay").first.get_by_role("checkbox", name="/scan").check()
    assert colour(page, 0.9, 0.05) == lit


def test_the_wheel_scrolls_the_page_and_zooms_with_control_only(page):
    player = page.locator(".rosmini-replay").first
    page.evaluate("scrollTo(0, 0)")
    box = player.locator("canvas").bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.wheel(0, 200)
    page.wait_for_function("scrollY > 0")
    assert player.get_attribute("data-zoom") == "1.00"
    page.evaluate("scrollTo(0, 0)")
    page.keyboard.down("Control")
    page.mouse.wheel(0, -200)
    page.keyboard.up("Control")
    page.wait_for_function("Number(document.querySelector('.rosmini-replay').dataset.zoom) > 1.5")
    player.get_by_role("button", name="Reset the view").click()
    assert player.get_attribute("data-zoom") == "1.00"


def test_the_view_follows_is_moved_and_comes_back_by_keys(page):
    player = page.locator(".rosmini-replay").first
    scrub(page, 0.0)
    everything = colour(page, 3.0, 0.0), page.evaluate("seen.get(document.querySelector('canvas')).view.x(0)")
    player.get_by_role("slider", name="Time").focus()
    for key in ("f", "PageUp", "PageUp"):
        page.keyboard.press(key)
    assert (player.get_attribute("data-follow"), player.get_attribute("data-zoom")) == ("true", "2.25")
    assert player.get_by_role("button", name="Follow robot").get_attribute("aria-pressed") == "true"
    page.keyboard.press("End")
    painted(page)
    middle = page.evaluate("(({view}) => [view.x(3.0), view.width / 2])(seen.get(document.querySelector('canvas')))")
    assert middle[0] == pytest.approx(middle[1], abs=2), "the robot is in the middle"
    page.keyboard.press("Shift+ArrowLeft")
    assert player.get_attribute("data-follow") == "false"
    page.keyboard.press("0")
    page.keyboard.press("Home")
    painted(page)
    assert "The view shows everything" not in player.locator("[role=status]").inner_text(), "the last deed is said"
    back = colour(page, 3.0, 0.0), page.evaluate("seen.get(document.querySelector('canvas')).view.x(0)")
    assert back == everything


def test_two_runs_have_one_clock(page):
    both = page.locator(".rosmini-replay").nth(1)
    assert both.locator(".rr-title").all_inner_texts() == ["before", "after"]
    scrub(page, 6.0, which=1)
    for canvas in (1, 2):
        assert is_near(colour(page, 3.55, 1.55, canvas), (255, 255, 255))
    left, right = (both.locator("canvas").nth(i).bounding_box() for i in (0, 1))
    assert left["y"] == pytest.approx(right["y"], abs=1)
    assert left["x"] + left["width"] <= right["x"] + 1
    readings = both.locator("dd").all_inner_texts()
    assert readings == ["1.80, 0.00 m, 0.0°"] * 2
    both.get_by_role("slider", name="Time").press("ArrowRight")
    assert both.locator("[role=status]").inner_text().startswith("6.2 s. before: robot 1.86, 0.00 m")


def costs():
    """Five seconds: a map with a wall, and a costmap that later has something beside it that a laser has seen."""
    walls = np.zeros((40, 60), dtype=np.uint8)
    walls[5] = 100
    first = walls.copy()
    first[6:8] = 99
    first[8] = 40
    later = first.copy()
    later[25, 30], later[25, 32] = 100, 32
    grids = (Grid(first, 0.1, (-1.0, -1.0, 0.0)), Grid(later, 0.1, (-1.0, -1.0, 0.0)))
    return Run(
        "costs",
        0.0,
        5.0,
        (Body("robot", np.array([0.0, 5.0]), np.zeros((2, 3))),),
        (
            Grids("/map", np.array([0.0]), (Grid(walls, 0.1, (-1.0, -1.0, 0.0)),)),
            Grids("/local_costmap/costmap", np.array([0.0, 2.0]), grids),
        ),
        bounds=(-1.0, -1.0, 5.0, 3.0),
    )


def test_a_player_of_turtles_has_their_units_and_no_question_about_costs(chromium, tmp_path):
    logo = Logo()
    logo.run("forward 60 right 90 forward 30")
    window = Body("turtle1", np.array([0.0, 1.0]), np.array([(5.5, 5.5, 0.0), (7.25, 4.0, 1.5)]), trail=False)
    views = [
        logo.drawing.show(),
        replay(Run("/turtlesim", 0.0, 1.0, (window,), bounds=(0, 0, 11, 11), background="#4556ff")),
        replay(costs()),
        replay(Run("strokes", 0.0, 1.0, layers=(Strokes("/pen", (Stroke(np.arange(2.0), np.eye(2)),)),))),
    ]
    body = "".join(view.page for view in views)
    (tmp_path / "page.html").write_text(f"<!DOCTYPE html><meta charset=utf-8>{body}", encoding="utf-8")
    page = chromium.new_page(viewport={"width": 900, "height": 800})
    page.goto((tmp_path / "page.html").as_uri())
    page.wait_for_function("document.querySelectorAll('.rosmini-replay[data-state=paused]').length === 4")
    for which in range(4):
        scrub(page, 60.0, which)  # the end
    players = page.locator(".rosmini-replay").all()
    assert [player.locator("dd").first.inner_text() for player in players[:3]] == [
        "[30 60], heading 90", "x 7.25, y 4.00, theta 1.50", "0.00, 0.00 m, 0.0°"
    ]  # fmt: skip
    assert ["costs" in player.locator(".rr-keys").inner_text() for player in players] == [False, False, True, False]
    assert [player.get_by_role("button", name="Follow").count() for player in players] == [1, 1, 1, 0]
    page.close()


def test_a_place_says_what_it_costs_and_why(chromium, tmp_path):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSMINI_DISPLAY", "live")
        html = replay(costs()).html
    (tmp_path / "page.html").write_text(f"<!DOCTYPE html><meta charset=utf-8>{html}", encoding="utf-8")
    page = chromium.new_page(viewport={"width": 900, "height": 800})
    page.goto((tmp_path / "page.html").as_uri())
    page.wait_for_selector(PLAYER)
    page.evaluate(SPY)
    said = page.locator(".rosmini-replay [data-read=why]")
    assert not said.is_visible()
    scrub(page, 1.0)

    def ask(x, y):
        at = page.evaluate(
            """([x, y]) => {
            const {view} = seen.get(document.querySelector(".rosmini-replay canvas"));
            return [view.x(x), view.y(y)]; }""",
            [x, y],
        )
        page.locator("canvas").click(position={"x": at[0], "y": at[1]}, modifiers=["Shift"])
        painted(page)
        return said.inner_text()

    assert ask(0.05, -0.15) == (
        "/map: free; /local_costmap/costmap: about 40, inflated, 0.30 m from an obstacle, on the map"
    )
    assert "99, too near: inflated, 0.10 m from an obstacle, on the map" in ask(0.05, -0.35)
    assert ask(0.05, -0.45).startswith("/map: occupied; /local_costmap/costmap: 100, an obstacle")
    assert ask(2.25, 1.55) == "/map: free; /local_costmap/costmap: free"
    scrub(page, 3.0)
    assert said.inner_text().endswith("inflated, 0.20 m from an obstacle, seen by a sensor")
    page.locator(".rosmini-replay input[type=range]").focus()
    page.keyboard.press("w")
    painted(page)
    assert not said.is_visible()
    page.keyboard.press("w")
    painted(page)
    assert said.inner_text().startswith("/map: free")
    assert page.locator(PLAYER).count() == 1, "it was asked, and did not begin to play"
    page.close()
