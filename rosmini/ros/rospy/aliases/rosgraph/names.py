"""``rosgraph.names``: rules for names."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from rosmini.core.errors import IllegalName
from rosmini.core.graph import running_graph
from rosmini.core.names import (
    Remappings,
    is_global,
    is_legal_base_name,
    is_legal_name,
    is_private,
    is_remapping,
    join,
    namespace,
    resolve_for,
)
from rosmini.core.names import canonicalize as canonicalize_name

__all__ = [
    "ANYTYPE",
    "GLOBALNS",
    "PRIV_NAME",
    "REMAP",
    "SEP",
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
    "script_resolve_name",
]

SEP = "/"
GLOBALNS = "/"
PRIV_NAME = "~"
REMAP = ":="
ANYTYPE = "*"
MSG_EXT = ".msg"
SRV_EXT = ".srv"

ROS_NAMESPACE = "ROS_NAMESPACE"

ns_join = join
is_legal_remap = is_remapping


def resolve_name(name: str, namespace_: str, remappings: dict[str, str] | None = None) -> str:
    """Return the global name of ``name`` for the node ``namespace_``; ``remappings`` use global names."""
    resolved = resolve_for(name, namespace_)
    return (remappings or {}).get(resolved, resolved)


def load_mappings(argv: Sequence[str]) -> dict[str, str]:
    """Return the remappings in the arguments, without private parameters; prints an error for two ``:=`` to stderr."""
    kept = []
    for argument in filter(is_remapping, argv):
        if argument.count(REMAP) > 1:
            sys.stderr.write(f"ERROR: Invalid remapping argument '{argument}'\n")
        elif argument.startswith("__") or not argument.startswith("_"):
            kept.append(argument)
    found = Remappings.from_argv(kept)
    return {**found.names, **found.special}


def make_global_ns(name: str) -> str:
    """Return ``name`` as a global namespace, with a closing slash. Raises ``ValueError`` for a private name."""
    if is_private(name):
        raise IllegalName(f"{name} is private to a node and cannot be a namespace")
    given = name if name.startswith(SEP) else SEP + name
    return given if given.endswith(SEP) else given + SEP


def get_ros_namespace(env: dict[str, str] | None = None, argv: Sequence[str] | None = None) -> str:
    """Return the namespace from ``__ns:=`` or ``ROS_NAMESPACE``, with a closing slash."""
    given = Remappings.from_argv(sys.argv if argv is None else argv).namespace
    return make_global_ns(given or (os.environ if env is None else env).get("ROS_NAMESPACE", "/"))


def make_caller_id(name: str) -> str:
    """Return the global name of a caller, with a closing slash."""
    return make_global_ns(ns_join(get_ros_namespace(), name))


def anonymous_name(id: str) -> str:
    """Return ``id`` with numbers that make it unique; the same on each run in simulated time."""
    return running_graph().anonymous_name(id)


def script_resolve_name(script_name: str, name: str | None) -> str:
    """Return the global name of ``name`` for a script without a node or remappings; for "", the namespace."""
    if not name:
        return get_ros_namespace()
    if is_private(name):
        return ns_join(make_caller_id(script_name), name[1:])
    return name if is_global(name) else get_ros_namespace() + name
