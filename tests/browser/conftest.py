"""A headless Chromium, and a watcher that reports what a page says, raises and fetches."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

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
