"""Makes functions of a syntax tree whose every node is on a list."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any, ClassVar

from rosmini.errors import nearest, shown

from .budget import BITS, Budget
from .errors import ExpressionError, NotAllowed, cut
from .functions import Function, Namespace, method
from .operators import BINARY, COMPARE, UNARY, compute

__all__ = ["Compiler", "Fields", "Run", "no_fields"]

DEEPEST = 100
"""How deep an expression may be nested."""

Fields = Callable[[Any, str], Any]
"""The attribute of a value that an expression may read. Raises ``AttributeError`` if there is none."""


def no_fields(value: Any, name: str) -> Any:
    """No value has attributes (see `Fields`)."""
    raise AttributeError(f"a {type(value).__name__} has no {name!r}")


class Run:
    """One evaluation: the names, the variables of loops, what is left to spend."""

    __slots__ = ("bound", "budget", "names")

    def __init__(self, names: Mapping[str, Any], bound: list[Any], budget: Budget) -> None:
        self.names, self.bound, self.budget = names, bound, budget


Step = Callable[[Run], Any]


class Compiler:
    """Makes the functions of one expression. Every method for a kind of node raises `NotAllowed` for what may not be there."""

    def __init__(
        self,
        text: str,
        names: Collection[str] | None,
        functions: Mapping[str, Any],
        fields: Fields,
        methods: Mapping[type, Collection[str]],
    ) -> None:
        self.text, self.names, self.functions, self.fields = text, names, functions, fields
        self.methods = methods
        self.variables: dict[str, int] = {}
        self.slots = 0
        self.depth = 0

    def step(self, node: ast.AST) -> Step:
        """A function for a node. Raises `NotAllowed`."""
        make = self.NODES.get(type(node))
        if make is None:
            raise self._refused(node, f"{type(node).__name__} is not allowed")
        self.depth += 1
        if self.depth > DEEPEST:
            raise NotAllowed(f"an expression is nested deeper than {DEEPEST}")
        made = make(self, node)
        self.depth -= 1
        return made if isinstance(node, ast.Constant) else self._telling(node, made)

    def _telling(self, node: ast.AST, made: Step) -> Step:
        """The same function, whose errors are ours and name the part of the expression that failed."""
        spot = self._spot(node)

        def told(run: Run) -> Any:
            try:
                return made(run)
            except Exception as error:
                if isinstance(error, ExpressionError) and error.has_spot:
                    raise
                kind = NotAllowed if isinstance(error, NotAllowed) else ExpressionError
                failed = kind(f"{error if error.args else type(error).__name__}{spot}")
                failed.has_spot = True
                raise failed from error

        return told

    def _spot(self, node: ast.AST) -> str:
        """Where in the text a node is, unless it is all of it."""
        written = cut(ast.get_source_segment(self.text, node) or "")
        return f" (in {written!r})" if written not in {"", cut(self.text)} else ""

    def _refused(self, node: ast.AST, why: str) -> NotAllowed:
        return NotAllowed(f"{why}{self._spot(node)}")

    # ---- names and literals ----

    def _constant(self, node: ast.Constant) -> Step:
        value = node.value
        if not isinstance(value, str | bytes | int | float | None):
            raise self._refused(node, f"{shown(value)} is not allowed")
        if isinstance(value, int) and value.bit_length() > BITS:
            raise self._refused(node, f"a whole number of more than {BITS} bits")
        return lambda _: value

    def _name(self, node: ast.Name) -> Step:
        name, functions = node.id, self.functions
        if name in self.variables:
            slot = self.variables[name]
            return lambda run: run.bound[slot]
        if self.names is None:
            return lambda run: _look_up(name, run.names, functions)
        if name in self.names:
            return lambda run: run.names[name]
        if name in functions:
            value = functions[name]
            return lambda _: value
        hint = nearest(name, (*self.names, *functions))
        known = hint or f"there are {', '.join([*self.names, 'and functions such as len'])}"
        raise self._refused(node, f"there is no {name!r}; {known}")

    def _attribute(self, node: ast.Attribute) -> Step:
        if node.attr.startswith("__"):
            raise self._refused(node, f"names that begin with two underscores ({node.attr}) are not allowed")
        value, name, fields = self.step(node.value), node.attr, self.fields

        def read(run: Run) -> Any:
            found = value(run)
            return found.member(name) if isinstance(found, Namespace) else fields(found, name)

        return read

    # ---- operators ----

    def _binary(self, node: ast.BinOp) -> Step:
        operate = BINARY.get(type(node.op))
        if operate is None:
            raise self._refused(node, f"{type(node.op).__name__} is not allowed")
        left, right = self.step(node.left), self.step(node.right)
        return lambda run: compute(operate, left(run), right(run), run.budget)

    def _unary(self, node: ast.UnaryOp) -> Step:
        operate, operand = UNARY[type(node.op)], self.step(node.operand)
        return lambda run: operate(operand(run))

    def _choice(self, node: ast.BoolOp) -> Step:
        values, until = [self.step(each) for each in node.values], isinstance(node.op, ast.Or)

        def choose(run: Run) -> Any:
            found = None
            for value in values:
                found = value(run)
                if bool(found) is until:
                    break
            return found

        return choose

    def _compare(self, node: ast.Compare) -> Step:
        first = self.step(node.left)
        operators = [COMPARE[type(each)] for each in node.ops]
        rest = list(zip(operators, map(self.step, node.comparators), strict=True))

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
        test, then, otherwise = self.step(node.test), self.step(node.body), self.step(node.orelse)
        return lambda run: then(run) if test(run) else otherwise(run)

    def _subscript(self, node: ast.Subscript) -> Step:
        value, index = self.step(node.value), self.step(node.slice)

        def subscript(run: Run) -> Any:
            holder, at = value(run), index(run)
            run.budget.read(at)
            found = holder[at]
            return run.budget.made(found) if isinstance(at, slice) else found

        return subscript

    def _slice(self, node: ast.Slice) -> Step:
        bounds = [None if part is None else self.step(part) for part in (node.lower, node.upper, node.step)]
        return lambda run: slice(*(None if bound is None else bound(run) for bound in bounds))

    # ---- calls ----

    def _call(self, node: ast.Call) -> Step:
        called = node.func
        if not isinstance(called, ast.Attribute | ast.Name):
            raise self._refused(node, "only functions and methods with a name can be called")
        if any(each.arg is None for each in node.keywords):
            raise self._refused(node, "** is not allowed")
        find = self._method(called) if isinstance(called, ast.Attribute) else self._function(called)
        arguments = [self.step(each) for each in node.args]
        named = {str(each.arg): self.step(each.value) for each in node.keywords}

        def call(run: Run) -> Any:
            function, values = find(run)
            values += tuple(each(run) for each in arguments)
            return function.apply(run.budget, values, {name: each(run) for name, each in named.items()})

        return call

    def _function(self, node: ast.Name) -> Callable[[Run], tuple[Function, tuple[Any, ...]]]:
        """The function that a name stands for."""
        if self.names is not None and node.id not in self.functions:
            there = sorted(name for name, value in self.functions.items() if isinstance(value, Function))
            hint = nearest(node.id, there) or f"there are {', '.join(there)}"
            raise self._refused(node, f"{node.id}() is not allowed; {hint}")
        found = self.step(node)

        def find(run: Run) -> tuple[Function, tuple[Any, ...]]:
            return _callable(found(run), node.id), ()

        return find

    def _method(self, node: ast.Attribute) -> Callable[[Run], tuple[Function, tuple[Any, ...]]]:
        """The function that stands behind a dot, and the value before it if that is an argument."""
        name, methods, fields = node.attr, self.methods, self.fields
        holder = self.step(node.value)
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
                raise NotAllowed(
                    f".{name}() of a {kind.__name__} is not allowed{f'; {hint}' if hint else ''}"
                ) from None

        return find

    # ---- lists and loops ----

    def _display(self, node: ast.List | ast.Tuple | ast.Set) -> Step:
        kind = {ast.List: list, ast.Tuple: tuple, ast.Set: set}[type(node)]
        parts = [self.step(part) for part in node.elts]
        return lambda run: run.budget.made(kind(part(run) for part in parts))

    def _mapping(self, node: ast.Dict) -> Step:
        if None in node.keys:
            raise self._refused(node, "** is not allowed")
        keys = [self.step(key) for key in node.keys if key is not None]
        pairs = list(zip(keys, map(self.step, node.values), strict=True))
        return lambda run: run.budget.made({key(run): value(run) for key, value in pairs})

    def _comprehension(self, node: ast.ListComp | ast.SetComp | ast.GeneratorExp) -> Step:
        turns = self._loop(node.generators, node.elt)
        if isinstance(node, ast.GeneratorExp):
            return turns
        kind = list if isinstance(node, ast.ListComp) else set
        return lambda run: run.budget.made(kind(turns(run)))

    def _dict_comprehension(self, node: ast.DictComp) -> Step:
        pair = ast.copy_location(ast.Tuple([node.key, node.value], ast.Load()), node)
        turns = self._loop(node.generators, pair)
        return lambda run: run.budget.made(dict(turns(run)))

    def _loop(self, generators: list[ast.comprehension], each: ast.expr) -> Callable[[Run], Iterator[Any]]:
        """A generator of the elements of a comprehension."""
        outer = dict(self.variables)
        levels = [self._level(part) for part in generators]
        element = self.step(each)
        self.variables = outer

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

        return lambda run: turns(Run(run.names, list(run.bound), run.budget))

    def _level(self, part: ast.comprehension) -> tuple[Step, Callable[[Run, Any], None], list[Step]]:
        """One ``for``: what it loops over, what sets its variables, and its tests."""
        if part.is_async:
            raise NotAllowed("async is not allowed")
        source = self.step(part.iter)
        return source, self._target(part.target), [self.step(test) for test in part.ifs]

    def _target(self, node: ast.expr) -> Callable[[Run, Any], None]:
        """A function that gives the variables of a loop their values."""
        if isinstance(node, ast.Name):
            slot = self.variables[node.id] = self.slots
            self.slots += 1
            return lambda run, value: operator.setitem(run.bound, slot, value)
        if not isinstance(node, ast.Tuple | ast.List):
            raise self._refused(node, "only names can be the variables of a loop")
        parts = [self._target(part) for part in node.elts]

        def assign(run: Run, value: Any) -> None:
            for part, item in zip(parts, value, strict=True):
                part(run, item)

        return assign

    NODES: ClassVar[Mapping[type[ast.AST], Callable[[Compiler, Any], Step]]] = {
        ast.Attribute: _attribute,
        ast.BinOp: _binary,
        ast.BoolOp: _choice,
        ast.Call: _call,
        ast.Compare: _compare,
        ast.Constant: _constant,
        ast.Dict: _mapping,
        ast.DictComp: _dict_comprehension,
        ast.GeneratorExp: _comprehension,
        ast.IfExp: _conditional,
        ast.List: _display,
        ast.ListComp: _comprehension,
        ast.Name: _name,
        ast.Set: _display,
        ast.SetComp: _comprehension,
        ast.Slice: _slice,
        ast.Subscript: _subscript,
        ast.Tuple: _display,
        ast.UnaryOp: _unary,
    }
    """What may stand in an expression."""


def _look_up(name: str, names: Mapping[str, Any], functions: Mapping[str, Any]) -> Any:
    if name in names:
        return names[name]
    if name in functions:
        return functions[name]
    raise NameError(f"name {name!r} is not defined")


def _callable(value: Any, name: str) -> Function:
    if not isinstance(value, Function):
        raise NotAllowed(f"{name} is no function that may be called")
    return value
