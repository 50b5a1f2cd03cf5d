"""The checks of the chapters' exercises."""

from rosmini.book.checks import check

__all__ = ["check"]
