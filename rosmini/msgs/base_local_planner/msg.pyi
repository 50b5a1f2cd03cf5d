# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message

class Position2DInt(_Message):
    x: int
    y: int
    @overload
    def __init__(self, *, x: int | None = ..., y: int | None = ...) -> None: ...
    @overload
    def __init__(self, x: int | None, y: int | None, /) -> None: ...
