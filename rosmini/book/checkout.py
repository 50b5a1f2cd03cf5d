"""Where the sources of the book are."""

from __future__ import annotations

from pathlib import Path

from rosmini.errors import RosminiError


class NoCheckout(RosminiError):
    """The book's sources were not found."""


def is_checkout(folder: Path) -> bool:
    """Whether `folder` holds the sources of the book."""
    return (folder / "book" / "_config.yml").is_file() and (folder / "notebooks").is_dir()


def find_checkout(start: Path | None = None) -> Path:
    """The checkout around `start` (default: the current folder), else the one that rosmini itself runs from.

    Raises `NoCheckout` if neither has `book/_config.yml` and `notebooks/`, as in an installed wheel.
    """
    here = (start or Path.cwd()).resolve()
    own = Path(__file__).resolve().parents[2]
    for folder in (here, *here.parents, own):
        if is_checkout(folder):
            return folder
    raise NoCheckout(
        f"the book's sources (book/_config.yml and notebooks/) are neither in {here} nor in a folder above it. "
        "The installed package does not carry them: clone the repository, and run the command inside the clone"
    )
