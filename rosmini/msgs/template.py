"""Templates for messages that change little, such as those of a sensor: the constant part is checked once.

Publishing takes a snapshot of a message: each field is read, checked and copied. A template makes snapshots from the
changing fields alone, and a `MessageFactory` publishes them without another copy.

>>> from rosmini.msgs import message_class
>>> point = message_class("geometry_msgs/PointStamped")()
>>> point.header.frame_id = "odom"
>>> at = template(point, "header.stamp.secs", "header.stamp.nsecs", "point.x")
>>> made = at(3, 500_000_000, 1.5)
>>> made.header.frame_id, made.header.stamp.to_sec(), made.point.x
('odom', 3.5, 1.5)
"""

from __future__ import annotations

from functools import lru_cache
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, SerializationError

from . import fields
from .codegen import Generator, Leaf, compiled
from .definition import BYTES, FORMATS

if TYPE_CHECKING:
    from collections.abc import Callable

    from .message import Message


def template(message: Message, *varying: str) -> Callable[..., Any]:
    """Return a function that makes frozen copies of `message`, as it is now, with new values in the fields `varying`.

    Fields are given as paths ("pose.pose.position.x") to a number, a text or an array. The function takes
    their values in this order. It raises `SerializationError`, with the field, for an invalid value.

    Raises `RosminiError` for a path without such a field, and `SerializationError` if `message` is invalid.
    """
    frozen = type(message)._freeze(message)
    cls: Any = type(frozen)
    maker, constant = _maker(cls, varying)

    def explained(values: tuple[Any, ...], cause: Exception) -> SerializationError:
        """Return the error for a set of values with an invalid one."""
        example = cls._freeze(frozen)
        for path, value in zip(varying, values, strict=True):
            parent, _, name = path.rpartition(".")
            setattr(attrgetter(parent)(example) if parent else example, name, value)
        return fields.explain(cls, example, cause)

    made: Callable[..., Any] = maker(tuple(attrgetter(path)(frozen) for path in constant), explained)
    return made


@lru_cache(maxsize=1024)
def _maker(cls: Any, varying: tuple[str, ...]) -> tuple[Callable[..., Any], tuple[str, ...]]:
    """Compile the shared code of templates with the same class and varying fields; return it and the other fields."""
    generator = _Template(cls, varying)
    return compiled(generator), tuple(generator.constant)


class _Template(Generator):
    def __init__(self, cls: Any, varying: tuple[str, ...]) -> None:
        super().__init__(cls, "maker")
        self.varying = {path: f"v{place}" for place, path in enumerate(varying)}
        paths = [self.path(leaf) for leaf in self.leaves]
        for path in varying:
            if path not in paths:
                msg = f"{cls._type} has no field {path!r} for a template to set; it has {', '.join(paths)}"
                raise RosminiError(msg)
        constant = [path for path in paths if path not in self.varying]
        self.constant = {path: f"c{place}" for place, path in enumerate(constant)}

    @staticmethod
    def path(leaf: Leaf) -> str:
        return leaf[0].field_path(leaf[1])

    def _maker(self) -> None:
        self.emit("def maker(constants, explained):", 0)
        given = ", ".join(self.varying.values())
        self.emit(f"def make({given}):")
        changing = [leaf for leaf in self.leaves if self.path(leaf) in self.varying]
        numbers = [leaf for leaf in changing if self.is_number(leaf)]
        if changing:
            self.emit("try:", 2)
        if numbers:
            packer, _ = self.struct_for(numbers)
            values = [self.varying[self.path(leaf)] for leaf in numbers]
            listed = ", ".join(values)
            as_bool = self.use("as_bool", fields.as_bool)
            packed = (
                f"{as_bool}({value})" if leaf[3] == "bool" else value
                for leaf, value in zip(numbers, values, strict=True)
            )
            self.emit(f"{listed}, = {packer}.unpack({packer}.pack({', '.join(packed)}))", 3)
            for leaf, value in zip(numbers, values, strict=True):
                if leaf[3] == "bool":
                    self.emit(f"{value} = {value} != 0", 3)
        for leaf in changing:
            if not self.is_number(leaf):
                self.emit_checked(leaf, self.varying[self.path(leaf)], 3)
        if changing:
            self.emit(f"except {self.use('ERRORS', fields.ERRORS)} as error:", 2)
            self.emit(f"raise explained(({given},), error) from error", 3)
        if self.constant:
            self.emit(f"{', '.join(self.constant.values())}, = constants", 2)
        self.emit_targets(2)
        for leaf in self.leaves:
            value = self.varying.get(self.path(leaf)) or self.fresh(leaf)
            self.emit(f"{leaf[0].target}.{self.slot(leaf[1])} = {value}", 2)
        self.emit_finish(2)
        self.emit("return o", 2)
        self.emit("return make")

    def fresh(self, leaf: Leaf) -> str:
        """Return the expression for a constant field; lists are copied, because a receiver may modify them."""
        _, _, field, _ = leaf
        name = self.constant[self.path(leaf)]
        if field is None or field.size is None or field.base in FORMATS or field.base in BYTES:
            return name
        return f"{self.array_function(field, verb='freeze')}({name})"
