"""A topic of a bag as a table: one row per message, one column per number or text in it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from rosmini.core.time import TVal

TIME = "time"
"""Name of the column with the recording times of messages [s]."""


class Table(dict[str, Any]):
    """Columns by name, of equal length, in the order of the fields: ``pandas.DataFrame(table)`` is a data frame.

    Columns of numbers are numpy arrays; columns of texts and of arrays (``ranges`` of a scan) are lists with one entry
    per message.
    """

    @property
    def rows(self) -> int:
        """Number of messages."""
        return len(self[TIME]) if TIME in self else 0


def table(cls: Any, messages: Iterable[tuple[str, Any, TVal]]) -> Table:
    """Return messages of one class, as yielded by `Bag.read_messages`, as columns.

    Nested fields are written with dots: ``pose.pose.position.x``; ``header.stamp`` and other times are in seconds.
    ``time`` is when the message was recorded [s]. An array of messages becomes a list column.
    """
    columns: dict[str, list[Any]] = {TIME: []}
    for name in _columns(cls, ""):
        columns[name] = []
    for _, message, time in messages:
        columns[TIME].append(time.to_sec())
        _fill(columns, message, "")
    return Table((name, _packed(values)) for name, values in columns.items())


def _columns(cls: Any, prefix: str) -> list[str]:
    """Return the columns of a message class, so that a topic without messages has them too."""
    names: list[str] = []
    for field in cls._spec.fields:
        name = prefix + field.name
        nested = cls._nested.get(field.base)
        names += [name] if nested is None or field.size is not None else _columns(nested, name + ".")
    return names


def _fill(columns: dict[str, list[Any]], message: Any, prefix: str) -> None:
    for field in message._spec.fields:
        value = getattr(message, field.name)
        name = prefix + field.name
        if hasattr(value, "_spec"):
            _fill(columns, value, name + ".")
        else:
            columns[name].append(value.to_sec() if isinstance(value, TVal) else value)


def _packed(values: list[Any]) -> Any:
    """Return numbers as an array, anything else as a list."""
    if values and all(isinstance(value, bool | int | float) for value in values):
        return np.array(values)
    return values
