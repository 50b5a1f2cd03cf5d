"""Pictures of worlds and runs in Chromium: they take the theme of their page, and leave other pictures alone."""

import numpy as np
import pytest

from rosmini.sim.worlds import world
from rosmini.viz import rqt_graph, style
from rosmini.viz.beams import beams_of
from rosmini.viz.embed import STATIC
from rosmini.viz.world_pictures import Scene

pytestmark = pytest.mark.browser

SIZE = (660, 540)
SHEET = (STATIC / "rosmini.css").read_text(encoding="utf-8")

PAINTS = """(selector) => [...document.querySelectorAll(selector)].map((node) => {
  const look = getComputedStyle(node);
  return [look.fill, look.stroke, look.strokeWidth];
})"""


def rgb(colour):
    return f"rgb({', '.join(str(int(colour[i : i + 2], 16)) for i in (1, 3, 5))})"


@pytest.fixture
def show(tabs):
    """Open pictures in a page of a theme; closing it asserts that the browser had nothing to say."""
    with tabs.open({"width": 800, "height": 900}) as (page, _):

        def show(theme, *views):
            figures = "".join(view.html for view in views)
            page.set_content(
                f'<!DOCTYPE html><html data-theme="{theme}"><head><style>{SHEET}</style></head>'
                f"<body>{figures}</body></html>"
            )
            return page

        yield show


@pytest.mark.parametrize(("theme", "palette"), [("light", style.LIGHT), ("dark", style.DARK)])
def test_every_colour_is_that_of_the_theme(show, theme, palette):
    room = world("room")
    trail = [(0, 0), (1, 0), (1, 1)]
    scene = Scene(room)
    scene.robot, scene.trail, scene.odom = (1.0, 1.0, 1.0), np.array(trail), np.array(trail)
    scene.add_scan(beams_of(np.ones(360), scene.model.laser), scene.robot, None)
    page = show(theme, scene.picture(None, SIZE))
    paints = page.evaluate(PAINTS, ".rosmini-plot :is(path, text, use):not(defs *)")
    allowed = {"none", *(rgb(colour) for colour in palette.values())}
    used = {paint for fill, stroke, _ in paints for paint in (fill, stroke)}
    assert {part for part in used if part not in allowed and not part.startswith("rgba")} == set()
    assert {rgb(palette[name]) for name in ("blue", "orange", "vermilion", "muted", "ink")} <= used


def test_pictures_on_one_page_leave_one_another_alone(show):
    system = [[["/chatter", ["/talker"]]], [["/chatter", ["/listener"]]], []]
    scene = Scene(world("room"))
    scene.robot = (0.0, 0.0, 0.0)
    room = scene.picture(None, SIZE)
    alone = show("dark", room).evaluate(PAINTS, ".rosmini-plot *")
    graph = show("dark", rqt_graph(system)).evaluate(PAINTS, ".rosmini-svg *")
    page = show("dark", room, rqt_graph(system))
    assert page.evaluate(PAINTS, ".rosmini-plot *") == alone
    assert page.evaluate(PAINTS, ".rosmini-svg *") == graph


def test_on_a_narrow_page_the_picture_shrinks(show):
    page = show("light", Scene(world("room")).picture(None, SIZE))
    page.set_viewport_size({"width": 480, "height": 800})
    box = page.locator(".rosmini-plot").bounding_box()
    assert box["width"] < 470
    assert box["height"] / box["width"] == pytest.approx(540 / 660, abs=0.1)


def test_on_a_phone_the_widest_picture_is_no_wider_than_its_column(show):
    many = [[f"/topic_{i}", [f"/node_{i}"]] for i in range(8)]
    chain = [[f"/topic_{i}", [f"/node_{i + 1}"]] for i in range(8)]
    page = show("light", rqt_graph([many, chain, []]))
    page.set_viewport_size({"width": 390, "height": 800})
    assert float(page.locator(".rosmini-svg").get_attribute("width")) > 1000
    assert page.evaluate("document.querySelector('figure').scrollWidth") <= 390
