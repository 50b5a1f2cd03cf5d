# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message

class Logger(_Message):
    name: str
    level: str
    @overload
    def __init__(self, *, name: str | None = ..., level: str | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, level: str | None, /) -> None: ...
