"""Builds the book as static HTML from the notebooks' stored outputs."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from rosmini.errors import RosminiError


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
    target = (output or checkout / "book") / "_build"
    # Sphinx keeps pages and notebooks of earlier builds, and would miss a change in our own extension.
    shutil.rmtree(target, ignore_errors=True)
    command = [sys.executable, "-m", "jupyter_book", "build", str(checkout)]
    command += [
        "--config",
        str(checkout / "book" / "_config.yml"),
        "--toc",
        str(checkout / "book" / "_toc.yml"),
    ]
    command += ["--path-output", str(target.parent), "-W", "-n", "--keep-going"]
    command += ["-q"] if quiet else []
    environment = os.environ | {"PYTHONIOENCODING": "utf-8", "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    done = subprocess.run(command, cwd=checkout, env=environment, check=False)
    first = target / "html" / "index.html"
    if done.returncode or not first.is_file():
        raise BookError(
            f"the book was not built (Jupyter Book ended with status {done.returncode}); its messages are above"
        )
    return first


def has_display() -> bool:
    """Whether a browser opened from here would be seen."""
    if os.environ.get("CI"):
        return False
    if sys.platform in {"win32", "darwin"}:
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _has_jupyter_book() -> bool:
    from importlib.util import find_spec

    return find_spec("jupyter_book") is not None
