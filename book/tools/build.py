"""Builds the book as static HTML from the notebooks' stored outputs."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from rosmini.core.errors import RosminiError

PLACES = [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Google\Chrome\Application\chrome.exe",
]
"""Where macOS and Windows have a browser, which is on no search path there."""


class BookError(RosminiError):
    """The book could not be built."""


def build_book(checkout: Path, output: Path | None = None, *, quiet: bool = True) -> Path:
    """Build the book of `checkout` below `output` (default: its `book` folder); the path of its first page.

    No notebook is executed: the pages show the outputs stored in them. A warning is an error.
    Raises `BookError` if Jupyter Book is not installed or the build fails.
    """
    if not _has_jupyter_book():
        raise BookError(
            "Jupyter Book is not installed in this environment; run `uv run rosmini book` in the checkout, "
            "or `pip install -e '.[book]'` first"
        )
    build = (output or checkout / "book") / "_build"
    # Sphinx keeps the pages of earlier builds, and would miss a change in our own extension.
    for stale in ("html", ".doctrees", ".jupyter_cache"):
        shutil.rmtree(build / stale, ignore_errors=True)
    done = _jupyter_book(checkout, build.parent, quiet=quiet)
    first = build / "html" / "index.html"
    if done.returncode or not first.is_file():
        if quiet:
            print(done.stdout, file=sys.stderr)
        raise BookError(
            f"the book was not built (Jupyter Book ended with status {done.returncode}); its messages are above"
        )
    return first


def _jupyter_book(checkout: Path, output: Path, *, quiet: bool) -> subprocess.CompletedProcess[str]:
    """Run Jupyter Book in a process of its own: it changes `sys.path`, locale and logging of the one it runs in."""
    command = [sys.executable, "-c", "from jupyter_book.cli.main import main; main()", "build", str(checkout)]
    for option, value in (("config", "book/_config.yml"), ("toc", "book/_toc.yml")):
        command += [f"--{option}", str(checkout / value)]
    command += ["--path-output", str(output), "-W", "-n", "--keep-going"]
    return subprocess.run(
        command,
        cwd=checkout,
        env=os.environ | {"PYTHONUTF8": "1", "PYDEVD_DISABLE_FILE_VALIDATION": "1"},
        check=False,
        stdout=subprocess.PIPE if quiet else None,
        stderr=subprocess.STDOUT if quiet else None,
        encoding="utf-8",
        errors="replace",
    )


def has_display() -> bool:
    """Whether a browser opened from here would be seen."""
    if os.environ.get("CI"):
        return False
    if sys.platform in {"win32", "darwin"}:
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def find_chromium() -> str:
    """Return the path of Chromium or Chrome: `ROSMINI_CHROMIUM`, or one on the search path, or in its usual place.

    Raises `BookError` if there is none.
    """
    names = ("chromium", "chromium-browser", "google-chrome", "chrome", "msedge")
    given = os.environ.get("ROSMINI_CHROMIUM")
    found = [given] if given else [*filter(None, map(shutil.which, names)), *PLACES]
    path = next(filter(os.path.isfile, found), None)
    if path is None:
        raise BookError(
            "a PDF is printed by Chromium or Chrome, and neither was found. Install one, for instance with "
            "`apt install chromium`, or set ROSMINI_CHROMIUM to the path of its program"
        )
    return path


def _has_jupyter_book() -> bool:
    from importlib.util import find_spec

    return find_spec("jupyter_book") is not None
