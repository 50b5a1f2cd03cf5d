"""An expression: checked once, evaluated as often as one likes."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Any

from .budget import Budget
from .compiler import Compiler, Fields, Run, no_fields
from .errors import ExpressionError, NotAllowed, cut
from .functions import FUNCTIONS, MATH, METHODS, Namespace

__all__ = ["Expression"]

LONGEST = 10_000
"""How many characters an expression may have."""


class Expression:
    """An expression in Python's syntax.

    Args:
        text: what was written.
        names: the names whose values are given to `evaluate`; None: whatever it is given (an unknown name fails then, and not now).
        functions: what else has a name: `Function`, `Namespace` and plain values; by default `FUNCTIONS`, `MATH` and ``math``.
        fields: the attributes of values.
        methods: methods that may be called beside those of `METHODS`, by type. They must change nothing.

    Raises:
        NotAllowed: it uses what is not listed, or a name that is unknown.
        ExpressionError: it is no expression.

    """

    def __init__(
        self,
        text: str,
        *,
        names: Collection[str] | None = None,
        functions: Mapping[str, Any] | None = None,
        fields: Fields = no_fields,
        methods: Mapping[type, Collection[str]] = MappingProxyType({}),
    ) -> None:
        self.text = text.strip()
        if len(self.text) > LONGEST:
            raise NotAllowed(f"an expression of {len(self.text)} characters; {LONGEST} are allowed")
        known = {**MATH, **FUNCTIONS, "math": Namespace("math", MATH)} if functions is None else functions
        compiler = Compiler(self.text, names, known, fields, {**METHODS, **methods})
        self._step = compiler.step(_tree(self.text))
        self._slots = compiler.slots

    def __repr__(self) -> str:
        return f"Expression({cut(self.text)!r})"

    def evaluate(self, names: Mapping[str, Any], budget: Budget | None = None) -> Any:
        """What the expression says of these values. Raises `ExpressionError`, which names the part that failed."""
        run = Run(names, [None] * self._slots, budget or Budget())
        return run.budget.made(self._step(run))


def _tree(text: str) -> ast.expr:
    try:
        with warnings.catch_warnings():  # of "\d"
            warnings.simplefilter("ignore")
            return ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        reason = error.msg if isinstance(error, SyntaxError) else str(error) or "nested too deep"
        raise ExpressionError(f"this is no Python expression: {reason}") from error
