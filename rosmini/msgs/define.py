"""Message and service classes from a text at hand, for types that have no file: in notebooks, and to compare two versions of one type."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.errors import UnknownPackage, UnknownType, nearest

from .definition import BUILTIN_TYPES, parse_message, parse_service
from .fingerprint import full_text, message_md5, service_md5
from .message import make_message_class
from .registry import MODULE_PREFIX, make_service_class, registry

if TYPE_CHECKING:
    from .definition import MessageSpec
    from .message import Message

__all__ = ["define_message", "define_service"]


def define_message(name: str, text: str) -> type[Any]:
    """The class of a message type "package/Type" that ``text`` defines, in the language of ``.msg`` files (http://wiki.ros.org/msg).

    Each call makes a class of its own, also for a name that was given before or that has a file: so two versions of a type can stand
    side by side. Only types that have files can be nested. Raises :class:`~rosmini.errors.DefinitionError` with the line that is wrong.
    """
    return _class_of(parse_message(text, name), "msg")


def define_service(name: str, text: str) -> type[Any]:
    """The class of a service type "package/Type" that ``text`` defines, in the language of ``.srv`` files (http://wiki.ros.org/srv).

    Its attributes ``_request_class`` and ``_response_class`` are the classes of the two messages. Raises as :func:`define_message` does.
    """
    spec = parse_service(text, name)
    request, response = _class_of(spec.request, "srv"), _class_of(spec.response, "srv")
    return make_service_class(spec, request, response, service_md5(spec, registry().definition))


def _class_of(spec: MessageSpec, folder: str) -> type[Message]:
    known, nested = registry(), {}
    for field in spec.fields:
        if field.builtin:
            continue
        try:
            nested[field.base] = known.message_class(field.base)
        except (UnknownType, UnknownPackage) as error:
            hint = nearest(field.base.removeprefix(f"{spec.package}/"), BUILTIN_TYPES)
            raise spec.error(field.line, f"unknown type '{field.base}': {hint or error}") from error
    return make_message_class(
        spec,
        nested,
        known,
        message_md5(spec, known.definition),
        full_text(spec, known.definition),
        f"{MODULE_PREFIX}.{spec.package}.{folder}",
    )
