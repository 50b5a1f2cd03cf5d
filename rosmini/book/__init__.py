"""What the notebooks and the book need beside the library: checks for exercises, the build, notebook hygiene."""

from rosmini.book.checks import check

__all__ = ["check"]
