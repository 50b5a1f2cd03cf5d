"""Md5 sums and full texts of definitions, as ROS derives them.

Both appear in connection headers and bags, so they must be identical to genmsg's. rosbags makes them from parsed
values (``0.50`` becomes ``0.5``, comments are lost), so here they are made from the text.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .definition import MessageSpec, ServiceSpec

    Lookup = Callable[[str], MessageSpec]


def message_md5(spec: MessageSpec, lookup: Lookup) -> str:
    """Return a message's md5 sum: of its text without comments, with nested types replaced by their md5 sums.

    ``lookup`` returns the definition of a nested type by its full name.
    """
    return _md5(_md5_text(spec, lookup, {}))


def service_md5(spec: ServiceSpec, lookup: Lookup) -> str:
    """Return a service's md5 sum: of the request's md5 text directly followed by the response's."""
    known: dict[str, str] = {}
    return _md5(_md5_text(spec.request, lookup, known) + _md5_text(spec.response, lookup, known))


def full_text(spec: MessageSpec, lookup: Lookup) -> str:
    """Return the definition followed by those of all nested types, each after a line of 80 "=" and "MSG: type"."""
    parts = [spec.text]
    parts += [f"{'=' * 80}\nMSG: {name}\n{lookup(name).text}" for name in dependencies(spec, lookup)]
    return "\n".join(parts)


def dependencies(spec: MessageSpec, lookup: Lookup) -> list[str]:
    """Return the full names of all nested types, each once, depth first, in the order of the fields."""
    found: dict[str, None] = {}

    def add(part: MessageSpec) -> None:
        for field in part.fields:
            if not field.builtin and field.base not in found:  # the nested types of a known type are known
                found[field.base] = None
                add(lookup(field.base))

    add(spec)
    return list(found)


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


def _md5_text(spec: MessageSpec, lookup: Lookup, known: dict[str, str]) -> str:
    """Return the text for the md5 sum; `known` collects the sums of nested types."""
    lines = [f"{constant.type} {constant.ros_name}={constant.text}" for constant in spec.constants]
    for field in spec.fields:
        if not field.builtin and field.base not in known:
            known[field.base] = _md5(_md5_text(lookup(field.base), lookup, known))
        lines.append(f"{field.type if field.builtin else known[field.base]} {field.ros_name}")
    return "\n".join(lines).strip()
