# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class EmptyRequest(_Message):
    def __init__(self) -> None: ...

class EmptyResponse(_Message):
    def __init__(self) -> None: ...

class SetBoolRequest(_Message):
    data: bool
    @overload
    def __init__(self, *, data: bool | None = ...) -> None: ...
    @overload
    def __init__(self, data: bool | None, /) -> None: ...

class SetBoolResponse(_Message):
    success: bool
    message: str
    @overload
    def __init__(self, *, success: bool | None = ..., message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, message: str | None, /) -> None: ...

class TriggerRequest(_Message):
    def __init__(self) -> None: ...

class TriggerResponse(_Message):
    success: bool
    message: str
    @overload
    def __init__(self, *, success: bool | None = ..., message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, message: str | None, /) -> None: ...

class Empty(_Service):
    _request_class: ClassVar[type[EmptyRequest]]
    _response_class: ClassVar[type[EmptyResponse]]

class SetBool(_Service):
    _request_class: ClassVar[type[SetBoolRequest]]
    _response_class: ClassVar[type[SetBoolResponse]]

class Trigger(_Service):
    _request_class: ClassVar[type[TriggerRequest]]
    _response_class: ClassVar[type[TriggerResponse]]
