"""Numbers as text for the player in a page: integers, then differences, then bytes, then base64.

The result could be compressed further, but other versions of zlib write other bytes, and nbval compares the HTML.
"""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.viz.rounding import snap

LENGTH = 1e-3
"""Unit of lengths [m] and speeds [m/s]."""
ANGLE = 1e-4
"""Unit of angles [rad] and angular velocities [rad/s]."""
TIME = 1e-3
"""Unit of times [s]."""
NANOSECOND = 1e-9
"""Unit of short times [s]."""
MAX_DIFFERENCE = 2**50
"""Above this, a difference is not an exact number in JavaScript."""


def whole(values: Any, quantum: float) -> NDArray[np.int64]:
    """Return values as integer multiples of `quantum`, off by less than 0.54 of it, regardless of their last bit."""
    bounded = np.clip(np.asarray(values, dtype=float), -MAX_DIFFERENCE * quantum, MAX_DIFFERENCE * quantum)
    return snap(bounded / quantum, 1.0).astype(np.int64)


def pack(values: NDArray[np.int64]) -> str:
    """Return integers (n,) as text.

    The text contains differences, each folded to a natural number (0, -1, 1, -2 become 0, 1, 2, 3), in bytes of
    seven bits, the lowest first, the eighth bit set in all but the last byte of a number; as base64. Fold and bytes
    are those of Protocol Buffers' sint64 (protobuf.dev/programming-guides/encoding).
    """
    steps = np.diff(values, prepend=0)
    return pack_natural(np.where(steps < 0, -2 * steps - 1, 2 * steps))


def pack_natural(values: ArrayLike) -> str:
    """Return natural numbers (n,) as text in the format of `pack`, but without differences and without folding."""
    numbers = np.asarray(values, dtype=np.int64)
    length = np.ones(len(numbers), dtype=np.int64)
    longer, rest = [np.arange(len(numbers))], numbers >> 7
    while len(more := longer[-1][rest > 0]):  # most numbers are one byte long
        length[more] += 1
        longer.append(more)
        rest = numbers[more] >> 7 * len(longer)
    begin = np.cumsum(length) - length
    coded = np.empty(int(length.sum()), dtype=np.uint8)
    for place, which in enumerate(longer):
        last = length[which] == place + 1
        coded[begin[which] + place] = (numbers[which] >> 7 * place & 127) | np.where(last, 0, 128)
    return base64.b64encode(coded.tobytes()).decode()


def pack_columns(rows: ArrayLike, *quanta: float) -> str:
    """Return rows (n, c) as text, column by column, each in integer multiples of its quantum."""
    table = np.asarray(rows, dtype=float).reshape(-1, len(quanta))
    columns = [whole(column, quantum) for column, quantum in zip(table.T, quanta, strict=True)]
    return pack(np.concatenate(columns))
