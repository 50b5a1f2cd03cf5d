"""The pad in a page without a kernel: real keys, buttons and touches drive its robot as the engine would."""

import itertools
import json
import re
import shutil
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from rosmini import Graph, rosrun
from rosmini.core.geometry.angles import normalize_angle
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World
from rosmini.viz.embed import STATIC
from rosmini.viz.live.key_maps import NAMES, key_map
from rosmini.viz.live.pad import TeleopPad
from rosmini.viz.live.page import SCRIPTS, pad_data
from rosmini.viz.live.teleop import PERIOD, Limits, Teleop, table

from ..conftest import nightly

pytestmark = pytest.mark.browser

HALL = World(
    "hall",
    walls=np.array([(-2, -1.5, 3, -1.5), (3, -1.5, 3, 1.5), (3, 1.5, -2, 1.5), (-2, 1.5, -2, -1.5)], dtype=float),
    obstacles=(
        Obstacle("crate", Box(0.4, 0.3), (1.2, -0.9, 0.0), colour="orange"),
        Obstacle("pillar", Cylinder(0.15), (1.5, 0.9, 0.0), colour="green"),
        Obstacle("sill", Box(0.3, 0.3), (-1.2, 0.9, 0.0), height=0.1, colour="purple"),  # the laser looks over it
        Obstacle("wedge", Polygon(((0.0, 0.0), (0.6, 0.0), (0.0, 0.5))), (-1.8, -1.4, 0.0), colour="blue"),
    ),
    title="a hall with four obstacles",
)  # fmt: skip
"""All its corners are whole millimetres, as the page knows them."""


def simulated(pose=(0.0, 0.0, 0.0), world=HALL):
    graph = Graph()
    for key, value in zip(("noise", "x", "y", "yaw"), (0.0, *pose), strict=True):
        graph.master.setParam("/test", f"/simulator/{key}", value)
    return graph, Simulator(graph.node("simulator"), world=world)


def document(html, *, theme="light", root=None):
    """A page with the pad between a link before it and one after it, and something to scroll to."""
    content_root = "" if root is None else f' data-content_root="{root}"'
    return (
        f'<!DOCTYPE html><html lang="en" data-theme="{theme}"{content_root}><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width"><title>pad</title><link rel="icon" href="data:,"></head>'
        '<body style="margin:16px"><a href="#before" id="before">before</a>'
        f'{html}<a href="#after" id="after">after</a><div style="height:2000px"></div></body></html>'
    )


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A folder with the pad as the book has it, in both themes, as it stands alone, and one without a robot."""
    folder = tmp_path_factory.mktemp("pad")
    (folder / "_static").mkdir()
    for script in STATIC.glob("*.js"):
        shutil.copy(script, folder / "_static")
    with pytest.MonkeyPatch.context() as patch:
        _, simulator = simulated()
        pad = simulator.pad()
        (folder / "alone.html").write_text(document(pad.html), encoding="utf-8")
        patch.setenv("ROSMINI_DISPLAY", "book")
        (folder / "light.html").write_text(document(pad.html, root="./"), encoding="utf-8")
        (folder / "dark.html").write_text(document(pad.html, root="./", theme="dark"), encoding="utf-8")
        blind = TeleopPad(Graph()).html
        (folder / "blind.html").write_text(document(blind, root="./"), encoding="utf-8")
    return folder


class Pad:
    """A page with a pad, on a clock that the test sets."""

    def __init__(self, page, address):
        self.page = page
        page.clock.install(time=0)
        page.goto(address)
        self.stage = page.locator(".rp-stage")
        self.stage.wait_for()
        page.clock.pause_at(60_000)

    def run(self, seconds):
        self.page.clock.run_for(round(seconds * 1000))

    def keys(self, keys):
        for key in keys:
            self.page.keyboard.press(key)

    @property
    def mood(self):
        return self.page.locator(".rp-pill").get_attribute("data-mood")

    @property
    def note(self):
        return self.page.locator(".rp-pill").inner_text()

    @property
    def message(self):
        """The last one: as in a terminal, the newest is at the bottom."""
        return self.page.locator(".rp-log").first.locator("pre, p").last.text_content()

    @property
    def pose(self):
        text = self.page.locator(".rp-readings .rp-value").first.inner_text()
        x, y, theta = (part.strip(" xym°") for part in text.split(","))
        return float(x), float(y), float(theta)

    def focused(self):
        return self.page.evaluate(
            "(({id, dataset, className, tagName}) => id || dataset.key || className || tagName)(document.activeElement)"
        )


@pytest.fixture
def show(chromium, watch, site):
    """Open a page of the site; in the end it has to have said, raised and fetched nothing."""
    pages = []

    def open_page(name, **options):
        options = {"viewport": {"width": 900, "height": 1000}} | options
        context = chromium.new_context(**options)
        page = context.new_page()
        watcher = watch(page)
        pages.append((context, watcher))
        return Pad(page, (site / f"{name}.html").as_uri())

    yield open_page
    for context, watcher in pages:
        context.close()
        assert watcher.seen == []


@pytest.fixture(scope="module")
def bare(chromium, site):
    """A page with the scripts and nothing else."""
    scripts = "".join(f'<script src="_static/{name}"></script>' for name in SCRIPTS)
    (site / "bare.html").write_text(f"<!DOCTYPE html><title>bare</title>{scripts}", encoding="utf-8")
    page = chromium.new_page()
    page.goto((site / "bare.html").as_uri())
    yield page
    page.close()


# -- the same as in Python --


def test_the_same_keys_give_the_same_messages_as_in_python(bare):
    rng = np.random.default_rng(3)
    for name, limits in itertools.product(NAMES, (Limits(), Limits(0.26, 1.82))):
        known = [*key_map(name).keys, None]
        keys = [known[k] for k in rng.integers(0, len(known), 3000)]
        if name == "turtlebot3_teleop_key":
            keys += ["w"] * 60 + ["d"] * 60 + [None] * 120 + ["x"] * 99 + ["ArrowLeft"] * 99 + [None] * 120
        teleop = Teleop(limits, key_map(name))
        ours = [(*(teleop.cycle() if key is None else teleop.press(key)), *teleop.aside, *teleop.speed) for key in keys]
        theirs = bare.evaluate(
            """([table, keys]) => {
              const teleop = new rosminiTeleop.Teleop(table);
              return keys.map((key) => [
                ...(key === null ? teleop.cycle() : teleop.press(key)), ...teleop.aside, ...teleop.speed]);
            }""",
            [table(limits, key_map(name)), keys],
        )
        assert [tuple(row) for row in theirs] == ours  # to the last bit


@pytest.mark.parametrize("velocity", [(0.0, 0.0), (0.005, -0.1), (-0.22, 2.84), (0.1, 1.0), (0.015, 0.05)])
def test_a_message_is_shown_as_rostopic_echo_prints_it(bare, velocity):
    twist = Twist()
    twist.linear.x, twist.angular.z = velocity
    twist.linear.y = velocity[0]
    shown = bare.evaluate("([linear, angular]) => rosminiTeleop.yaml({linear, angular, aside: [linear, 0]})", velocity)
    assert shown == f"{twist}\n---"


RUNS = {
    "straight": [("w", 12, 3.0), ("s", 1, 1.0)],
    "back": [("x", 9, 2.0), (" ", 1, 0.5)],
    "turn": [("a", 15, 3.0), ("d", 30, 2.0), ("s", 1, 1.0)],
    "curve": [("w", 15, 1.0), ("a", 6, 4.0), ("d", 12, 3.0), ("x", 5, 2.0), ("s", 1, 1.0)],
    "as fast as it can": [("w", 30, 2.0), ("a", 40, 3.0), ("s", 1, 1.0)],
    "against the wall": [("w", 30, 18.0)],
    "off the wall": [("w", 30, 16.0), ("s", 1, 0.5), ("x", 10, 2.0)],
}
"""Keys, how often, and the seconds after that."""


@pytest.mark.parametrize("name", RUNS)
def test_motion_and_laser_are_the_engines(bare, name):
    graph, simulator = simulated()
    pad = TeleopPad(simulator)
    data = pad_data(pad)
    # Looked at between the cycles; each key comes shortly before one.
    steps = [
        [key, times, [PERIOD / 2, *[PERIOD] * (round(seconds / PERIOD) - 1), PERIOD / 2 - 0.01]]
        for key, times, seconds in RUNS[name]
    ]
    ours, start, robot = [], graph.now(), simulator.engine.robot(simulator.name)
    for key, times, waits in steps:
        pad.press(key, times)
        for wait in waits:
            graph.run(wait)
            simulator.engine.advance((graph.now() - start).to_sec())
            ours.append((*robot.pose, pad.sent))
    theirs = bare.evaluate(
        """([data, steps]) => {
          const pad = new rosminiTeleop.Run(data), found = [];
          for (const [key, times, waits] of steps) {
            for (let i = 0; i < times; i += 1) pad.press(key);
            for (const wait of waits) {
              pad.advance(wait);
              found.push([...pad.robot.pose, pad.sent]);
            }
          }
          return found;
        }""",
        [data, steps],
    )
    a, b = np.array(ours), np.array(theirs)
    worst = np.hypot(*(a - b)[:, :2].T).max()
    turned = max(abs(normalize_angle(float(d))) for d in (a - b)[:, 2])
    print(f"{name}: {1000 * worst:.4f} mm, {1000 * turned:.4f} mrad")
    assert worst < 1e-3
    assert turned < 1e-3
    assert (a[:, 3] == b[:, 3]).all()  # as many messages

    measured = simulator.engine.scan(simulator.name, None)
    cast = bare.evaluate(
        "([scene, pose]) => "
        "[...rosminiTeleop.laser(scene, pose)].map((r) => Number.isFinite(r) ? r : r > 0 ? 1e9 : -1e9)",
        [data["scene"], list(robot.pose)],
    )
    cast = np.where(np.abs(cast) == 1e9, np.copysign(np.inf, cast), cast)
    hit = np.isfinite(measured)
    assert (cast[~hit] == measured[~hit]).all()
    print(f"{name}: ranges differ by {np.abs(cast[hit] - measured[hit]).max():.2e} m")
    assert np.abs(cast[hit] - measured[hit]).max() < 1e-3


def test_the_laser_looks_over_walls_that_are_low(bare):
    _, simulator = simulated(world=replace(HALL, wall_height=0.1))
    data = pad_data(TeleopPad(simulator))
    hits = bare.evaluate(
        "({scene, pose}) => [...rosminiTeleop.laser(scene, pose)].filter((range) => range < Infinity).length", data
    )
    assert hits == np.isfinite(simulator.engine.scan(simulator.name, None)).sum()
    assert 0 < hits < 100


def test_a_laser_that_does_not_look_all_around_is_the_engines(bare):
    with Graph() as graph:
        stage = rosrun("stage_ros", "stageros", "package://stage_ros/world/boxes.world", graph=graph).instance()
        measured = stage.engine.scan("robot_0", None)
        data = pad_data(stage.pad())
    cast = bare.evaluate(
        "([scene, pose]) => [...rosminiTeleop.laser(scene, pose)].map((r) => Number.isFinite(r) ? r : 1e9)",
        [data["scene"], data["pose"]],
    )
    measured = np.where(np.isfinite(measured), measured, 1e9)
    assert len(cast) == len(measured) == 1081
    assert np.mean(np.abs(np.array(cast) - measured) < 5e-3) > 0.98  # some beams just pass a corner


def test_a_robot_that_leans_against_a_wall_gets_away(bare):
    graph, simulator = simulated()
    pad = TeleopPad(simulator)
    pad.press("w", 30)
    graph.run(20.0)
    assert simulator.engine.robot(simulator.name).touching
    x = bare.evaluate(
        """(data) => {
          const run = new rosminiTeleop.Run(data);
          for (let i = 0; i < 10; i += 1) run.press("x");
          run.advance(5);
          return run.robot.pose[0];
        }""",
        pad_data(pad),
    )
    assert x == pytest.approx(simulator.truth()[0] - 0.4, abs=0.1)


@pytest.mark.nightly
def test_discs_and_corners_stop_a_robot(bare):
    """A robot drives in each direction, at obstacles low and high, at corners and at walls: it never gets through."""
    _, simulator = simulated()
    data = pad_data(TeleopPad(simulator))
    ends = bare.evaluate(
        """(data) => {
          const ends = [];
          for (let i = 0; i < 24; i += 1) {
            const heading = (Math.PI * i) / 12;
            const run = new rosminiTeleop.Run({...data, pose: [0.5, 0, heading]});
            for (let k = 0; k < 30; k += 1) run.press("w");
            run.advance(20);
            ends.push([...run.robot.pose, run.robot.blocked, rosminiTeleop.touches(data.scene, run.robot.pose)]);
          }
          return ends;
        }""",
        data,
    )
    assert any(x < -0.7 and y > 0.5 for x, y, *_ in ends)  # one is stopped by what its laser does not see
    for x, y, _, blocked, touches in ends:
        assert blocked
        assert not touches
        assert -2 < x < 3
        assert -1.5 < y < 1.5


# -- in the page --


@pytest.mark.parametrize("name", ["light", *nightly("alone")])
def test_real_keys_drive_and_each_message_is_shown(show, name):
    pad = show(name)
    assert pad.message == "Nothing has been published yet."
    pad.stage.focus()
    pad.keys("wwwwa")
    pad.run(0.05)
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.025, 0.05
    assert pad.message == f"{twist}\n---"
    twist.linear.x, twist.angular.z = 0.02, 0.0
    assert pad.page.locator(".rp-log pre").all_text_contents()[-2] == f"{twist}\n---"  # the one before is above it
    assert "5 messages" in pad.page.locator(".rp-command").inner_text()
    pad.run(2.0)
    twist.linear.x, twist.angular.z = 0.04, 0.1
    assert pad.message == f"{twist}\n---"
    assert pad.mood == "driving"
    x, _, heading = pad.pose
    assert x == pytest.approx(0.08, abs=0.02)
    assert heading > 8
    pad.keys("s")
    pad.run(0.5)
    assert pad.message == f"{Twist()}\n---"
    assert pad.mood == "ready"
    assert "beams hit" in pad.page.locator(".rp-readings").inner_text()


@pytest.mark.nightly
def test_a_wall_stops_the_robot(show):
    pad = show("light")
    pad.stage.focus()
    pad.keys("w" * 30)
    pad.run(16.0)
    assert (pad.mood, pad.note) == ("blocked", "something is in the way")
    assert pad.pose[0] == pytest.approx(3 - 0.041, abs=0.006)
    pad.keys("x" * 30)
    pad.run(4.0)
    assert pad.mood == "driving"
    assert pad.pose[0] < 2.9
    pad.page.locator(".rp-plain[data-act='reset']").click()
    pad.run(0.1)
    assert pad.pose == (0.0, 0.0, 0.0)
    assert pad.mood == "ready"


def test_the_arrows_and_the_space_bar_drive_and_the_page_does_not_scroll(show):
    pad = show("light")
    pad.stage.focus()
    pad.page.keyboard.press("ArrowDown")
    pad.page.keyboard.press("ArrowRight")
    pad.run(1.0)
    assert "x: -0.01" in pad.message
    assert "z: -0.1" in pad.message
    pad.page.keyboard.press("Space")
    pad.run(0.5)
    assert pad.mood == "ready"
    assert pad.page.evaluate("scrollY") == 0
    pad.page.keyboard.press("Escape")
    sent = pad.page.locator(".rp-command").inner_text()
    pad.page.keyboard.press("w")
    pad.page.keyboard.press("PageDown")
    pad.run(0.5)
    pad.page.wait_for_function("scrollY > 0")  # outside of the pad, keys are the page's
    assert pad.page.locator(".rp-command").inner_text() == sent


@pytest.mark.nightly
def test_capitals_and_other_alphabets_drive_too_but_shortcuts_of_the_browser_do_not(show):
    pad = show("light")
    pad.stage.focus()
    for keys in ("Control+a", "Alt+d", "Meta+s", "Shift+Tab"):
        pad.page.keyboard.press(keys)
    assert pad.message == "Nothing has been published yet."
    pad.stage.focus()
    pad.page.keyboard.press("Shift+W")
    pad.stage.dispatch_event("keydown", {"key": "ц", "code": "KeyW"})  # the same key on a Russian keyboard
    pad.stage.dispatch_event("keydown", {"key": "z", "code": "KeyW"})  # and on a French one, which has a w elsewhere
    pad.run(1.0)
    assert "x: 0.02" in pad.message


def test_the_keyboard_alone_is_enough(show):
    pad = show("light")
    pad.page.locator("#before").focus()
    order = []
    for _ in range(10):
        pad.page.keyboard.press("Tab")
        order.append(pad.focused())
    assert order == ["rp-stage", *"wasdx", "rp-plain", "SELECT", "INPUT", "after"]
    # Enter presses a button; the keys and the space bar drive there too.
    for _ in range(7):
        pad.page.keyboard.press("Shift+Tab")
    assert pad.focused() == "a"
    pad.page.keyboard.press("Enter")
    pad.keys("w")
    pad.run(1.0)
    assert "x: 0.01" in pad.message
    assert "z: 0.1" in pad.message
    pad.page.keyboard.press("Space")
    pad.run(0.5)
    assert pad.mood == "ready"
    # Whoever chooses with keys stays, to choose again.
    for _ in range(6):
        pad.page.keyboard.press("Tab")
    pad.page.keyboard.press("Space")
    assert pad.focused() == "INPUT"
    pad.page.keyboard.press("Shift+Tab")
    pad.page.keyboard.press("ArrowUp")
    pad.page.keyboard.press("ArrowDown")
    assert pad.focused() == "SELECT"


@pytest.mark.parametrize("name", ["light", *nightly("dark")])
def test_the_focus_is_visible(show, name):
    pad = show(name)
    ring = "getComputedStyle(document.querySelector('.rp-stage'), '::after').borderTopWidth"
    assert pad.page.evaluate(ring) in ("0px", "")
    pad.page.locator("#before").focus()
    pad.page.keyboard.press("Tab")
    assert pad.page.evaluate(ring) == "3px"
    pad.page.keyboard.press("Tab")
    assert pad.page.evaluate(ring) in ("0px", "")
    shadow = pad.page.evaluate("getComputedStyle(document.activeElement).boxShadow")
    assert "0px 0px 0px 3px" in shadow


def test_what_a_screen_reader_is_told(show):
    pad = show("light")
    tree = pad.page.locator(".rosmini-pad").aria_snapshot()
    for part in ("Forward", "Turn left", "Stop", "Turn right", "Backward", "Back to the start"):
        assert f'button "{part}' in tree
    assert 'region "Teleoperation pad"' in tree
    assert 'application "Drive the TurtleBot3 Burger in the world hall"' in tree
    assert "img" in tree
    help_id = pad.stage.get_attribute("aria-describedby")
    assert "s or space stop at once" in pad.page.locator(f"#{help_id}").inner_text()
    status = pad.page.locator("[role=status]")
    pad.stage.focus()
    pad.keys("wwwwwaa")
    pad.run(0.3)
    assert status.text_content() == ""  # not at each key
    pad.run(2.0)
    assert re.findall(r"forward|left|[\d.]+", status.text_content()) == ["forward", "0.05", "left", "0.2"]
    pad.keys("s")
    pad.run(2.0)
    assert status.text_content() == "stopped"


LEAVING = {
    "window": "window.dispatchEvent(new Event('blur'))",
    "elsewhere": "document.getElementById('after').focus()",
    "scrolled away": "window.scrollTo(0, document.body.scrollHeight)",
    "tab hidden": "Object.defineProperty(document, 'hidden', {value: true, configurable: true}); "
    "document.dispatchEvent(new Event('visibilitychange')); delete document.hidden",
}


def test_whoever_leaves_the_pad_stops_the_robot_with_one_message(show):
    pad = show("light")
    hint = pad.page.locator(".rp-hint")
    pad.page.evaluate("document.body.insertAdjacentHTML('beforeend', '<div style=\"height:3000px\"></div>')")

    def stopped_by(leave):
        pad.page.evaluate("window.scrollTo(0, 0)")
        pad.stage.focus()
        assert not hint.is_visible()
        pad.keys("wwww")
        pad.run(1.0)
        assert pad.mood == "driving"
        leave()
        pad.page.wait_for_function("document.querySelector('.rp-log').lastChild.textContent.includes('x: 0.0\\n  y')")
        pad.run(1.0)
        assert pad.mood == "ready"
        *_, before, last = pad.page.locator(".rp-log pre").all_text_contents()
        assert last == f"{Twist()}\n---"
        assert before != last  # one such message, and no more

    for leave in LEAVING.values():
        stopped_by(partial(pad.page.evaluate, leave))
    pad.page.evaluate("document.activeElement.blur()")
    stopped_by(partial(pad.page.keyboard.press, "Escape"))
    assert hint.inner_text().startswith("Click here to drive")
    assert hint.is_visible()


def test_a_held_button_repeats_and_a_click_moves_the_focus_to_the_pad(show):
    pad = show("light")
    box = pad.page.locator("[data-key=w]").bounding_box()
    pad.page.mouse.move(box["x"] + 20, box["y"] + 20)
    pad.page.mouse.down()
    pad.run(1.05)
    pad.page.mouse.up()
    pad.run(1.0)
    target = pad.page.locator(".rp-meter").first.inner_text()
    assert "0.08 m/s" in target  # once at once, after 0.4 s, and then each 0.1 s
    assert pad.focused() == "rp-stage"
    pad.page.keyboard.press("Space")  # does not press the button again
    pad.run(0.5)
    assert pad.mood == "ready"


def test_the_keys_of_another_program_and_a_dead_mans_switch(show):
    pad = show("blind")
    keys = pad.page.get_by_label("Keys of")
    keys.select_option("teleop_twist_keyboard")
    assert pad.focused() == "rp-stage"
    pad.run(0.1)
    assert [b.get_attribute("data-key") for b in pad.page.locator(".rp-key").all()] == [*"uiojklm,.", "z", "q"]
    assert "any other key: stop" in pad.page.locator(".rp-help").inner_text()
    pad.keys("u")
    pad.run(0.3)
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.22, 1.0
    assert pad.message == f"{twist}\n---"
    pad.page.keyboard.press("Shift+J")
    pad.run(0.1)
    twist = Twist()
    twist.linear.y = 0.22
    assert pad.message == f"{twist}\n---"
    pad.keys("z5")  # slower; and a key that means nothing stops
    pad.run(0.1)
    assert (pad.mood, pad.message) == ("ready", f"{Twist()}\n---")
    assert "currently: speed 0.198, turn 0.9" in pad.page.locator(".rp-gauges").inner_text()
    pad.page.get_by_label("hold to drive").check()
    pad.page.keyboard.down("i")
    pad.page.keyboard.down("l")
    pad.page.keyboard.up("i")
    pad.run(0.3)
    assert pad.mood == "driving"
    pad.page.keyboard.up("l")
    pad.run(0.3)
    assert pad.mood == "ready"
    keys.select_option("turtlebot3_teleop_key")
    pad.run(0.1)
    assert pad.page.locator(".rp-key").count() == 5


@pytest.mark.nightly
def test_a_gamepad_drives_while_its_switch_is_held(show):
    pad = show("light")
    pad.page.evaluate(
        """() => {
          const buttons = Array.from({length: 16}, () => ({pressed: false}));
          globalThis.stick = { connected: true, axes: [-0.54, -1, 0, 0], buttons };
          navigator.getGamepads = () => [null, globalThis.stick];
          window.dispatchEvent(new Event("gamepadconnected"));
        }"""
    )
    pad.stage.focus()
    pad.run(0.5)
    assert pad.mood == "ready"  # its switch is not held
    pad.page.evaluate("stick.buttons[5].pressed = true")
    pad.run(6.0)
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.22, 1.42
    assert pad.message == f"{twist}\n---"
    pad.page.evaluate("stick.buttons[5].pressed = false")
    pad.run(0.5)
    assert (pad.mood, pad.message) == ("ready", f"{Twist()}\n---")
    pad.page.evaluate("stick.buttons[5].pressed = true; document.activeElement.blur()")
    pad.run(0.5)
    assert pad.mood == "ready"  # the pad has not the focus


PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True, "device_scale_factor": 2}


@pytest.mark.parametrize("name", ["blind", *nightly("light")])
def test_on_a_phone_fingers_drive(show, name, shared_tmp):
    pad = show(name, **PHONE)
    assert pad.page.evaluate("document.documentElement.scrollWidth") == 390
    for button in pad.page.locator(".rosmini-pad button:visible").all():
        box = button.bounding_box()
        assert min(box["width"], box["height"]) >= 44
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
    for _ in range(3):
        pad.page.locator("[data-key=w]").tap()
    pad.page.locator("[data-key=d]").tap()
    pad.run(1.0)
    assert "x: 0.03" in pad.message
    assert "z: -0.1" in pad.message
    pad.page.screenshot(path=shared_tmp / f"pad_phone_{name}.png", full_page=False)
    pad.page.locator("[data-key=s]").tap()
    pad.run(0.5)
    assert pad.mood == "ready"


def luminance(colour):
    parts = [int(part) / 255 for part in colour[colour.index("(") + 1 : -1].split(",")[:3]]
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


@pytest.mark.parametrize("name", ["dark", *nightly("light")])
def test_the_pad_has_the_theme_of_its_page(show, name, shared_tmp):
    pad = show(name)
    pad.stage.focus()
    pad.keys("wwwwwwwwwwwwaaa")
    pad.run(6.0)
    pad.page.screenshot(path=shared_tmp / f"pad_{name}.png")

    def colours(selector):
        text, ground = pad.page.evaluate(
            """(selector) => {
              const paint = (element) => {
                const c = getComputedStyle(element).backgroundColor;
                return c.includes(", 0)") && element.parentElement ? paint(element.parentElement) : c;
              };
              const found = document.querySelector(selector);
              return [getComputedStyle(found).color, paint(found)];
            }""",
            selector,
        )
        return luminance(text), luminance(ground)

    _, ground = colours(".rosmini-pad")
    assert (ground > 0.9) if name == "light" else (ground < 0.05)
    for selector in (
        ".rp-readings .rp-value",
        ".rp-readings .rp-name",
        ".rp-help",
        ".rp-key kbd",
        ".rp-log pre:nth-child(2)",
        ".rp-command em",
    ):
        text, ground = colours(selector)
        assert (max(text, ground) + 0.05) / (min(text, ground) + 0.05) >= 4.5, selector


@pytest.mark.nightly
def test_the_theme_can_change_while_it_is_open(show):
    pad = show("light")
    pad.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    pad.run(0.2)
    ground = pad.page.evaluate("getComputedStyle(document.querySelector('.rosmini-pad')).backgroundColor")
    assert luminance(ground) < 0.05
    corner = pad.page.evaluate(
        "String([...document.querySelector('.rp-sight canvas').getContext('2d').getImageData(2, 2, 1, 1).data])"
    )
    assert luminance(f"rgb({corner})") < 0.05


def test_print_shows_the_still(show, shared_tmp):
    pad = show("light")
    still, moving = pad.page.locator(".rosmini-still"), pad.page.locator(".rosmini-moving")
    assert not still.is_visible()
    pad.page.emulate_media(media="print")
    assert still.is_visible()
    assert not moving.is_visible()
    assert "teleop_pad publishes geometry_msgs/Twist on /cmd_vel" in still.inner_text()
    pad.page.screenshot(path=shared_tmp / "pad_print.png")


def test_with_reduced_motion_nothing_fades(show):
    pad = show("light", reduced_motion="reduce")
    assert pad.page.evaluate("getComputedStyle(document.querySelector('.rp-key')).transitionDuration") == "0s"


def test_without_scripts_the_still_is_there(chromium, site):
    context = chromium.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "light.html").as_uri())
    assert page.locator(".rosmini-still svg").is_visible()
    context.close()


def test_the_book_form_is_small_and_the_same_each_time(monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    _, simulator = simulated()
    pad = simulator.pad()
    data, _ = pad._repr_mimebundle_()
    assert set(data) == {"text/plain", "text/html"}
    assert data["text/html"] == simulated()[1].pad().html
    assert len(data["text/html"]) < 30_000
    start = data["text/html"].index('<script type="application/json">') + len('<script type="application/json">')
    told = json.loads(data["text/html"][start : data["text/html"].index("</script>", start)])
    robots = ("turtlebot3_teleop_key", "teleop_twist_keyboard")
    assert told["maps"] == [table(Limits(), key_map(name)) for name in robots]
