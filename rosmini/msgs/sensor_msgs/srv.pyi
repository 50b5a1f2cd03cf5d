# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service
from rosmini.msgs.sensor_msgs import msg as _sensor_msgs

class SetCameraInfoRequest(_Message):
    camera_info: _sensor_msgs.CameraInfo
    @overload
    def __init__(self, *, camera_info: _sensor_msgs.CameraInfo | None = ...) -> None: ...
    @overload
    def __init__(self, camera_info: _sensor_msgs.CameraInfo | None, /) -> None: ...

class SetCameraInfoResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetCameraInfo(_Service):
    _request_class: ClassVar[type[SetCameraInfoRequest]]
    _response_class: ClassVar[type[SetCameraInfoResponse]]
