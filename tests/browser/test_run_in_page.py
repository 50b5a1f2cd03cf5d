"""The button *Run in this page*: the cells of a page run in the browser, and print what the book shows.

ROSMINI_PYODIDE names the folder of npm's package `pyodide`: its files are sent in place of the same ones on jsDelivr.
In the folder of Pyodide's full distribution, which has the packages, pages with packages are run as well.
"""

import json
from mimetypes import guess_type

import pytest

from book.tools import notebooks
from book.tools.pages import ASKS
from book.tools.run_in_page import PACKAGE_MB, PAGES
from book.tools.solutions import checks, solved

from .test_book_pages import SETTLES, violations_of

pytestmark = pytest.mark.browser

SITE = "http://book.test/"
CDN, PACKAGES = ASKS["run-worker.js"]
WITHOUT_NUMPY = [name for name, packages in PAGES.items() if not packages]
FIRST = WITHOUT_NUMPY[0]
CATKIN = "notebooks/4_files/50_catkin"
"""A page whose checks need no numpy either."""

DIFFERENT = {"notebooks/2_graph/50_parameter_server": {6}, "notebooks/5_turtlesim/30_motion_node": {4}}
"""Cells whose text differs: Python 3.13 marks other parts of a line in a traceback than the book's Python 3.11."""

PIXEL = (
    "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b550000"
    "000a49444154789c63f80f0001010100b138f6140000000049454e44ae426082"
)
"""A PNG."""

FROM_CDN = {"Access-Control-Allow-Origin": "*"}

TEXTS = """Array.from(document.querySelectorAll(".bd-article .cell"), (cell) =>
    Array.from(cell.querySelectorAll(".output > .highlight > pre"), (text) => text.textContent.trim()))"""

PANEL = """
%load_ext rosmini
%roscore
%rqt_logger_level
"""

LIVE = """
from rosmini import Graph
graph = Graph()
for number in range(20):
    graph.node(f"clock{number}").timer(0.001, lambda event: None)
print(graph.live())
"""

ENDLESS_CALLBACK = """
from rosmini import Graph
def spin(event):
    while True:
        pass
graph = Graph()
graph.node("clock").timer(0.001, spin)
print(graph.live())
"""

ENDLESS_RUN = """
from rosmini import Graph
graph = Graph()
graph.node("clock").timer(0.001, lambda event: None)
graph.run(1e9)
"""


@pytest.fixture(scope="module")
def served(chromium, book_html):
    """Open a page of the book as from a server; returns it and the addresses that it asks.

    The files of Pyodide come from the folder `pyodide`, if given; `change(name, body)` returns the body that is sent.
    """
    contexts = []

    def open_page(name, pyodide=None, change=lambda _, body: body):
        def send(route):
            file = pyodide / route.request.url.removeprefix(CDN)
            kind = guess_type(file.name)[0] or "application/octet-stream"
            body = change(file.name, file.read_bytes())
            route.fulfill(body=body, headers=FROM_CDN | {"Content-Type": kind})

        def send_package(route):
            file = pyodide / route.request.url.removeprefix(PACKAGES)
            body = file.read_bytes() if file.is_file() else b"not the package"
            route.fulfill(body=change(file.name, body), headers=FROM_CDN)

        def send_page(route):
            route.fulfill(path=book_html / route.request.url.removeprefix(SITE).partition("?")[0])

        context = chromium.new_context(viewport={"width": 1280, "height": 800})
        contexts.append(context)
        asked = []
        context.on("request", lambda request: asked.append(request.url))
        context.route("**/*", lambda route: route.abort())
        context.route(f"{SITE}**", send_page)
        if pyodide:
            context.route(f"{CDN}**", send)
            context.route(f"{PACKAGES}**", send_package)
        page = context.new_page()
        page.goto(f"{SITE}{name}.html")
        return page, asked

    yield open_page
    for context in contexts:
        context.close()


def early(asked):
    """What may be asked only after the button was pressed."""
    return [url for url in asked if "worker" in url or "packages" in url or not url.startswith(SITE)]


def press(page, name="Run in this page"):
    page.locator(".run-panel").get_by_role("button", name=name).click()


def wait_for(page, text):
    page.locator(".run-panel").get_by_role("status").get_by_text(text).wait_for()


def last_cell(page, source):
    """Give the last cell this code and start it."""
    cell = page.locator(".bd-article .cell").last
    cell.get_by_label("Code of cell").fill(source)
    cell.get_by_role("button", name="Run").click()
    return cell


@pytest.fixture(scope="module")
def running(served, pyodide):
    """The first page, with Python."""
    page, _ = served(FIRST, pyodide)
    press(page)
    wait_for(page, "Ready.")
    return page


@pytest.mark.nightly
@pytest.mark.parametrize("name", PAGES)
def test_all_cells_of_a_page_print_what_the_book_shows(served, pyodide, name):
    if missing := [package for package in PAGES[name] if not any(pyodide.glob(f"{package}-*.whl"))]:
        pytest.skip(f"npm's package pyodide has no {missing[0]}")
    page, asked = served(name, pyodide)
    stored = page.evaluate(TEXTS)
    assert not early(asked)
    press(page)
    wait_for(page, "Ready.")
    press(page, "Run all")
    wait_for(page, "Done.")
    numbers = range(1, len(stored) + 1)
    shown = zip(numbers, stored, page.evaluate(TEXTS), strict=True)
    marked = {number for number in numbers if page.locator(f".cell >> nth={number - 1} >> .run-differs").count()}
    assert {number for number, old, new in shown if old != new} == DIFFERENT.get(name, set()) == marked
    assert {url for url in asked if not url.startswith((SITE, CDN))} == {
        url for url in asked if url.startswith("blob:" + SITE)
    }


@pytest.mark.nightly
def test_the_solutions_of_a_page_pass_their_checks(served, pyodide, root):
    chapter = notebooks.read(root / f"{CATKIN}.ipynb")
    sources = [cell.source for cell in solved(chapter).cells if cell.cell_type == "code"]
    page, _ = served(CATKIN, pyodide)
    press(page)
    wait_for(page, "Ready.")
    for editor, source in zip(page.locator(".run-editor").all(), sources, strict=True):
        editor.evaluate("(editor, source) => { editor.value = source; }", source)
    press(page, "Run all")
    wait_for(page, "Done.")
    text = page.locator(".bd-article").inner_text()
    assert [exercise for exercise in checks(chapter) if f"Exercise {exercise}: right." not in text] == []


def test_an_edited_cell_is_run_and_the_difference_is_marked(running):
    cell = last_cell(running, "print('something else')")
    cell.get_by_text("The text differs from the output that the book shows.").wait_for()
    assert "something else" in cell.locator(".stream").inner_text()


def test_a_picture_is_shown_with_an_alternative_text(running):
    cell = last_cell(running, f"from IPython.display import Image\nImage(bytes.fromhex('{PIXEL}'))")
    cell.get_by_role("img", name="<IPython.core.display.Image object>").wait_for()
    assert cell.locator("img").evaluate("image => image.decode().then(() => image.naturalWidth)") == 1


def test_input_asks_below_the_cell(running):
    cell = last_cell(running, "print(input('Your name? ') + '!')")
    cell.get_by_label("Your name?").fill("Ada")
    cell.get_by_label("Your name?").press("Enter")
    cell.get_by_text("Ada!").wait_for()


@pytest.mark.parametrize("source", [ENDLESS_RUN, "input('Wait? ')"], ids=["run", "input"])
def test_a_cell_that_waits_is_stopped(running, source):
    cell = last_cell(running, source)
    if "input" in source:
        cell.get_by_label("Wait?").wait_for()
    cell.get_by_role("button", name="Stop").click()
    cell.get_by_text("KeyboardInterrupt").first.wait_for()


def test_a_panel_acts_on_the_graph(running):
    cell = last_cell(running, PANEL)
    cell.get_by_label("Node").select_option("/rosout")
    cell.get_by_role("cell", name="rosout", exact=True).wait_for()


def test_no_cell_begins_while_a_live_graph_is_driven(running):
    last_cell(running, LIVE).get_by_text("<live graph").wait_for()
    for number in range(5):
        cell = last_cell(running, f"print({number}, graph.is_live, graph.scheduler.driven)")
        cell.get_by_text(f"{number} True False").wait_for()
    last_cell(running, "graph.live().stop()\nprint('stopped')").get_by_text("stopped").wait_for()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_on_a_page_that_runs(running, scheme):
    running.emulate_media(color_scheme=scheme)
    running.evaluate(SETTLES)
    assert violations_of(running) == []


@pytest.mark.parametrize("before", ["", ENDLESS_CALLBACK], ids=["cell", "callback"])
def test_a_loop_that_never_waits_is_ended_by_restarting_python(running, before):
    last_cell(running, before)
    cell = last_cell(running, "while True: pass")
    cell.get_by_role("button", name="Stop").click()
    wait_for(running, "A loop that never waits ends only when Python is restarted.")
    cell.get_by_role("button", name="Restart Python").click()
    wait_for(running, "Python was restarted and all variables are gone. Ready.")
    last_cell(running, "print(6 * 7)").get_by_text("42").wait_for()


def test_a_cell_prints_what_the_book_shows(running):
    cell = running.locator(".bd-article .cell").first
    cell.get_by_role("button", name="Run").click()
    running.locator(".run-panel").get_by_role("button", name="Run all").wait_for()
    cell.get_by_text("started core service [/rosout]").wait_for()
    assert cell.locator(".run-differs").count() == 0


def test_a_file_of_pyodide_that_was_changed_is_refused(served, pyodide):
    page, _ = served(FIRST, pyodide, change=lambda name, body: body + b" " * (name == "pyodide-lock.json"))
    press(page)
    wait_for(page, f"Python ended: {CDN}pyodide-lock.json could not be loaded, or its content has changed")


def test_a_package_is_asked_for_when_it_is_imported_and_refused_if_it_was_changed(served, pyodide):
    page, asked = served(FIRST, pyodide, change=lambda name, body: body + b" " * name.endswith(".whl"))
    press(page)
    wait_for(page, "Ready.")
    assert not [url for url in asked if url.startswith(PACKAGES)]
    last_cell(page, "import numpy").get_by_text("ImportError: the package numpy could not be loaded").wait_for()
    lock = json.loads((pyodide / "pyodide-lock.json").read_text(encoding="utf-8"))
    file = lock["packages"]["numpy"]["file_name"]
    assert {url for url in asked if url.startswith(PACKAGES)} == {PACKAGES + file}


def test_the_button_says_how_much_is_loaded_before_anything_is(served):
    sizes = {}
    for name in (FIRST, "notebooks/1_start/10_first_steps"):
        page, asked = served(name)
        text = page.locator(".run-panel").get_by_role("status").inner_text()
        sizes[name] = int(text.partition("Loads ")[2].partition(" MB")[0])
        assert not early(asked)
    more = PACKAGE_MB["numpy"] + PACKAGE_MB["pillow"]
    assert sizes["notebooks/1_start/10_first_steps"] - sizes[FIRST] == pytest.approx(more, abs=1)  # both are rounded


def test_a_page_from_a_file_names_the_command_that_serves_the_book(book_html, tabs):
    with tabs.open({"width": 390, "height": 844}) as (page, _):
        page.goto((book_html / f"{FIRST}.html").as_uri())
        press(page)
        wait_for(page, "python -m http.server")
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_a_browser_that_cannot_suspend_python_is_told_so(served):
    page, asked = served(FIRST)
    page.evaluate("delete WebAssembly.Suspending")
    press(page)
    wait_for(page, "This browser cannot suspend Python")
    assert not early(asked)


def test_other_pages_have_no_button(book_html):
    with_button = [path for path in book_html.rglob("*.html") if "run.js" in path.read_text(encoding="utf-8")]
    assert {path.relative_to(book_html).with_suffix("").as_posix() for path in with_button} == set(PAGES)
