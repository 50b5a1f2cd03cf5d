"""What the book's chapters use besides ROS: the checks of their exercises, and drawings."""

from rosmini.book.checks import check
from rosmini.book.drawings import drawing

__all__ = ["check", "drawing"]
