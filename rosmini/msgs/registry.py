"""The classes of all message, service and action types, made from their definitions on first use, or from a text."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from rosmini.core.errors import UnknownPackage, UnknownType, nearest, shown

from .definition import (
    ACTION_SUFFIXES,
    BUILTIN_TYPES,
    MessageSpec,
    ServiceSpec,
    is_type_name,
    parse_message,
    parse_service,
    split_action,
)
from .fingerprint import full_text, message_md5, service_md5
from .limits import MAX_DEPTH, Measure, measure
from .message import Message, make_message_class
from .sources import PackageSource, Source

MODULE_PREFIX = "rosmini.msgs"

Lookup = Callable[[str], MessageSpec]


class Service:
    """Base class of all services, which only have a type, an md5 sum and two message classes."""

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _request_class: ClassVar[type[Message]]
    _response_class: ClassVar[type[Message]]


def _make(
    spec: MessageSpec, nested: dict[str, type[Message]], owner: Registry, lookup: Lookup, folder: str
) -> type[Message]:
    """Make the class for ``spec``, in the module ``folder`` ("msg" or "srv") of its package."""
    md5sum, text = message_md5(spec, lookup), full_text(spec, lookup)
    return make_message_class(spec, nested, owner, md5sum, text, f"{MODULE_PREFIX}.{spec.package}.{folder}")


def make_service_class(
    spec: ServiceSpec, request: type[Message], response: type[Message], md5sum: str
) -> type[Service]:
    """Make the class for ``spec``; ``request`` and ``response`` are the classes of its two messages."""
    package, _, short = spec.name.partition("/")
    return type(
        short,
        (Service,),
        {
            "__module__": f"{MODULE_PREFIX}.{package}.srv",
            "__doc__": f"{spec.name}: a service (request: {spec.request.name}, response: {spec.response.name})",
            "_type": spec.name,
            "_md5sum": md5sum,
            "_request_class": request,
            "_response_class": response,
        },
    )


class Registry:
    """Makes and caches the classes for the definitions of one source. Thread-safe."""

    def __init__(self, source: Source, *, is_default: bool = False) -> None:
        self.source = source
        self.is_default = is_default
        self._lock = threading.RLock()
        self._messages: dict[str, type[Message]] = {}
        self._services: dict[str, type[Service]] = {}
        self._specs: dict[str, MessageSpec] = {}
        self._measures: dict[str, Measure] = {}

    # ---- classes ----

    def message_class(self, name: str) -> type[Any]:
        """Return the class of a message type "package/Type", including the messages of services and actions.

        Raises :class:`UnknownType` or :class:`UnknownPackage` with similar names, :class:`DefinitionError` with
        file and line if the definition or that of a nested type is wrong.
        """
        found = self._messages.get(name)
        if found is not None:
            return found
        with self._lock:
            return self._make_message_class(name)

    def service_class(self, name: str) -> type[Any]:
        """Return the class of a service type "package/Type". Raises as :meth:`message_class` does."""
        with self._lock:
            if name not in self._services:
                spec = self.service_definition(name)
                self._services[name] = make_service_class(
                    spec,
                    self.message_class(spec.request.name),
                    self.message_class(spec.response.name),
                    service_md5(spec, self.definition),
                )
            return self._services[name]

    def action_class(self, name: str) -> type[Any]:
        """Return the class of an action "package/Type" (or "package/TypeAction"), for actionlib's constructors.

        It is a message class with the fields ``action_goal``, ``action_result`` and ``action_feedback``.
        """
        package, _, short = name.partition("/")
        base = short.removesuffix("Action") or short
        if self.source.read(package, "action", base) is None:
            cls = self._messages.get(name) or (self._try(name) if short.endswith("Action") else None)
            if cls is not None and [field.name for field in cls._spec.fields] == [
                "action_goal",
                "action_result",
                "action_feedback",
            ]:
                return cls  # an action whose generated messages are in the package's msg folder
            raise self._unknown("action", name)
        return self.message_class(f"{package}/{base}Action")

    def _try(self, name: str) -> type[Message] | None:
        try:
            return self.message_class(name)
        except UnknownType:
            return None

    def reduce(self, message: Message) -> tuple[Any, ...] | None:
        """Return how to pickle a message: by the name of its type, which every process knows.

        None for a message of a subclass or another registry, which another process could not find by name.
        """
        cls = type(message)
        if not self.is_default or self._messages.get(cls._type) is not cls:
            return None
        return _restore, (cls._type, message.__getstate__())

    # ---- definitions ----

    def definition(self, name: str) -> MessageSpec:
        """Return a message type's parsed definition, whose nested types all exist. Raises as :meth:`message_class`."""
        with self._lock:
            return self._load(name, ())

    def service_definition(self, name: str) -> ServiceSpec:
        """Return the parsed definition of a service type. Raises as :meth:`message_class`."""
        package, short = self._split(name, "service")
        found = self.source.read(package, "srv", short)
        if found is None:
            raise self._unknown("service", name)
        spec = parse_service(found[0], name, found[1])
        for half in (spec.request, spec.response):
            self.definition(half.name)
        return spec

    def messages(self, package: str) -> list[str]:
        """Return the names of a package's messages, including those of actions, sorted, without parsing them."""
        derived = [f"{name}{suffix}" for name in self.source.names(package, "action") for suffix in ACTION_SUFFIXES]
        return sorted({*self.source.names(package, "msg"), *derived})

    def services(self, package: str) -> list[str]:
        """Return the names of a package's services, sorted, without parsing them."""
        return self.source.names(package, "srv")

    def forget(self, package: str) -> set[str]:
        """Discard the definitions of a package, and those that contain them; they are read again on next use.

        Classes in use do not change. Returns the affected packages.
        """
        with self._lock:
            gone = {name for name in (*self._specs, *self._services) if name.startswith(f"{package}/")}
            while more := {
                name
                for name, spec in self._specs.items()
                if name not in gone and any(field.base in gone for field in spec.fields)
            }:
                gone |= more
            for kept in (self._messages, self._specs, self._measures):
                for name in gone:
                    kept.pop(name, None)
            self._services = {
                name: service
                for name, service in self._services.items()
                if not gone & {name, service._request_class._type, service._response_class._type}
            }
            return {package, *(name.partition("/")[0] for name in gone)}

    # ---- inside ----

    def _make_message_class(self, name: str) -> type[Message]:
        if name in self._messages:
            return self._messages[name]
        spec = self.definition(name)
        nested = {field.base: self._make_message_class(field.base) for field in spec.fields if not field.builtin}
        folder = "srv" if self._is_half_of_service(spec) else "msg"
        self._messages[name] = _make(spec, nested, self, self.definition, folder)
        return self._messages[name]

    @staticmethod
    def _is_half_of_service(spec: MessageSpec) -> bool:
        return spec.file is not None and spec.file.endswith(".srv")

    def _load(self, name: str, within: tuple[str, ...]) -> MessageSpec:
        if name in self._specs:
            return self._specs[name]
        package, short = self._split(name, "message")
        spec = self._parse(package, short)
        if spec is None:
            raise self._unknown("message", name)
        for field in spec.fields:
            if field.builtin:
                continue
            if field.base in (*within, name):
                circle = " -> ".join((*within, name, field.base))
                raise spec.error(field.line, f"a message cannot contain itself: {circle}")
            if len(within) >= MAX_DEPTH:
                raise spec.error(field.line, f"more than {MAX_DEPTH} levels of messages in messages")
            try:
                self._load(field.base, (*within, name))
            except UnknownType as error:
                known = [*BUILTIN_TYPES, *self._type_names(package)]
                hint = nearest(field.base.removeprefix(f"{package}/"), known)
                if field.base == f"{package}/Header":
                    hint = "write std_msgs/Header"
                raise spec.error(field.line, f"unknown type '{field.base}': {hint}" if hint else str(error)) from error
            except UnknownPackage as error:
                raise spec.error(field.line, str(error)) from error
        self._measures[name] = measure(spec, self._measures.__getitem__)
        self._specs[name] = spec
        return spec

    def _parse(self, package: str, short: str) -> MessageSpec | None:
        name = f"{package}/{short}"
        found = self.source.read(package, "msg", short)
        if found is not None:
            return parse_message(found[0], name, found[1])
        for suffix in ACTION_SUFFIXES:
            base = short.removesuffix(suffix)
            found = self.source.read(package, "action", base) if base and base != short else None
            if found is not None:
                return split_action(found[0], f"{package}/{base}", found[1])[name]
        for suffix in ("Request", "Response"):
            base = short.removesuffix(suffix)
            found = self.source.read(package, "srv", base) if base and base != short else None
            if found is not None:
                service = parse_service(found[0], f"{package}/{base}", found[1])
                return service.request if suffix == "Request" else service.response
        return None

    @staticmethod
    def _split(name: str, what: str) -> tuple[str, str]:
        if not is_type_name(name):
            raise UnknownType(f"{shown(name)} is no {what} type: it is written package/Type, as in std_msgs/String")
        package, _, short = name.partition("/")
        return package, short

    def _type_names(self, package: str) -> list[str]:
        return [
            *self.messages(package),
            *(
                f"{owner}/{name}"
                for owner in self.source.packages()
                if owner != package
                for name in self.messages(owner)
            ),
        ]

    def _unknown(self, what: str, name: str) -> UnknownType | UnknownPackage:
        package, short = self._split(name, what)
        packages = self.source.packages()
        kind = {"message": self.messages, "service": self.services}.get(what, lambda p: self.source.names(p, "action"))
        if package not in packages:
            everywhere = [f"{owner}/{other}" for owner in packages for other in kind(owner) if other == short]
            hint = nearest(package, packages) or (
                f"{short} is defined by {', '.join(everywhere)}" if everywhere else ""
            )
            hint = hint or "is it on ROS_PACKAGE_PATH?"
            return UnknownPackage(f"{what} type {name}: no package '{package}' defines messages or services: {hint}")
        names = kind(package)
        hint = nearest(short, names)
        elsewhere = [f"{owner}/{short}" for owner in packages if owner != package and short in kind(owner)]
        if elsewhere:
            hint = f"did you mean {' or '.join(elsewhere)}?"
        shown = hint or (
            f"it has {', '.join(names[:12])}{' ...' if len(names) > 12 else ''}" if names else "it has none"
        )
        return UnknownType(f"package '{package}' has no {what} type '{short}': {shown}")


class _Holder:
    """Holds the process-wide registry, used by the module functions and the import hook.

    This is the only global state of ``rosmini.msgs``. It is necessary, because a message type must be the same
    class wherever it is imported.
    """

    current: ClassVar[Registry | None] = None
    lock: ClassVar[threading.Lock] = threading.Lock()


def _restore(name: str, state: list[Any]) -> Message:
    """Restore a message from its pickle."""
    message: Message = object.__new__(registry().message_class(name))
    message.__setstate__(state)
    return message


def registry() -> Registry:
    """Return the registry of this process, for all packages on the path."""
    with _Holder.lock:
        if _Holder.current is None:
            _Holder.current = Registry(PackageSource(), is_default=True)
        return _Holder.current


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
    return _make(spec, nested, known, definition, folder)
