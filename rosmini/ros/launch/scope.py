"""What holds at one point of a launch file: namespace, arguments, remappings, environment, private parameters.

Groups, includes and nodes have a scope of their own inside; what they change there does not show outside
(http://wiki.ros.org/roslaunch/XML/group).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from rosmini.core.names import canonicalize, join


@dataclass
class Scope:
    """See the module. ``namespace`` ends in a slash."""

    file: str
    namespace: str = "/"
    args: dict[str, str] = field(default_factory=dict)
    """Values of arguments, also of such as were given and are not declared."""
    declared: set[str] = field(default_factory=set)
    anonymous: dict[str, str] = field(default_factory=dict)
    """What ``$(anon name)`` stands for."""
    private: dict[str, Any] = field(default_factory=dict)
    """Parameters that every node below gets as its own, by name without the tilde."""
    environment: dict[str, str] = field(default_factory=dict)
    remappings: dict[str, str] = field(default_factory=dict)
    included_at: str = ""
    """Where the ``<include>`` of this file is; empty in a file that was named itself."""
    takes_all: bool = False
    """True at the top of a file that is included with ``pass_all_args``."""

    def child(self, namespace: str | None = None) -> Scope:
        """Return a scope inside this one, in a namespace below it or in a global one."""
        return replace(
            self,
            namespace=self.inside(namespace),
            args=dict(self.args),
            declared=set(self.declared),
            anonymous=dict(self.anonymous),
            private=dict(self.private),
            environment=dict(self.environment),
            remappings=dict(self.remappings),
            takes_all=False,
        )

    def included(
        self, file: str, namespace: str | None, args: Mapping[str, str], *, at: str, takes_all: bool
    ) -> Scope:
        """Return the scope of a file that is included ``at`` a place: it knows only the arguments that it is given."""
        made = self.child(namespace)
        made.file, made.included_at, made.takes_all = file, at, takes_all
        made.args, made.declared, made.anonymous = dict(args), set(), {}
        made.private = (
            self.private or {}
        )  # as in ROS: it adds to those of the including file, if that has any
        return made

    def inside(self, namespace: str | None) -> str:
        """Return the namespace that ``ns`` means here, with its closing slash."""
        if not namespace:
            return self.namespace
        return canonicalize(join(self.namespace, namespace)).rstrip("/") + "/"

    def full(self, name: str) -> str:
        """Return the global name of a parameter or a node."""
        return canonicalize(join(self.namespace, name))

    def remap(self, source: str, target: str) -> None:
        """Add a remapping; an earlier one of the same name is forgotten."""
        self.remappings.pop(source, None)
        self.remappings[source] = target

    def unused(self, given: Mapping[str, str]) -> Iterator[str]:
        """Yield the names of arguments that were given and that nobody has declared."""
        return (name for name in given if name not in self.declared)
