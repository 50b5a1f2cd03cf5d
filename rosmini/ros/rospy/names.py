"""Names of the caller's node, and name resolution: http://wiki.ros.org/Names."""

from __future__ import annotations

from rosmini.core.errors import ROSException
from rosmini.core.names import Remappings, canonicalize, is_global, is_private, join, namespace, resolve_for

from .session import any_node, current_node, current_session

__all__ = [
    "canonicalize_name",
    "get_caller_id",
    "get_mappings",
    "get_name",
    "get_namespace",
    "get_resolved_mappings",
    "is_global",
    "is_private",
    "namespace",
    "ns_join",
    "remap_name",
    "resolve_name",
    "scoped_name",
]

SEP = "/"
GLOBALNS = "/"
PRIV_NAME = "~"
REMAP = ":="
ANYTYPE = "*"

canonicalize_name = canonicalize
ns_join = join


def get_name() -> str:
    """Return the node's global name; ``/unnamed`` before ``init_node``."""
    return any_node().name


get_caller_id = get_name


def get_namespace() -> str:
    """Return the node's namespace, with a closing slash."""
    node = current_node()
    found = current_session().namespace() if node is None else node.namespace
    return found if found.endswith("/") else found + "/"


def resolve_name(name: str, caller_id: str | None = None) -> str:
    """Return the global name of ``name`` for the node, or for ``caller_id``, after remapping.

    Raises ``IllegalName``.
    """
    if caller_id:
        return _remappings().apply(resolve_for(name, caller_id), caller_id)
    if not name:
        return namespace(get_name())
    return any_node().resolve(name)


def remap_name(name: str, caller_id: str | None = None, resolved: bool = True) -> str:
    """Return the remapped name for ``name``, resolved unless ``resolved`` is false.

    Return ``name`` itself if it is not remapped.
    """
    caller_id = caller_id or get_name()
    mappings = get_mappings()
    if name not in mappings:
        return name
    target = str(mappings[name])
    return resolve_for(target, caller_id) if resolved else target


def scoped_name(caller_id: str, name: str) -> str:
    """Return the global ``name`` relative to the namespace of ``caller_id``.

    Raises ``ROSException`` if ``name`` is not global.
    """
    if not is_global(caller_id):
        raise ROSException(f"caller_id must be global: {caller_id} is not")
    return canonicalize(name)[len(namespace(caller_id)) :]


def _remappings() -> Remappings:
    node = current_node()
    return current_session().remappings() if node is None else node.remappings


def get_mappings() -> dict[str, str]:
    """Return the remappings as they were written."""
    found = _remappings()
    return {**found.names, **found.special}


def get_resolved_mappings() -> dict[str, str]:
    """Return the remappings between global names."""
    found, name = _remappings(), get_name()
    return {resolve_for(a, name): resolve_for(b, name) for a, b in found.names.items()} | found.special
