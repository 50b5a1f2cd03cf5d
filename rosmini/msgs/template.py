"""Messages of which little changes from one to the next, such as those of a sensor: what stays is checked once.

Publishing takes a snapshot of a message: each field is read, checked and copied. A template makes snapshots from what
changes alone, and `Publisher.publish_frozen` sends them as they are.

>>> from rosmini.msgs import message_class
>>> point = message_class("geometry_msgs/PointStamped")()
>>> point.header.frame_id = "odom"
>>> at = template(point, "header.stamp.secs", "header.stamp.nsecs", "point.x")
>>> made = at(3, 500_000_000, 1.5)
>>> made.header.frame_id, made.header.stamp.to_sec(), made.point.x
('odom', 3.5, 1.5)
"""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Any

from rosmini.errors import RosminiError, SerializationError

from . import fields
from .codegen import Generator, Leaf, compiled

if TYPE_CHECKING:
    from collections.abc import Callable

    from .message import Message

__all__ = ["template"]


def template(message: Message, *varying: str) -> Callable[..., Any]:
    """Return a function that makes frozen messages which differ from `message`, as it is now, in the fields `varying`.

    Fields are named by their paths ("pose.pose.position.x"); each is a number, a text or an array. The function takes
    their values in this order. It raises `SerializationError`, which names the field, for what that cannot hold.

    Raises `RosminiError` if a path leads to no such field, and `SerializationError` as publishing the message does.
    """
    return compiled(_Template(type(message)._freeze(message), varying))


class _Template(Generator):
    def __init__(self, frozen: Any, varying: tuple[str, ...]) -> None:
        cls = type(frozen)
        super().__init__(cls, "make")
        self.frozen = frozen
        self.varying = {path: f"v{place}" for place, path in enumerate(varying)}
        known = [self.path(leaf) for leaf in self.leaves]
        for path in varying:
            if path not in known:
                msg = f"{cls._type} has no field {path!r} for a template to set; it has {', '.join(known)}"
                raise RosminiError(msg)

    @staticmethod
    def path(leaf: Leaf) -> str:
        return leaf[0].field_path(leaf[1])

    def _make(self) -> None:
        given = ", ".join(self.varying.values())
        self.emit(f"def make({given}):", 0)
        changing = [leaf for leaf in self.leaves if self.path(leaf) in self.varying]
        numbers = [leaf for leaf in changing if self.is_number(leaf)]
        if changing:
            self.emit("try:")
        if numbers:
            packer, _ = self.struct_for(numbers)
            values = [self.varying[self.path(leaf)] for leaf in numbers]
            listed = ", ".join(values)
            as_bool = self.use("as_bool", fields.as_bool)
            packed = (
                f"{as_bool}({value})" if leaf[3] == "bool" else value
                for leaf, value in zip(numbers, values, strict=True)
            )
            self.emit(f"{listed}, = {packer}.unpack({packer}.pack({', '.join(packed)}))", 2)
            for leaf, value in zip(numbers, values, strict=True):
                if leaf[3] == "bool":
                    self.emit(f"{value} = {value} != 0", 2)
        for leaf in changing:
            if not self.is_number(leaf):
                self.emit_checked(leaf, self.varying[self.path(leaf)], 2)
        if changing:
            self.emit(f"except {self.use('ERRORS', fields.ERRORS)} as error:")
            self.emit(f"raise {self.use('explained', self.explained)}(({given},), error) from error", 2)
        self.emit_targets(1)
        for leaf in self.leaves:
            value = self.varying.get(self.path(leaf)) or self.constant(leaf)
            self.emit(f"{leaf[0].target}.{self.slot(leaf[1])} = {value}")
        self.emit_finish(1)
        self.emit("return o")

    def constant(self, leaf: Leaf) -> str:
        """What stays, as it is put into each message: lists anew, for a receiver may write into them."""
        _, _, field, _ = leaf
        value = attrgetter(self.path(leaf))(self.frozen)
        name = self.use("constant", value)
        if isinstance(value, list) and field is not None:
            return f"{self.array_function(field, verb='freeze')}({name})"
        return name

    def explained(self, values: tuple[Any, ...], cause: Exception) -> SerializationError:
        """The error for values of which one does not fit."""
        message = self.cls._freeze(self.frozen)
        for path, value in zip(self.varying, values, strict=True):
            parent, _, name = path.rpartition(".")
            setattr(attrgetter(parent)(message) if parent else message, name, value)
        return fields.explain(self.cls, message, cause)
