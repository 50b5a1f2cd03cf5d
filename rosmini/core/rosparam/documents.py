"""Parameter files: reading and writing YAML as ``rosparam`` does (http://wiki.ros.org/rosparam).

YAML is version 1.1, as in PyYAML: ``yes`` is a boolean, ``010`` is eight, ``1e5`` without a point is text.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import yaml

from rosmini.core.errors import ParameterError, shown
from rosmini.core.expressions import MATH, STEPS_OF_A_FILE, Budget, Expression, ExpressionError, Namespace
from rosmini.core.files import read
from rosmini.core.names import join
from rosmini.core.yaml_text import Loader, children, documents, line_of

from .errors import RosParamException

_NAMES = {"pi": math.pi, "math": Namespace("math", MATH)}


def degrees(text: str) -> float:
    """Convert ``deg(<number>)``, or a plain number in degrees, to radians.

    Raises ``RosParamException`` for any other text.
    """
    inner = text.strip()
    if inner.startswith("deg(") and inner.endswith(")"):
        inner = inner[4:-1]
    try:
        return float(inner) * math.pi / 180.0
    except ValueError as error:
        raise RosParamException(
            f"{shown(text)} is not an angle in degrees: write a number, such as deg(90) or !degrees 90"
        ) from error


def radians(text: str, budget: Budget | None = None) -> float:
    """Return the value of ``rad(<expression>)``, or of the expression alone, which is an angle in radians.

    Expressions may contain numbers, ``pi``, ``+ - * / // % **``, brackets, and functions of ``math``, such as
    ``math.sqrt(2)``. The evaluation is charged to ``budget``. Raises ``RosParamException`` for any other text.
    """
    inner = text.strip()
    if inner.startswith("rad(") and inner.endswith(")"):
        inner = inner[4:-1]
    try:
        value = Expression(inner, names=(), functions=_NAMES).evaluate({}, budget)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ExpressionError(f"{shown(value)} is not a real number")
        return float(value)
    except (ExpressionError, OverflowError) as error:
        raise RosParamException(
            f"{shown(text)} is not an angle in radians ({error}): write a number or an expression, such as rad(2*pi)"
        ) from error


NS = "_ns"
"""The key with which a document names its namespace."""
MAX_BYTES = 4_000_000
"""Maximum size of a parameter file [bytes]."""


@dataclass(frozen=True)
class Document:
    """One YAML document: ``values`` (usually a dictionary) for the namespace ``namespace``."""

    values: Any
    namespace: str
    source: str = ""
    lines: Mapping[str, int] = field(default_factory=dict, repr=False)
    """The line of each value, by its path in the document: ``/a/b``, ``/a/sizes[2]``."""
    own_namespace: bool = False
    """True if the document names its namespace itself."""

    def assignments(self) -> list[tuple[str, Any]]:
        """Return name and value of each parameter to set.

        Raises ``RosParamException``, with file and line, if one of them is invalid.
        """
        try:
            return list(assignments(self.namespace, self.values))
        except _Refused as error:
            line = self.lines.get(error.place) or self.lines.get("/")
            raise RosParamException(str(error), self.source, line) from error


class _Refused(RosParamException):
    """A value that the Parameter Server does not support, and its path in the document."""

    def __init__(self, message: str, place: str) -> None:
        super().__init__(message)
        self.place = place


def assignments(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the (name, value) pairs that rosparam sets to store ``value`` under ``name``.

    A dictionary yields one pair for each value in it, at any depth, so it is merged into the existing namespace; an
    empty dictionary yields nothing. Any other value, including a list, replaces the old one.

    Raises ``RosParamException`` for a value that the Parameter Server does not support, a key that is not a string, and
    a root that is not a dictionary.
    """
    if name == "/" and not isinstance(value, dict):
        raise _Refused(
            f"the root of the Parameter Server is a dictionary, not {value!r}: "
            "write lines of the form `name: value`, or give a namespace",
            "/",
        )
    return _assignments(name, value, "")


def _assignments(name: str, value: Any, place: str) -> Iterator[tuple[str, Any]]:
    if not isinstance(value, dict):
        yield name, _checked(name, value, place)
        return
    for key, item in value.items():
        if not isinstance(key, str):
            raise _Refused(f"parameter {name}: the key {key!r} is not a string: quote it", f"{place}/{key}")
        yield from _assignments(join(name, key), item, f"{place}/{key}")


def _checked(name: str, value: Any, place: str) -> Any:
    if isinstance(value, list):
        return [_checked(f"{name}[{number}]", item, f"{place}[{number}]") for number, item in enumerate(value)]
    if isinstance(value, dict):
        for key in value:
            if not isinstance(key, str):
                raise _Refused(f"parameter {name}: the key {key!r} is not a string", f"{place}/{key}")
        return {key: _checked(f"{name}/{key}", item, f"{place}/{key}") for key, item in value.items()}
    if value is None:
        raise _Refused(
            f"parameter {name} has no value (YAML's null), which a parameter cannot be: "
            "write '' for an empty text, {} for an empty namespace",
            place,
        )
    from rosmini.core.graph.parameter_client import (
        check_value,
    )  # here, so that reading parameters does not import the graph

    try:
        return check_value(name, value)
    except ParameterError as error:
        raise _Refused(str(error), place) from error


# ---- reading ----


class _Loader(Loader):
    """A loader that reads ``deg(...)`` and ``rad(...)`` as angles, as in parameter files; other YAML has no angles."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.budget = Budget(STEPS_OF_A_FILE)

    def angle(self, node: Any, read: Callable[[str, Budget], float]) -> float:
        text = str(self.construct_scalar(node))
        self.budget.earn(len(text))
        try:
            return read(text, self.budget)
        except RosParamException as error:
            raise RosParamException(error.message, self.name, line_of(node)) from error


class _Dumper(yaml.SafeDumper):
    """A dumper that quotes strings which look like an angle."""


for _tag, _word, _read in (("!degrees", "deg", lambda text, _: degrees(text)), ("!radians", "rad", radians)):
    _Loader.add_constructor(_tag, partial(_Loader.angle, read=_read))
    for _kind in (_Loader, _Dumper):
        _kind.add_implicit_resolver(_tag, re.compile(rf"^{_word}\([^)]*\)$"), [_word[0]])


def load_file(path: str | Path, namespace: str = "/") -> list[Document]:
    """Return the documents of a parameter file, for parameters in ``namespace``.

    Raises ``RosParamException``, with file and line, if the file cannot be read or is not valid.
    """
    path = Path(path)
    try:
        text = read(path, MAX_BYTES).decode("utf-8")
    except FileNotFoundError as error:
        raise RosParamException(f"file [{path}] does not exist") from error
    except OSError as error:
        raise RosParamException(f"cannot read this file: {error.strerror}", path) from error
    except UnicodeDecodeError as error:
        raise RosParamException(f"cannot read this file: {error}", path) from error
    return load_str(text, str(path), namespace)


def load_str(text: str, source: str = "", namespace: str = "/") -> list[Document]:
    """Return the documents of a YAML text, for parameters in ``namespace``; errors call it ``source``.

    Raises ``RosParamException`` if the text is not valid YAML, or contains an empty document.
    """
    found: list[Document] = []
    for values, node in documents(text, source, RosParamException, _Loader):
        if values is None:
            raise RosParamException("this document is empty (YAML's null)", source, line_of(node))
        ns = namespace
        named = isinstance(values, dict) and NS in values
        if named:
            ns = join(namespace, str(values.pop(NS)))
        found.append(Document(values, ns, source, dict(_lines(node, "")), named))
    return found


def parse(text: str) -> Any:
    """Return the value of a YAML text, as in ``rosparam set /gains '[1, 2.5]'``; None for an empty text.

    Raises ``RosParamException`` if the text is not valid YAML, or has several documents.
    """
    documents = load_str(text)
    if len(documents) > 1:
        raise RosParamException(f"{text!r} is {len(documents)} YAML documents, but a single value is needed")
    return documents[0].values if documents else None


def _lines(node: yaml.Node, place: str) -> Iterator[tuple[str, int]]:
    yield place or "/", line_of(node) or 1
    for step, written, value in children(node):
        yield from _lines(value, place + step)
        yield place + step, line_of(written) or 1


# ---- writing ----


def dumps(value: Any) -> str:
    """Return a value as YAML in rosparam's format: keys sorted, one value per line."""
    text: str = yaml.dump(value, Dumper=_Dumper, default_flow_style=False, sort_keys=True)
    return text.removesuffix("...\n")


def printed(value: Any) -> str:
    """Return the output of ``rosparam get``: YAML, followed by an empty line unless it is a scalar without quotes."""
    text = dumps(value)
    is_plain = not isinstance(value, (dict, list)) and text[0] not in "'\"|"
    return text if is_plain else f"{text}\n"


def pretty(value: Any) -> str:
    """Return the output of ``rosparam get -p``: readable text, not YAML."""
    if isinstance(value, str):
        return f"{value}\n"
    return "".join(f"{line}\n" for line in _pretty(value, "")) if isinstance(value, dict) else printed(value)


def _pretty(tree: dict[str, Any], indent: str) -> Iterator[str]:
    for key, value in sorted(tree.items()):
        if isinstance(value, dict):
            yield f"{indent}{key}:"
            yield from _pretty(value, indent + "  ")
        elif isinstance(value, str) and "\n" in value:
            yield f"{indent}{key}: |"
            yield from (f"{indent}  {line}" for line in value.split("\n"))
        else:
            yield f"{indent}{key}: {value if isinstance(value, str) else dumps(value).rstrip()}"
