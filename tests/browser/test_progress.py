"""The page "Your progress": what was read and solved is ticked, exported, imported and cleared, without a network."""

import json

import pytest

from .test_book_pages import violations_of

pytestmark = pytest.mark.browser

READ = "notebooks/2_graph/60_names"


@pytest.fixture
def phone(chromium, watch):
    context = chromium.new_context(viewport={"width": 390, "height": 844})
    page = context.new_page()
    watcher = watch(page)
    yield page
    assert watcher.seen == []
    context.close()


def ticked(page):
    """The names of the pages and exercises that are ticked."""
    return page.evaluate("Array.from(document.querySelectorAll(':checked'), (box) => Object.values(box.dataset)[0])")


def test_ticks_are_kept_exported_cleared_and_imported(book_html, phone, tmp_path):
    progress = (book_html / "book" / "progress.html").as_uri()
    phone.goto((book_html / f"{READ}.html").as_uri())
    phone.goto(progress)
    assert ticked(phone) == []  # the page was opened, and its end not seen
    phone.goto((book_html / f"{READ}.html").as_uri())
    phone.locator("footer.prev-next-footer").scroll_into_view_if_needed()
    phone.wait_for_function("localStorage.getItem('rosmini-progress')")
    phone.goto(progress)
    phone.locator("[data-exercises=gentle]").press("Space")
    phone.reload()
    assert set(ticked(phone)) == {READ, "gentle"}
    with phone.expect_download() as download:
        phone.get_by_role("button", name="Export").press("Enter")
    exported = tmp_path / "progress.json"
    download.value.save_as(exported)
    assert {kind: list(names) for kind, names in json.loads(exported.read_text(encoding="utf-8")).items()} == {
        "pages": [READ],
        "exercises": ["gentle"],
    }
    phone.on("dialog", lambda dialog: dialog.accept())
    phone.get_by_role("button", name="Clear").press("Enter")
    assert ticked(phone) == []
    phone.locator("#progress-tools [type=file]").set_input_files(exported)
    phone.wait_for_function("document.querySelectorAll(':checked').length == 2")
    assert "1 of " in phone.get_by_role("status").inner_text()


@pytest.mark.parametrize("text", ["no JSON", "{}", '{"pages": {"a": 1}, "exercises": {}}', '{"pages": null}'])
def test_a_file_of_something_else_changes_nothing(book_html, phone, text):
    phone.goto((book_html / "book" / "progress.html").as_uri())
    phone.locator("[data-exercises=gentle]").check()
    file = {"name": "other.json", "mimeType": "application/json", "buffer": text.encode()}
    phone.locator("#progress-tools [type=file]").set_input_files(file)
    phone.get_by_role("status").get_by_text("other.json").wait_for()
    assert ticked(phone) == ["gentle"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_fits_a_phone_and_axe_finds_nothing(book_html, phone, scheme):
    phone.emulate_media(color_scheme=scheme)
    phone.goto((book_html / "book" / "progress.html").as_uri())
    assert phone.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert violations_of(phone) == []


def test_it_says_so_where_the_browser_keeps_nothing(book_html, chromium):
    context = chromium.new_context()
    page = context.new_page()
    page.add_init_script("Storage.prototype.setItem = () => { throw new DOMException('full'); }")
    page.goto((book_html / "book" / "progress.html").as_uri())
    page.locator("[data-exercises=gentle]").check()
    assert ticked(page) == ["gentle"]
    assert "keeps nothing" in page.get_by_role("status").inner_text()
    context.close()
