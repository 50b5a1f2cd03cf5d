"""Inflation with dials in Chromium: the costs are those of Python, by hand and by keys."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.navigation.costmap_2d.inflation import cell_distance, cost_table, inflate
from rosmini.navigation.costmap_2d.layer import Window

pytestmark = pytest.mark.browser

RNG = np.random.default_rng(7)
COSTS = RNG.choice([0, 254, 255], size=(24, 40), p=[0.9, 0.05, 0.05]).astype(np.uint8)


@pytest.fixture(scope="module")
def page(tabs, tmp_path_factory):
    """A page with the dials of a costmap; one test alone turns them."""
    view = Costmap2D.of(COSTS[::-1], 0.05).show_inflation(title="Dials", inscribed_radius=0.1)
    with tabs.open({"width": 800, "height": 900}) as (page, _):
        page.goto(view.save(tmp_path_factory.mktemp("dials") / "dials.html").as_uri())
        yield page


@pytest.mark.parametrize("radius", [0.0, 0.05, 0.31, 0.55])
@pytest.mark.parametrize(("inscribed", "scaling"), [(0.0, 0.5), (0.105, 10.0), (0.2, 3.0)])
def test_the_costs_are_those_of_python(page, radius, inscribed, scaling):
    settings = {"resolution": 0.05, "radius": radius, "inscribed": inscribed, "scaling": scaling}
    shown = page.evaluate(
        "([costs, s]) => [...rosminiInflation.inflated(Uint8Array.from(costs), [40, 24], s)]",
        [COSTS.ravel().tolist(), settings],
    )
    wanted = COSTS.copy()
    reach = cell_distance(radius, 0.05)
    inflate(wanted, Window(0, 0, 40, 24), reach, cost_table(reach, 0.05, inscribed, scaling))
    assert shown == wanted.ravel().tolist()


def test_the_dials_turn_and_a_cell_says_what_it_costs(page):
    said = page.get_by_role("status")
    before = said.text_content()
    page.get_by_role("slider", name="inflation_radius").fill("0.2")
    assert said.text_content() != before
    assert "free" in said.text_content()
    page.get_by_role("slider", name="inflation_radius").fill("0.05")
    assert said.text_content().startswith("The inflation radius is under the inscribed radius")
    page.get_by_role("slider", name="inflation_radius").fill("0.5")
    page.get_by_role("img", name="The costs").focus()
    page.keyboard.press("ArrowRight")
    assert said.text_content().startswith("cell (21, 11): ")
    assert page.locator(".ri-curve .line").count() == 1
