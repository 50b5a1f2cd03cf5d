# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message

class Num(_Message):
    num: int
    @overload
    def __init__(self, *, num: int | None = ...) -> None: ...
    @overload
    def __init__(self, num: int | None, /) -> None: ...
