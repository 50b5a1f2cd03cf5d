"""Messages in rospy's style: of any type, and made from the arguments of ``publish``."""

from __future__ import annotations

from io import BytesIO
from typing import Any, ClassVar, Self

from rosmini.core.errors import ROSException
from rosmini.msgs.message import Message


class AnyMsg(Message):
    """A message of any type, as received bytes in ``_buff``.

    A subscriber with this type accepts every topic; ``_connection_header['type']`` of a received message gives its
    type.
    """

    __slots__ = ("_buff",)
    _md5sum = "*"
    _type = "*"
    _has_header = False
    _full_text = ""
    _slot_types: ClassVar[list[str]] = []
    _plain = False
    _plain_numpy = False

    def __init__(self, *args: Any) -> None:
        if args:
            raise ROSException("an AnyMsg is made by deserialize(bytes) and takes no arguments")
        self._buff: bytes | None = None

    def serialize(self, buff: BytesIO) -> None:
        """Write the bytes. Raises ``ROSException`` if no bytes were received."""
        if self._buff is None:
            raise ROSException("this AnyMsg holds nothing: deserialize() bytes into it first")
        buff.write(self._buff)

    def deserialize(self, str: bytes) -> Self:
        """Store the bytes unchanged."""
        self._buff = bytes(str)
        return self

    def __eq__(self, other: object) -> bool:
        return isinstance(other, AnyMsg) and self._buff == other._buff

    __hash__ = None

    def __str__(self) -> str:
        return f"AnyMsg of {len(self._buff or b'')} bytes"

    __repr__ = __str__

    def __reduce_ex__(self, protocol: Any) -> Any:
        return _restore_any, (self._buff,)

    @classmethod
    def received(cls, frozen: Any) -> AnyMsg:
        """Return the message that a subscriber of any type receives for a frozen message."""
        return cls().deserialize(type(frozen)._encode(frozen))


def _restore_any(data: bytes | None) -> AnyMsg:
    made = AnyMsg()
    made._buff = data  # noqa: SLF001 - its own
    return made


def args_kwds_to_message(data_class: Any, args: tuple[Any, ...], kwds: dict[str, Any]) -> Any:
    """Return the message for ``publish(*args, **kwds)``.

    A message of ``data_class``, or of another type with its md5 sum, is returned as it is; otherwise the arguments are
    all fields in order, or some by name. Raises ``TypeError`` for another message, or for both kinds of arguments at
    once.
    """
    if args and kwds:
        raise TypeError("publish() can be called with arguments or keywords, but not both.")
    if kwds or len(args) != 1:
        return data_class(*args, **kwds)
    given = args[0]
    if isinstance(given, data_class) or getattr(given, "_md5sum", None) == data_class._md5sum:
        return given
    if isinstance(given, Message):
        types = data_class._slot_types
        if types[:1] != [given._type]:
            what = f"a first field of type {types[0]}" if types else "no fields"
            raise TypeError(
                f"expected a {data_class._type} but got a {given._type}. "
                f"(The fields of a {data_class._type} could be given instead of it, but it has {what}.)"
            )
    return data_class(given)
