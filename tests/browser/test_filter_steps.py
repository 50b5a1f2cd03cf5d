"""A particle filter that is stepped, in Chromium: by the button, by keys and by itself."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.amcl import show_steps
from rosmini.navigation.map_server.grid_map import GridMap

pytestmark = pytest.mark.browser


@pytest.fixture
def view():
    random = np.random.default_rng(1)
    steps = [
        (
            f"step {k}",
            random.normal((2.0, 1.0, 0.0), 0.5 / (k + 1), (200, 3)),
            random.random(200),
            (2.0, 1.0, 0.5),
        )
        for k in range(5)
    ]
    return show_steps(GridMap(np.zeros((20, 40), np.int8), 0.1, (0.0, 0.0, 0.0)), steps, title="Steps")


GATHER = """(status) => {
  globalThis.said = [];
  const gather = new MutationObserver(() => said.push(status.textContent));
  gather.observe(status, {childList: true, characterData: true, subtree: true});
}"""
"""What is said while it plays: none of it stays for long enough that a test on a slow machine sees it."""


def test_it_is_stepped(tabs, tmp_path, view):
    with tabs.open({"width": 800, "height": 600}) as (page, _):
        page.goto(view.save(tmp_path / "steps.html").as_uri())
        said, slider = page.get_by_role("status"), page.get_by_role("slider", name="step")
        assert said.text_content().startswith("1. step 0: 200 particles")
        page.get_by_role("button", name="Next step").click()
        assert said.text_content().startswith("2. step 1: ")
        slider.focus()
        page.keyboard.press("End")
        assert said.text_content() == f"5. {view.data['steps'][-1]['said']}"
        said.evaluate(GATHER)
        page.get_by_role("button", name="Play").click()
        page.get_by_role("button", name="Play").wait_for()
        shown = page.evaluate("said")
        assert [text.partition(":")[0] for text in shown] == [f"{i + 1}. step {i}" for i in range(5)]
        assert page.get_by_role("img", name="after the step step 4").count() == 1
