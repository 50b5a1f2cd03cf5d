"""The reverse of `rosmini.viz.replay.packing`, written from its description."""

from __future__ import annotations

import base64

import numpy as np


def naturals(text: str) -> np.ndarray:
    """What `pack_natural` wrote."""
    values, number, shift = [], 0, 0
    for byte in base64.b64decode(text):
        number |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            values.append(number)
            number = shift = 0
    return np.array(values, dtype=np.int64)


def unpack(text: str) -> np.ndarray:
    """What `pack` wrote."""
    folded = naturals(text)
    return np.cumsum(np.where(folded % 2, -(folded + 1) // 2, folded // 2))


def columns(text: str, count: int) -> np.ndarray:
    """What `pack_columns` wrote, in whole numbers (n, count)."""
    return unpack(text).reshape(count, -1).T
