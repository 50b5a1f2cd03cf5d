"""What a chapter needs beside the library: exercises that check themselves."""

from rosmini.book.checks import check

__all__ = ["check"]
