"""Where the book's sources and the tools of those who write it are: in a checkout, not in the installed package."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from rosmini.errors import RosminiError


class NoCheckout(RosminiError):
    """The book's sources were not found."""


def find_checkout() -> Path:
    """The checkout around the current folder, else the one that rosmini itself runs from.

    Raises `NoCheckout` if neither has `book/_config.yml` and `notebooks/`, as in an installed wheel.
    """
    here = Path.cwd()
    for folder in (here, *here.parents, Path(__file__).resolve().parents[2]):
        if (folder / "book" / "_config.yml").is_file() and (folder / "notebooks").is_dir():
            return folder
    raise NoCheckout(
        f"the book's sources (book/_config.yml and notebooks/) are neither in {here} nor in a folder above it. "
        "The installed package does not carry them: clone the repository, and run the command inside the clone"
    )


def make_importable(folder: Path) -> None:
    """Let Python import what is in `folder` of a checkout."""
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))


def has_display() -> bool:
    """Whether a browser opened from here would be seen."""
    if os.environ.get("CI"):
        return False
    if sys.platform in {"win32", "darwin"}:
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
