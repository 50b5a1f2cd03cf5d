"""``tf2_ros.buffer_interface``: the interface of buffers, and conversions between types."""

# ruff: noqa: ARG002 - the arguments are for derived classes

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.tf import messages
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class
from rosmini.ros.rospy.logs import warn_once
from rosmini.ros.rospy.session import current_session

AT_ONCE = Duration()


class TypeException(RosminiError):
    """No transformation or conversion is registered for a type."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(RosminiError):
    """A script's subclass of ``BufferInterface`` does not implement the lookup of a transform."""

    def __init__(self) -> None:
        self.errstr = "lookup_transform() and can_transform(), or their advanced forms, are not implemented"
        super().__init__(self.errstr)


class BufferInterface:
    """Interface for looking up transforms; derive from it for sources other than ``Buffer``."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(self, object_stamped: Any, target_frame: str, timeout: Any = AT_ONCE, new_type: Any = None) -> Any:
        """Return a stamped object in another frame, at the time in its header; as a ``new_type`` if given.

        Raises ``TypeException`` for an unregistered type, and the errors of ``lookup_transform``.
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
        """Return it at another time, assuming that ``fixed_frame`` does not move in between."""
        move = TransformRegistration().get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(move(object_stamped, found), new_type)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Time, timeout: Any = AT_ONCE) -> Any:
        """Raise ``NotImplementedException``; subclasses return the pose of ``source_frame`` in ``target_frame``."""
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
        """Raise ``NotImplementedException``; the form with a fixed frame."""
        raise NotImplementedException

    def can_transform(self, target_frame: str, source_frame: str, time: Time, timeout: Any = AT_ONCE) -> Any:
        """Raise ``NotImplementedException``; subclasses return True if a lookup would succeed."""
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
        """Raise ``NotImplementedException``; the form with a fixed frame."""
        raise NotImplementedException


def moved(message: Any, transform: Any) -> Any:
    """Return a copy of a stamped message in the frame of ``transform``, with its stamp.

    A zero quaternion counts as no rotation; the script is warned once for each type and frame.
    """
    return messages.transformed(message, transform, warn_once)


def _converted(thing: Any, new_type: Any) -> Any:
    return thing if not new_type else convert(thing, new_type)


def Stamped(obj: Any, stamp: Time, frame_id: str) -> Any:
    """Add a header to ``obj`` and return it."""
    obj.header = message_class("std_msgs/Header")(frame_id=frame_id, stamp=stamp)
    return obj


class _Registration:
    """Registered functions by type, private to each script."""

    def _put(self, what: str, key: Any, callback: Callable[..., Any]) -> None:
        self._all()[what, key] = callback

    def _find(self, what: str, key: Any) -> Callable[..., Any]:
        found: Callable[..., Any] | None = self._all().get((what, key))
        if found is None:
            raise TypeException(f"Type {key} is not loaded or supported: register a function for it with add...()")
        return found

    @staticmethod
    def _all() -> dict[tuple[str, Any], Any]:
        found: dict[tuple[str, Any], Any] = vars(current_session()).setdefault("tf2_types", {})
        return found


class TransformRegistration(_Registration):
    """Functions that transform objects of a type: ``callback(object, transform)``; for geometry and clouds."""

    def print_me(self) -> None:
        """Print the registered functions."""
        print({key: callback for (what, key), callback in self._all().items() if what == "transform"})

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Register the function that transforms objects of the type ``key``."""
        self._put("transform", key, callback)

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Return the function that transforms objects of the type ``key``. Raises ``TypeException``."""
        if ("transform", key) not in self._all() and getattr(key, "_type", None) in messages.MOVERS:
            return moved
        return self._find("transform", key)


class ConvertRegistration(_Registration):
    """Functions that convert objects of a type to messages, from messages, and directly to another type."""

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register the conversion from a message to a ``key``."""
        self._put("from_msg", key, callback)

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register the conversion from a ``key`` to a message."""
        self._put("to_msg", key, callback)

    def add_convert(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register a direct conversion; ``key`` is the pair of types."""
        self._put("convert", key, callback)

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that converts a message to a ``key``. Raises ``TypeException``."""
        return self._find("from_msg", key)

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that converts a ``key`` to a message. Raises ``TypeException``."""
        return self._find("to_msg", key)

    def get_convert(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that converts between the types of the pair ``key``. Raises ``TypeException``."""
        return self._find("convert", key)


def convert(a: Any, b_type: Any) -> Any:
    """Return ``a`` as a ``b_type``: by registered conversion, as a copy, or via a message. Raises ``TypeException``."""
    registered = ConvertRegistration()
    try:
        return registered.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return copy.deepcopy(a)
        to_message, from_message = registered.get_to_msg(type(a)), registered.get_from_msg(b_type)
        return from_message(to_message(a))
