"""For pytest: notebooks run with the display form of the book, which is what their stored outputs hold.

The rest of the tests, and the kernels and servers that they start, keep the environment as it is.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from rosmini.viz.book_form import BOOK, VARIABLE


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Set `ROSMINI_DISPLAY=book` around a cell of a notebook: nbval starts the kernel when it sets up the first."""
    if item.path.suffix != ".ipynb":
        return (yield)
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = BOOK
    try:
        return (yield)
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before
