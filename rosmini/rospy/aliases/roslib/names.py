"""``roslib.names``: what is in ``rosgraph.names``."""

from __future__ import annotations

from rosmini.rospy.aliases.rosgraph.names import (
    canonicalize_name,
    is_global,
    is_private,
    namespace,
    ns_join,
    resolve_name,
)

__all__ = ["canonicalize_name", "is_global", "is_private", "namespace", "ns_join", "resolve_name"]
