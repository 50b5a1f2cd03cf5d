"""Message classes from a full text: a type with all that it is made of, as bags and connection headers carry it."""

from __future__ import annotations

import re
from typing import Any

from rosmini.core.errors import DefinitionError

from .registry import Registry

_SEPARATOR = re.compile(r"^={80}\n", re.MULTILINE)

MOST_TYPES = 500
"""The largest number of nested types: each class has the texts of all types below it."""


class FullText:
    """The definitions in the full text of one message type, as a source of a registry.

    Raises ``DefinitionError`` for too many.
    """

    def __init__(self, name: str, text: str) -> None:
        first, *rest = _SEPARATOR.split(text)
        if len(rest) > MOST_TYPES:
            raise DefinitionError(f"the full text of {name} has more than {MOST_TYPES} nested types")
        self._texts = {name: first}
        for part in rest:
            head, _, body = part.partition("\n")
            self._texts[head.removeprefix("MSG:").strip()] = body

    def packages(self) -> list[str]:
        """The packages that define something, sorted."""
        return sorted({name.partition("/")[0] for name in self._texts})

    def has_package(self, package: str) -> bool:
        """True if this package defines something."""
        return package in self.packages()

    def names(self, package: str, kind: str) -> list[str]:
        """The names of a package's definitions of one kind, sorted."""
        if kind != "msg":
            return []
        return sorted(name.partition("/")[2] for name in self._texts if name.partition("/")[0] == package)

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        """The text of a definition, and where it is from."""
        text = self._texts.get(f"{package}/{name}") if kind == "msg" else None
        return None if text is None else (text, f"the full text's definition of {package}/{name}")


def class_from(name: str, text: str) -> Any:
    """Return the class of the message type ``name`` that a full text describes.

    Raises ``DefinitionError`` for a text that is wrong, ``UnknownType`` or ``UnknownPackage`` for a nested type that is
    missing.
    """
    return Registry(FullText(name, text)).message_class(name)
