# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class DiagnosticArray(_Message):
    header: _std_msgs.Header
    status: list[DiagnosticStatus]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: Sequence[DiagnosticStatus] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: Sequence[DiagnosticStatus] | None, /) -> None: ...

class DiagnosticStatus(_Message):
    OK: ClassVar[int]
    WARN: ClassVar[int]
    ERROR: ClassVar[int]
    STALE: ClassVar[int]
    level: int
    name: str
    message: str
    hardware_id: str
    values: list[KeyValue]
    @overload
    def __init__(self, *, level: int | None = ..., name: str | None = ..., message: str | None = ..., hardware_id: str | None = ..., values: Sequence[KeyValue] | None = ...) -> None: ...
    @overload
    def __init__(self, level: int | None, name: str | None, message: str | None, hardware_id: str | None, values: Sequence[KeyValue] | None, /) -> None: ...

class KeyValue(_Message):
    key: str
    value: str
    @overload
    def __init__(self, *, key: str | None = ..., value: str | None = ...) -> None: ...
    @overload
    def __init__(self, key: str | None, value: str | None, /) -> None: ...
