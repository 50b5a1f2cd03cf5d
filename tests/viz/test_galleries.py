"""Views in a grid: one text, one alt text, one document, and as many columns as a page has room for."""

import base64
import xml.etree.ElementTree as ET

import pytest

from rosmini.sim.worlds import world
from rosmini.viz import Picture, ViewError, grid, plot, rqt_graph
from rosmini.viz.world_pictures import Scene

SYSTEM = [[["/chatter", ["/talker"]]], [["/chatter", ["/listener"]]], []]
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)
TAG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def views():
    return (
        Scene(world("room")).picture("the room", (660, 540)),
        plot({"speed": ([0, 1], [0, 1])}, x="t [s]", y="v [m/s]", title="the speed"),
        rqt_graph(SYSTEM),
    )


def test_text_and_alt_text_are_those_of_all(views):
    made = grid(*views, title="Figure 1: three")
    assert made.text.splitlines()[0] == "Figure 1: three: 3 views"
    for i, view in enumerate(views, 1):
        assert view.text in made.text
        assert f"{i}. {view.alt}" in made.alt


def test_the_picture_has_them_side_by_side_and_none_over_another(views):
    root = ET.fromstring(grid(*views, columns=2)._images()["image/svg+xml"])
    *_, width, height = (float(part) for part in root.get("viewBox").split())
    boxes = [[float(svg.get(name)) for name in ("x", "y", "width", "height")] for svg in root.findall(f"{TAG}svg")]
    assert len(boxes) == 3
    for i, (x, y, w, h) in enumerate(boxes):
        assert x >= 0
        assert y >= 0
        assert x + w <= width + 0.1
        assert y + h <= height + 0.1
        for a, b, c, d in boxes[:i]:
            assert x >= a + c or a >= x + w or y >= b + d or b >= y + h
    assert [node.text for node in root.findall(f"{TAG}text")] == ["the room", "the speed"]
    assert boxes[0][1] == boxes[1][1] < boxes[2][1]


def test_a_page_gets_their_own_figures_with_their_captions(views):
    made = grid(*views, title="all <of> them")
    root = ET.fromstring(made.html)
    assert len(root.findall(".//figure")) == 3
    assert [node.text for node in root.iter("figcaption")] == ["the room", "the speed", "all <of> them"]


def test_what_cannot_stand_in_a_grid_is_refused(views):
    with pytest.raises(ViewError, match="at least one view"):
        grid()
    with pytest.raises(ViewError, match="3 views in 0"):
        grid(*views, columns=0)
    with pytest.raises(ViewError, match="'one pixel' has no vector form"):
        grid(views[0], Picture(PNG, text="one pixel", alt="A pixel."))
