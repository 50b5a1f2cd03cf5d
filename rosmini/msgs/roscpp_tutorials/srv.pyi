# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class TwoIntsRequest(_Message):
    a: int
    b: int
    @overload
    def __init__(self, *, a: int | None = ..., b: int | None = ...) -> None: ...
    @overload
    def __init__(self, a: int | None, b: int | None, /) -> None: ...

class TwoIntsResponse(_Message):
    sum: int
    @overload
    def __init__(self, *, sum: int | None = ...) -> None: ...
    @overload
    def __init__(self, sum: int | None, /) -> None: ...

class TwoInts(_Service):
    _request_class: ClassVar[type[TwoIntsRequest]]
    _response_class: ClassVar[type[TwoIntsResponse]]
