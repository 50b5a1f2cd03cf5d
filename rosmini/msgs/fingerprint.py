"""The two things that ROS derives from definitions: md5 sums and full texts.

Both travel in connection headers and bags, so they must equal genmsg's to the byte. rosbags makes them from parsed
values (``0.50`` becomes ``0.5``, comments are lost), which is why they are made here from the text itself.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from .definition import MessageSpec, ServiceSpec

    Lookup = Callable[[str], MessageSpec]


def message_md5(spec: MessageSpec, lookup: Lookup) -> str:
    """The md5 sum of a message: of its text without comments, with each nested type replaced by its own md5 sum.

    ``lookup`` gives the definition of a nested type by its full name.
    """
    return hashlib.md5(_md5_text(spec, lookup).encode(), usedforsecurity=False).hexdigest()


def service_md5(spec: ServiceSpec, lookup: Lookup) -> str:
    """The md5 sum of a service: of its request's md5 text directly followed by its response's."""
    text = _md5_text(spec.request, lookup) + _md5_text(spec.response, lookup)
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


def full_text(spec: MessageSpec, lookup: Lookup) -> str:
    """The definition followed by those of all nested types, each under a line of 80 "=" and a line "MSG: type"."""
    parts = [spec.text]
    parts += [
        f"{'=' * 80}\nMSG: {name}\n{lookup(name).text}" for name in dict.fromkeys(dependencies(spec, lookup))
    ]
    return "\n".join(parts)


def dependencies(spec: MessageSpec, lookup: Lookup) -> Iterator[str]:
    """The full names of all nested types, depth first, in the order of the fields, with repetitions."""
    for field in spec.fields:
        if not field.builtin:
            yield field.base
            yield from dependencies(lookup(field.base), lookup)


def _md5_text(spec: MessageSpec, lookup: Lookup) -> str:
    lines = [f"{constant.type} {constant.ros_name}={constant.text}" for constant in spec.constants]
    for field in spec.fields:
        kind = field.type if field.builtin else message_md5(lookup(field.base), lookup)
        lines.append(f"{kind} {field.ros_name}")
    return "\n".join(lines).strip()
