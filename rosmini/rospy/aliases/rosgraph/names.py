"""``rosgraph.names``: rules of names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.errors import IllegalName
from rosmini.graph import default_graph
from rosmini.names import (
    Remappings,
    check_base_name,
    check_name,
    is_global,
    is_private,
    is_remapping,
    join,
    namespace,
    resolve_for,
)
from rosmini.names import canonicalize as canonicalize_name

__all__ = [
    "anonymous_name",
    "canonicalize_name",
    "get_ros_namespace",
    "is_global",
    "is_legal_base_name",
    "is_legal_name",
    "is_legal_remap",
    "is_private",
    "load_mappings",
    "make_caller_id",
    "make_global_ns",
    "namespace",
    "ns_join",
    "resolve_name",
]

SEP = "/"
GLOBALNS = "/"
PRIV_NAME = "~"
REMAP = ":="
ANYTYPE = "*"
MSG_EXT = ".msg"
SRV_EXT = ".srv"

ns_join = join
is_legal_remap = is_remapping


def is_legal_name(name: Any) -> bool:
    """Tell whether ``name`` is a legal graph resource name."""
    return name is not None and _passes(check_name, name)


def is_legal_base_name(name: Any) -> bool:
    """Tell whether ``name`` is a legal base name, one without a namespace."""
    return name is not None and _passes(check_base_name, name)


def _passes(check: Any, name: Any) -> bool:
    try:
        check(name)
    except IllegalName:
        return False
    return True


def resolve_name(name: str, namespace_: str, remappings: dict[str, str] | None = None) -> str:
    """Return the global name that ``name`` means for the node ``namespace_``; ``remappings`` are between global names."""
    resolved = resolve_for(name, namespace_)
    return (remappings or {}).get(resolved, resolved)


def load_mappings(argv: Sequence[str]) -> dict[str, str]:
    """Return the remappings among the arguments, without private parameters."""
    found = Remappings.from_argv(argv)
    return {**found.names, **found.special}


def make_global_ns(name: str) -> str:
    """Return ``name`` as a global namespace, with a closing slash. Raises ``ValueError`` for a private name."""
    if is_private(name):
        raise IllegalName(f"{name} is private to a node and cannot be a namespace")
    given = name if name.startswith(SEP) else SEP + name
    return given if given.endswith(SEP) else given + SEP


def get_ros_namespace(env: dict[str, str] | None = None, argv: Sequence[str] | None = None) -> str:
    """Return the namespace that ``__ns:=`` or ``ROS_NAMESPACE`` gives, with a closing slash."""
    import os
    import sys

    given = Remappings.from_argv(sys.argv if argv is None else argv).namespace
    return make_global_ns(given or (os.environ if env is None else env).get("ROS_NAMESPACE", "/"))


def make_caller_id(name: str) -> str:
    """Return the global name of a caller, with a closing slash."""
    return make_global_ns(ns_join(get_ros_namespace(), name))


def anonymous_name(id: str) -> str:
    """Return ``id`` with numbers that make it unique: the same on each run in simulated time."""
    return default_graph().anonymous_name(id)
