"""Comparison of the types at both ends of a topic or service, and conversion between types with equal md5 sums."""

from __future__ import annotations

from difflib import ndiff
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .transport import Header


def _fields(definition: str) -> list[str]:
    """Return the field lines of a full definition, without comments, up to the first dependency."""
    lines = []
    for line in definition.splitlines():
        if line.startswith("=" * 20):
            break
        text = line.split("#", 1)[0].strip()
        if text:
            lines.append(" ".join(text.split()))
    return lines


def describe_mismatch(topic: str, publisher: Header, subscriber: Header) -> str:
    """Return the message of a ``TypeMismatch``: both nodes, both types, the fields that differ, and what to do.

    The two connection headers contain ``callerid``, ``type``, ``md5sum`` and, to compare the fields,
    ``message_definition``.
    """
    mine, theirs = publisher["type"], subscriber["type"]
    same = mine == theirs
    sender, receiver = publisher["callerid"], subscriber["callerid"]
    lines = [
        f"{sender} publishes {topic} as {mine}, but {receiver} subscribes to it as {theirs}: no message will arrive."
    ]
    if same:
        lines.append(
            f"  The definitions differ: md5 {publisher['md5sum']} at the publisher, "
            f"{subscriber['md5sum']} at the subscriber."
        )
    definitions = [end.get("message_definition") for end in (publisher, subscriber)]
    if definitions[0] is not None and definitions[1] is not None:
        changes = [line for line in ndiff(_fields(definitions[0]), _fields(definitions[1])) if line[0] in "+-"]
        ends = "- publisher, + subscriber" if same else f"- only in {mine}, + only in {theirs}"
        lines.append(f"  Fields ({ends}):")
        lines += [f"    {change}" for change in changes[:12]]
        if len(changes) > 12:
            lines.append(f"    ... and {len(changes) - 12} more")
    lines.append(
        "  Use the same version of the definition at both ends."
        if same
        else "  Use the same type at both ends, or give one of them another topic name."
    )
    return "\n".join(lines)


def recast(message: Any, message_class: Any) -> Any:
    """Return ``message`` as a frozen message of ``message_class``, which has the same md5 sum.

    The message is encoded and decoded, as by a network connection. Raises ``DeserializationError`` if the types do not
    match after all.
    """
    return message_class._decode(type(message)._encode(message))
