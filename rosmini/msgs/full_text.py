"""Message classes from a full text: a type with all its nested types, as in bags and connection headers."""

from __future__ import annotations

import re
from typing import Any

from rosmini.core.errors import DefinitionError

from .registry import Registry

_SEPARATOR = re.compile(r"^={80}\n", re.MULTILINE)

MAX_TYPES = 500
"""Maximum number of nested types: each class contains the texts of all its nested types."""


class FullText:
    """The definitions in the full text of a message type, as a source for a registry.

    Raises ``DefinitionError`` if there are too many.
    """

    def __init__(self, name: str, text: str) -> None:
        first, *rest = _SEPARATOR.split(text)
        if len(rest) > MAX_TYPES:
            raise DefinitionError(f"the full text of {name} has more than {MAX_TYPES} nested types")
        self._texts = {name: first}
        for part in rest:
            head, _, body = part.partition("\n")
            self._texts[head.removeprefix("MSG:").strip()] = body

    def packages(self) -> list[str]:
        """Return the packages with definitions, sorted."""
        return sorted({name.partition("/")[0] for name in self._texts})

    def has_package(self, package: str) -> bool:
        """True if this package has definitions."""
        return package in self.packages()

    def names(self, package: str, kind: str) -> list[str]:
        """Return the names of a package's definitions of one kind, sorted."""
        if kind != "msg":
            return []
        return sorted(name.partition("/")[2] for name in self._texts if name.partition("/")[0] == package)

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        """Return the text of a definition, and its origin for errors."""
        text = self._texts.get(f"{package}/{name}") if kind == "msg" else None
        return None if text is None else (text, f"the full text's definition of {package}/{name}")


def class_from(name: str, text: str) -> Any:
    """Return the class of the message type ``name`` that a full text defines.

    Raises ``DefinitionError`` for a wrong text, ``UnknownType`` or ``UnknownPackage`` for a missing
    nested type.
    """
    return Registry(FullText(name, text)).message_class(name)
