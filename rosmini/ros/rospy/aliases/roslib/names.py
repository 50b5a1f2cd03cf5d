"""``roslib.names``: the contents of ``rosgraph.names``, and names of the form ``package/Type``."""

from __future__ import annotations

import re

from rosmini.core.errors import IllegalName
from rosmini.ros.rospy.aliases.rosgraph.names import *  # noqa: F403

PRN_SEPARATOR = TYPE_SEPARATOR = "/"

_RESOURCE = re.compile(r"[A-Za-z][\w/]*")
_RESOURCE_BASE = re.compile(r"[A-Za-z]\w*")


def resource_name(res_pkg_name: str, name: str, my_pkg: str | None = None) -> str:
    """Return ``package/name``, or only the name within its own package ``my_pkg``."""
    return name if res_pkg_name == my_pkg else f"{res_pkg_name}/{name}"


def resource_name_base(name: str) -> str:
    """Return the name without its package."""
    return name.rpartition("/")[2]


def resource_name_package(name: str) -> str | None:
    """Return the package of a name, or None if it has no package."""
    return name.partition("/")[0] if "/" in name else None


def package_resource_name(name: str) -> tuple[str, str]:
    """Return the package, possibly empty, and the name in it. Raises ``ValueError`` for more than one slash."""
    if name.count("/") > 1:
        raise IllegalName(f"invalid name [{name}]: it has more than one slash; a type is package/Type")
    package, _, base = name.rpartition("/")
    return package, base


def is_legal_resource_name(name: str | None) -> bool:
    """Return True if ``name`` is a legal name of something in a package."""
    return name is not None and bool(_RESOURCE.fullmatch(name)) and "//" not in name


def is_legal_resource_base_name(name: str | None) -> bool:
    """Return True if ``name`` is a legal name without a package."""
    return name is not None and bool(_RESOURCE_BASE.fullmatch(name))
