"""The window of trajectories in Chromium: sliders, keys and clicks choose, and the table follows."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.dwa_local_planner.dwa_planner import DWAPlanner, DWAPlannerParameters

pytestmark = pytest.mark.browser

FOOTPRINT = np.array([(-0.105, -0.105), (-0.105, 0.105), (0.041, 0.105), (0.041, -0.105)])


@pytest.fixture
def page(tabs, tmp_path):
    grid = Costmap2D(60, 60, 0.05, (-1.5, -1.5))
    grid.costs[20:, 36:40] = 254
    plan = np.column_stack([np.arange(0, 1, 0.05), np.zeros(20), np.zeros(20)])
    parameters = DWAPlannerParameters(max_vel_y=0.0, min_vel_y=0.0, vy_samples=1, vx_samples=4, vth_samples=5)
    planner = DWAPlanner(parameters, 0.1)
    planner.update_plan(grid, (0.0, 0.0, 0.0), plan, FOOTPRINT)
    samples = planner.find_best(grid, (0.0, 0.0, 0.0), np.array([0.2, 0.0, 0.3]))
    view = samples.show(costmap=grid, plan=plan, footprint=FOOTPRINT, title="Tried")
    with tabs.open({"width": 800, "height": 900}) as (page, _):
        page.goto(view.save(tmp_path / "tried.html").as_uri())
        page.samples, page.view = samples, view
        yield page


def test_the_best_is_shown_first_and_keys_go_on_to_the_next(page):
    said, slider = page.get_by_role("status"), page.get_by_role("slider", name="trajectory")
    best = f"cost {page.samples.totals[page.samples.best]:.2f}"
    assert best in said.text_content()
    slider.focus()
    page.keyboard.press("ArrowRight")
    assert slider.input_value() == "1"
    assert "cost" in said.text_content()
    page.keyboard.press("End")
    assert "rejected by obstacle: the footprint meets an obstacle at point" in said.text_content()
    assert page.get_by_role("row", name="obstacle").text_content().endswith("rejected")
    page.keyboard.press("Home")
    assert best in said.text_content()


def test_the_table_has_what_each_critic_gave(page):
    rows = page.get_by_role("row").all_text_contents()[1:]
    weighed = int((page.samples.scales != 0).sum())
    assert len(rows) == weighed
    total = sum(
        float(cell) for cell in page.locator(".rosmini-trajectories tbody td:last-child").all_text_contents()
    )
    assert total == pytest.approx(float(page.samples.totals[page.samples.best]), abs=0.05)


def test_the_second_slider_goes_along_it_and_a_click_chooses(page):
    point = page.get_by_role("slider", name="point")
    length = int(page.samples.lengths[page.samples.best])
    assert (point.input_value(), point.get_attribute("max")) == (str(length - 1), str(length - 1))
    point.fill("0")
    assert page.locator(".rt-value").nth(1).text_content() == f"1 of {length}"
    page.locator("canvas").click(position={"x": 220, "y": 300})
    assert page.get_by_role("slider", name="trajectory").input_value() != "0"
