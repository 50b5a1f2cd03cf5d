"""Generated Python source for the fast functions of a message class: init, freeze, thaw, encode and read.

Nested messages are flattened, so that one call of :mod:`struct` handles neighbouring numbers (the three integers of a
``Header``, the seven floats of a ``Pose``). ``print(source(cls, "freeze"))`` shows the source, with ``f0``, ``f1`` ...
for the names of fields: no name from a definition is part of the compiled source. The names are inserted into the
code object, where they are data.

We do not use rosbags' ROS 1 serialisation, with which the tests compare: rospy replaces text that is not UTF-8 where
rosbags raises; for an array of empty messages, rosbags loops as often as a hostile length says; it requires numpy
for byte arrays; and it generates thirteen functions per type. Publishing needs the same struct calls to check
messages, so reading and writing cost little extra code.
"""

from __future__ import annotations

import struct
from types import CodeType
from typing import TYPE_CHECKING, Any

from rosmini.core.lazy import np
from rosmini.core.time import Duration, Time

from . import fields
from .definition import BYTES, FORMATS
from .fields import dtype_of
from .limits import MAX_EMPTY, measured

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FunctionType

    from .contract import MessageContract
    from .definition import Field

__all__ = ["compile_function", "source"]

_LENGTH, _READ_LENGTH = struct.Struct("<I").pack, struct.Struct("<I").unpack_from
_TIME, _DURATION = struct.Struct("<II"), struct.Struct("<ii")


def compile_function(cls: type[MessageContract], purpose: str) -> Callable[..., Any]:
    """Compile one function of ``cls``: init, freeze, thaw, thaw_numpy, thaw_genpy_numpy, encode or read."""
    return compiled(Generator(cls, purpose))


def compiled(generator: Generator) -> Callable[..., Any]:
    """Compile the function of a generator."""
    purpose = generator.purpose
    exec(compile(generator.source(), f"<{purpose} of a message>", "exec"), generator.globals)  # noqa: S102
    function: FunctionType = generator.globals[purpose]
    names = {slot: name for name, slot in generator.slots.items()}
    function.__code__ = _named(function.__code__, names)
    if function.__kwdefaults__:
        function.__kwdefaults__ = {names[slot]: value for slot, value in function.__kwdefaults__.items()}
    return function


def source(cls: type[MessageContract], purpose: str) -> str:
    """Return the source that :func:`compile_function` compiles."""
    return Generator(cls, purpose).source()


def _named(code: CodeType, names: dict[str, str]) -> CodeType:
    """Return the code with the names of fields instead of their slots, including nested code objects."""

    def named(slots: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(names.get(slot, slot) for slot in slots)

    return code.replace(
        co_names=named(code.co_names),
        co_varnames=named(code.co_varnames),
        co_consts=tuple(_named(each, names) if isinstance(each, CodeType) else each for each in code.co_consts),
    )


class _Node:
    """One message or time in the flattened tree: its class, and the variables for source and target."""

    def __init__(self, path: str, cls: type[Any], parent: _Node | None, name: str, number: int) -> None:
        self.path, self.cls, self.parent, self.name = path, cls, parent, name
        self.source, self.target = (f"m{number}", f"o{number}") if number else ("m", "o")
        self.is_time = issubclass(cls, (Time, Duration))

    def field_path(self, name: str) -> str:
        return f"{self.path}.{name}" if self.path else name


Leaf = tuple[_Node, str, "Field | None", str]
"""A field that is not a message: its node, its name in the node, its definition (None in a time), its type."""


class Generator:
    """Generates the source of one function of a message class."""

    def __init__(self, cls: type[MessageContract], purpose: str) -> None:
        self.cls, self.purpose = cls, purpose
        self.lines: list[str] = []
        self.globals: dict[str, Any] = {"__builtins__": __builtins__}
        self.used: dict[tuple[str, int], str] = {}
        self.slots: dict[str, str] = {}
        """The placeholders for names of fields in the source."""
        self.nodes: list[_Node] = []
        self.nested: dict[str, type[MessageContract]] = {}
        self.leaves: list[Leaf] = []
        self._walk(_Node("", cls, None, "", 0))

    def _walk(self, node: _Node) -> None:
        self.nodes.append(node)
        if node.is_time:
            kind = "uint32" if node.cls is Time else "int32"
            self.leaves += [(node, part, None, kind) for part in ("secs", "nsecs")]
            return
        self.nested |= node.cls._nested
        for field in node.cls._spec.fields:
            if field.size is not None or (field.builtin and field.base not in ("time", "duration")):
                self.leaves.append((node, field.name, field, field.base))
            else:
                nested = self.class_of(node.cls, field.base)
                self._walk(_Node(node.field_path(field.name), nested, node, field.name, len(self.nodes)))

    @staticmethod
    def class_of(owner: type[Any], base: str) -> type[Any]:
        if base == "time":
            return Time
        return Duration if base == "duration" else owner._nested[base]

    # ---- pieces ----

    def use(self, name: str, value: Any) -> str:
        """Add a global to the generated code, and return its unique name."""
        unique = self.used.get((name, id(value)))
        if unique is None:
            unique = f"{name}_{len(self.used)}"
            self.used[name, id(value)] = unique
            self.globals[unique] = value
        return unique

    def slot(self, name: str) -> str:
        """Return the placeholder for the name of an attribute."""
        return self.slots.setdefault(name, f"f{len(self.slots)}")

    def emit(self, line: str, depth: int = 1) -> None:
        self.lines.append("    " * depth + line)

    def source(self) -> str:
        self.lines = []
        getattr(self, f"_{self.purpose}")()
        return "\n".join(self.lines) + "\n"

    def runs(self) -> Iterator[list[Leaf]]:
        """Yield the leaves in wire order, with neighbouring numbers grouped."""
        run: list[Leaf] = []
        for leaf in self.leaves:
            if leaf[3] != "string" and (leaf[2] is None or leaf[2].size is None):
                run.append(leaf)
                continue
            if run:
                yield run
            run = []
            yield [leaf]
        if run:
            yield run

    @staticmethod
    def is_number(leaf: Leaf) -> bool:
        return leaf[3] != "string" and (leaf[2] is None or leaf[2].size is None)

    def struct_for(self, run: list[Leaf]) -> tuple[str, struct.Struct]:
        code = "".join(FORMATS[kind] for *_, kind in run)
        packer = struct.Struct("<" + code)
        return self.use("numbers", packer), packer

    def emit_sources(self, depth: int) -> None:
        for node in self.nodes:
            if node.parent is not None:
                self.emit(f"{node.source} = {node.parent.source}.{self.slot(node.name)}", depth)

    def emit_targets(self, depth: int) -> None:
        """Create the objects, as instances of the classes without ``__setattr__`` for speed (see message.py)."""
        for node in self.nodes:
            if node.is_time:
                new = self.use("new", object.__new__)
                self.emit(f"{node.target} = {new}({self.use('made', node.cls)})", depth)
            else:
                self.emit(f"{node.target} = {self.use('fields', node.cls._fields_class)}()", depth)

    def emit_finish(self, depth: int) -> None:
        for node in reversed(self.nodes):
            if node.parent is not None:
                self.emit(f"{node.parent.target}.{self.slot(node.name)} = {node.target}", depth)
            if not node.is_time:
                self.emit(f"{node.target}.__class__ = {self.use('made', node.cls)}", depth)
            elif node.parent is self.nodes[0]:
                # genpy normalises times that are direct fields of the message
                wrong = f"{node.target}.nsecs > 999999999"
                wrong += f" or {node.target}.nsecs < 0" if node.cls is Duration else ""
                self.emit(f"if {wrong}:", depth)
                self.emit(f"{node.target}.canon()", depth + 1)

    def emit_unpacked(self, run: list[Leaf], values: str, depth: int) -> None:
        targets = [f"{node.target}.{self.slot(name)}" for node, name, _, _ in run]
        self.emit(
            f"{', '.join(targets)}, = {values}" if len(targets) == 1 else f"{', '.join(targets)} = {values}", depth
        )
        for target, (*_, kind) in zip(targets, run, strict=True):
            if kind == "bool":
                self.emit(f"{target} = {target} != 0", depth)

    def packed(self, run: list[Leaf], name: str) -> str:
        arguments = []
        for node, attribute, _, kind in run:
            value = f"{node.source}.{self.slot(attribute)}"
            arguments.append(f"{self.use('as_bool', fields.as_bool)}({value})" if kind == "bool" else value)
        return f"{name}.pack({', '.join(arguments)})"

    def array_function(self, field: Field, *, verb: str) -> str:
        """Return the name of the function that freezes (or thaws) an array field."""
        size = -1 if field.size is None else field.size
        if field.base in BYTES:
            return self.use("array", fields.freeze_bytes(size))
        if field.base in FORMATS:
            return self.use("array", fields.array_freezer(field.base, size))
        element: Callable[[Any], Any]
        if field.base == "string":
            element = fields.checked_text
        elif field.base in ("time", "duration"):
            element = _freeze_time if field.base == "time" else _freeze_duration
        else:
            element = getattr(self.nested[field.base], f"_{verb}")
        return self.use("array", _list_freezer(element, size))

    def not_frozen(self, field: Field, v: str) -> str:
        """Return the condition that the array `v` is not yet a read-only one over bytes."""
        wrong = [
            f"type({v}) is not {self.use('ndarray', np.ndarray)}",
            f"type({v}.base) is not {self.use('_bytes', bytes)}",
            f"{v}.dtype is not {self.use(f'dtype_{field.base}', dtype_of(field.base))}",
            f"{v}.ndim != 1",
            f"not {v}.flags.c_contiguous",
        ]
        wrong += [f"len({v}) != {field.size}"] if field.size != -1 else []
        return " or ".join(wrong)

    # ---- functions ----

    def _init(self) -> None:
        names = tuple(field.name for field in self.cls._spec.fields)
        slots = [self.slot(name) for name in names]
        listed = "".join(f"{slot}, " for slot in slots)
        self.emit(f"def init(self, /, *_args, {''.join(f'{slot}=None, ' for slot in slots)}**_unknown):", 0)
        self.emit("if _args or _unknown:")
        values = f"{self.use('_arguments', _arguments)}(self, _args, {self.use('_names', names)}, ({listed}), _unknown)"
        if slots:  # the usual case: all fields by position
            right = f"{self.use('_len', len)}(_args) == {len(slots)} and {' is '.join(slots)} is None"
            values = f"_args if {right} and not _unknown else {values}"
        self.emit(f"{listed or '_'} = {values}", 2)
        for field, slot in zip(self.cls._spec.fields, slots, strict=True):
            setter = self.use("_set", getattr(self.cls._fields_class, field.name).__set__)
            self.emit(f"{setter}(self, {self.default(field)} if {slot} is None else {slot})")

    def default(self, field: Field) -> str:
        if field.size == -1:
            return "b''" if field.base in BYTES else "[]"
        if field.base in BYTES and field.size is not None:
            return f"{self.use('_bytes', bytes)}({field.size})"
        if field.base in FORMATS or field.base == "string":
            single = {"float32": "0.0", "float64": "0.0", "string": "''", "bool": "False"}.get(field.base, "0")
            return single if field.size is None else f"[{single}] * {field.size}"
        cls = self.class_of(self.cls, field.base)
        single = f"{self.use('_class', cls)}()"
        return single if field.size is None else f"[{single} for _ in {self.use('_range', range)}({field.size})]"

    def _freeze(self) -> None:
        self.emit("def freeze(m, header=None):", 0)
        self.emit("try:")
        self.emit_sources(2)
        self.emit_targets(2)
        self.emit(f"o.{self.slot('_connection_header')} = header", 2)
        numbers = [leaf for leaf in self.leaves if self.is_number(leaf)]
        if numbers:
            packer, _struct = self.struct_for(numbers)
            self.emit_unpacked(numbers, f"{packer}.unpack({self.packed(numbers, packer)})", 2)
        for leaf in self.leaves:
            if self.is_number(leaf):
                continue
            node, name, _, _ = leaf
            self.emit(f"v = {node.source}.{self.slot(name)}", 2)
            self.emit_checked(leaf, "v", 2)
            self.emit(f"{node.target}.{self.slot(name)} = v", 2)
        self.emit_explained()
        self.emit_finish(1)
        self.emit("return o")

    def emit_checked(self, leaf: Leaf, value: str, depth: int) -> None:
        """Freeze the text or array in a variable."""
        _, _, field, kind = leaf
        if field is None or field.size is None:
            self.emit(f"if type({value}) is not str or not {value}.isascii():", depth)
            self.emit(f"{value} = {self.use('checked_text', fields.checked_text)}({value})", depth + 1)
            return
        freeze = self.array_function(field, verb="freeze")
        if kind in FORMATS and kind not in BYTES and kind != "bool":
            self.emit(f"if {self.not_frozen(field, value)}:", depth)
            depth += 1
        self.emit(f"{value} = {freeze}({value})", depth)

    def emit_explained(self) -> None:
        self.emit(f"except {self.use('ERRORS', fields.ERRORS)} as error:")
        self.emit(f"raise {self.use('explain', fields.explain)}({self.use('CLS', self.cls)}, m, error) from error", 2)

    def _thaw(self) -> None:
        self.emit(f"def {self.purpose}(m):", 0)
        self.emit_sources(1)
        self.emit_targets(1)
        for node, name, field, kind in self.leaves:
            value = f"{node.source}.{self.slot(name)}"
            if field is not None and field.size is not None:
                value = self.thawed(field, kind, value)
            self.emit(f"{node.target}.{self.slot(name)} = {value}")
        self.emit_finish(1)
        self.emit("return o")

    _thaw_numpy = _thaw_genpy_numpy = _thaw

    def thawed(self, field: Field, kind: str, value: str) -> str:
        """Return the expression for an array field in the form that a subscriber gets."""
        as_arrays = self.purpose != "thaw"
        if kind in BYTES:
            if self.purpose != "thaw_numpy":
                return value
            return f"{self.use('frombuffer', np.frombuffer)}({value}, {self.use('uint8', np.uint8)})"
        if kind in FORMATS:
            if as_arrays:
                return value
            return f"{value}.tolist()" if kind == "bool" else f"tuple({value}.tolist())"
        if kind == "string":
            return f"list({value})"
        if kind in ("time", "duration"):
            element: Callable[[Any], Any] = _freeze_time if kind == "time" else _freeze_duration
        else:
            element = getattr(self.nested[field.base], f"_{self.purpose}")
        return f"[{self.use('thaw_element', element)}(v) for v in {value}]"

    def _encode(self) -> None:
        length = self.use("length", _LENGTH)
        self.emit("def encode(m):", 0)
        self.emit("try:")
        self.emit_sources(2)
        self.emit("parts = []", 2)
        for run in self.runs():
            node, name, field, kind = run[0]
            value = f"{node.source}.{self.slot(name)}"
            if self.is_number(run[0]):
                packer, _struct = self.struct_for(run)
                self.emit(f"parts.append({self.packed(run, packer)})", 2)
                continue
            if field is None or field.size is None:
                self.emit(f"v = {self.use('checked_text', fields.checked_text)}({value}).encode()", 2)
                self.emit(f"parts += ({length}(len(v)), v)", 2)
                continue
            self.emit(f"v = {self.array_function(field, verb='encode')}({value})", 2)
            if field.size == -1:
                self.emit(f"parts.append({length}(len(v)))", 2)
            if kind in BYTES:
                self.emit("parts.append(v)", 2)
            elif kind in FORMATS:
                self.emit("parts.append(v.tobytes())", 2)
            elif kind == "string":
                self.emit("for s in v:", 2)
                self.emit("s = s.encode()", 3)
                self.emit(f"parts += ({length}(len(s)), s)", 3)
            elif kind in ("time", "duration"):
                packer = self.use(f"pack_{kind}", struct.Struct("<II" if kind == "time" else "<ii").pack)
                self.emit(f"parts += [{packer}(t.secs, t.nsecs) for t in v]", 2)
            else:
                self.emit("parts += v", 2)
        self.emit("return b''.join(parts)", 2)
        self.emit_explained()

    def _read(self) -> None:
        self.emit("def read(data, pos, end):", 0)
        self.emit_targets(1)
        for run in self.runs():
            node, name, field, _ = run[0]
            if self.is_number(run[0]):
                packer, compiled = self.struct_for(run)
                self.emit_unpacked(run, f"{packer}.unpack_from(data, pos)", 1)
                self.emit(f"pos += {compiled.size}")
            elif field is not None and field.size is not None:
                self.emit_array_read(node, field)
            else:
                self.emit_text_read(f"{node.target}.{self.slot(name)}", self.place(node, name), 1)
        self.emit_finish(1)
        self.emit("return o, pos")

    def place(self, node: _Node, name: str) -> str:
        """Return the arguments that tell an error the type and the field."""
        return f"{self.use('type', self.cls._type)}, {self.use('path', node.field_path(name))}"

    def emit_length(self, variable: str, depth: int) -> None:
        self.emit(f"{variable}, = {self.use('length', _READ_LENGTH)}(data, pos)", depth)
        self.emit("pos += 4", depth)

    def emit_text_read(self, target: str, place: str, depth: int) -> None:
        self.emit_length("n", depth)
        self.emit("stop = pos + n", depth)
        self.emit("if stop > end:", depth)
        self.emit(f"raise {self.use('short', fields.short)}({place}, n, end - pos)", depth + 1)
        # as in rospy, bytes that are not UTF-8 become U+FFFD
        self.emit(f"{target} = str(data[pos:stop], 'utf-8', 'replace')", depth)
        self.emit("pos = stop", depth)

    def emit_array_read(self, node: _Node, field: Field) -> None:
        place, target = self.place(node, field.name), f"{node.target}.{self.slot(field.name)}"
        kind = field.base
        if field.size == -1:
            self.emit_length("count", 1)
        else:
            self.emit(f"count = {field.size}")
        smallest = measured(field).wire if field.builtin else self.nested[field.base]._measure.wire
        limit = f"count * {smallest} > end - pos" if smallest else f"count > {MAX_EMPTY}"
        self.emit(f"if {limit}:")
        self.emit(f"raise {self.use('too_many', fields.too_many)}({place}, count, end - pos)", 2)
        if kind in FORMATS:
            size = struct.calcsize("<" + FORMATS[kind])
            self.emit(f"stop = pos + count * {size}")
            if kind in BYTES:
                value = "data[pos:stop]"
            elif kind == "bool":
                value = f"{self.use('bools_from', fields.bools_from)}(data[pos:stop])"
            else:
                dtype = self.use(f"dtype_{kind}", dtype_of(kind))
                empty = self.use(f"empty_{kind}", np.frombuffer(b"", dtype_of(kind)))
                value = f"{self.use('frombuffer', np.frombuffer)}(data, {dtype}, count, pos) if count else {empty}"
            self.emit(f"{target} = {value}")
            self.emit("pos = stop")
            return
        self.emit("found = []")
        self.emit("for _ in range(count):")
        if kind == "string":
            self.emit_text_read("v", place, 2)
        elif kind in ("time", "duration"):
            unpack = self.use(f"unpack_{kind}", struct.Struct("<II" if kind == "time" else "<ii").unpack_from)
            cls = self.class_of(self.cls, kind)
            self.emit(f"v = {self.use('new', object.__new__)}({self.use('made', cls)})", 2)
            self.emit(f"v.secs, v.nsecs = {unpack}(data, pos)", 2)
            self.emit("pos += 8", 2)
        else:
            reader = self.nested[field.base]._read
            self.emit(f"v, pos = {self.use('read_element', reader)}(data, pos, end)", 2)
        self.emit("found.append(v)", 2)
        self.emit(f"{target} = found")


def _list_freezer(element: Callable[[Any], Any], size: int) -> Callable[[Any], list[Any]]:
    def convert(values: Any) -> list[Any]:
        if isinstance(values, (str, bytes, dict)):
            raise TypeError("not a list")
        if size >= 0 and len(values) != size:
            raise ValueError("wrong length")
        return [element(value) for value in values]

    return convert


def _freeze_time(value: Any) -> Time:
    time = object.__new__(Time)
    time.secs, time.nsecs = _TIME.unpack(_TIME.pack(value.secs, value.nsecs))
    return time


def _freeze_duration(value: Any) -> Duration:
    duration = object.__new__(Duration)
    duration.secs, duration.nsecs = _DURATION.unpack(_DURATION.pack(value.secs, value.nsecs))
    return duration


def _arguments(
    message: Any, args: tuple[Any, ...], names: tuple[str, ...], values: tuple[Any, ...], unknown: dict[str, Any]
) -> Any:
    """Return the values of the fields for a constructor call by position, or raise for a wrong call."""
    return message._positional(args, dict(zip(names, values, strict=True)), unknown)
