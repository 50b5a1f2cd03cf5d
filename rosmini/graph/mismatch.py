"""Two ends of a topic or service with two types: what differs, or, where their md5 sums are the same, one message as the other."""

from __future__ import annotations

from difflib import ndiff
from typing import Any


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


def describe_mismatch(
    topic: str,
    publisher: str,
    publisher_class: Any,
    subscriber: str,
    their_type: str,
    their_md5: str,
    their_definition: str | None,
) -> str:
    """Return the message of a ``TypeMismatch`` on ``topic``: both nodes, both types, the fields that differ, and what to do."""
    my_type, my_md5 = publisher_class._type, publisher_class._md5sum
    lines = [
        f"{publisher} publishes {topic} as {my_type}, but {subscriber} subscribes to it as {their_type}: no message will arrive.",
    ]
    if my_type == their_type:
        lines.append(
            f"  The definitions differ: md5 {my_md5} at the publisher, {their_md5} at the subscriber."
        )
    if their_definition is not None:
        changes = [
            line
            for line in ndiff(_fields(publisher_class._full_text), _fields(their_definition))
            if line[0] in "+-"
        ]
        lines.append(
            f"  Fields (- only in {my_type}, + only in {their_type}):"
            if my_type != their_type
            else "  Fields (- publisher, + subscriber):"
        )
        lines += [f"    {change}" for change in changes[:12]]
        if len(changes) > 12:
            lines.append(f"    ... and {len(changes) - 12} more")
    lines.append(
        "  Use the same type at both ends, or give one of them another topic name."
        if my_type != their_type
        else "  Use the same version of the definition at both ends."
    )
    return "\n".join(lines)


def recast(message: Any, message_class: Any) -> Any:
    """Return ``message`` as a frozen one of another type with the same md5 sum, as it would come over the wire.

    Raises ``DeserializationError`` where the types are not alike after all.
    """
    return message_class._decode(type(message)._encode(message))
