"""``genpy.dynamic``: message classes from the full text of a definition, as bags and connections contain it."""

from __future__ import annotations

from typing import Any

from rosmini.msgs.full_text import FullText
from rosmini.msgs.registry import Registry


def generate_dynamic(core_type: str, msg_cat: str) -> dict[str, Any]:
    """Return the classes of a type and its nested types by name, from a full text like ``_full_text``.

    The text is that of the type ``core_type``, followed by those of nested types, each after a line of 80 ``=`` and a
    line ``MSG: package/Type``. Raises ``DefinitionError`` for an invalid text, ``UnknownType`` or
    ``UnknownPackage`` for a nested type that is missing.
    """
    source = FullText(core_type, msg_cat)
    made = Registry(source)
    names = [f"{package}/{name}" for package in source.packages() for name in source.names(package, "msg")]
    return {name: made.message_class(name) for name in dict.fromkeys([core_type, *names])}
