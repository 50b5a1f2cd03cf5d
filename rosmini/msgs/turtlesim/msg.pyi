# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message

class Color(_Message):
    r: int
    g: int
    b: int
    @overload
    def __init__(self, *, r: int | None = ..., g: int | None = ..., b: int | None = ...) -> None: ...
    @overload
    def __init__(self, r: int | None, g: int | None, b: int | None, /) -> None: ...

class Pose(_Message):
    x: float
    y: float
    theta: float
    linear_velocity: float
    angular_velocity: float
    @overload
    def __init__(self, *, x: float | None = ..., y: float | None = ..., theta: float | None = ..., linear_velocity: float | None = ..., angular_velocity: float | None = ...) -> None: ...
    @overload
    def __init__(self, x: float | None, y: float | None, theta: float | None, linear_velocity: float | None, angular_velocity: float | None, /) -> None: ...
