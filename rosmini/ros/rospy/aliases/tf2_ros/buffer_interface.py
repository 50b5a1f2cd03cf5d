"""``tf2_ros.buffer_interface``: what buffers and their clients share, and the conversions between types."""

# ruff: noqa: ARG002 - the arguments are for derived classes

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.core.tf import messages
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class
from rosmini.ros.rospy.logs import warn_once
from rosmini.ros.rospy.session import current_session

if TYPE_CHECKING:
    from collections.abc import Callable

AT_ONCE = Duration()


class TypeException(RosminiError):
    """Nobody has said how a type is moved to another frame, or converted."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(RosminiError):
    """A class of the script's own derives from ``BufferInterface`` and does not say how to look a transform up."""

    def __init__(self) -> None:
        self.errstr = "lookup_transform() and can_transform(), or their advanced forms, are not implemented"
        super().__init__(self.errstr)


class BufferInterface:
    """Where transforms are looked up: in one's own buffer, or in another node's. Derive from it to look elsewhere."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = AT_ONCE, new_type: Any = None
    ) -> Any:
        """Return a stamped thing in another frame, at the time in its header; as a ``new_type`` if given.

        Raises ``TypeException`` for a type that nobody has registered, else as ``lookup_transform`` does.
        """
        move = TransformRegistration().get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(move(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: Any = AT_ONCE,
        new_type: Any = None,
    ) -> Any:
        """Return the same at another time, if ``fixed_frame`` does not move in between."""
        move = TransformRegistration().get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(move(object_stamped, found), new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Any = AT_ONCE
    ) -> Any:
        """Raise ``NotImplementedException``: derived classes say where ``source_frame`` is in ``target_frame``."""
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Any = AT_ONCE,
    ) -> Any:
        """Raise ``NotImplementedException``: the advanced form."""
        raise NotImplementedException

    def can_transform(self, target_frame: str, source_frame: str, time: Time, timeout: Any = AT_ONCE) -> Any:
        """Raise ``NotImplementedException``: derived classes return whether a lookup would succeed."""
        raise NotImplementedException

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Any = AT_ONCE,
    ) -> Any:
        """Raise ``NotImplementedException``: the advanced form."""
        raise NotImplementedException


def moved(message: Any, transform: Any) -> Any:
    """Return a copy of a stamped message in the frame of ``transform``, with its stamp.

    A quaternion of length 0 counts as no rotation; the script is warned once for each type and frame.
    """
    return messages.moved(message, transform, warn_once)


def _converted(thing: Any, new_type: Any) -> Any:
    return thing if not new_type else convert(thing, new_type)


def Stamped(obj: Any, stamp: Time, frame_id: str) -> Any:
    """Give ``obj`` a header, and return it."""
    obj.header = message_class("std_msgs/Header")(frame_id=frame_id, stamp=stamp)
    return obj


class _Registration:
    """Functions by type, of the script: what one script registers no other one finds."""

    def _put(self, what: str, key: Any, callback: Callable[..., Any]) -> None:
        self._all()[what, key] = callback

    def _find(self, what: str, key: Any) -> Callable[..., Any]:
        found: Callable[..., Any] | None = self._all().get((what, key))
        if found is None:
            raise TypeException(
                f"Type {key} is not loaded or supported: register a function for it with add...()"
            )
        return found

    @staticmethod
    def _all() -> dict[tuple[str, Any], Any]:
        found: dict[tuple[str, Any], Any] = vars(current_session()).setdefault("tf2_types", {})
        return found


class TransformRegistration(_Registration):
    """How things of a type are moved to another frame: ``callback(thing, transform)``; geometry and clouds."""

    def print_me(self) -> None:
        """Print what was added."""
        print({key: callback for (what, key), callback in self._all().items() if what == "transform"})

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Say how things of the type ``key`` are moved."""
        self._put("transform", key, callback)

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Return what moves things of the type ``key``. Raises ``TypeException``."""
        if ("transform", key) not in self._all() and getattr(key, "_type", None) in messages.MOVERS:
            return moved
        return self._find("transform", key)


class ConvertRegistration(_Registration):
    """How things of a type become messages, and come from messages, and become things of another type at once."""

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Say how a message becomes a ``key``."""
        self._put("from_msg", key, callback)

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Say how a ``key`` becomes a message."""
        self._put("to_msg", key, callback)

    def add_convert(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Say how one type becomes another; ``key`` is the pair of them."""
        self._put("convert", key, callback)

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return what makes a ``key`` of a message. Raises ``TypeException``."""
        return self._find("from_msg", key)

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return what makes a message of a ``key``. Raises ``TypeException``."""
        return self._find("to_msg", key)

    def get_convert(self, key: Any) -> Callable[[Any], Any]:
        """Return what makes the second type of the pair ``key`` of the first. Raises ``TypeException``."""
        return self._find("convert", key)


def convert(a: Any, b_type: Any) -> Any:
    """Return ``a`` as a ``b_type``: as registered, a copy, or via a message. Raises ``TypeException``."""
    registered = ConvertRegistration()
    try:
        return registered.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return copy.deepcopy(a)
        to_message, from_message = registered.get_to_msg(type(a)), registered.get_from_msg(b_type)
        return from_message(to_message(a))
