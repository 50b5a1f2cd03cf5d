"""The two things that ROS derives from definitions: md5 sums and full texts.

Both travel in connection headers and bags, so they must equal genmsg's to the byte. rosbags makes them from parsed
values (``0.50`` becomes ``0.5``, comments are lost), which is why they are made here from the text itself.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .definition import MessageSpec, ServiceSpec

    Lookup = Callable[[str], MessageSpec]


def message_md5(spec: MessageSpec, lookup: Lookup) -> str:
    """The md5 sum of a message: of its text without comments, with each nested type replaced by its own md5 sum.

    ``lookup`` gives the definition of a nested type by its full name.
    """
    return _md5(_md5_text(spec, lookup, {}))


def service_md5(spec: ServiceSpec, lookup: Lookup) -> str:
    """The md5 sum of a service: of its request's md5 text directly followed by its response's."""
    known: dict[str, str] = {}
    return _md5(_md5_text(spec.request, lookup, known) + _md5_text(spec.response, lookup, known))


def full_text(spec: MessageSpec, lookup: Lookup) -> str:
    """The definition followed by those of all nested types, each under a line of 80 "=" and a line "MSG: type"."""
    parts = [spec.text]
    parts += [f"{'=' * 80}\nMSG: {name}\n{lookup(name).text}" for name in dependencies(spec, lookup)]
    return "\n".join(parts)


def dependencies(spec: MessageSpec, lookup: Lookup) -> list[str]:
    """The full names of all nested types, each once, depth first, in the order of the fields."""
    found: dict[str, None] = {}

    def add(part: MessageSpec) -> None:
        for field in part.fields:
            if not field.builtin and field.base not in found:  # a type that was found before adds nothing
                found[field.base] = None
                add(lookup(field.base))

    add(spec)
    return list(found)


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


def _md5_text(spec: MessageSpec, lookup: Lookup, known: dict[str, str]) -> str:
    """The text of which the md5 sum is made; `known` collects the sums of nested types."""
    lines = [f"{constant.type} {constant.ros_name}={constant.text}" for constant in spec.constants]
    for field in spec.fields:
        if not field.builtin and field.base not in known:
            known[field.base] = _md5(_md5_text(lookup(field.base), lookup, known))
        lines.append(f"{field.type if field.builtin else known[field.base]} {field.ros_name}")
    return "\n".join(lines).strip()
