"""The base class of all messages: everything that does not depend on the fields of a type.

A message class has two layers. The lower one has only slots; the generated code creates and fills instances of it
at full speed, and then turns them into instances of the upper, public class (``message.__class__ = ...``), whose
``__setattr__`` gives a helpful error for a mistyped field.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from io import BytesIO
from types import ModuleType
from typing import TYPE_CHECKING, Any, Self

from rosmini.core.errors import DeserializationError, SerializationError, nearest

from .contract import MessageContract
from .definition import BYTES, NUMBERS, MessageSpec
from .limits import measure


class _Compiled:
    """A function of a message class that is generated on first use."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, instance: Any, owner: type[Message]) -> Any:
        from .codegen import compile_function

        home = next((cls for cls in owner.__mro__ if "_spec" in cls.__dict__), None)
        if home is None:  # help() and inspect also look at the base classes
            raise AttributeError(f"{owner.__name__} has no {self.name}: it is not the class of a message type")
        function = compile_function(home, self.name.removeprefix("_"))
        setattr(home, self.name, staticmethod(function))
        return function


class Message(MessageContract):
    """A ROS message; ``isinstance(x, Message)`` is true for messages of every type.

    Classes are made by :func:`rosmini.msgs.message_class`, with the conventions of genpy
    (http://wiki.ros.org/msg, http://docs.ros.org/en/noetic/api/genpy/html/).
    """

    __slots__ = ("_cause", "_connection_header")

    _cause: int
    """The number of its publication, if the graph records history."""
    _connection_header: dict[str, Any] | None

    _freeze = _Compiled()
    _thaw = _Compiled()
    _thaw_numpy = _Compiled()
    _thaw_genpy_numpy = _Compiled()
    _encode = _Compiled()
    _read = _Compiled()

    @classmethod
    def _decode(cls, data: bytes | bytearray | memoryview) -> Self:
        """Return the frozen message in ``data``, in ROS 1 serialisation.

        Raises :class:`DeserializationError` unless ``data`` is exactly one message of this type.
        """
        # numpy arrays will refer to these bytes, so they must be immutable
        fixed = data if type(data) is bytes else bytes(data)
        try:
            message, used = cls._read(fixed, 0, len(fixed))
        except struct.error as error:
            problem = f"{len(fixed)} bytes are too few: the data is cut off, or of another type"
            raise DeserializationError(f"{cls._type}: {problem}") from error
        except DeserializationError as error:
            if str(error).startswith(f"{cls._type}: "):
                raise
            raise DeserializationError(f"{cls._type}: in {error}") from error  # in an element of an array
        if used != len(fixed):
            problem = f"{len(fixed) - used} of {len(fixed)} bytes are left over: the data is of another type"
            raise DeserializationError(f"{cls._type}: {problem}")
        return message  # type: ignore[no-any-return]

    @classmethod
    def _thawer(cls, *, numpy: bool) -> Callable[[Any], Any] | None:
        """Return the function that converts a frozen message for a receiver, with numpy arrays or rospy's tuples.

        None if no conversion is needed.
        """
        if cls._plain_numpy if numpy else cls._plain:
            return None
        thaw: Callable[[Any], Any] = cls._thaw_numpy if numpy else cls._thaw
        return thaw

    # ---- hand-written classes ----

    def __init_subclass__(cls, **kwds: Any) -> None:
        super().__init_subclass__(**kwds)
        if "_slot_types" in cls.__dict__ and not hasattr(cls, "_spec"):
            from .by_hand import complete

            complete(cls, Message)

    if not TYPE_CHECKING:  # generated classes have their own constructors

        def __init__(self, *args: Any, **kwds: Any) -> None:
            from .by_hand import set_slots

            set_slots(self, args, kwds)

    # ---- genpy's interface ----

    def serialize(self, buff: BytesIO) -> None:
        """Write the message to ``buff``. Raises :class:`SerializationError`, with the field."""
        buff.write(type(self)._encode(self))

    def deserialize(self, str: bytes) -> Self:
        """Set all fields from bytes, and return ``self``. Raises :class:`DeserializationError`.

        Unlike genpy, it refuses bytes after the end of the message.
        """
        cls = type(self)
        return self._take(cls._thaw(cls._decode(str)))

    def serialize_numpy(self, buff: BytesIO, numpy: ModuleType) -> None:  # noqa: ARG002 (genpy's signature)
        """Do the same as :meth:`serialize`, which accepts numpy arrays as well."""
        self.serialize(buff)

    def deserialize_numpy(self, str: bytes, numpy: ModuleType) -> Self:  # noqa: ARG002 (genpy's signature)
        """Do as :meth:`deserialize`, but use numpy arrays for numbers; ``uint8[]`` remains bytes, as in genpy."""
        cls = type(self)
        return self._take(cls._thaw_genpy_numpy(cls._decode(str)))

    def _take(self, other: Message) -> Self:
        for field in self._spec.fields:
            setattr(self, field.name, getattr(other, field.name))
        return self

    def _get_types(self) -> list[str]:
        return self._slot_types

    def _check_types(self, exc: Exception | None = None) -> None:
        """Raise :class:`SerializationError` if a field is invalid, or with the text of ``exc`` if given."""
        from .fields import check

        cls = type(self)
        cls._freeze(self)
        check(cls, self)
        if exc is not None:
            raise SerializationError(str(exc)) from exc

    # ---- Python's interface ----

    def __str__(self) -> str:
        from .text import strify_message

        return strify_message(self)

    __repr__ = __str__

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        names = [field.name for field in self._spec.fields]
        return all(_alike(getattr(self, name, None), getattr(other, name, None)) for name in names)

    __hash__ = None  # type: ignore[assignment]  # as in genpy: messages can be changed

    if not TYPE_CHECKING:  # a type checker must not accept arbitrary attributes

        def __getattr__(self, name: str) -> Any:
            if name == "_connection_header":
                return None  # not received from anyone
            if name.startswith("_"):
                raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'", name=name, obj=self)
            raise self._no_such_field(name)

    def _no_such_field(self, name: str) -> AttributeError:
        names = [field.name for field in self._spec.fields]
        if name in names:
            return AttributeError(f"field '{name}' of this {self._type} was never set", name=name, obj=self)
        help_text = nearest(name, names) or f"its fields are {', '.join(names) or '(none)'}"
        problem = f"{name} is not an attribute of {type(self).__name__} ({self._type}): {help_text}"
        return AttributeError(problem, name=name, obj=self)

    def _positional(self, args: tuple[Any, ...], given: dict[str, Any], unknown: dict[str, Any]) -> Sequence[Any]:
        """Return the field values of a constructor call by position; raise genpy's errors for a wrong call."""
        if args and (unknown or any(value is not None for value in given.values())):
            raise TypeError("Message constructor may only use args OR keywords, not both")
        for name in unknown:
            raise self._no_such_field(name)
        if len(args) != len(given):
            fields = ", ".join(given) or "(none)"
            problem = f"{type(self).__name__} takes all of its {len(given)} fields by position, or some by keyword"
            raise TypeError(f"Invalid number of arguments: {problem}; given: {len(args)}, fields: {fields}")
        return args

    def __reduce_ex__(self, protocol: Any) -> Any:
        made_by = getattr(type(self), "_registry", None)
        return (made_by and made_by.reduce(self)) or super().__reduce_ex__(protocol)

    def __getstate__(self) -> list[Any]:
        return [getattr(self, field.name) for field in self._spec.fields]

    def __setstate__(self, state: Sequence[Any]) -> None:
        for field, value in zip(self._spec.fields, state, strict=True):
            setattr(self, field.name, value)


def _alike(one: Any, other: Any) -> bool:
    """Compare field values: a list equals a tuple with the same elements, numpy arrays compare as a whole."""
    if hasattr(one, "dtype") or hasattr(other, "dtype"):
        import numpy as np

        return bool(np.array_equal(one, other))
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        return tuple(one) == tuple(other)
    return bool(one == other)


def _set_field(self: Message, name: str, value: Any) -> None:
    try:
        object.__setattr__(self, name, value)
    except AttributeError:
        raise self._no_such_field(name) from None


def _first_init(self: Message, /, *args: Any, **kwds: Any) -> None:
    """Compile the constructor when the first message is made, and call it."""
    from .codegen import compile_function

    home = next(cls for cls in type(self).__mro__ if "_spec" in cls.__dict__)
    home.__init__ = compile_function(home, "init")  # type: ignore[misc]
    home.__init__(self, *args, **kwds)  # type: ignore[misc]


def make_message_class(
    spec: MessageSpec, nested: dict[str, type[Message]], registry: object, md5sum: str, text: str, module: str
) -> type[Message]:
    """Make the class for ``spec``; ``nested`` contains the classes of its fields by type name.

    Raises :class:`~rosmini.core.errors.DefinitionError` if it is too large: see :mod:`rosmini.msgs.limits`.
    """
    names = [field.name for field in spec.fields]
    fields_class = type(
        f"_{spec.short_name}Fields",
        (Message,),
        {"__slots__": tuple(names), "__module__": module, "__init__": object.__init__},
    )
    namespace: dict[str, Any] = {
        "__slots__": (),
        "__module__": module,
        "__qualname__": spec.short_name,
        "__doc__": _docstring(spec),
        "__setattr__": _set_field,
        "__init__": _first_init,
        "__match_args__": tuple(names),
        "_type": spec.name,
        "_md5sum": md5sum,
        "_full_text": text,
        "_has_header": spec.has_header,
        "_slot_types": [field.type for field in spec.fields],
        "_spec": spec,
        "_nested": nested,
        "_registry": registry,
        "_fields_class": fields_class,
        "_measure": measure(spec, lambda name: nested[name]._measure),
        "_plain": not any(field.size is not None and field.base in NUMBERS for field in spec.fields)
        and all(cls._plain for cls in nested.values()),
        "_plain_numpy": not any(field.size is not None and field.base in BYTES for field in spec.fields)
        and all(cls._plain_numpy for cls in nested.values()),
        **{constant.name: constant.value for constant in spec.constants},
    }
    cls = type(spec.short_name, (fields_class,), namespace)
    # The slots belong to the lower layer; scripts expect to find the field names here.
    cls.__slots__ = names  # type: ignore[attr-defined]
    return cls


def _docstring(spec: MessageSpec) -> str:
    lines = [f"{spec.name}", ""]
    lines += [f"    {field.type} {field.name}" for field in spec.fields] or ["    (no fields)"]
    return "\n".join(lines)
