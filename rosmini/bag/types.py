"""Message classes for a bag: this system's where it is the same, else one made from the bag's definition."""

from __future__ import annotations

import re
from io import BytesIO
from typing import TYPE_CHECKING, Any

from rosmini.errors import DefinitionError, UnknownPackage, UnknownType, shown
from rosmini.msgs import message_class
from rosmini.msgs.registry import Registry

from .errors import ROSBagFormatException, in_file

if TYPE_CHECKING:
    from .index import Connection

_SEPARATOR = re.compile(r"^={80}\n", re.MULTILINE)


class RecordedSource:
    """The definitions in the full text of one message type, as a source of a registry."""

    def __init__(self, name: str, text: str) -> None:
        first, *rest = _SEPARATOR.split(text)
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
        return None if text is None else (text, f"the bag's definition of {package}/{name}")


class Types:
    """Gives the connections of a bag their message classes; each is made once. ``name`` is the file's, for errors."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._made: dict[tuple[str, str], Any] = {}

    def of(self, connection: Connection) -> Any:
        """Return the class of a connection's messages.

        Raises ``ROSBagFormatException`` if the type is not known here and the definition in the bag is broken.
        """
        key = (connection.type, connection.md5sum)
        found = self._made.get(key)
        if found is None:
            with in_file(self._name):
                found = local_class(connection)
                if found is None or found._md5sum != connection.md5sum:
                    found = recorded_class(connection)
            self._made[key] = found
        return found


def local_class(connection: Connection) -> Any:
    """Return the class of this name on this system, whatever its definition; None if there is none."""
    try:
        return message_class(connection.type)
    except (UnknownType, UnknownPackage, DefinitionError):
        return None


def recorded_class(connection: Connection) -> Any:
    """Return the class that the definition in the bag describes. Raises ``ROSBagFormatException`` if that is broken."""
    source = RecordedSource(connection.type, connection.definition)
    try:
        return Registry(source).message_class(connection.type)
    except (UnknownType, UnknownPackage, DefinitionError) as error:
        raise ROSBagFormatException(
            f"the definition of {shown(connection.type)} on {shown(connection.topic)} is broken: {error}. "
            f"Read with raw=True to get the bytes."
        ) from error


def serialized(msg: Any) -> bytes:
    """Return the bytes of a message, of ours or of real ROS."""
    if hasattr(type(msg), "_encode"):
        return type(msg)._encode(msg)  # type: ignore[no-any-return]
    buffer = BytesIO()
    msg.serialize(buffer)
    return buffer.getvalue()
