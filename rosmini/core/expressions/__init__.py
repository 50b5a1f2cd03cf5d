"""Confined evaluation of expressions: Python's arithmetic, comparisons, comprehensions and a list of functions.

Robot descriptions (``${...}`` of xacro), parameter files (``rad(2*pi)``) and ``rosbag filter`` contain expressions
that ROS passes to Python's ``eval``, which is unsafe even with its builtins hidden. Here the syntax tree is compiled
into closures. Only the listed kinds of nodes, functions and methods are available. Attributes of values are read by
the caller's `Fields`, never by ``getattr``. Sizes and steps are counted in advance, so ``10**10**10`` and
``'a'*10**9`` are errors.
"""

from __future__ import annotations

from .budget import STEPS_OF_A_FILE, Budget, ExpressionError, NotAllowed
from .expression import Expression, no_fields
from .functions import FUNCTIONS, MATH, Function, Namespace

__all__ = [
    "FUNCTIONS",
    "MATH",
    "STEPS_OF_A_FILE",
    "Budget",
    "Expression",
    "ExpressionError",
    "Function",
    "Namespace",
    "NotAllowed",
    "no_fields",
]
