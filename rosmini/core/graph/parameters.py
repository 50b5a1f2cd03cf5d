"""The tree of parameters behind the Parameter Server (http://wiki.ros.org/Parameter%20Server)."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from rosmini.core.errors import ParameterError
from rosmini.core.names import canonicalize, is_global, is_private, join

Tree = dict[str, Any]
Update = tuple[str, str, Any]
"""The subscribed key, and the key and value to send to its subscribers."""


class ParameterTree:
    """The parameters by global name; a namespace is a dictionary.

    Keys must be resolved names. Values are copied when they are set and when they are returned.
    """

    def __init__(self) -> None:
        self._root: Tree = {}

    def set(self, key: str, value: Any) -> None:
        """Set a value; a dictionary replaces the whole namespace. Raises ``ParameterError`` if ROS cannot store it."""
        value = wire_copy(value, key)
        if not _parts(key):
            if type(value) is not dict:
                raise ParameterError("cannot set root of parameter tree to non-dictionary")
            self._root = value
            return
        *path, last = _parts(key)
        tree = self._root
        for part in path:
            # A namespace replaces a value that is in its place.
            if type(tree.get(part)) is not dict:
                tree[part] = {}
            tree = tree[part]
        tree[last] = value

    def get(self, key: str) -> Any:
        """Return a value, or a namespace as a dictionary. Raises ``KeyError`` if the key is not set."""
        return wire_copy(self._find(_parts(key)), key)

    def delete(self, key: str) -> None:
        """Delete a value or a namespace. Raises ``KeyError`` if the key is not set or is the root."""
        if not _parts(key):
            raise KeyError(key)
        *path, last = _parts(key)
        tree = self._find(path)
        if type(tree) is not dict or last not in tree:
            raise KeyError(key)
        del tree[last]

    def __contains__(self, key: str) -> bool:
        try:
            self._find(_parts(key))
        except KeyError:
            return False
        return True

    def names(self) -> list[str]:
        """Return the names of all parameters, in insertion order within each namespace."""
        return _leaves("/", self._root)

    def search(self, ns: str, key: str) -> str | None:
        """Return the nearest match for ``key``, going up from the namespace ``ns``, or None.

        Only the first part of ``key`` is searched for. Raises ``ValueError`` for a private key or a namespace that is
        not global.
        """
        if is_private(key):
            raise ValueError("invalid key")
        if not is_global(ns):
            raise ValueError("namespace must be global")
        if is_global(key):
            return key if key in self else None
        first = _parts(key)[0]
        if join(ns, first) in self:
            return join(ns, key)
        path = _parts(ns)
        while path:
            path.pop()
            if "/" + "/".join([*path, first]) in self:
                return "/" + "/".join([*path, key])
        return None

    def _find(self, path: list[str]) -> Any:
        found: Any = self._root
        for part in path:
            if type(found) is not dict:
                raise KeyError(part)
            found = found[part]
        return found


def updates(subscribed: list[str], key: str, value: Any) -> list[Update]:
    """Return the updates for those of the ``subscribed`` keys that a change of ``key`` to ``value`` affects.

    A subscription to a namespace gets every change within it. A subscription below ``key`` gets its own part of
    the new value, or ``{}`` (ROS's "deleted") if the value does not contain that part.
    """
    changed = closed(key)
    parts = _subtrees(changed, value) if type(value) is dict else None
    found: list[Update] = []
    for name in subscribed:
        if changed.startswith(name):
            found.append((name, changed, value))
        elif parts is not None and name.startswith(changed) and name not in parts:
            found.append((name, name, {}))
    if parts is not None:
        found += [(name, name, part) for name, part in parts.items() if name in subscribed]
    return found


def closed(key: str) -> str:
    """Return ``key`` with a trailing slash, so that ``/a/`` is a prefix of ``/a/b/`` but not of ``/ab/``."""
    return key if key == "/" else canonicalize(key) + "/"


def wire_copy(value: Any, key: str = "") -> Any:
    """Return a copy of ``value`` as XML-RPC would deliver it: tuples become lists.

    ROS parameters are bool, int (32 bits), float, str, bytes, datetime, lists, and dictionaries with str keys. Raises
    ``ParameterError``, which names the place (``/robot/sizes[2]``), for other types.
    """
    kind = type(value)
    if kind in (bool, float, str, bytes, datetime):
        return value
    if kind is int:
        if -(2**31) <= value < 2**31:
            return value
        raise ParameterError(
            f"{key}: {value} does not fit into 32 bits, ROS's limit for integers: use a float or a str"
        )
    if kind in (list, tuple):
        return [wire_copy(item, f"{key}[{index}]") for index, item in enumerate(value)]
    if kind is dict:
        for name in value:
            if type(name) is not str:
                raise ParameterError(f"{key}: the key {name!r} is not a str, but the parts of a parameter's name are")
        return {name: wire_copy(item, join(key, name)) for name, item in value.items()}
    module = "" if kind.__module__ == "builtins" else kind.__module__ + "."
    raise ParameterError(
        f"{key}: a parameter cannot be {value!r} (a {module}{kind.__qualname__}): "
        "use bool, int, float, str, bytes, or lists and dictionaries of them"
    )


def _parts(key: str) -> list[str]:
    return [part for part in key.split("/") if part]


def _leaves(key: str, tree: Tree) -> list[str]:
    names: list[str] = []
    for name, value in tree.items():
        full = join(key, name)
        names += _leaves(full, value) if type(value) is dict else [full]
    return names


def _subtrees(key: str, tree: Tree) -> Tree:
    """Return all namespaces and values below ``key``, by names with a trailing slash."""
    found: Tree = {}
    for name, value in tree.items():
        full = join(key, name) + "/"
        found[full] = value
        if type(value) is dict:
            found |= _subtrees(full, value)
    return found
