"""What a message class knows about itself: the contract between `Message` and the modules that it is built from."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from .definition import MessageSpec
    from .limits import Measure


class MessageContract:
    """The base of `Message`, for annotations."""

    __slots__ = ()

    _type: ClassVar[str]
    _md5sum: ClassVar[str]
    _full_text: ClassVar[str]
    _has_header: ClassVar[bool]
    _slot_types: ClassVar[list[str]]
    _spec: ClassVar[MessageSpec]
    _nested: ClassVar[dict[str, type[MessageContract]]]
    _registry: ClassVar[object]
    _fields_class: ClassVar[type[MessageContract]]
    _measure: ClassVar[Measure]
    _plain: ClassVar[bool]
    """A frozen message is what a receiver gets: it has no arrays of numbers, which rospy gives as tuples and bytes."""
    _plain_numpy: ClassVar[bool]
    """A frozen message is what a receiver gets who wants numpy arrays: there are no bytes in it."""

    _freeze: ClassVar[Callable[[Any], Any]]
    _thaw: ClassVar[Callable[[Any], Any]]
    _thaw_numpy: ClassVar[Callable[[Any], Any]]
    _thaw_genpy_numpy: ClassVar[Callable[[Any], Any]]
    _encode: ClassVar[Callable[[Any], bytes]]
    _read: ClassVar[Callable[[bytes, int, int], tuple[Any, int]]]
