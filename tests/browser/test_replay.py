"""The replay player in a real browser, from file://: alone, and in a page deep in a book."""

import itertools
import math
import re
import shutil
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.models import model
from rosmini.sim.recorder import Recorder
from rosmini.sim.recording import Moved
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Cylinder, Obstacle
from rosmini.viz import style
from rosmini.viz.replay.encode import replay_data

from ..conftest import nightly
from ..recordings import part

pytestmark = pytest.mark.browser

STATIC = Path(style.__file__).parent / "static"
WIDTHS = {"desktop": (1000, 900), "phone": (390, 844), "small": (360, 640)}
SIDEWAYS = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
PICTURE = "document.querySelector('.rosmini-replay canvas').toDataURL()"
PAGE = """<!DOCTYPE html>
<html lang="en" data-theme="{theme}" data-content_root="../../"><head><meta charset="utf-8"><title>t</title>
<meta name="viewport" content="width=device-width, initial-scale=1">{head}
<style>
  body {{ margin: 12px auto; max-width: 760px; padding: 0 12px; box-sizing: border-box; background: {background} }}
</style></head>
<body>{body}</body></html>"""
# How many pixels of the canvas are near a colour.
COUNT = """([canvas, colour]) => {
  const copy = Object.assign(document.createElement("canvas"), {width: canvas.width, height: canvas.height});
  const context = copy.getContext("2d", {willReadFrequently: true});
  context.drawImage(canvas, 0, 0);
  const data = context.getImageData(0, 0, copy.width, copy.height).data;
  const near = (i) => colour.every((value, c) => Math.abs(data[i + c] - value) < 12);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) count += near(i);
  return count;
}"""


@pytest.fixture(scope="module")
def recording():
    """Ten seconds of driving through the room, as the simulator's messages tell."""
    graph = Graph()
    recorder = Recorder(graph, Simulator(graph.node("simulator")))
    twist = message_class("geometry_msgs/Twist")
    publisher = graph.node("driver").publisher("cmd_vel", twist)
    for linear, angular in [(0.2, 0.0), (0.15, 0.6), (0.2, -0.4), (0.0, -1.0), (0.18, 0.2)]:
        for _ in range(20):
            message = twist()
            message.linear.x, message.angular.z = linear, angular
            publisher.publish(message)
            graph.run(0.1)
    return recorder.recording()


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Writes a page with players: alone, or deep in a folder like that of the built book."""

    def write(*recordings, form="live", theme="light", before=""):
        monkeypatch.setenv("ROSMINI_DISPLAY", form)
        head = ""
        if form == "book":
            shutil.copytree(STATIC, tmp_path / "_static", dirs_exist_ok=True)
            head = '<link rel="stylesheet" href="../../_static/rosmini.css">'
        folder = tmp_path / "notebooks" / "deep"
        folder.mkdir(parents=True, exist_ok=True)
        body = before + "\n".join(recording.replay().html for recording in recordings)
        background = (style.DARK if theme == "dark" else style.LIGHT)["page"]
        path = folder / f"{form}.html"
        path.write_text(PAGE.format(theme=theme, head=head, body=body, background=background), encoding="utf-8")
        return path.as_uri()

    return write


@pytest.fixture
def opened(tabs):
    """Opens pages, and sees to it that they said and fetched nothing."""
    with ExitStack() as stack:

        def open_page(address, *, width="desktop", **options):
            wide, high = WIDTHS[width]
            page, _ = stack.enter_context(tabs.open({"width": wide, "height": high}, **options))
            page.goto(address)
            if options.get("java_script_enabled", True):
                page.locator(".rosmini-replay[data-state=paused]").first.wait_for()
            return page

        yield open_page


def time_of(page):
    return float(page.locator(".rosmini-replay").first.get_attribute("data-time"))


def painted(page):
    """Wait until what was asked for is on the canvas."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def scrub(page, time):
    page.locator(".rosmini-replay input[type=range]").first.evaluate(
        """(slider, time) => { slider.value = time;
        for (const name of ["input", "change"]) slider.dispatchEvent(new Event(name, {bubbles: true})); }""",
        time,
    )
    painted(page)


def reading(page, name):
    text = page.locator(f"[data-read={name}]").first.inner_text().replace("\N{MINUS SIGN}", "-")
    return [float(number) for number in re.findall(r"-?\d+\.\d+", text)]


def count(page, name, palette=style.LIGHT):
    colour = [int(palette[name][i : i + 2], 16) for i in (1, 3, 5)]
    canvas = page.locator(".rosmini-replay canvas").first.element_handle()
    return page.evaluate(COUNT, [canvas, colour])


FITS = [("book", "light", "desktop"), ("live", "dark", "small")]
ALL_FITS = itertools.product(("book", "live"), ("light", "dark"), WIDTHS)


@pytest.mark.parametrize(
    ("form", "theme", "width"), [*FITS, *nightly(*(case for case in ALL_FITS if case not in FITS))]
)
def test_it_fits_its_page_in_each_theme(write, opened, recording, shared_tmp, form, theme, width):
    page = opened(write(recording, form=form, theme=theme), width=width, reduced_motion="reduce")
    scrub(page, 6.0)
    assert page.evaluate(SIDEWAYS) <= 0
    assert not page.locator(".rosmini-still").is_visible()
    canvas = page.locator("canvas").bounding_box()
    assert canvas["width"] > 0.9 * min(736, WIDTHS[width][0] - 24)
    assert canvas["height"] > 0.6 * min(canvas["width"], 520)
    palette = style.DARK if theme == "dark" else style.LIGHT
    for name, least in (("page", 5000), ("muted", 2000), ("vermilion", 150), ("blue", 80), ("orange", 20)):
        assert count(page, name, palette) >= least, name
    for button in page.locator("button").all():
        assert button.bounding_box()["width"] >= 36
    folder = shared_tmp / "screenshots"
    folder.mkdir(exist_ok=True)
    page.screenshot(path=folder / f"replay-{form}-{theme}-{width}.png", full_page=True)


def test_the_canvas_is_crisp_on_dense_screens(write, opened, recording):
    page = opened(write(recording), device_scale_factor=2)
    wide, shown = page.evaluate("(c => [c.width, c.clientWidth])(document.querySelector('canvas'))")
    assert wide == 2 * shown


def test_what_python_wrote_is_what_the_page_reads(write, opened, recording):
    page = opened(write(recording))
    run = page.evaluate(
        """() => { const run = rosminiReplayData.decode(JSON.parse(
          document.querySelector('script[type="application/json"]').textContent));
          return {...run, scans: run.scans.map(([time, ranges]) => [time, ranges])}; }"""
    )
    assert (run["start"], run["end"]) == pytest.approx((0.0, recording.duration), abs=1e-3)
    even = np.linspace(0.0, recording.duration, len(run["truth"]))
    for name, poses in (("truth", recording.truth), ("odom", recording.odom_in_map())):
        expected = np.column_stack([np.interp(even, recording.times, column) for column in poses.T])
        assert np.array(run[name]) == pytest.approx(expected, abs=1e-3)
    assert [time for time, _ in run["scans"]] == pytest.approx(recording.scan_times, abs=1e-3)
    ranges = np.array([ranges for _, ranges in run["scans"]])
    assert ranges == pytest.approx(np.where(np.isfinite(recording.scans), recording.scans, 0.0), abs=1e-3)


def test_it_waits_to_be_told_then_plays_and_pauses(write, opened, recording):
    page = opened(write(recording))
    painted(page)
    assert time_of(page) == 0.0
    before = page.evaluate(PICTURE)
    # Slowly: on a busy machine it would be over before the click on Pause.
    page.get_by_role("combobox", name="Speed").select_option("0.25")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("document.querySelector('.rosmini-replay').dataset.time > 0.7")
    assert reading(page, "truth")[0] > 0.05
    assert page.evaluate(PICTURE) != before
    page.get_by_role("button", name="Pause").click()
    painted(page)
    stopped = time_of(page), page.evaluate(PICTURE)
    painted(page)
    assert (time_of(page), page.evaluate(PICTURE)) == stopped


@pytest.mark.parametrize(("form", "reduced"), [("book", False), ("book", True), ("live", False)])
def test_in_the_book_the_first_one_plays_once_when_it_comes_into_view(chromium, write, recording, form, reduced):
    motion = "reduce" if reduced else "no-preference"
    page = chromium.new_page(viewport={"width": 390, "height": 844}, reduced_motion=motion)
    short = part(recording, 0.0, 0.5)
    page.goto(write(short, short, form=form, before='<div style="height: 1500px"></div>'))
    page.wait_for_function("document.querySelectorAll('.rosmini-replay[data-state=paused]').length === 2")
    player, other = page.locator(".rosmini-replay").all()
    painted(page)
    assert player.get_attribute("data-time") == "0.000"
    player.locator("canvas").scroll_into_view_if_needed()
    if form == "book" and not reduced:
        page.wait_for_function("document.querySelector('.rosmini-replay').dataset.time === '0.500'")
        assert player.get_attribute("data-state") == "paused"
        assert player.locator("[role=status]").inner_text() == "", "a screen reader does not speak by itself"
    other.locator("canvas").scroll_into_view_if_needed()
    painted(page)
    player.locator("canvas").scroll_into_view_if_needed()
    painted(page)
    states = [each.get_attribute("data-state") for each in (player, other)]
    assert states == ["paused", "paused"]
    assert other.get_attribute("data-time") == "0.000"
    assert player.get_attribute("data-time") == ("0.500" if form == "book" and not reduced else "0.000")
    page.close()


def test_it_stops_at_the_end_and_begins_anew(write, opened, recording):
    page = opened(write(part(recording, 0.0, 1.0)))
    player = page.locator(".rosmini-replay")
    page.get_by_label("Speed").select_option("8")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("document.querySelector('.rosmini-replay').dataset.state === 'paused'")
    painted(page)
    assert time_of(page) == pytest.approx(1.0, abs=0.04)
    assert page.locator("[role=status]").inner_text().startswith("End: 1.0 s. Robot ")
    page.get_by_label("Speed").select_option("0.25")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("document.querySelector('.rosmini-replay').dataset.time < 0.5")
    assert player.get_attribute("data-state") == "playing"


def test_scrubbing_shows_that_moment(write, opened, recording):
    page = opened(write(recording))
    slider = page.get_by_role("slider", name="Time")
    for time in (3.21, 7.5, 9.9, 0.0):
        scrub(page, time)
        x, y, heading = recording.pose_at(time)
        wrapped = math.degrees(math.remainder(heading, math.tau))
        assert reading(page, "truth") == pytest.approx([x, y, wrapped], abs=0.06)
        odom = [float(np.interp(time, recording.times, column)) for column in recording.odom_in_map().T]
        assert reading(page, "odom")[:2] == pytest.approx(odom[:2], abs=0.006)
        assert reading(page, "error")[0] == pytest.approx(math.dist((x, y), odom[:2]), abs=0.002)
        given = recording.commands[recording.commands[:, 0] <= time]
        if len(given):
            assert reading(page, "command") == pytest.approx(given[-1, 1:], abs=0.006)
        assert slider.get_attribute("aria-valuetext") == f"{time:.1f} of {recording.duration:.1f} seconds"


def test_keys_work_inside_the_player_and_nowhere_else(write, opened, recording):
    page = opened(write(recording))
    player = page.locator(".rosmini-replay")
    for key in ("ArrowRight", "End", "+", " "):
        page.keyboard.press(key)
    painted(page)
    assert (time_of(page), player.get_attribute("data-speed")) == (0.0, "1")
    page.get_by_role("slider", name="Time").focus()
    for key, expected in [
        ("ArrowRight", 0.2),
        ("ArrowUp", 0.4),
        ("ArrowLeft", 0.2),
        ("ArrowLeft", 0.0),
        ("ArrowLeft", 0.0),
        ("End", recording.duration),
        ("ArrowRight", recording.duration),
        ("Home", 0.0),
    ]:
        page.keyboard.press(key)
        painted(page)
        assert time_of(page) == pytest.approx(expected, abs=1e-3), key
    for keys, speed in ("+", "2"), ("+", "4"), ("-", "2"), ("+" * 9, "8"), ("-" * 9, "0.25"):
        for key in keys:
            page.keyboard.press(key)
        assert player.get_attribute("data-speed") == speed == page.get_by_label("Speed").input_value()
    page.keyboard.press(" ")
    assert player.get_attribute("data-state") == "playing"
    page.keyboard.press(" ")
    assert player.get_attribute("data-state") == "paused"
    before = time_of(page)
    # On the slider itself the browser would move it, as it does any slider.
    player.get_by_role("button").first.focus()
    page.keyboard.press("Control+End")
    painted(page)
    assert time_of(page) == before < 9.0


def test_a_button_takes_its_own_space_key_and_tab_reaches_everything(write, opened, recording):
    page = opened(write(recording))
    names = []
    for _ in range(8):
        page.keyboard.press("Tab")
        names.append(
            page.evaluate(
                """() => { const e = document.activeElement;
                const outline = getComputedStyle(e).outlineStyle;
                return [e.ariaLabel ?? e.labels?.[0].textContent, outline]; }"""
            )
        )
    assert [name for name, _ in names] == [
        "Step back", "Play", "Step forward", "Time", "Speed", "True path", "Odometry", "Laser"
    ]  # fmt: skip
    assert {outline for _, outline in names} == {"solid"}
    page.get_by_role("button", name="Step forward").focus()
    page.keyboard.press(" ")
    painted(page)
    assert time_of(page) == pytest.approx(0.2, abs=1e-3)
    assert page.locator(".rosmini-replay").get_attribute("data-state") == "paused"
    page.get_by_role("checkbox", name="Laser").focus()
    page.keyboard.press(" ")
    assert not page.get_by_role("checkbox", name="Laser").is_checked()


@pytest.mark.parametrize("speed", [4, *nightly(0.5)])
def test_it_plays_as_fast_as_it_is_told(write, opened, recording, speed):
    page = opened(write(recording))
    page.get_by_label("Speed").select_option(str(speed))
    ratio = page.evaluate(
        """() => new Promise((done) => {
          const player = document.querySelector(".rosmini-replay");
          player.querySelector("[data-do=play]").click();
          let frames = 0, first, slow = 0, last;
          requestAnimationFrame(function look(now) {
            if (last !== undefined) slow += Math.max(0, now - last - 100);
            last = now;
            const at = [now, Number(player.dataset.time)];
            if (frames === 3) first = at;
            if (++frames < 40) requestAnimationFrame(look);
            else done(1000 * (at[1] - first[1]) / (at[0] - first[0] - slow));
          });
        })"""
    )
    assert ratio == pytest.approx(speed, rel=0.2)


def test_layers_can_be_taken_away(write, opened, recording):
    page = opened(write(recording))
    scrub(page, 9.0)
    for label, colour in (("Laser", "vermilion"), ("True path", "blue"), ("Odometry", "orange")):
        before = count(page, colour)
        page.get_by_role("checkbox", name=label).uncheck()
        painted(page)
        assert count(page, colour) < before - 20, label


def test_a_change_of_the_theme_and_of_the_width_is_followed(write, opened, recording):
    page = opened(write(recording, form="book"), reduced_motion="reduce")
    assert count(page, "page", style.DARK) < 100
    page.evaluate("document.documentElement.dataset.theme = 'dark'")
    page.wait_for_function(f"({COUNT})([document.querySelector('canvas'), [20, 24, 30]]) > 5000")
    page.set_viewport_size({"width": 420, "height": 800})
    page.wait_for_function("(c => c.width === c.clientWidth && c.width < 500)(document.querySelector('canvas'))")
    painted(page)
    assert count(page, "page", style.DARK) > 5000


def test_who_wants_less_motion_gets_a_picture_each_half_second(write, opened, recording):
    page = opened(write(recording), reduced_motion="reduce")
    pictures, seconds = page.evaluate(
        """() => new Promise((done) => {
          const player = document.querySelector(".rosmini-replay");
          const times = new Set();
          const begin = performance.now();
          new MutationObserver(() => times.add(player.dataset.time)).observe(player, {attributes: true});
          player.querySelector("[data-do=play]").click();
          (function look() {
            const passed = performance.now() - begin;
            if (passed > 1300) done([times.size, passed / 1000]);
            else requestAnimationFrame(look);
          })();
        })"""
    )
    # one more for the press, and one for a page that was held up; without the wish it would be 60 a second
    assert 2 <= pictures <= 2 * seconds + 2


def test_it_does_not_run_where_nobody_sees_it(write, opened, recording):
    page = opened(write(recording, before='<div style="height: 3000px"></div>'))
    page.locator(".rosmini-replay").scroll_into_view_if_needed()
    page.get_by_label("Speed").select_option("0.25")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("document.querySelector('.rosmini-replay').dataset.time > 0.05")
    page.evaluate("scrollTo(0, 0)")
    page.evaluate(
        """() => new Promise((done) => new IntersectionObserver(
          (entries) => entries.at(-1).isIntersecting || requestAnimationFrame(() => requestAnimationFrame(done))
        ).observe(document.querySelector(".rosmini-replay")))"""
    )
    left = time_of(page)
    painted(page)
    assert time_of(page) == left
    page.locator(".rosmini-replay").scroll_into_view_if_needed()
    page.wait_for_function(f"document.querySelector('.rosmini-replay').dataset.time > {left}")


@pytest.mark.parametrize("form", ["book", *nightly("live")])
def test_several_on_one_page_are_independent(write, opened, recording, form):
    page = opened(write(recording, recording, part(recording, 0.0, 4.0), form=form), reduced_motion="reduce")
    players = page.locator(".rosmini-replay")
    page.wait_for_function("document.querySelectorAll('.rosmini-replay[data-state]').length === 3")
    players.nth(1).get_by_role("button", name="Step forward").click()
    painted(page)
    assert [players.nth(i).get_attribute("data-time") for i in range(3)] == ["0.000", "0.200", "0.000"]
    assert players.nth(2).locator("output").inner_text() == "0.0 / 4.0 s"


def test_the_status_is_spoken_when_something_was_done_only(write, opened, recording):
    page = opened(write(recording))
    assert page.locator("[role=status]").inner_text() == ""
    said = page.evaluate(
        """() => new Promise((done) => {
          const player = document.querySelector(".rosmini-replay");
          const said = [];
          const status = player.querySelector("[role=status]");
          new MutationObserver(() => said.push(status.textContent)).observe(status, {childList: true});
          const play = player.querySelector("[data-do=play]");
          play.click();
          let frames = 0;
          requestAnimationFrame(function look() {
            if (++frames === 20) play.click();
            if (frames < 24) requestAnimationFrame(look);
            else done(said);
          });
        })"""
    )
    assert len(said) == 2
    assert said[0] == "Playing"
    assert re.fullmatch(
        r"Paused: \d\.\d s\. Robot .* m, .*°\. Error of odometry .*\. Command .* m/s, .* rad/s\.", said[1]
    )


def test_a_run_of_one_sample_and_one_without_scans(write, opened, recording):
    blind = replace(recording, scan_times=np.empty(0), scans=np.empty((0, 360)), commands=np.empty((0, 3)))
    page = opened(write(part(blind, 0.0, 0.0)))
    assert page.locator("output").inner_text() == "0.0 / 0.0 s"
    for control in page.locator(".rr-bar button, [type=range]").all():
        assert control.is_disabled()
    assert not page.get_by_role("checkbox", name="Laser").is_visible()
    assert page.locator("[data-read=command]").inner_text() == "none yet"
    assert count(page, "blue") > 80
    page = opened(write(blind))
    scrub(page, 5.0)
    assert reading(page, "truth")[0] == pytest.approx(recording.pose_at(5.0)[0], abs=0.006)


@pytest.mark.parametrize("form", ["book", *nightly("live")])
def test_in_print_and_without_scripts_the_still_picture_is_there(write, opened, recording, form):
    address = write(recording, form=form)
    page = opened(address, reduced_motion="reduce")
    page.emulate_media(media="print")
    assert page.locator(".rosmini-still svg").is_visible()
    assert not page.locator(".rosmini-replay").is_visible()
    page = opened(address, java_script_enabled=False)
    assert page.locator(".rosmini-still svg").is_visible()


@pytest.mark.nightly
def test_in_jupyterlab_its_keys_are_its_own(open_lab):
    cells = [
        """
from rosmini.core.graph import Graph
from rosmini.sim.recorder import Recorder
from rosmini.sim.simulator import Simulator
graph = Graph()
recorder = Recorder(graph, Simulator(graph.node("simulator")))
graph.run(5.0)
recorder.recording().replay()
""",
        "print('below')",
    ]
    lab = open_lab(cells)
    page, errors = lab.page, []
    page.on("pageerror", lambda error: errors.append(str(error)))
    lab.run(0)
    player = lab.cells.nth(0).locator(".rosmini-replay[data-state=paused]")
    player.wait_for()
    player.get_by_role("slider", name="Time").focus()
    for key in ("ArrowRight", "ArrowRight", "ArrowDown", "ArrowUp", "ArrowUp", "+"):
        page.keyboard.press(key)
    for key in ("b", "d", "d", "a"):  # JupyterLab's: they would add cells and delete this one
        page.keyboard.press(key)
    painted(page)
    assert player.get_attribute("data-time") == "0.600"
    assert player.get_attribute("data-speed") == "2"
    assert lab.cells.count() == 2
    page.keyboard.press(" ")
    page.wait_for_function("document.querySelector('.rosmini-replay').dataset.time > 1")
    assert errors == []


@pytest.mark.parametrize("width", ["phone", *nightly("desktop")])
def test_the_theme_of_the_book_does_not_disturb_its_layout(book_html, opened, recording, monkeypatch, tmp_path, width):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    chapter = (book_html / "notebooks" / "2_graph/10_nodes_and_master.html").read_text(encoding="utf-8")
    begin = chapter.index('<div class="output text_html">') + len('<div class="output text_html">')
    path = tmp_path / "notebooks" / "2_graph" / "chapter.html"
    path.parent.mkdir(parents=True)
    (tmp_path / "_static").symlink_to(book_html / "_static", target_is_directory=True)
    path.write_text(chapter[:begin] + recording.replay().html + chapter[begin:], encoding="utf-8")
    page = opened(path.as_uri(), width=width, color_scheme="dark", reduced_motion="reduce")
    assert page.evaluate(SIDEWAYS) <= 0
    boxes = {
        name: page.locator(f".rosmini-replay {selector}").first.bounding_box()
        for name, selector in [
            ("play", "[data-do=play]"),
            ("slider", "[type=range]"),
            ("truth", "label:has([data-layer=truth])"),
            ("odom", "label:has([data-layer=odom])"),
        ]
    }
    middle = {name: box["y"] + box["height"] / 2 for name, box in boxes.items()}
    assert middle["play"] == pytest.approx(middle["slider"], abs=3)
    assert middle["truth"] == pytest.approx(middle["odom"], abs=3)
    assert count(page, "page", style.DARK) > 5000


@pytest.mark.nightly
def test_other_robots_and_what_moves_are_drawn_where_they_are(recording, write, opened):
    truth = recording.truth
    walker = Obstacle("walker", Cylinder(0.12), (2.4, 1.6, 0.0), colour="#102040")
    end = float(recording.times[-1])
    moved = Moved(walker, np.array([0.0, end]), np.array([(2.4, 1.6, 0.0), (2.4, 0.4, 0.0)]))
    other = replace(recording, truth=truth + (0.0, 0.8, 0.0), name="tb3_1", model=model("waffle"))
    together = replace(recording, name="tb3_0", others=(other,), things=(moved,))
    for theme, palette, tint in (("light", style.LIGHT, "#102040"), ("dark", style.DARK, style.dark_of("#102040"))):
        page = opened(write(together, theme=theme), color_scheme=theme)
        canvas = page.locator(".rosmini-replay canvas")
        green = colour_count(page, canvas, palette["green"])
        edge = colour_count(page, canvas, tint)
        assert green > 150 and edge > 20
        before = page.evaluate(PICTURE)
        page.locator(".rosmini-replay [type=range]").press("End")
        page.wait_for_function(f"before => {PICTURE} !== before", arg=before)
        assert colour_count(page, canvas, palette["green"]) > green


def colour_count(page, canvas, colour):
    """How many pixels of a canvas are near a colour."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return page.evaluate(COUNT, [canvas.element_handle(), rgb])


# What the player draws as hits, in metres.
HITS = """() => {
  const draw = rosminiCanvas.scan;
  rosminiCanvas.scan = (view, ...seen) => {
    globalThis.hits = [];
    const arc = (x, y) => hits.push([x, y]);
    const context = new Proxy({}, {get: (_, name) => (name === "arc" ? arc : () => {}), set: () => true});
    draw({context, theme: view.theme, scale: view.scale, x: (x) => x, y: (y) => y}, ...seen);
    draw(view, ...seen);
  };
}"""


def test_what_a_sweeping_laser_hit_lies_on_the_walls(write, opened, turning, off_the_walls, shared_tmp):
    assert turning.time_increment != 0
    page = opened(write(turning))
    page.evaluate(HITS)
    for time in (1.5, 2.3, 3.1):
        scrub(page, time)
        hits = page.evaluate("hits")
        assert len(hits) > 300
        assert off_the_walls(hits).max() < 0.02
    page.screenshot(path=shared_tmp / "replay-turning.png")


def test_each_beam_is_drawn_from_where_the_recording_puts_it(write, opened, turning):
    page = opened(write(turning))
    beams = turning.scans.shape[1]
    for which in (2, 9, -1):
        poses = page.evaluate(
            "([data, time, beams]) => { const run = rosminiReplayData.decode(data);"
            "return Array.from({length: beams}, (_, i) => rosminiReplayData.beamPose(run, time, i)); }",
            [replay_data(turning), turning.scan_times[which], beams],
        )
        assert np.array(poses) == pytest.approx(turning.scan_poses(which), abs=0.005)


def test_a_drawing_of_logo_is_there_before_it_is_played(write, opened):
    from types import SimpleNamespace

    from rosmini.sim.logo import Logo

    logo = Logo()
    logo.run('setpencolor "yellow setpensize 20 repeat 4 [forward 100 right 90]')
    page = opened(write(SimpleNamespace(replay=logo.drawing.show)))
    painted(page)
    yellow = {"yellow": "#ffff00"}
    assert count(page, "yellow", yellow) > 500
    assert time_of(page) > 2
    scrub(page, 0)
    assert count(page, "yellow", yellow) == 0
