"""Searches that are stepped, in Chromium: by hand, by keys and by themselves."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.global_planner import GlobalAStar
from rosmini.navigation.navfn import NavfnSearch, show_steps

pytestmark = pytest.mark.browser


@pytest.fixture
def view():
    costs = np.zeros((20, 30), np.uint8)
    costs[:14, 15] = 254
    return show_steps(
        {"Dijkstra": NavfnSearch(costs, (3, 5), (25, 5)), "A*": GlobalAStar(costs, (3, 5), (25, 5))},
        title="Steps",
    )


@pytest.fixture
def page(tabs, tmp_path, view):
    with tabs.open({"width": 800, "height": 600}) as (page, _):
        page.goto(view.save(tmp_path / "steps.html").as_uri())
        yield page


def test_the_slider_steps_both_searches_and_the_end_is_that_of_python(page, view):
    said, slider = page.get_by_role("status"), page.get_by_role("slider", name="step")
    assert said.nth(0).text_content() == "0 cells taken up, 1 reached"
    slider.focus()
    page.keyboard.press("ArrowRight")
    assert said.nth(0).text_content().startswith(f"{view.data['step']} cells taken up, ")
    page.keyboard.press("End")
    for number, each in enumerate(view.data["searches"]):
        reached = int((np.frombuffer(each["when"], np.uint8) > 0).sum())
        assert (
            said.nth(number).text_content() == f"{each['taken']} cells taken up, {reached} reached, arrived"
        )
    assert page.get_by_role("img", name="A*: ").count() == 1


def test_it_plays(page, view):
    page.get_by_role("button", name="Play").click()
    page.get_by_role("status").nth(0).filter(has_text="arrived").wait_for()
    page.get_by_role("button", name="Play").wait_for()
    assert page.get_by_role("slider", name="step").input_value() == str(view.data["frames"])
