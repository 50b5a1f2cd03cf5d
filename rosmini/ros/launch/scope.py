"""The scope at a point of a launch file: namespace, arguments, remappings, environment, private parameters.

Groups, includes and nodes have an inner scope; their changes are not visible outside
(http://wiki.ros.org/roslaunch/XML/group).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from rosmini.core.names import canonicalize, join


@dataclass
class Scope:
    """A scope, as the module describes; ``namespace`` ends in a slash."""

    file: str
    namespace: str = "/"
    args: dict[str, str] = field(default_factory=dict)
    """Values of arguments, including undeclared ones that were given."""
    declared: set[str] = field(default_factory=set)
    anonymous: dict[str, str] = field(default_factory=dict)
    """Names for ``$(anon name)``."""
    private: dict[str, Any] = field(default_factory=dict)
    """Private parameters for every node in the scope, by name without the tilde."""
    environment: dict[str, str] = field(default_factory=dict)
    remappings: dict[str, str] = field(default_factory=dict)
    included_at: str = ""
    """Place of the ``<include>`` of this file; empty for a top-level file."""
    takes_all: bool = False
    """True at the top of a file that is included with ``pass_all_args``."""

    def child(self, namespace: str | None = None) -> Scope:
        """Return a scope inside this one, in a relative or global namespace."""
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

    def included(self, file: str, namespace: str | None, args: Mapping[str, str], *, at: str, takes_all: bool) -> Scope:
        """Return the scope of a file that is included ``at`` a place: it has only the arguments passed to it."""
        made = self.child(namespace)
        made.file, made.included_at, made.takes_all = file, at, takes_all
        made.args, made.declared, made.anonymous = dict(args), set(), {}
        made.private = self.private or {}  # as in ROS: adds to those of the including file, if any
        return made

    def inside(self, namespace: str | None) -> str:
        """Return the namespace for ``ns`` here, with its closing slash."""
        if not namespace:
            return self.namespace
        return canonicalize(join(self.namespace, namespace)).rstrip("/") + "/"

    def full(self, name: str) -> str:
        """Return the global name of a parameter or a node."""
        return canonicalize(join(self.namespace, name))

    def remap(self, source: str, target: str) -> None:
        """Add a remapping, replacing an earlier one of the same name."""
        self.remappings.pop(source, None)
        self.remappings[source] = target

    def unused(self, given: Mapping[str, str]) -> Iterator[str]:
        """Yield the names of given arguments that no file has declared."""
        return (name for name in given if name not in self.declared)
