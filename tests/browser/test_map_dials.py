"""The dials of a map's image in Chromium: they make the map that Python makes, by hand and by keys."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from rosmini.navigation.map_server import map_file
from rosmini.navigation.map_server.map_io import Fields, occupancy_of

pytestmark = pytest.mark.browser

GREYS = np.arange(256, dtype=np.uint8).reshape(8, 32)


@pytest.fixture(scope="module")
def page(tabs, tmp_path_factory):
    """A page with the dials of an image that has every grey; one test alone turns them."""
    folder = tmp_path_factory.mktemp("dials")
    Image.fromarray(GREYS).save(folder / "map.pgm")
    text = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n"
    (folder / "map.yaml").write_text(text, encoding="utf-8")
    view = map_file(folder / "map.yaml").show(title="Dials")
    with tabs.open({"width": 800, "height": 600}) as (page, _):
        page.goto(view.save(folder / "dials.html").as_uri())
        yield page


@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
@pytest.mark.parametrize("negate", [False, True])
@pytest.mark.parametrize(("free", "occupied"), [(0.196, 0.65), (0.25, 0.65), (0.5, 0.5), (0.0, 1.0)])
def test_the_map_is_that_of_python(page, mode, negate, free, occupied):
    settings = {"mode": mode, "negate": negate, "free": free, "occupied": occupied}
    shown = page.evaluate(
        "([greys, s]) => [...rosminiMapDials.cells(greys, s)]", [GREYS.ravel().tolist(), settings]
    )
    fields = Fields("map.pgm", 0.05, (0.0, 0.0, 0.0), occupied, free, negate, mode)
    assert shown == occupancy_of(GREYS[..., None], fields).ravel().tolist()


def test_the_dials_turn_and_a_pixel_says_what_it_is(page):
    said = page.get_by_role("status")
    assert said.text_content() == "free 19.5 %, occupied 35.2 %, unknown 45.3 %"
    page.get_by_role("slider", name="free_thresh").fill("0.5")
    assert said.text_content() == "free 50.0 %, occupied 35.2 %, unknown 14.8 %"
    page.get_by_role("slider", name="free_thresh").fill("0.9")
    assert said.text_content() == "free_thresh is above occupied_thresh: no map, cells would be both"
    page.get_by_role("slider", name="free_thresh").fill("0.196")
    page.get_by_label("The image map.pgm").focus()
    for key in ("ArrowUp", "ArrowLeft", "ArrowDown"):
        page.keyboard.press(key)
    assert said.text_content() == "pixel 143, p = 0.439: unknown (-1)"
    page.get_by_role("combobox", name="mode").select_option("scale")
    assert said.text_content() == "pixel 143, p = 0.439: 53 (53)"
    page.get_by_role("checkbox", name="negate").check()
    assert said.text_content() == "pixel 143, p = 0.561: 79 (79)"
