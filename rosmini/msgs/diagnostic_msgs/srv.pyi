# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.diagnostic_msgs import msg as _diagnostic_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class AddDiagnosticsRequest(_Message):
    load_namespace: str
    @overload
    def __init__(self, *, load_namespace: str | None = ...) -> None: ...
    @overload
    def __init__(self, load_namespace: str | None, /) -> None: ...

class AddDiagnosticsResponse(_Message):
    success: bool
    message: str
    @overload
    def __init__(self, *, success: bool | None = ..., message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, message: str | None, /) -> None: ...

class SelfTestRequest(_Message):
    def __init__(self) -> None: ...

class SelfTestResponse(_Message):
    id: str
    passed: int
    status: list[_diagnostic_msgs.DiagnosticStatus]
    @overload
    def __init__(self, *, id: str | None = ..., passed: int | None = ..., status: Sequence[_diagnostic_msgs.DiagnosticStatus] | None = ...) -> None: ...
    @overload
    def __init__(self, id: str | None, passed: int | None, status: Sequence[_diagnostic_msgs.DiagnosticStatus] | None, /) -> None: ...

class AddDiagnostics(_Service):
    _request_class: ClassVar[type[AddDiagnosticsRequest]]
    _response_class: ClassVar[type[AddDiagnosticsResponse]]

class SelfTest(_Service):
    _request_class: ClassVar[type[SelfTestRequest]]
    _response_class: ClassVar[type[SelfTestResponse]]
