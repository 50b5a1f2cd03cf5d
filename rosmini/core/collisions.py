"""Hash collisions: Python hashes numbers predictably, so a file can make its sets and dictionaries quadratic.

``{i * (2**61 - 1) for i in range(20000)}`` compares each number with all the others. Strings are hashed with a secret
key, so collisions cannot be constructed.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable

MAX_COLLISIONS = 64
"""Maximum number of different keys with the same hash in one set or dictionary."""


def collide(keys: Iterable[Hashable]) -> bool:
    """Return whether more than `MAX_COLLISIONS` different keys have the same hash.

    Raises ``TypeError`` for a key that cannot be hashed.
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
            if len(different) >= MAX_COLLISIONS:
                return True
    return False
