"""A headless Chromium, a watcher that reports what a page says, raises and fetches, and a JupyterLab."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

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


def chromium_path() -> str | None:
    """Where Chromium is: `ROSMINI_CHROMIUM`, or on the search path."""
    given = os.environ.get("ROSMINI_CHROMIUM")
    if given:
        return given if Path(given).is_file() else None
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@pytest.fixture(scope="session")
def chromium():
    """The browser; skips without one, and fails if ROSMINI_REQUIRE_BROWSER=1."""
    from playwright.sync_api import sync_playwright

    path = chromium_path()
    if path is None:
        message = "no Chromium: install it, or name it in ROSMINI_CHROMIUM"
        if os.environ.get("ROSMINI_REQUIRE_BROWSER") == "1":
            pytest.fail(f"{message} (ROSMINI_REQUIRE_BROWSER=1)")
        pytest.skip(message)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


class Watcher:
    """What `page` wrote to the console, raised, and asked for outside of file://."""

    def __init__(self, page) -> None:
        self.seen: list[str] = []
        page.on("console", lambda message: self.seen.append(f"console {message.type}: {message.text}"))
        page.on("pageerror", lambda error: self.seen.append(f"error: {error}"))
        page.on("requestfailed", lambda request: self.seen.append(f"failed: {request.url}"))
        page.on("request", self.request)

    def request(self, request) -> None:
        if not request.url.startswith(("file:", "data:", "blob:")):
            self.seen.append(f"request: {request.url}")


@pytest.fixture
def watch():
    return Watcher


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


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


@contextmanager
def jupyterlab(tmp_path, cells):
    """Run a JupyterLab with `live.ipynb`, with settings and runtime files of its own; its end is the kernel's."""
    (tmp_path / "work").mkdir()
    (tmp_path / "work" / "live.ipynb").write_text(json.dumps(notebook(cells)), encoding="utf-8")
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
    with (tmp_path / "lab.log").open("wb") as log:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *arguments],
            env=os.environ | own,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
    address = f"http://127.0.0.1:{port}"
    try:
        for _ in range(300):
            try:
                urllib.request.urlopen(f"{address}/api?token={TOKEN}", timeout=5).close()
                break
            except OSError:
                assert server.poll() is None, (tmp_path / "lab.log").read_text()
                time.sleep(0.1)
        yield f"{address}/lab/tree/live.ipynb?token={TOKEN}"
    finally:
        server.terminate()
        try:
            server.wait(20)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()


@pytest.fixture
def start_lab(tmp_path):
    """Start a JupyterLab with a notebook of the given cells; return the notebook's address."""
    with ExitStack() as stack:
        yield lambda cells: stack.enter_context(jupyterlab(tmp_path, cells))


@pytest.fixture(scope="session")
def webgl(chromium):
    """A browser of its own that draws in three dimensions, in software."""
    flags = [flag for flag in FLAGS if flag != "--disable-gpu"]
    flags += ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    browser = chromium.browser_type.launch(executable_path=chromium_path(), args=flags)
    yield browser
    browser.close()
