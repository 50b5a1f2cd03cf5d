"""Every page of the built book in a real browser, from file://: an empty console, and nothing from the network."""

from __future__ import annotations

import pytest

pytestmark = pytest.mark.browser

WIDTHS = {"desktop": (1280, 900), "phone": (390, 844)}
SIDEWAYS = "document.documentElement.scrollWidth - document.documentElement.clientWidth"

CODE_ASIDE = """[...document.querySelectorAll(".bd-article div.highlight pre")]
    .filter(code => code.scrollWidth > code.clientWidth + 1).length"""
"""How many listings one has to push aside to read."""


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_page_opens_with_an_empty_console(book_html, chromium, watch, shared_tmp, scheme, width):
    screenshots = shared_tmp / "screenshots"
    screenshots.mkdir(exist_ok=True)
    wide, high = WIDTHS[width]
    context = chromium.new_context(color_scheme=scheme, viewport={"width": wide, "height": high})
    pages = sorted(path for path in book_html.rglob("*.html") if "_static" not in path.parts)
    assert len(pages) > 5
    problems = []
    for path in pages:
        name = path.relative_to(book_html).with_suffix("").as_posix()
        page = context.new_page()
        watcher = watch(page)
        page.goto(path.as_uri(), wait_until="load")
        page.wait_for_function("document.readyState === 'complete'")
        problems += [f"{name}: {seen}" for seen in watcher.seen]
        if page.evaluate(SIDEWAYS) > 0:
            problems.append(f"{name}: wider than the {width}")
        if width == "phone" and page.evaluate(CODE_ASIDE):
            problems.append(f"{name}: lines of code are wider than the phone")
        if page.evaluate("document.documentElement.dataset.theme") != scheme:
            problems.append(f"{name}: not {scheme}")
        if (scheme, width) == ("light", "desktop"):  # to be looked at; it takes longer than all the rest
            page.screenshot(path=screenshots / f"{name.replace('/', '_')}.png", full_page=True)
        page.close()
    context.close()
    assert problems == []


def test_the_reader_can_change_the_theme_and_search(book_html, chromium, watch):
    context = chromium.new_context(color_scheme="light", viewport={"width": 1280, "height": 900})
    page = context.new_page()
    watcher = watch(page)
    page.goto((book_html / "index.html").as_uri())
    page.wait_for_url("**/book/intro.html")
    while page.evaluate("document.documentElement.dataset.mode") != "dark":
        page.locator(".theme-switch-button:visible").first.click()
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    page.goto((book_html / "search.html").as_uri() + "?q=Master")
    page.locator("#search-results li").first.wait_for()
    assert page.locator("#search-results li").count() >= 2
    # searchtools asks for each hit's text, which a page from file:// may not read; it shows the hits without.
    assert [seen for seen in watcher.seen if "request:" in seen] == []
    context.close()


@pytest.mark.parametrize(
    ("html", "seen"),
    [
        ("<script>console.log('hello')</script>", "console log: hello"),
        ("<script>console.error('oh')</script>", "console error: oh"),
        ("<script>nothing.here()</script>", "error: nothing is not defined"),
        ("<img src='http://example.invalid/a.png'>", "request: http://example.invalid/a.png"),
        ("<script src='missing.js'></script>", "missing.js"),
    ],
)
def test_the_watcher_sees_what_it_is_there_to_see(chromium, watch, tmp_path, html, seen):
    (tmp_path / "bad.html").write_text(f"<!DOCTYPE html><title>t</title>{html}", encoding="utf-8")
    page = chromium.new_page()
    watcher = watch(page)
    page.goto((tmp_path / "bad.html").as_uri(), wait_until="load")
    assert any(seen in line for line in watcher.seen), watcher.seen
    page.close()
