"""The fields of a message as a form: one row for each, with an expression that makes its value."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BytesIO
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.expressions import Expression, ExpressionError
from rosmini.core.time import Duration, Time
from rosmini.msgs.message import Message
from rosmini.viz.view import ViewError

from .parts import Control, Row, Rows

TIMES = {"time": Time, "duration": Duration}

MAX_DEPTH = 12
"""Maximum depth of nested messages shown."""


class Fields:
    """A message type, and an expression for each of its fields: ``0.5 * sin(i)``, ``'hello'``, ``[1, 2]``.

    ``i`` counts the messages. Paths such as ``linear/x`` name the fields. Arrays of messages keep their
    default. :mod:`rosmini.core.expressions` evaluates the expressions safely.
    """

    def __init__(self, cls: Any) -> None:
        self.cls = cls
        self.texts: dict[str, str] = {}
        self._kinds: dict[str, str] = {}
        self._expressions: dict[str, Expression] = {}
        """The expressions given; other fields keep their default."""
        for path, kind, value in walk(cls()):
            if not isinstance(value, Message):
                self._kinds[path] = kind
                self.texts[path] = _text(value)

    @property
    def given(self) -> dict[str, str]:
        """The given expressions, by path."""
        return {path: self.texts[path] for path in self._expressions}

    def fill(self, path: str, text: str) -> None:
        """Give a field an expression.

        Raises:
            ViewError: there is no such field, the text is not an expression, or its value does not fit the field.

        """
        if path not in self.texts:
            hint = nearest(path, self.texts) or f"there are {', '.join(self.texts) or 'none'}"
            raise ViewError(f"{self.cls._type} has no field {path!r:.80}; {hint}")
        try:
            expression = Expression(text, names=("i",))
        except ExpressionError as error:
            raise ViewError(f"{path}: {text!r:.80} is not an expression: {error}") from error
        before = self._expressions.get(path)
        self._expressions[path] = expression
        try:
            self.message(0)
        except ViewError:
            del self._expressions[path]
            if before is not None:
                self._expressions[path] = before
            raise
        self.texts[path] = text

    def message(self, count: int) -> Any:
        """Return a message, in which ``i`` is ``count``. Raises ``ViewError`` if an expression has no value."""
        made = self.cls()
        for path, expression in self._expressions.items():
            *parents, name = path.split("/")
            owner = made
            for parent in parents:
                owner = getattr(owner, parent)
            try:
                value = expression.evaluate({"i": count})
                setattr(owner, name, _fitting(value, self._kinds[path]))
            except (ExpressionError, TypeError, ValueError, OverflowError) as error:
                raise ViewError(f"{path} [{self._kinds[path]}]: {expression.text!r:.80}: {error}") from error
        try:
            made.serialize(BytesIO())
        except RosminiError as error:
            raise ViewError(str(error)) from error
        return made

    def table(self, prefix: str) -> Rows:
        """Return a row for each field; the key of its control is ``prefix/PATH``."""
        rows = []
        for path, kind, value in walk(self.cls()):
            name, depth = path.rpartition("/")[2], path.count("/")
            control = Control(f"{prefix}/{path}", f"{path} [{kind}]", "text", self.texts.get(path, ""))
            rows.append(Row((name, kind, "" if isinstance(value, Message) else control), depth))
        return Rows(("Field", "Type", "Expression"), tuple(rows), f"Fields of {self.cls._type}", "no fields")


def value_table(message: Any, shown: Callable[[Any], str]) -> Rows:
    """Return a row with the value of each field of a received message."""
    rows = (
        Row((path.rpartition("/")[2], kind, "" if isinstance(value, Message) else shown(value)), path.count("/"))
        for path, kind, value in walk(message)
    )
    return Rows(("Field", "Type", "Value"), tuple(rows), f"Values of {message._type}", "no fields")


def _fitting(value: Any, kind: str) -> Any:
    """Convert a value to the type of its field: whole numbers to floats, and seconds to times."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        if kind in ("float32", "float64"):
            return float(value)
        if kind in TIMES:
            return TIMES[kind].from_sec(value)
    return value


def walk(message: Any, path: str = "", depth: int = 0) -> Iterator[tuple[str, str, Any]]:
    """Yield path, type and value of each field; the fields of a nested message follow it."""
    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        value = getattr(message, name)
        here = f"{path}/{name}" if path else name
        yield here, kind, value
        if isinstance(value, Message) and depth < MAX_DEPTH:
            yield from walk(value, here, depth + 1)


def _text(value: Any) -> str:
    if hasattr(value, "to_sec"):
        return f"{value.to_sec():g}"
    if isinstance(value, bytes):
        return repr(list(value))
    tolist = getattr(value, "tolist", None)
    return repr(value if tolist is None else tolist())
