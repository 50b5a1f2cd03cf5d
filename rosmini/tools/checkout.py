"""Finds the book's sources, for commands that need a checkout rather than the installed package."""

from __future__ import annotations

from pathlib import Path

from rosmini.core.errors import RosminiError


class NoCheckout(RosminiError):
    """The book's sources were not found."""


def find_checkout() -> Path:
    """Return the checkout around the current folder, or the one that contains the running rosmini.

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
