"""The two forms of a view's HTML: for the book, where pages share scripts, or self-contained."""

from __future__ import annotations

import os

VARIABLE = "ROSMINI_DISPLAY"
BOOK = "book"


def book_form() -> bool:
    """True if outputs are made for the book: the environment has `ROSMINI_DISPLAY=book`.

    `python -m book.tools.notebooks execute` and the tests set it for the kernels that they start, so that committed
    outputs hold small HTML that refers to the book's scripts. Elsewhere a view's HTML contains its scripts.
    """
    return os.environ.get(VARIABLE) == BOOK
