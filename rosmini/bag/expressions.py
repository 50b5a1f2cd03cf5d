"""The expression of ``rosbag filter``, confined: it may look at ``topic``, ``m`` and ``t`` and compute, and nothing else.

ROS's tool evaluates any Python. Here an expression is taken apart first, and only what is named below passes: operators, comparisons,
literals, fields, indices, comprehensions, a few functions without effect, and a few methods of texts and times.
"""

from __future__ import annotations

import ast
import math
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from rosmini.errors import nearest

from .errors import FilterError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

VARIABLES = ("topic", "m", "t")
FUNCTIONS = MappingProxyType(
    {
        **{
            function.__name__: function
            for function in (
                abs, all, any, bool, float, int, len, list, max, min, round, set, sorted, str, sum, tuple, zip, enumerate,
            )
        },
        **{name: getattr(math, name) for name in ("atan2", "cos", "degrees", "hypot", "isfinite", "isinf", "isnan")},
        **{name: getattr(math, name) for name in ("pi", "radians", "sin", "sqrt", "tan")},
    }
)  # fmt: skip
METHODS = frozenset(
    {
        "to_sec", "to_nsec", "startswith", "endswith", "lower", "upper", "strip", "split", "find", "count", "index",
        "min", "max", "mean", "sum", "any", "all",
    }
)  # fmt: skip
"""What may be called with a dot before it: of times, texts, and numpy arrays."""

_NODES = (
    ast.Expression, ast.BoolOp, ast.And, ast.Or, ast.UnaryOp, ast.Not, ast.USub, ast.UAdd, ast.Invert, ast.BinOp,
    ast.Add, ast.Sub, ast.Mult, ast.Div, ast.FloorDiv, ast.Mod, ast.BitAnd, ast.BitOr, ast.BitXor, ast.RShift,
    ast.Compare, ast.Eq, ast.NotEq, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Is, ast.IsNot, ast.In, ast.NotIn,
    ast.Call, ast.Attribute, ast.Subscript, ast.Slice, ast.Constant, ast.Name, ast.Load, ast.Store, ast.IfExp,
    ast.List, ast.Tuple, ast.Set, ast.Dict, ast.GeneratorExp, ast.ListComp, ast.SetComp, ast.comprehension, ast.keyword,
)  # fmt: skip
_LONGEST = 10_000


def compile_expression(text: str) -> Callable[[str, Any, Any], Any]:
    """Return ``f(topic, m, t)`` that evaluates an expression on a message.

    Raises ``FilterError``, which says what is not allowed or where the expression breaks off; the function raises it, too, when an
    expression fails on a message (a field that this type does not have, for instance).
    """
    if len(text) > _LONGEST:
        raise FilterError(f"the expression has {len(text)} characters; {_LONGEST} are enough")
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise FilterError(
            f"{text!r} is no Python expression: {error}. An example: topic == '/scan' and t.secs > 5"
        ) from error
    bound = {
        node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    for node in ast.walk(tree):
        problem = next(_problems(node, bound), None)
        if problem:
            raise FilterError(f"{text!r}: {problem}")
    code = compile(tree, "<filter expression>", "eval")

    def evaluate(topic: str, m: Any, t: Any) -> Any:
        names = {"__builtins__": {}, **FUNCTIONS, "topic": topic, "m": m, "t": t}
        try:
            # What is evaluated was taken apart above: no name but these, no attribute with an underscore, no other call.
            return eval(code, names)  # noqa: S307
        except Exception as error:
            kind = getattr(m, "_type", type(m).__name__)
            raise FilterError(
                f"{text!r} failed on a {kind} of {topic}: {error}. Test the topic first: topic == {topic!r} and ..."
            ) from error

    return evaluate


def _problems(node: ast.AST, bound: set[str]) -> Iterator[str]:
    if not isinstance(node, _NODES):
        yield f"{type(node).__name__} is not allowed in a filter"
    elif isinstance(node, ast.Attribute) and node.attr.startswith("_"):
        yield f"names that begin with an underscore ({node.attr}) are not allowed in a filter"
    elif isinstance(node, ast.Name):
        known = (*VARIABLES, *FUNCTIONS)
        if isinstance(node.ctx, ast.Store):
            if node.id in known or node.id.startswith("_"):
                yield f"{node.id!r} cannot be the variable of a loop"
        elif node.id not in known and node.id not in bound:
            hint = (
                nearest(node.id, known) or f"a filter knows {', '.join(VARIABLES)} and functions such as len"
            )
            yield f"there is no {node.id!r}: {hint}"
    elif isinstance(node, ast.Call):
        called = node.func
        if isinstance(called, ast.Name):
            if called.id not in FUNCTIONS:
                yield f"{called.id}() is not allowed in a filter: it may call {', '.join(sorted(FUNCTIONS))}"
        elif not (isinstance(called, ast.Attribute) and called.attr in METHODS):
            name = called.attr if isinstance(called, ast.Attribute) else type(called).__name__
            yield f".{name}() is not allowed in a filter: it may call {', '.join(sorted(METHODS))}"
    elif isinstance(node, ast.Mod | ast.Mult):
        return  # of numbers; of texts they cannot do harm below the length that an expression may have
