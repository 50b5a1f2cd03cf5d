"""What all tests share: the checkout, and the switch between `skip` and `fail` for what a machine may lack."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def shared_tmp(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A temporary folder that all xdist workers of this run share."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base


def required(what: str) -> bool:
    """Whether `ROSMINI_REQUIRE_<what>` forbids to skip tests for want of it."""
    return os.environ.get(f"ROSMINI_REQUIRE_{what}") == "1"


@pytest.fixture(scope="session")
def book_html(shared_tmp: Path) -> Path:
    """The folder of the built book: built once in a run, whichever worker asks first."""
    from filelock import FileLock

    from rosmini.book.build import build_book

    output = shared_tmp / "book"
    with FileLock(shared_tmp / "book.lock", timeout=240):
        first = output / "_build" / "html" / "index.html"
        if not (output / "built").is_file():
            output.mkdir(exist_ok=True)
            build_book(ROOT, output)
            (output / "built").touch()
    return first.parent
