"""Message classes for a bag: this system's class if it is the same, otherwise one made from the bag's definition."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import DefinitionError, UnknownPackage, UnknownType, shown
from rosmini.msgs import message_class
from rosmini.msgs.full_text import class_from

from .errors import ROSBagFormatException, in_file

if TYPE_CHECKING:
    from .index import Connection


class Types:
    """Provides the message class of each connection, made once; ``name`` is the file's name in errors."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._made: dict[tuple[str, str], Any] = {}

    def of(self, connection: Connection) -> Any:
        """Return the class of a connection's messages.

        Raises ``ROSBagFormatException`` if the type is unknown here and the definition in the bag is invalid.
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
    """Return this system's class of this name, whatever its definition; None if the type is unknown."""
    try:
        return message_class(connection.type)
    except (UnknownType, UnknownPackage, DefinitionError):
        return None


def recorded_class(connection: Connection) -> Any:
    """Return a class made from the definition in the bag. Raises ``ROSBagFormatException`` if that is invalid."""
    try:
        return class_from(connection.type, connection.definition)
    except (UnknownType, UnknownPackage, DefinitionError) as error:
        raise ROSBagFormatException(
            f"the definition of {shown(connection.type)} on {shown(connection.topic)} is broken: {error}. "
            f"Read with raw=True to get the bytes."
        ) from error


def serialized(msg: Any) -> bytes:
    """Return the bytes of a message of rosmini or of real ROS."""
    if hasattr(type(msg), "_encode"):
        return type(msg)._encode(msg)  # type: ignore[no-any-return]
    buffer = BytesIO()
    msg.serialize(buffer)
    return buffer.getvalue()
