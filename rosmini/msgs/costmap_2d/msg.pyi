# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class VoxelGrid(_Message):
    header: _std_msgs.Header
    data: Any
    origin: _geometry_msgs.Point32
    resolutions: _geometry_msgs.Vector3
    size_x: int
    size_y: int
    size_z: int
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., data: Sequence[int] | Any | None = ..., origin: _geometry_msgs.Point32 | None = ..., resolutions: _geometry_msgs.Vector3 | None = ..., size_x: int | None = ..., size_y: int | None = ..., size_z: int | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, data: Sequence[int] | Any | None, origin: _geometry_msgs.Point32 | None, resolutions: _geometry_msgs.Vector3 | None, size_x: int | None, size_y: int | None, size_z: int | None, /) -> None: ...
