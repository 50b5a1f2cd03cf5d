"""Every page of the built book in a real browser, from file://: an empty console, and nothing from the network."""

import os

import pytest

from ..conftest import nightly, tool

pytestmark = pytest.mark.browser

IS_SHOT = os.environ.get("ROSMINI_SCREENSHOTS") == "1"
"""Whether pictures of the whole pages are wanted, to be looked at: they take longer than all the rest."""

PARTS = [f"notebooks/{part}_*/*.html" for part in range(1, 10)]
WIDTHS = {"desktop": (1280, 900), "phone": (390, 844)}
SIDEWAYS = "document.documentElement.scrollWidth - document.documentElement.clientWidth"

SETTLES = """() => new Promise((settled) => {
  const begin = performance.now();
  let again = begin + 1000;
  const look = () => {
    document.getAnimations().forEach((each) => each instanceof CSSTransition && each.finish());
    const areReached = [...document.querySelectorAll(".bd-article :is(pre, .pst-scrollable-table-container)")]
      .every((each) => (each.tabIndex === 0) === (each.scrollWidth > each.clientWidth));
    const now = performance.now();
    if (areReached || now > begin + 3000) return settled();
    if (now > again) window.dispatchEvent(new Event("resize")), (again = now + 1000);
    setTimeout(look, 50);
  };
  look();
})"""
"""Give the colours of a scheme, and wait until the keyboard reaches what scrolls, only; if it never does, axe says so.

The theme sees to the latter 300 ms after the window has changed, once; a busy machine may not have laid the page out.
"""

IS_DRAWN = "() => new Promise(drawn => requestAnimationFrame(() => requestAnimationFrame(drawn)))"


def problems_of(page, width, scheme):
    """What is wrong with a page as it is shown now."""
    found = []
    if page.evaluate(SIDEWAYS) > 0:
        found.append(f"wider than the {width}")
    if page.evaluate("document.documentElement.dataset.theme") != scheme:
        found.append(f"not {scheme}")
    return found


def violations_of(page):
    """What a screen reader or the keyboard cannot use on a page, by axe: the rule, how often, and the first element."""
    axe = tool("axe_playwright_python.sync_playwright").Axe()
    options = {"resultTypes": ["violations"], "preload": False, "iframes": False}
    found = axe.run(page, options=options).response["violations"]
    return [f"{each['id']} ({len(each['nodes'])}): {each['nodes'][0]['html'][:120]}" for each in found]


LOOKS = (("light", "desktop"), ("dark", "phone"))


@pytest.mark.parametrize("which", ["notebooks/*/10_turtlebot3.html", *nightly("*.html", "book/**/*.html", *PARTS)])
def test_each_page_opens_with_an_empty_console(book_html, chromium, watch, shared_tmp, which):
    """A page is seen in both schemes and both widths, and axe finds nothing that hinders a reader.

    Pages take turns in what is there when they load and what comes when the reader's system and window change: each
    kind of figure is on many pages.
    """
    screenshots = shared_tmp / "screenshots"
    screenshots.mkdir(exist_ok=True)
    pages = sorted(path for path in book_html.glob(which) if "_static" not in path.parts)
    assert pages
    sizes = {name: dict(zip(("width", "height"), size, strict=True)) for name, size in WIDTHS.items()}
    context = chromium.new_context()
    page = context.new_page()  # one for all: to open it costs as much as to load a chapter
    watcher = watch(page)
    problems = []

    def look(scheme, width):
        page.emulate_media(color_scheme=scheme)
        page.set_viewport_size(sizes[width])

    for i, path in enumerate(pages):
        name = path.relative_to(book_html).with_suffix("").as_posix()
        first, second = LOOKS if i % 2 else LOOKS[::-1]
        look(*first)
        page.goto(path.as_uri(), wait_until="load")
        page.wait_for_function("document.readyState === 'complete'")
        for scheme, width in (first, second):
            look(scheme, width)
            page.evaluate(IS_DRAWN)
            problems += [f"{name}: {each}" for each in problems_of(page, width, scheme)]
            if page.url.startswith(path.as_uri()):  # no page that leads to another one
                page.evaluate(SETTLES)
                problems += [f"{name}, {scheme}: {each}" for each in violations_of(page)]
            if IS_SHOT and scheme == "light":
                page.screenshot(path=screenshots / f"{name.replace('/', '_')}.png", full_page=True)
        problems += [f"{name}: {seen}" for seen in watcher.seen]
        watcher.seen.clear()
    context.close()
    assert problems == []


@pytest.mark.parametrize("by", ["keys", *nightly("thumb")])
def test_the_robot_on_the_cover_is_driven(book_html, chromium, watch, by):
    width, height = WIDTHS["desktop" if by == "keys" else "phone"]
    context = chromium.new_context(viewport={"width": width, "height": height}, has_touch=by == "thumb")
    page = context.new_page()
    watcher = watch(page)
    page.clock.install(time=0)
    page.goto((book_html / "book" / "intro.html").as_uri())
    page.locator(".rp-stage").wait_for()
    page.clock.pause_at(60_000)
    if by == "keys":
        page.locator(".rp-stage").click()
        for _ in range(9):
            page.keyboard.press("w")
    else:
        for _ in range(9):
            page.locator("[data-key=w]").tap()
    page.clock.run_for(3_000)
    assert "x: 0.09" in page.locator(".rp-log").first.inner_text()
    assert "x 0.00 m" not in page.locator(".rp-readings .rp-value").first.inner_text()
    assert watcher.seen == []
    context.close()


def test_the_films_on_the_cover_can_be_paused(book_html, chromium):
    context = chromium.new_context()
    page = context.new_page()
    page.goto((book_html / "book" / "intro.html").as_uri())
    states = """() => document.querySelector(".films").getAnimations({subtree: true}).map((each) => each.playState)"""
    assert set(page.evaluate(states)) == {"running"}
    page.locator("#pause-films").check()
    assert set(page.evaluate(states)) == {"paused"}
    page.emulate_media(reduced_motion="reduce")
    assert page.evaluate(states) == []
    context.close()


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


SMALLEST_TEXT = """(picture) => picture.naturalWidth ? 13.9 * picture.width / picture.naturalWidth  // of matplotlib
: Math.min(...Array.from(picture.querySelectorAll("text, tspan"), (text) => {
  const {a, b, c, d} = text.getScreenCTM() ?? {};
  return parseFloat(getComputedStyle(text).fontSize) * Math.sqrt(Math.abs(a * d - b * c)) || Infinity;
}))"""
UNREADABLE = f"""() => [...document.querySelectorAll(".bd-article :is(svg[role=img], .cell_output img)")].filter(
  (svg) => svg.checkVisibility() && !svg.closest("[data-mounted]") && ({SMALLEST_TEXT})(svg) < 9
    && !svg.nextElementSibling?.checkVisibility()).length"""
"""How many pictures have text below 9 px and no button."""


@pytest.fixture
def phone(chromium, watch):
    context = chromium.new_context(viewport=dict(zip(("width", "height"), WIDTHS["phone"], strict=True)))
    page = context.new_page()
    watcher = watch(page)
    yield page
    assert watcher.seen == []
    context.close()


@pytest.mark.parametrize("which", ["notebooks/8_use_cases/40_many_turtlebots.html", *nightly("**/*.html")])
def test_pictures_with_text_below_nine_pixels_open_in_a_larger_view(book_html, phone, which):
    opened = 0
    for path in sorted(path for path in book_html.glob(which) if "_static" not in path.parts):
        if 'http-equiv="refresh"' in path.read_text(encoding="utf-8").lower():
            continue  # it leads to another page
        phone.goto(path.as_uri())
        phone.evaluate(IS_DRAWN)
        assert phone.evaluate(UNREADABLE) == 0, path
        for button in phone.locator("button.larger:visible").all():
            button.press("Enter")
            assert phone.locator(".larger-view :is(svg, img)").first.evaluate(SMALLEST_TEXT) >= 9, path
            phone.keyboard.press("Escape")
            phone.wait_for_function("document.activeElement.matches(':is(svg, img) + button.larger')")
            opened += 1
    assert opened


def test_a_click_opens_a_picture_too_and_no_button_is_printed_or_on_a_desktop(book_html, phone):
    phone.goto((book_html / "book" / "ros.html").as_uri())
    dialog, button = phone.get_by_role("dialog", name="Larger view"), phone.locator("button.larger").first
    phone.locator("svg.opens").first.click()
    assert dialog.get_by_role("group", name="Figure 1: Twenty years of ROS").is_visible()
    dialog.get_by_role("button", name="Close").click()
    dialog.wait_for(state="hidden")
    assert button.is_visible()
    phone.emulate_media(media="print")
    assert not button.is_visible()
    phone.emulate_media(media="screen")
    phone.set_viewport_size({"width": 1280, "height": 900})
    button.wait_for(state="hidden")


@pytest.mark.parametrize("paper", ["A4", "Letter"])
def test_the_cheat_sheet_prints_on_one_page(book_html, chromium, paper):
    page = chromium.new_page()
    page.goto((book_html / "book" / "cheat_sheet.html").as_uri())
    assert page.pdf(format=paper).count(b"/Type /Page\n") == 1
    page.close()
