# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service
from rosmini.msgs.roscpp import msg as _roscpp

class EmptyRequest(_Message):
    def __init__(self) -> None: ...

class EmptyResponse(_Message):
    def __init__(self) -> None: ...

class GetLoggersRequest(_Message):
    def __init__(self) -> None: ...

class GetLoggersResponse(_Message):
    loggers: list[_roscpp.Logger]
    @overload
    def __init__(self, *, loggers: Sequence[_roscpp.Logger] | None = ...) -> None: ...
    @overload
    def __init__(self, loggers: Sequence[_roscpp.Logger] | None, /) -> None: ...

class SetLoggerLevelRequest(_Message):
    logger: str
    level: str
    @overload
    def __init__(self, *, logger: str | None = ..., level: str | None = ...) -> None: ...
    @overload
    def __init__(self, logger: str | None, level: str | None, /) -> None: ...

class SetLoggerLevelResponse(_Message):
    def __init__(self) -> None: ...

class Empty(_Service):
    _request_class: ClassVar[type[EmptyRequest]]
    _response_class: ClassVar[type[EmptyResponse]]

class GetLoggers(_Service):
    _request_class: ClassVar[type[GetLoggersRequest]]
    _response_class: ClassVar[type[GetLoggersResponse]]

class SetLoggerLevel(_Service):
    _request_class: ClassVar[type[SetLoggerLevelRequest]]
    _response_class: ClassVar[type[SetLoggerLevelResponse]]
