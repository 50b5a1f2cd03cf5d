# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class GetNextFrontierRequest(_Message):
    start_pose: _geometry_msgs.PoseStamped
    @overload
    def __init__(self, *, start_pose: _geometry_msgs.PoseStamped | None = ...) -> None: ...
    @overload
    def __init__(self, start_pose: _geometry_msgs.PoseStamped | None, /) -> None: ...

class GetNextFrontierResponse(_Message):
    next_frontier: _geometry_msgs.PoseStamped
    @overload
    def __init__(self, *, next_frontier: _geometry_msgs.PoseStamped | None = ...) -> None: ...
    @overload
    def __init__(self, next_frontier: _geometry_msgs.PoseStamped | None, /) -> None: ...

class UpdateBoundaryPolygonRequest(_Message):
    explore_boundary: _geometry_msgs.PolygonStamped
    @overload
    def __init__(self, *, explore_boundary: _geometry_msgs.PolygonStamped | None = ...) -> None: ...
    @overload
    def __init__(self, explore_boundary: _geometry_msgs.PolygonStamped | None, /) -> None: ...

class UpdateBoundaryPolygonResponse(_Message):
    def __init__(self) -> None: ...

class GetNextFrontier(_Service):
    _request_class: ClassVar[type[GetNextFrontierRequest]]
    _response_class: ClassVar[type[GetNextFrontierResponse]]

class UpdateBoundaryPolygon(_Service):
    _request_class: ClassVar[type[UpdateBoundaryPolygonRequest]]
    _response_class: ClassVar[type[UpdateBoundaryPolygonResponse]]
