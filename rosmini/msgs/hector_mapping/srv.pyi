# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class ResetMappingRequest(_Message):
    initial_pose: _geometry_msgs.Pose
    @overload
    def __init__(self, *, initial_pose: _geometry_msgs.Pose | None = ...) -> None: ...
    @overload
    def __init__(self, initial_pose: _geometry_msgs.Pose | None, /) -> None: ...

class ResetMappingResponse(_Message):
    def __init__(self) -> None: ...

class ResetMapping(_Service):
    _request_class: ClassVar[type[ResetMappingRequest]]
    _response_class: ClassVar[type[ResetMappingResponse]]
