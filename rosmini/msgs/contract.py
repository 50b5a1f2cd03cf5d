"""The interface of message classes that the other modules rely on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from .definition import MessageSpec
    from .limits import Measure


class MessageContract:
    """Base class of `Message`, for annotations."""

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
    """True if a frozen message needs no conversion for rospy's tuples and bytes: it has no arrays of numbers."""
    _plain_numpy: ClassVar[bool]
    """True if a frozen message needs no conversion for receivers of numpy arrays: it contains no bytes."""

    _freeze: ClassVar[Callable[[Any], Any]]
    _thaw: ClassVar[Callable[[Any], Any]]
    _thaw_numpy: ClassVar[Callable[[Any], Any]]
    _thaw_genpy_numpy: ClassVar[Callable[[Any], Any]]
    _encode: ClassVar[Callable[[Any], bytes]]
    _read: ClassVar[Callable[[bytes, int, int], tuple[Any, int]]]
