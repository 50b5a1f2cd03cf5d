"""Which HTML a view gives: that of the book, which shares scripts between pages, or one that stands alone."""

from __future__ import annotations

import os

VARIABLE = "ROSMINI_DISPLAY"
BOOK = "book"


def book_form() -> bool:
    """Whether outputs are made for the book: the environment has `ROSMINI_DISPLAY=book`.

    `python -m book.tools.notebooks execute` and the tests set it for the kernels that they start, so committed
    outputs hold small HTML that refers to the book's scripts. Anywhere else a view's HTML carries its scripts.
    """
    return os.environ.get(VARIABLE) == BOOK
