# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Duration as _Duration, Time as _Time
from rosmini.msgs.message import Message as _Message

class Bool(_Message):
    data: bool
    @overload
    def __init__(self, *, data: bool | None = ...) -> None: ...
    @overload
    def __init__(self, data: bool | None, /) -> None: ...

class Byte(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class ByteMultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class Char(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class ColorRGBA(_Message):
    r: float
    g: float
    b: float
    a: float
    @overload
    def __init__(self, *, r: float | None = ..., g: float | None = ..., b: float | None = ..., a: float | None = ...) -> None: ...
    @overload
    def __init__(self, r: float | None, g: float | None, b: float | None, a: float | None, /) -> None: ...

class Duration(_Message):
    data: _Duration
    @overload
    def __init__(self, *, data: _Duration | None = ...) -> None: ...
    @overload
    def __init__(self, data: _Duration | None, /) -> None: ...

class Empty(_Message):
    def __init__(self) -> None: ...

class Float32(_Message):
    data: float
    @overload
    def __init__(self, *, data: float | None = ...) -> None: ...
    @overload
    def __init__(self, data: float | None, /) -> None: ...

class Float32MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[float] | Any | None, /) -> None: ...

class Float64(_Message):
    data: float
    @overload
    def __init__(self, *, data: float | None = ...) -> None: ...
    @overload
    def __init__(self, data: float | None, /) -> None: ...

class Float64MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[float] | Any | None, /) -> None: ...

class Header(_Message):
    seq: int
    stamp: _Time
    frame_id: str
    @overload
    def __init__(self, *, seq: int | None = ..., stamp: _Time | None = ..., frame_id: str | None = ...) -> None: ...
    @overload
    def __init__(self, seq: int | None, stamp: _Time | None, frame_id: str | None, /) -> None: ...

class Int16(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class Int16MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class Int32(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class Int32MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class Int64(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class Int64MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class Int8(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class Int8MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class MultiArrayDimension(_Message):
    label: str
    size: int
    stride: int
    @overload
    def __init__(self, *, label: str | None = ..., size: int | None = ..., stride: int | None = ...) -> None: ...
    @overload
    def __init__(self, label: str | None, size: int | None, stride: int | None, /) -> None: ...

class MultiArrayLayout(_Message):
    dim: list[MultiArrayDimension]
    data_offset: int
    @overload
    def __init__(self, *, dim: Sequence[MultiArrayDimension] | None = ..., data_offset: int | None = ...) -> None: ...
    @overload
    def __init__(self, dim: Sequence[MultiArrayDimension] | None, data_offset: int | None, /) -> None: ...

class String(_Message):
    data: str
    @overload
    def __init__(self, *, data: str | None = ...) -> None: ...
    @overload
    def __init__(self, data: str | None, /) -> None: ...

class Time(_Message):
    data: _Time
    @overload
    def __init__(self, *, data: _Time | None = ...) -> None: ...
    @overload
    def __init__(self, data: _Time | None, /) -> None: ...

class UInt16(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class UInt16MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class UInt32(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class UInt32MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class UInt64(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class UInt64MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: Sequence[int] | Any | None, /) -> None: ...

class UInt8(_Message):
    data: int
    @overload
    def __init__(self, *, data: int | None = ...) -> None: ...
    @overload
    def __init__(self, data: int | None, /) -> None: ...

class UInt8MultiArray(_Message):
    layout: MultiArrayLayout
    data: Any
    @overload
    def __init__(self, *, layout: MultiArrayLayout | None = ..., data: bytes | Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, layout: MultiArrayLayout | None, data: bytes | Sequence[int] | Any | None, /) -> None: ...
