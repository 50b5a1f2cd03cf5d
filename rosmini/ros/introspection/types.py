"""Types of messages and services: the packages that define them, and their definitions as in ``rosmsg``.

The Master is not needed: definitions are files of packages (http://wiki.ros.org/rosmsg).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from rosmini.core.errors import nearest
from rosmini.msgs.registry import registry

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.msgs.definition import MessageSpec


class Kind(NamedTuple):
    """Kind of a type: ``message`` or ``service``, with the suffix of its definition files."""

    name: str
    ending: str

    def names(self, package: str) -> list[str]:
        """Return the names of the types that a package defines, including those from actions, sorted."""
        known = registry()
        return known.messages(package) if self is MESSAGE else known.services(package)

    def packages(self) -> list[str]:
        """Return the packages that define such types, sorted."""
        return [package for package in registry().source.packages() if self.names(package)]

    def of_package(self, package: str) -> list[str]:
        """Return the types that a package defines, as "package/Type". Raises ``UnknownPackage``."""
        if not registry().source.has_package(package):
            from rosmini.core.packages import PackageIndex

            PackageIndex().path(package)  # raises for an unknown package
        return [f"{package}/{name}" for name in self.names(package)]

    def all(self) -> list[str]:
        """Return all such types, as "package/Type", sorted."""
        return [kind for package in self.packages() for kind in self.of_package(package)]

    def search(self, short: str) -> list[str]:
        """Return the types with this name in any package."""
        return [f"{package}/{short}" for package in self.packages() if short in self.names(package)]

    def md5(self, kind: str) -> str:
        """Return the md5 sum of a type. Raises ``UnknownType``, ``UnknownPackage`` or ``DefinitionError``."""
        known = registry()
        found: str = (known.message_class(kind) if self is MESSAGE else known.service_class(kind))._md5sum
        return found

    def text(self, kind: str, *, raw: bool = False) -> str:
        """Return the definition of a type with the fields of nested messages indented, or ``raw``, as in its file.

        Raises ``UnknownType``, ``UnknownPackage`` or ``DefinitionError``.
        """
        known = registry()
        if self is MESSAGE:
            spec = known.definition(kind)
            return spec.text if raw else tree(spec, known.definition)
        service = known.service_definition(kind)
        halves = (service.request, service.response)
        if raw:
            return "---\n".join(half.text if half.text.endswith("\n") else f"{half.text}\n" for half in halves)
        return "---\n".join(tree(half, known.definition) for half in halves)

    def what_next(self, short: str) -> str:
        """Return a hint about an unknown type: similar names."""
        names = sorted({name for package in self.packages() for name in self.names(package)})
        return nearest(short, names) or f"`ros{self.ending} list` lists the {self.name} types that there are."


MESSAGE = Kind("message", "msg")
SERVICE = Kind("service", "srv")


def tree(spec: MessageSpec, definition: Callable[[str], MessageSpec]) -> str:
    """Return constants and fields of a message, one per line, with those of nested messages indented below.

    ``definition`` returns the definition of a nested type.
    """
    return "".join(f"{line}\n" for line in _lines(spec, definition, ""))


def _lines(spec: MessageSpec, definition: Callable[[str], MessageSpec], indent: str) -> Iterator[str]:
    for constant in spec.constants:
        yield f"{indent}{constant.type} {constant.ros_name}={constant.text}"
    for field in spec.fields:
        yield f"{indent}{field.type} {field.ros_name}"
        if not field.builtin:
            yield from _lines(definition(field.base), definition, f"{indent}  ")
