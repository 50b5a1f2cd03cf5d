# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class Floats(_Message):
    data: Any
    @overload
    def __init__(self, *, data: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, data: Sequence[float] | Any | None, /) -> None: ...

class HeaderString(_Message):
    header: _std_msgs.Header
    data: str
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., data: str | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, data: str | None, /) -> None: ...
