"""Confined expressions: checked once, evaluated any number of times."""

from __future__ import annotations

import ast
import operator
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple

from rosmini.core.errors import nearest, shown

from .budget import Budget, ExpressionError, NotAllowed, check_bits, cut
from .functions import FUNCTIONS, MATH, METHODS, OPERATORS, Function, Namespace, compute, method

MAX_DEPTH = 100
"""Maximum nesting depth of an expression."""

MAX_LENGTH = 10_000
"""Maximum length of an expression [characters]."""

Fields = Callable[[Any, str], Any]
"""A function of a value and a name that returns an attribute which expressions may read.

It raises ``AttributeError`` for any other name.
"""


def no_fields(value: Any, name: str) -> Any:
    """Raise ``AttributeError``: values have no attributes (see `Fields`)."""
    raise AttributeError(f"a {type(value).__name__} has no {name!r}")


class Run(NamedTuple):
    """One evaluation: the names, the loop variables, the remaining budget."""

    names: Mapping[str, Any]
    bound: dict[str, Any]
    budget: Budget


Step = Callable[[Run], Any]
Find = Callable[[Run], tuple[Function, tuple[Any, ...]]]
"""Returns the function to call, with the value before the dot as its first argument if it is a method."""


class Expression:
    """An expression in Python's syntax.

    Args:
        text: the expression.
        names: the names that `evaluate` will provide; None allows any (an unknown name then fails in `evaluate`).
        functions: instances of `Function` and `Namespace` and other values that the expression may use, by name; by
            default `FUNCTIONS`, `MATH` and ``math``.
        fields: reads attributes of values, by default none.
        methods: methods that may be called in addition to `METHODS`, by type. They must not modify anything.

    Raises:
        NotAllowed: it uses something that is not listed, or an unknown name.
        ExpressionError: it is not an expression.

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
        if len(self.text) > MAX_LENGTH:
            raise NotAllowed(f"an expression of {len(self.text)} characters; {MAX_LENGTH} are allowed")
        if functions is None:
            functions = {**MATH, **FUNCTIONS, "math": Namespace("math", MATH)}
        self._names, self._functions, self._fields = names, functions, fields
        self._methods = {**METHODS, **methods}
        self._variables: frozenset[str] = frozenset()
        self._depth = 0
        self._step = self._make(_tree(self.text))

    def __repr__(self) -> str:
        return f"Expression({cut(self.text)!r})"

    def evaluate(self, names: Mapping[str, Any], budget: Budget | None = None) -> Any:
        """Return the value for these names. Raises `ExpressionError`, whose message quotes the part that failed."""
        run = Run(names, {}, budget or Budget())
        return run.budget.made(self._step(run))

    # ---- compiling nodes to closures; each method raises `NotAllowed` for a node that is not supported ----

    def _make(self, node: ast.AST) -> Step:
        make = self.NODES.get(type(node))
        if make is None:
            raise self._refused(node, f"{type(node).__name__} is not allowed")
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise NotAllowed(f"an expression is nested deeper than {MAX_DEPTH}")
        made = make(self, node)
        self._depth -= 1
        return made if isinstance(node, ast.Constant) else self._with_spot(node, made)

    def _with_spot(self, node: ast.AST, made: Step) -> Step:
        """Wrap a closure so that all its errors become `ExpressionError` or `NotAllowed`, and quote ``node``."""

        def checked(run: Run) -> Any:
            try:
                return made(run)
            except Exception as error:
                if isinstance(error, ExpressionError) and error.has_spot:
                    raise
                kind = NotAllowed if isinstance(error, NotAllowed) else ExpressionError
                failed = kind(f"{error if error.args else type(error).__name__}{self._spot(node)}")
                failed.has_spot = True
                raise failed from error

        return checked

    def _spot(self, node: ast.AST) -> str:
        """Return the quoted text of a node, unless it is the whole expression."""
        written = cut(ast.get_source_segment(self.text, node) or "")
        return f" (in {written!r})" if written not in {"", cut(self.text)} else ""

    def _refused(self, node: ast.AST, why: str) -> NotAllowed:
        return NotAllowed(f"{why}{self._spot(node)}")

    def _constant(self, node: ast.Constant) -> Step:
        value = node.value
        if not isinstance(value, str | bytes | int | float | None):
            raise self._refused(node, f"{shown(value)} is not allowed")
        if isinstance(value, int):
            check_bits(value.bit_length())
        return lambda _: value

    def _name(self, node: ast.Name) -> Step:
        name, functions = node.id, self._functions
        if name in self._variables:
            return lambda run: run.bound[name]
        if self._names is None:
            return lambda run: _look_up(name, run.names, functions)
        if name in self._names:
            return lambda run: run.names[name]
        if name in functions:
            value = functions[name]
            return lambda _: value
        hint = nearest(name, (*self._names, *functions))
        known = hint or f"there are {', '.join([*self._names, 'and functions such as len'])}"
        raise self._refused(node, f"there is no {name!r}; {known}")

    def _attribute(self, node: ast.Attribute) -> Step:
        if node.attr.startswith("__"):
            raise self._refused(node, f"names that begin with two underscores ({node.attr}) are not allowed")
        value, name, fields = self._make(node.value), node.attr, self._fields

        def read(run: Run) -> Any:
            found = value(run)
            return found.member(name) if isinstance(found, Namespace) else fields(found, name)

        return read

    # ---- operators ----

    def _binary(self, node: ast.BinOp) -> Step:
        operate = OPERATORS.get(type(node.op))
        if operate is None:
            raise self._refused(node, f"{type(node.op).__name__} is not allowed")
        left, right = self._make(node.left), self._make(node.right)
        return lambda run: compute(operate, left(run), right(run), run.budget)

    def _unary(self, node: ast.UnaryOp) -> Step:
        operate, operand = OPERATORS[type(node.op)], self._make(node.operand)
        return lambda run: operate(operand(run))

    def _boolean(self, node: ast.BoolOp) -> Step:
        values, until = [self._make(each) for each in node.values], isinstance(node.op, ast.Or)

        def choose(run: Run) -> Any:
            found = None
            for value in values:
                found = value(run)
                if bool(found) is until:
                    break
            return found

        return choose

    def _compare(self, node: ast.Compare) -> Step:
        first = self._make(node.left)
        operators = [OPERATORS[type(each)] for each in node.ops]
        rest = list(zip(operators, map(self._make, node.comparators), strict=True))

        def compare(run: Run) -> Any:
            left, found = first(run), True
            for holds, value in rest:
                right = value(run)
                run.budget.read(left)
                run.budget.read(right)
                found = holds(left, right)
                if len(rest) > 1 and not found:
                    break
                left = right
            return found

        return compare

    def _conditional(self, node: ast.IfExp) -> Step:
        test, then, otherwise = self._make(node.test), self._make(node.body), self._make(node.orelse)
        return lambda run: then(run) if test(run) else otherwise(run)

    def _subscript(self, node: ast.Subscript) -> Step:
        value, index = self._make(node.value), self._make(node.slice)

        def subscript(run: Run) -> Any:
            holder, at = value(run), index(run)
            run.budget.read(at)
            found = holder[at]
            return run.budget.made(found) if isinstance(at, slice) else found

        return subscript

    def _slice(self, node: ast.Slice) -> Step:
        bounds = [None if part is None else self._make(part) for part in (node.lower, node.upper, node.step)]
        return lambda run: slice(*(None if bound is None else bound(run) for bound in bounds))

    # ---- calls ----

    def _call(self, node: ast.Call) -> Step:
        called = node.func
        if not isinstance(called, ast.Attribute | ast.Name):
            raise self._refused(node, "only functions and methods with a name can be called")
        if any(each.arg is None for each in node.keywords):
            raise self._refused(node, "** is not allowed")
        find = self._method(called) if isinstance(called, ast.Attribute) else self._function(called)
        arguments = [self._make(each) for each in node.args]
        named = {str(each.arg): self._make(each.value) for each in node.keywords}

        def call(run: Run) -> Any:
            function, values = find(run)
            values += tuple(each(run) for each in arguments)
            return function.apply(run.budget, values, {name: each(run) for name, each in named.items()})

        return call

    def _function(self, node: ast.Name) -> Find:
        if self._names is not None and node.id not in self._functions:
            there = sorted(name for name, value in self._functions.items() if isinstance(value, Function))
            hint = nearest(node.id, there) or f"there are {', '.join(there)}"
            raise self._refused(node, f"{node.id}() is not allowed; {hint}")
        found = self._make(node)
        return lambda run: (_callable(found(run), node.id), ())

    def _method(self, node: ast.Attribute) -> Find:
        name, methods, fields = node.attr, self._methods, self._fields
        holder = self._make(node.value)
        kinds: dict[type, Function | None] = {}

        def find(run: Run) -> tuple[Function, tuple[Any, ...]]:
            value = holder(run)
            kind = type(value)
            if kind not in kinds:
                kinds[kind] = method(kind, name, methods)
            found = kinds[kind]
            if found is not None:
                return found, (value,)
            if isinstance(value, Namespace):
                return _callable(value.member(name), f"{value.name}.{name}"), ()
            try:
                return _callable(fields(value, name), name), ()
            except AttributeError:
                there = {each for base in kind.__mro__ for each in methods.get(base, ())}
                hint = nearest(name, there) or (f"there are {', '.join(sorted(there))}" if there else "")
                why = f".{name}() of a {kind.__name__} is not allowed{f'; {hint}' if hint else ''}"
                raise NotAllowed(why) from None

        return find

    # ---- lists and loops ----

    def _display(self, node: ast.List | ast.Tuple | ast.Set) -> Step:
        kind = {ast.List: list, ast.Tuple: tuple, ast.Set: set}[type(node)]
        parts = [self._make(part) for part in node.elts]
        if kind is set:
            return lambda run: run.budget.made(set(run.budget.unique([part(run) for part in parts])))
        return lambda run: run.budget.made(kind(part(run) for part in parts))

    def _mapping(self, node: ast.Dict) -> Step:
        if None in node.keys:
            raise self._refused(node, "** is not allowed")
        keys = [self._make(key) for key in node.keys if key is not None]
        pairs = list(zip(keys, map(self._make, node.values), strict=True))

        def display(run: Run) -> Any:
            found = [(key(run), value(run)) for key, value in pairs]
            run.budget.unique([key for key, _ in found])
            return run.budget.made(dict(found))

        return display

    def _comprehension(self, node: ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp) -> Step:
        if isinstance(node, ast.DictComp):
            pair = ast.copy_location(ast.Tuple([node.key, node.value], ast.Load()), node)
            turns = self._loop(node.generators, pair)
        else:
            turns = self._loop(node.generators, node.elt)
        if isinstance(node, ast.GeneratorExp):
            return turns

        def collect(run: Run) -> Any:
            found = list(turns(run))
            if isinstance(node, ast.ListComp):
                return run.budget.made(found)
            if isinstance(node, ast.SetComp):
                return run.budget.made(set(run.budget.unique(found)))
            run.budget.unique([key for key, _ in found])
            return run.budget.made(dict(found))

        return collect

    def _loop(self, generators: list[ast.comprehension], each: ast.expr) -> Callable[[Run], Iterator[Any]]:
        """Return a generator function for the elements of a comprehension."""
        outer, levels = self._variables, []
        for part in generators:
            if part.is_async:
                raise NotAllowed("async is not allowed")
            source = self._make(part.iter)
            levels.append((source, self._target(part.target), [self._make(test) for test in part.ifs]))
        element = self._make(each)
        self._variables = outer

        def turns(run: Run, depth: int = 0) -> Iterator[Any]:
            if depth == len(levels):
                yield element(run)
                return
            source, assign, tests = levels[depth]
            for item in source(run):
                run.budget.spend(1)
                assign(run, item)
                if all(test(run) for test in tests):
                    yield from turns(run, depth + 1)

        return lambda run: turns(Run(run.names, dict(run.bound), run.budget))

    def _target(self, node: ast.expr) -> Callable[[Run, Any], None]:
        """Return a function that assigns to the loop variables."""
        if isinstance(node, ast.Name):
            name = node.id
            self._variables |= {name}
            return lambda run, value: operator.setitem(run.bound, name, value)
        if not isinstance(node, ast.Tuple | ast.List):
            raise self._refused(node, "only names can be the variables of a loop")
        parts = [self._target(part) for part in node.elts]

        def assign(run: Run, value: Any) -> None:
            for part, item in zip(parts, value, strict=True):
                part(run, item)

        return assign

    NODES: ClassVar[Mapping[type[ast.AST], Callable[[Expression, Any], Step]]] = {
        ast.Attribute: _attribute,
        ast.BinOp: _binary,
        ast.BoolOp: _boolean,
        ast.Call: _call,
        ast.Compare: _compare,
        ast.Constant: _constant,
        ast.Dict: _mapping,
        ast.IfExp: _conditional,
        ast.Name: _name,
        ast.Slice: _slice,
        ast.Subscript: _subscript,
        ast.UnaryOp: _unary,
        **dict.fromkeys((ast.List, ast.Set, ast.Tuple), _display),
        **dict.fromkeys((ast.DictComp, ast.GeneratorExp, ast.ListComp, ast.SetComp), _comprehension),
    }
    """The node types that are supported."""


def _tree(text: str) -> ast.expr:
    try:
        with warnings.catch_warnings():  # invalid escapes such as "\d"
            warnings.simplefilter("ignore")
            return ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        reason = error.msg if isinstance(error, SyntaxError) else str(error) or "nested too deep"
        raise ExpressionError(f"this is not a Python expression: {reason}") from error


def _look_up(name: str, names: Mapping[str, Any], functions: Mapping[str, Any]) -> Any:
    for known in (names, functions):
        if name in known:
            return known[name]
    raise NameError(f"name {name!r} is not defined")


def _callable(value: Any, name: str) -> Function:
    if not isinstance(value, Function):
        raise NotAllowed(f"{name} is not a function that can be called")
    return value
