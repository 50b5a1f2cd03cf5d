"""Message, service and action classes from a text, for types without a file, and for comparing versions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rosmini.core.errors import UnknownPackage, UnknownType, nearest

from .definition import BUILTIN_TYPES, MessageSpec, parse_message, parse_service, split_action
from .fingerprint import full_text, message_md5, service_md5
from .limits import measure
from .message import Message, make_message_class
from .registry import MODULE_PREFIX, make_service_class, registry


def define_message(name: str, text: str) -> type[Any]:
    """Return a class for the message type "package/Type" with the ``.msg`` text ``text`` (http://wiki.ros.org/msg).

    Each call makes a new class, even for a name that was used before or that has a file, so two versions of a
    type can exist at the same time. Only types that have files can be nested. Raises
    :class:`~rosmini.core.errors.DefinitionError` with the line of an error.
    """
    return _class_of(parse_message(text, name), "msg")


def define_service(name: str, text: str) -> type[Any]:
    """Return a class for the service type "package/Type" with the ``.srv`` text ``text`` (http://wiki.ros.org/srv).

    Its attributes ``_request_class`` and ``_response_class`` are the two message classes. Raises as
    :func:`define_message` does.
    """
    spec = parse_service(text, name)
    request, response = _class_of(spec.request, "srv"), _class_of(spec.response, "srv")
    return make_service_class(spec, request, response, service_md5(spec, registry().definition))


def define_action(name: str, text: str) -> tuple[type[Any], type[Any], type[Any], type[Any]]:
    """Return the classes of the action "package/Type" defined by ``text``, as in an ``.action`` file.

    These are four of the seven: the action, for clients and servers, and its goal, result and feedback. Raises as
    :func:`define_message` does.
    """
    specs = split_action(text, name)
    own: dict[str, type[Message]] = {}
    for suffix in ("Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback", "Action"):
        own[name + suffix] = _class_of(specs[name + suffix], "msg", own)
    return own[f"{name}Action"], own[f"{name}Goal"], own[f"{name}Result"], own[f"{name}Feedback"]


def _class_of(spec: MessageSpec, folder: str, own: Mapping[str, type[Message]] | None = None) -> type[Message]:
    """Make a class; its nested types may be in ``own`` or have files."""
    known, mine, nested = registry(), own or {}, {}

    def definition(name: str) -> MessageSpec:
        return mine[name]._spec if name in mine else known.definition(name)

    for field in spec.fields:
        if field.builtin:
            continue
        try:
            nested[field.base] = mine.get(field.base) or known.message_class(field.base)
        except (UnknownType, UnknownPackage) as error:
            hint = nearest(field.base.removeprefix(f"{spec.package}/"), BUILTIN_TYPES)
            raise spec.error(field.line, f"unknown type '{field.base}': {hint or error}") from error
    measure(spec, lambda base: nested[base]._measure)  # before the md5 sum, whose cost grows with the type
    return make_message_class(
        spec,
        nested,
        known,
        message_md5(spec, definition),
        full_text(spec, definition),
        f"{MODULE_PREFIX}.{spec.package}.{folder}",
    )
