"""The graph on Emscripten: in Pyodide and a real browser, nodes block, and the page's events arrive meanwhile.

ROSMINI_PYODIDE names the folder of npm's package `pyodide`. No registry has Pyodide's numpy; the graph needs none.
"""

import os
from importlib.metadata import distribution
from pathlib import Path
from zipfile import ZipFile

import pytest

PAGE = "http://rosmini.test/"

PURE = ["catkin-pkg", "defusedxml", "docutils", "h11", "packaging", "pyparsing", "python-dateutil", "PyYAML"]

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


def packages(archive, root):
    """Store the library of the checkout and the pure Python packages that it needs, as Pyodide unpacks them."""
    with ZipFile(archive, "w") as file:
        for folder, name in ((root / "rosmini", "rosmini"), (root / "assets", "rosmini/_assets")):
            for path in folder.rglob("*"):
                if path.suffix in (".py", ".msg", ".srv", ".action", ".xml"):
                    file.write(path, f"{name}/{path.relative_to(folder).as_posix()}")
        for name in PURE:
            for path in distribution(name).files:
                if path.suffix == ".py":
                    file.write(path.locate(), path.as_posix())


@pytest.fixture(scope="module")
def page(chromium, root, tmp_path_factory):
    """A page in which Pyodide has loaded the library, with the function `run`."""
    core = os.environ.get("ROSMINI_PYODIDE")
    if core is None:
        message = "ROSMINI_PYODIDE names no folder of npm's package pyodide"
        if os.environ.get("ROSMINI_REQUIRE_BROWSER") == "1":
            pytest.fail(f"{message} (ROSMINI_REQUIRE_BROWSER=1)")
        pytest.skip(message)
    folder = tmp_path_factory.mktemp("pyodide")
    packages(folder / "packages.zip", root)

    def answer(route):
        name = route.request.url.removeprefix(PAGE)
        if not name:
            route.fulfill(body="<!doctype html><title>Pyodide</title>", content_type="text/html")
        else:
            route.fulfill(path=(folder if name == "packages.zip" else Path(core)) / name)

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


def test_a_call_from_javascript_that_may_not_block_is_refused(page):
    assert "cannot suspend" in page.evaluate("run", A_CALL_THAT_MAY_NOT_BLOCK)
