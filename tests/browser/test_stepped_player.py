"""A stepped player in Chromium: sliders, keys, buttons, a narrow dark page, and paper."""

import itertools

import pytest

from rosmini.viz.stepped_player import Axis, Frame, Panel, SteppedPlayer

pytestmark = pytest.mark.browser

PANELS = [Panel("left", 320, 100), Panel("right", 320, 100)]


def circle(radius, colour="red"):
    return f'<circle cx="50" cy="50" r="{radius}" fill="{colour}"/>'


@pytest.fixture
def steps():
    frames = [Frame([circle(n + 1), circle(10 - n)], f"step {n}\nof five") for n in range(5)]
    return SteppedPlayer(
        "Steps", PANELS, [Axis("step", [f"{n} of 4" for n in range(5)])], frames, text="five steps", alt="Circles.",
        still=[4], period=20,
    )  # fmt: skip


@pytest.fixture
def shapes():
    axes = [Axis("radius", ["10", "20"]), Axis("colour", ["red", "green", "blue"])]
    frames = [
        Frame([circle(radius, colour), ""], f"{colour}, {radius}")
        for radius, colour in itertools.product(axes[0].values, axes[1].values)
    ]
    return SteppedPlayer("Shapes", PANELS, axes, frames, text="shapes", alt="Circles.", first=[1, 1])


GATHER = """(status) => {
  globalThis.said = [];
  new MutationObserver(() => said.push(status.textContent)).observe(status, {childList: true});
}"""


def test_steps_by_button_by_key_and_by_themselves(tabs, tmp_path, steps):
    with tabs.open({"width": 800, "height": 600}) as (page, _):
        page.goto(steps.save(tmp_path / "steps.html").as_uri())
        said, slider = page.get_by_role("status"), page.get_by_role("slider", name="step")
        assert said.text_content() == "step 0\nof five"
        page.get_by_role("button", name="Next step").click()
        assert said.text_content().startswith("step 1")
        assert page.locator(".rosmini-moving circle").first.get_attribute("r") == "2"
        slider.focus()
        page.keyboard.press("End")
        assert slider.get_attribute("aria-valuetext") == "4 of 4"
        assert page.get_by_role("img", name="left: step 4").count() == 1
        said.evaluate(GATHER)
        page.get_by_role("button", name="Play").click()
        page.get_by_role("button", name="Play").wait_for()
        assert [text.partition("\n")[0] for text in page.evaluate("said")] == [f"step {n}" for n in range(5)]


def test_two_sliders_choose_one_frame(tabs, tmp_path, shapes):
    with tabs.open({"width": 800, "height": 600}) as (page, _):
        page.goto(shapes.save(tmp_path / "shapes.html").as_uri())
        said = page.get_by_role("status")
        assert said.text_content() == "green, 20"
        page.get_by_role("slider", name="radius").fill("0")
        page.get_by_role("slider", name="colour").fill("2")
        assert said.text_content() == "blue, 10"
        assert page.locator(".rosmini-moving circle").get_attribute("fill") == "blue"
        assert page.get_by_role("button").count() == 0


def test_it_fits_a_narrow_page_and_its_still_picture_is_printed(tabs, tmp_path, steps):
    with tabs.open({"width": 390, "height": 700}) as (page, _):
        page.goto(steps.save(tmp_path / "steps.html").as_uri())
        boxes = [panel.bounding_box() for panel in page.locator(".rosmini-moving .rm-panel").all()]
        assert boxes[1]["y"] > boxes[0]["y"] + 99, "the second panel is below the first"
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page.emulate_media(media="print")
        assert not page.get_by_role("slider").is_visible()
        assert page.locator(".rosmini-still circle").first.get_attribute("r") == "5"
        assert page.locator(".rosmini-still > svg").is_visible()
