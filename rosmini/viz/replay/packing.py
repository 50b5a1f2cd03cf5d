"""Numbers as text for the player in a page: whole ones, then differences, then bytes, mostly one for each, then base64.

It could be compressed further, but another zlib writes other bytes, and nbval compares HTML to the byte.
"""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.viz.rounding import snap

LENGTH = 1e-3
"""[m], also [m/s]"""
ANGLE = 1e-4
"""[rad], also [rad/s]"""
TIME = 1e-3
"""[s]"""
NANOSECOND = 1e-9
"""[s]"""
LARGEST = 2**50
"""Beyond it a difference is no exact number in JavaScript."""


def whole(values: Any, quantum: float) -> NDArray[np.int64]:
    """Values as whole multiples of `quantum`; off by less than 0.54 of it, and never by the last bit of a value."""
    bounded = np.clip(np.asarray(values, dtype=float), -LARGEST * quantum, LARGEST * quantum)
    return snap(bounded / quantum, 1.0).astype(np.int64)


def pack(values: NDArray[np.int64]) -> str:
    """Whole numbers (n,) as text.

    What is written are the differences, each folded to a natural number (0, -1, 1, -2 become 0, 1, 2, 3), in bytes of
    seven bits, the lowest first, the eighth bit set in all but a number's last; as base64. The fold and the bytes are
    those of Protocol Buffers' sint64 (protobuf.dev/programming-guides/encoding).
    """
    steps = np.diff(values, prepend=0)
    return pack_natural(np.where(steps < 0, -2 * steps - 1, 2 * steps))


def pack_natural(values: ArrayLike) -> str:
    """Natural numbers (n,) as text: as `pack` writes them, but neither differences nor folded."""
    numbers = np.asarray(values, dtype=np.int64)
    groups = numbers[:, None] >> np.arange(0, 63, 7)
    length = np.maximum(1, (groups > 0).sum(axis=1))[:, None]
    place = np.arange(groups.shape[1])
    coded = (groups & 127) | np.where(place < length - 1, 128, 0)
    return base64.b64encode(coded[place < length].astype(np.uint8).tobytes()).decode()


def pack_columns(rows: ArrayLike, *quanta: float) -> str:
    """Rows (n, c) as text, column by column, each in whole multiples of its quantum."""
    table = np.asarray(rows, dtype=float).reshape(-1, len(quanta))
    columns = [whole(column, quantum) for column, quantum in zip(table.T, quanta, strict=True)]
    return pack(np.concatenate(columns))
