"""The sampled velocities along one axis: base_local_planner's `VelocityIterator`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def velocity_samples(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Return `count` evenly spaced values (at least two) from `low` to `high`, and 0 if it lies between two of them.

    If `low` and `high` are equal, return only that value.

    >>> velocity_samples(-1.0, 2.0, 3).tolist()
    [-1.0, 0.0, 0.5, 2.0]
    """
    if low == high:
        return np.array([low])
    count = max(2, count)
    values = low + (high - low) / (count - 1) * np.arange(count, dtype=np.float64)
    values[-1] = high
    after = int(np.searchsorted(values, 0.0))
    if 0 < after < count and values[after] > 0 > values[after - 1]:
        values = np.concatenate([values[:after], (0.0,), values[after:]])
    return values
