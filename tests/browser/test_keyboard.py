"""The keyboard alone: it reaches everything on a page, the focus is seen everywhere, and nothing holds it."""

import pytest

from ..conftest import nightly

pytestmark = pytest.mark.browser

FOCUSED = """() => {
  let element = document.activeElement;
  while (element?.tagName === "IFRAME") element = element.contentDocument.activeElement;
  if (!element || element === element.ownerDocument.body) return null;
  element.dataset.reached = "";
  const view = element.ownerDocument.defaultView;
  for (const each of element.getAnimations({subtree: true})) each.finish();  // transitions of the theme
  const styles = [view.getComputedStyle(element), view.getComputedStyle(element, "::after")];
  const outline = styles.find((style) => style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2
    && !/, 0\\)/.test(style.outlineColor));
  const ring = styles.some((style) => /[1-9]px/.test(style.boxShadow) || parseFloat(style.borderTopWidth) >= 3);
  const name = element.outerHTML.slice(0, 120);
  if (!outline) return ring || element.closest(".bd-search") ? "" : `focus is not seen: ${name}`;
  const box = element.getBoundingClientRect();
  const out = parseFloat(outline.outlineOffset) + parseFloat(outline.outlineWidth) - 1;
  for (let around = element.parentElement; around.parentElement; around = around.parentElement) {
    const style = view.getComputedStyle(around);
    if (around === view.document.body || style.overflow === "visible") continue;
    const edge = around.getBoundingClientRect();
    const gaps = [box.left - edge.left, box.top - edge.top, edge.right - box.right, edge.bottom - box.bottom];
    if (element.tagName !== "A" && Math.min(...gaps) < out) return `its outline is cut off: ${name}`;
  }
  return "";
}"""
"""What is wrong with the element that has the focus; null if none has it."""

UNREACHED = """() => [...document.querySelectorAll(
  "a[href], button, input, select, textarea, summary, [tabindex]"
)].filter((each) => each.tabIndex >= 0 && !each.disabled && !("reached" in each.dataset)
    && each.checkVisibility({visibilityProperty: true})).map((each) => each.outerHTML.slice(0, 120))"""


def walk(page):
    """Press Tab until the focus leaves the page; return what is wrong."""
    found = []
    for _ in range(2000):
        page.keyboard.press("Tab")
        if (problem := page.evaluate(FOCUSED)) is None:
            return found
        if problem:
            found.append(problem)
    raise AssertionError("the focus does not leave the page")


@pytest.fixture
def visit(book_html, tabs):
    """Open a page of the book where nothing glides."""
    with tabs.open({"width": 1280, "height": 900}, reduced_motion="reduce") as (page, _):

        def visit(name):
            page.goto((book_html / f"{name}.html").as_uri())
            return page

        yield visit


@pytest.mark.parametrize(
    "which",
    [
        "book/intro",
        *nightly("search", "book/progress", "notebooks/3_robot/10_turtlebot3", "notebooks/6_simulators/40_rqt"),
    ],
)
def test_tab_reaches_everything_and_leaves_the_page(visit, which):
    page = visit(which)
    assert walk(page) == []
    assert page.evaluate(UNREACHED) == []


def test_folded_boxes_the_theme_and_the_search_need_no_mouse(book_html, chromium):
    page = chromium.new_page()
    page.goto((book_html / "notebooks/4_files/10_environment.html").as_uri())
    for fold in (page.locator("details.hide summary").first, page.locator("details:not(.hide) summary").first):
        for is_open in (True, False):
            fold.press("Enter")
            assert fold.evaluate("(summary) => summary.parentElement.open") == is_open
    mode = page.evaluate("document.documentElement.dataset.mode")
    page.locator(".theme-switch-button:visible").first.press("Enter")
    assert page.evaluate("document.documentElement.dataset.mode") != mode
    for leave in ("Escape", "Enter"):
        page.keyboard.press("Control+k")
        page.get_by_role("searchbox").wait_for()
        page.keyboard.type("odometry")
        page.keyboard.press(leave)
    page.wait_for_url("**/search.html?q=odometry*")
    page.locator("#search-results li a").first.press("Enter")
    page.wait_for_url(lambda url: "search.html" not in url)
    page.close()
