# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.dynamic_reconfigure import msg as _dynamic_reconfigure
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class ReconfigureRequest(_Message):
    config: _dynamic_reconfigure.Config
    @overload
    def __init__(self, *, config: _dynamic_reconfigure.Config | None = ...) -> None: ...
    @overload
    def __init__(self, config: _dynamic_reconfigure.Config | None, /) -> None: ...

class ReconfigureResponse(_Message):
    config: _dynamic_reconfigure.Config
    @overload
    def __init__(self, *, config: _dynamic_reconfigure.Config | None = ...) -> None: ...
    @overload
    def __init__(self, config: _dynamic_reconfigure.Config | None, /) -> None: ...

class Reconfigure(_Service):
    _request_class: ClassVar[type[ReconfigureRequest]]
    _response_class: ClassVar[type[ReconfigureResponse]]
