# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class DemuxAddRequest(_Message):
    topic: str
    @overload
    def __init__(self, *, topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, topic: str | None, /) -> None: ...

class DemuxAddResponse(_Message):
    def __init__(self) -> None: ...

class DemuxDeleteRequest(_Message):
    topic: str
    @overload
    def __init__(self, *, topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, topic: str | None, /) -> None: ...

class DemuxDeleteResponse(_Message):
    def __init__(self) -> None: ...

class DemuxListRequest(_Message):
    def __init__(self) -> None: ...

class DemuxListResponse(_Message):
    topics: list[str]
    @overload
    def __init__(self, *, topics: Sequence[str] | None = ...) -> None: ...
    @overload
    def __init__(self, topics: Sequence[str] | None, /) -> None: ...

class DemuxSelectRequest(_Message):
    topic: str
    @overload
    def __init__(self, *, topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, topic: str | None, /) -> None: ...

class DemuxSelectResponse(_Message):
    prev_topic: str
    @overload
    def __init__(self, *, prev_topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, prev_topic: str | None, /) -> None: ...

class MuxAddRequest(_Message):
    topic: str
    @overload
    def __init__(self, *, topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, topic: str | None, /) -> None: ...

class MuxAddResponse(_Message):
    def __init__(self) -> None: ...

class MuxDeleteRequest(_Message):
    topic: str
    @overload
    def __init__(self, *, topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, topic: str | None, /) -> None: ...

class MuxDeleteResponse(_Message):
    def __init__(self) -> None: ...

class MuxListRequest(_Message):
    def __init__(self) -> None: ...

class MuxListResponse(_Message):
    topics: list[str]
    @overload
    def __init__(self, *, topics: Sequence[str] | None = ...) -> None: ...
    @overload
    def __init__(self, topics: Sequence[str] | None, /) -> None: ...

class MuxSelectRequest(_Message):
    topic: str
    @overload
    def __init__(self, *, topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, topic: str | None, /) -> None: ...

class MuxSelectResponse(_Message):
    prev_topic: str
    @overload
    def __init__(self, *, prev_topic: str | None = ...) -> None: ...
    @overload
    def __init__(self, prev_topic: str | None, /) -> None: ...

class DemuxAdd(_Service):
    _request_class: ClassVar[type[DemuxAddRequest]]
    _response_class: ClassVar[type[DemuxAddResponse]]

class DemuxDelete(_Service):
    _request_class: ClassVar[type[DemuxDeleteRequest]]
    _response_class: ClassVar[type[DemuxDeleteResponse]]

class DemuxList(_Service):
    _request_class: ClassVar[type[DemuxListRequest]]
    _response_class: ClassVar[type[DemuxListResponse]]

class DemuxSelect(_Service):
    _request_class: ClassVar[type[DemuxSelectRequest]]
    _response_class: ClassVar[type[DemuxSelectResponse]]

class MuxAdd(_Service):
    _request_class: ClassVar[type[MuxAddRequest]]
    _response_class: ClassVar[type[MuxAddResponse]]

class MuxDelete(_Service):
    _request_class: ClassVar[type[MuxDeleteRequest]]
    _response_class: ClassVar[type[MuxDeleteResponse]]

class MuxList(_Service):
    _request_class: ClassVar[type[MuxListRequest]]
    _response_class: ClassVar[type[MuxListResponse]]

class MuxSelect(_Service):
    _request_class: ClassVar[type[MuxSelectRequest]]
    _response_class: ClassVar[type[MuxSelectResponse]]
