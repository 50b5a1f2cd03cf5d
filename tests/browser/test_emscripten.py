"""The graph on Emscripten: in Pyodide and a real browser, nodes block, and the page's events arrive meanwhile.

ROSMINI_PYODIDE names the folder of npm's package `pyodide`. No registry has Pyodide's numpy; the graph needs none.
"""

import pytest

from book.tools.run_in_page import write_packages

PAGE = "http://rosmini.test/"

START = """async () => {
    const script = document.createElement("script");
    script.src = "pyodide.js";
    const loaded = new Promise((done) => { script.onload = done; });
    document.head.append(script);
    await loaded;
    const pyodide = await loadPyodide({ indexURL: location.href });
    const packages = await (await fetch("packages.zip")).arrayBuffer();
    pyodide.unpackArchive(packages, "zip", { extractDir: "/packages" });
    await pyodide.runPythonAsync("import sys; sys.path.insert(0, '/packages')");
    globalThis.run = (program) => pyodide.runPythonAsync(program);
}"""

TWO_NODES_THAT_BLOCK = """
from rosmini import Graph
from rosmini.msgs.std_msgs.msg import String

graph = Graph()
talker, listener = graph.node("talker"), graph.node("listener")
publisher = talker.publisher("chatter", String, latch=True)
heard = []

def talk():
    rate = talker.rate(10)
    for number in range(4):
        publisher.publish(String(f"hello {number}"))
        rate.sleep()

def listen():
    for _ in range(3):
        heard.append(listener.wait_for_message("chatter", String).data)
        listener.sleep(0.1)

talker.spawn("talk", talk)
listener.spawn("listen", listen)
graph.run(3)
", ".join(heard)
"""

AN_EVENT_DURING_A_WAIT = """
from js import setTimeout
from pyodide.ffi import create_once_callable
from rosmini import Graph

graph = Graph(simulated=False)
waiter = graph.scheduler.waiter("a key")

def press():
    graph.scheduler.call_soon_threadsafe(lambda: waiter.wake("left"))

setTimeout(create_once_callable(press), 0)
graph.node("pad").wait(waiter)
waiter.value
"""

AN_INTERRUPT_OF_AN_ENDLESS_RUN = """
import signal
from js import setTimeout
from pyodide.ffi import create_once_callable
from rosmini import Graph

graph = Graph()
graph.node("clock").timer(0.001, lambda event: None)
setTimeout(create_once_callable(lambda: signal.raise_signal(signal.SIGINT)), 0)
try:
    graph.run(1e9)
except KeyboardInterrupt:
    ended = "interrupted"
ended
"""

WORK_BEFORE_A_LIVE_GRAPH = """
from rosmini import Graph

graph, done = Graph(), []
graph.before_live(lambda: done.append("compiled"))
graph.live()
graph.run(1)
graph.live().stop()
", ".join(done)
"""

A_CALL_THAT_MAY_NOT_BLOCK = """
from pyodide.code import run_js
from rosmini import Graph, RosminiError

graph = Graph()

def block():
    try:
        graph.run(1)
    except RosminiError as error:
        return str(error)

run_js("(function_) => function_()")(block)
"""


@pytest.fixture(scope="module")
def page(chromium, pyodide, tmp_path_factory):
    """A page in which Pyodide has loaded the library, with the function `run`."""
    folder = tmp_path_factory.mktemp("pyodide")
    write_packages(folder / "packages.zip")

    def answer(route):
        name = route.request.url.removeprefix(PAGE)
        if not name:
            route.fulfill(body="<!doctype html><title>Pyodide</title>", content_type="text/html")
        else:
            route.fulfill(path=(folder if name == "packages.zip" else pyodide) / name)

    context = chromium.new_context()
    context.route(f"{PAGE}**", answer)
    page = context.new_page()
    page.goto(PAGE)
    page.evaluate(START)
    yield page
    context.close()


def test_code_that_blocks_is_suspended_and_continued(page):
    assert page.evaluate("run", TWO_NODES_THAT_BLOCK) == "hello 0, hello 1, hello 2"


def test_the_page_s_events_arrive_during_a_wait(page):
    assert page.evaluate("run", AN_EVENT_DURING_A_WAIT) == "left"


def test_an_interrupt_ends_a_run_in_simulated_time(page):
    assert page.evaluate("run", AN_INTERRUPT_OF_AN_ENDLESS_RUN) == "interrupted"


def test_work_for_a_helper_thread_is_done_without_one(page):
    assert page.evaluate("run", WORK_BEFORE_A_LIVE_GRAPH) == "compiled"


def test_a_call_from_javascript_that_may_not_block_is_refused(page):
    assert "cannot suspend" in page.evaluate("run", A_CALL_THAT_MAY_NOT_BLOCK)
