# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class KillRequest(_Message):
    name: str
    @overload
    def __init__(self, *, name: str | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, /) -> None: ...

class KillResponse(_Message):
    def __init__(self) -> None: ...

class SetPenRequest(_Message):
    r: int
    g: int
    b: int
    width: int
    off: int
    @overload
    def __init__(self, *, r: int | None = ..., g: int | None = ..., b: int | None = ..., width: int | None = ..., off: int | None = ...) -> None: ...
    @overload
    def __init__(self, r: int | None, g: int | None, b: int | None, width: int | None, off: int | None, /) -> None: ...

class SetPenResponse(_Message):
    def __init__(self) -> None: ...

class SpawnRequest(_Message):
    x: float
    y: float
    theta: float
    name: str
    @overload
    def __init__(self, *, x: float | None = ..., y: float | None = ..., theta: float | None = ..., name: str | None = ...) -> None: ...
    @overload
    def __init__(self, x: float | None, y: float | None, theta: float | None, name: str | None, /) -> None: ...

class SpawnResponse(_Message):
    name: str
    @overload
    def __init__(self, *, name: str | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, /) -> None: ...

class TeleportAbsoluteRequest(_Message):
    x: float
    y: float
    theta: float
    @overload
    def __init__(self, *, x: float | None = ..., y: float | None = ..., theta: float | None = ...) -> None: ...
    @overload
    def __init__(self, x: float | None, y: float | None, theta: float | None, /) -> None: ...

class TeleportAbsoluteResponse(_Message):
    def __init__(self) -> None: ...

class TeleportRelativeRequest(_Message):
    linear: float
    angular: float
    @overload
    def __init__(self, *, linear: float | None = ..., angular: float | None = ...) -> None: ...
    @overload
    def __init__(self, linear: float | None, angular: float | None, /) -> None: ...

class TeleportRelativeResponse(_Message):
    def __init__(self) -> None: ...

class Kill(_Service):
    _request_class: ClassVar[type[KillRequest]]
    _response_class: ClassVar[type[KillResponse]]

class SetPen(_Service):
    _request_class: ClassVar[type[SetPenRequest]]
    _response_class: ClassVar[type[SetPenResponse]]

class Spawn(_Service):
    _request_class: ClassVar[type[SpawnRequest]]
    _response_class: ClassVar[type[SpawnResponse]]

class TeleportAbsolute(_Service):
    _request_class: ClassVar[type[TeleportAbsoluteRequest]]
    _response_class: ClassVar[type[TeleportAbsoluteResponse]]

class TeleportRelative(_Service):
    _request_class: ClassVar[type[TeleportRelativeRequest]]
    _response_class: ClassVar[type[TeleportRelativeResponse]]
