"""A headless Chromium, a watcher that reports what a page says, raises and fetches, and a JupyterLab."""

import json
import os
import re
import sys
from contextlib import contextmanager
from pathlib import Path
from urllib.request import Request, urlopen

import numpy as np
import pytest

from book.tools.build import BookError, find_chromium
from rosmini import Graph
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.sim.recorder import Recorder
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import World

from ..conftest import tool
from ..processes import PATIENCE, free_port, listens, start, wait_until

TOKEN = "rosmini-test"

# Started like this it opens no connection of its own.
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def chromium_path():
    """Where Chromium or Chrome is, if anywhere."""
    try:
        return find_chromium()
    except BookError:
        return None


def launched(kind, flags):
    """A browser whose pages wait as long as all tests do.

    It ends with the process of the tests, whose pipe it reads: Playwright has waited for ever for the answer to `close`
    at the end of a whole run, with the browser gone.
    """
    browser = kind.launch(executable_path=chromium_path(), args=flags, timeout=PATIENCE * 1000)
    browser.on("context", lambda context: context.set_default_timeout(PATIENCE * 1000))
    return browser


@pytest.fixture(scope="session")
def chromium():
    """The browser; skips without one, and fails if ROSMINI_REQUIRE_BROWSER=1."""
    playwright = tool("playwright.sync_api")
    if chromium_path() is None:
        message = "no Chromium: install it, or name it in ROSMINI_CHROMIUM"
        if os.environ.get("ROSMINI_REQUIRE_BROWSER") == "1":
            pytest.fail(f"{message} (ROSMINI_REQUIRE_BROWSER=1)")
        pytest.skip(message)
    return launched(playwright.sync_playwright().start().chromium, FLAGS)


class Watcher:
    """What `page` wrote to the console, raised, and asked for outside of file://."""

    def __init__(self, page):
        self.seen = []
        page.on("console", self.console)
        page.on("pageerror", self.raised)
        page.on("requestfailed", self.failed)
        page.on("request", self.request)
        self.page = page

    def end(self):
        """Leave the page, which another test may have then; return what was seen."""
        self.page.goto("about:blank")
        self.page.remove_listener("console", self.console)
        self.page.remove_listener("pageerror", self.raised)
        self.page.remove_listener("requestfailed", self.failed)
        self.page.remove_listener("request", self.request)
        return self.seen

    def raised(self, error):
        self.seen.append(f"error: {error}")

    def console(self, message):
        # Reading a picture back out of a software renderer, as a screenshot does, is slow, and it says so.
        if "GPU stall due to ReadPixels" not in message.text:
            self.seen.append(f"console {message.type}: {message.text}")

    def failed(self, request):
        if request.failure != "net::ERR_ABORTED":  # what a page still loads when it is left
            self.seen.append(f"failed: {request.url}")

    def request(self, request):
        if not request.url.startswith(("file:", "data:", "blob:")):
            self.seen.append(f"request: {request.url}")


@pytest.fixture(scope="session")
def watch():
    return Watcher


class Tabs:
    """Pages of a browser that are used again: a new one is a new process, and costs more than most tests do in it.

    A page that was left has nothing of what was in it before. What stays with a page or its context does not come
    here: scripts that it starts with, a clock of the tests' own.
    """

    def __init__(self, browser):
        self.browser = browser
        self.free = {}

    @contextmanager
    def open(self, viewport, **options):
        """A page of this size for as long as the block lasts, with what it says; a context's other options are kept."""
        free = self.free.setdefault(repr(sorted(options.items())), [])
        page = free.pop() if free else self.browser.new_context(viewport=viewport, **options).new_page()
        page.set_viewport_size(viewport)
        watcher = Watcher(page)
        yield page, watcher
        page.mouse.move(0, 0)
        page.emulate_media(media="null")
        watcher.end()
        free.append(page)
        assert watcher.seen == []


@pytest.fixture(scope="session")
def tabs(chromium):
    """Pages of the browser, to be used again."""
    return Tabs(chromium)


def notebook(cells):
    return {
        "cells": [
            {
                "cell_type": "code",
                "execution_count": None,
                "id": f"c{i}",
                "metadata": {},
                "outputs": [],
                "source": source.strip(),
            }
            for i, source in enumerate(cells)
        ],
        "metadata": {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }


@pytest.fixture(scope="session")
def jupyterlab(tmp_path_factory):
    """A JupyterLab with settings and runtime files of its own: its folder and its address."""
    tmp_path = tmp_path_factory.mktemp("lab")
    (tmp_path / "work").mkdir()
    port = free_port()
    own = {
        name: str(tmp_path / name.lower())
        for name in (
            "JUPYTER_CONFIG_DIR",
            "JUPYTER_DATA_DIR",
            "JUPYTER_RUNTIME_DIR",
            "JUPYTERLAB_SETTINGS_DIR",
            "JUPYTERLAB_WORKSPACES_DIR",
            "IPYTHONDIR",
        )
    }
    tool("jupyterlab")
    arguments = [
        f"--ServerApp.root_dir={tmp_path / 'work'}",
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
        f"--IdentityProvider.token={TOKEN}",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
        "--no-browser",
        "--allow-root",
    ]
    with (
        (tmp_path / "lab.log").open("wb") as log,
        start([sys.executable, "-m", "jupyterlab", *arguments], env=os.environ | own, stdout=log, stderr=log) as server,
    ):
        wait_until(lambda: listens(port), "JupyterLab", server)
        try:
            yield tmp_path / "work", f"http://127.0.0.1:{port}"
        finally:
            server.terminate()  # its kernels, which lead sessions of their own, end with it
            server.wait(PATIENCE)


@pytest.fixture
def open_in_lab(jupyterlab):
    """Write a notebook of the given cells and return its address in JupyterLab; its kernel ends with the test."""
    folder, server = jupyterlab

    def open_in_lab(cells):
        name = f"live{len(list(folder.iterdir()))}"
        (folder / f"{name}.ipynb").write_text(json.dumps(notebook(cells)), encoding="utf-8")
        # A workspace of its own opens no notebook of a test before.
        return f"{server}/lab/workspaces/{name}/tree/{name}.ipynb?token={TOKEN}"

    def ask(method, path):
        headers = {"Authorization": f"token {TOKEN}"}
        with urlopen(Request(f"{server}/api/{path}", method=method, headers=headers)) as answer:
            return answer.read()

    yield open_in_lab
    for kernel in json.loads(ask("GET", "kernels")):
        ask("DELETE", f"kernels/{kernel['id']}")


class Lab:
    """A page with a notebook open in JupyterLab, and its kernel idle."""

    def __init__(self, page, address, cells):
        self.page = page
        page.goto(address)
        self.cells = page.locator(".jp-Notebook .jp-CodeCell")
        self.cells.nth(len(cells) - 1).wait_for()
        page.locator("#jp-main-statusbar", has_text="| Idle").wait_for()

    def run(self, number):
        cell = self.cells.nth(number)
        cell.locator(".jp-InputArea-editor").click()
        self.page.keyboard.press("Control+Enter")
        cell.locator(".jp-InputPrompt", has_text=re.compile(r"\[[*\d]+\]")).first.wait_for()

    def says(self, number, text):
        self.cells.nth(number).locator(".jp-OutputArea-output", has_text=text).first.wait_for()


@pytest.fixture
def open_lab(open_in_lab, chromium, shared_tmp, request):
    """Open a notebook of the given cells; in the end there is a picture of the page."""
    page = chromium.new_page(viewport={"width": 1280, "height": 1500})
    yield lambda cells: Lab(page, open_in_lab(cells), cells)
    page.screenshot(path=shared_tmp / f"{request.function.__name__}.png", full_page=True)
    page.close()


@pytest.fixture(scope="session")
def pyodide():
    """The folder of npm's package `pyodide`; skips without it, and fails if ROSMINI_REQUIRE_BROWSER=1."""
    folder = os.environ.get("ROSMINI_PYODIDE")
    if folder is None:
        message = "ROSMINI_PYODIDE names no folder of npm's package pyodide"
        if os.environ.get("ROSMINI_REQUIRE_BROWSER") == "1":
            pytest.fail(f"{message} (ROSMINI_REQUIRE_BROWSER=1)")
        pytest.skip(message)
    return Path(folder)


@pytest.fixture(scope="session")
def webgl(chromium):
    """A browser of its own that draws in three dimensions, in software."""
    flags = [flag for flag in FLAGS if flag != "--disable-gpu"]
    flags += ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    return launched(chromium.browser_type, flags)


@pytest.fixture(scope="session")
def solid_tabs(webgl):
    """Pages that draw in three dimensions, to be used again."""
    return Tabs(webgl)


SQUARE = World("square", walls=np.array([(-2, -2, 2, -2), (2, -2, 2, 2), (2, 2, -2, 2), (-2, 2, -2, -2)], dtype=float))


@pytest.fixture(scope="session")
def turning():
    """Four seconds of a Burger that turns as fast as it can in a square of 4 m; from 1 s on it has its full speed."""
    with Graph() as graph:
        for name, value in (("noise", 0.0), ("x", 0.4), ("y", -0.3)):
            graph.master.setParam("/test", f"/simulator/{name}", value)
        recorder = Recorder(graph, Simulator(graph.node("simulator"), world=SQUARE))
        publisher = graph.node("driver").publisher("cmd_vel", Twist)
        for _ in range(40):
            message = Twist()
            message.angular.z = 2.84
            publisher.publish(message)
            graph.run(0.1)
        return recorder.recording()


@pytest.fixture(scope="session")
def off_the_walls():
    """How far points (n, 2) are from the walls of that square [m]."""
    return lambda points: np.abs(np.abs(np.asarray(points)[:, :2]).max(axis=1) - 2)
