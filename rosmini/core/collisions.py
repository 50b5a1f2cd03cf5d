"""Keys with equal hashes: Python hashes numbers predictably, so a file can make its sets and dictionaries quadratic.

``{i * (2**61 - 1) for i in range(20000)}`` compares each number with all the others. Strings are hashed with a secret
and cannot be made to collide.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable

__all__ = ["MOST", "collide"]

MOST = 64
"""How many different keys of one set or dictionary may have the same hash."""


def collide(keys: Iterable[Hashable]) -> bool:
    """Return whether more than `MOST` different keys have the same hash.

    Raises ``TypeError`` for a key that has none.
    """
    firsts: dict[int, Hashable] = {}
    others: dict[int, list[Hashable]] = {}
    for key in keys:
        if type(key) is str:
            continue
        code = hash(key)
        first = firsts.setdefault(code, key)
        if first is key or first == key:
            continue
        different = others.setdefault(code, [])
        if key not in different:
            different.append(key)
            if len(different) >= MOST:
                return True
    return False
