# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message

class tfMessage(_Message):
    transforms: list[_geometry_msgs.TransformStamped]
    @overload
    def __init__(self, *, transforms: Sequence[_geometry_msgs.TransformStamped] | None = ...) -> None: ...
    @overload
    def __init__(self, transforms: Sequence[_geometry_msgs.TransformStamped] | None, /) -> None: ...
