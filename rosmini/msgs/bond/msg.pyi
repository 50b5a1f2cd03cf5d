# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class Constants(_Message):
    DEAD_PUBLISH_PERIOD: ClassVar[float]
    DEFAULT_CONNECT_TIMEOUT: ClassVar[float]
    DEFAULT_HEARTBEAT_TIMEOUT: ClassVar[float]
    DEFAULT_DISCONNECT_TIMEOUT: ClassVar[float]
    DEFAULT_HEARTBEAT_PERIOD: ClassVar[float]
    DISABLE_HEARTBEAT_TIMEOUT_PARAM: ClassVar[str]
    def __init__(self) -> None: ...

class Status(_Message):
    header: _std_msgs.Header
    id: str
    instance_id: str
    active: bool
    heartbeat_timeout: float
    heartbeat_period: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., id: str | None = ..., instance_id: str | None = ..., active: bool | None = ..., heartbeat_timeout: float | None = ..., heartbeat_period: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, id: str | None, instance_id: str | None, active: bool | None, heartbeat_timeout: float | None, heartbeat_period: float | None, /) -> None: ...
