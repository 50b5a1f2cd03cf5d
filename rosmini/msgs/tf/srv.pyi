# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class FrameGraphRequest(_Message):
    def __init__(self) -> None: ...

class FrameGraphResponse(_Message):
    dot_graph: str
    @overload
    def __init__(self, *, dot_graph: str | None = ...) -> None: ...
    @overload
    def __init__(self, dot_graph: str | None, /) -> None: ...

class FrameGraph(_Service):
    _request_class: ClassVar[type[FrameGraphRequest]]
    _response_class: ClassVar[type[FrameGraphResponse]]
