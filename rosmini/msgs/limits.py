"""Limits on the size of message types: a definition from outside may say ``float64[99999999999] x``.

No ROS type comes near these limits. They are checked before a definition is used, so that md5
sums, classes and default values cannot take more time or memory than they allow.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass

from .definition import BYTES, FORMATS, Field, MessageSpec

MAX_DEPTH = 64
"""Maximum nesting depth of messages."""
MAX_FIELDS = 4096
"""Maximum number of fields of a message, including those of nested messages."""
MAX_MEMORY = 64 * 1024 * 1024
"""Maximum memory for a message with default values [bytes]."""
MAX_EMPTY = 16
"""Maximum number of values without bytes (empty messages) in a message or array: no data limits their number."""

_OBJECT = 64  # approximate memory of an object


@dataclass(frozen=True, slots=True)
class Measure:
    """Size of a message: levels, fields (an array counts as one), minimum bytes, default memory, empty messages."""

    depth: int = 0
    fields: int = 0
    wire: int = 0
    memory: int = _OBJECT
    empty: int = 0


def measure(spec: MessageSpec, of: Callable[[str], Measure]) -> Measure:
    """Measure a definition; ``of`` returns the measures of nested types by name.

    Raises :class:`~rosmini.core.errors.DefinitionError` at the field that makes the type too large.
    """
    depth = fields = wire = empty = 0
    memory = _OBJECT
    for field in spec.fields:
        one = measured(field) if field.builtin else of(field.base)
        count = 1 if field.size is None else max(field.size, 0)
        depth = max(depth, one.depth + 1)
        fields += one.fields if field.size is None else 1
        wire += 4 if field.size == -1 else count * one.wire
        memory += _OBJECT + count * one.memory
        empty += count * (one.empty + (one.wire == 0))
        problem = _problem(depth, fields, memory, empty)
        if problem:
            raise spec.error(field.line, f"field '{field.name}' makes the message too large: {problem}")
    return Measure(depth, fields, wire, memory, empty)


def measured(field: Field) -> Measure:
    """Return the measure of one value of a built-in type."""
    if field.base in FORMATS:
        size = struct.calcsize("<" + FORMATS[field.base])
        return Measure(fields=1, wire=size, memory=1 if field.base in BYTES else 8)
    if field.base == "string":
        return Measure(fields=1, wire=4, memory=8)
    return Measure(fields=1, wire=8, memory=_OBJECT)


def _problem(depth: int, fields: int, memory: int, empty: int) -> str:
    if depth > MAX_DEPTH:
        return f"more than {MAX_DEPTH} levels of messages in messages"
    if fields > MAX_FIELDS:
        return f"more than {MAX_FIELDS:,} fields"
    if memory > MAX_MEMORY:
        return f"its default value alone would take {memory:,} bytes of memory, at most {MAX_MEMORY:,} are allowed"
    if empty > MAX_EMPTY:
        return f"more than {MAX_EMPTY} empty messages in one"
    return ""
