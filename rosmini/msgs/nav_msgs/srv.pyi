# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.nav_msgs import msg as _nav_msgs
from rosmini.msgs.registry import Service as _Service

class GetMapRequest(_Message):
    def __init__(self) -> None: ...

class GetMapResponse(_Message):
    map: _nav_msgs.OccupancyGrid
    @overload
    def __init__(self, *, map: _nav_msgs.OccupancyGrid | None = ...) -> None: ...
    @overload
    def __init__(self, map: _nav_msgs.OccupancyGrid | None, /) -> None: ...

class GetPlanRequest(_Message):
    start: _geometry_msgs.PoseStamped
    goal: _geometry_msgs.PoseStamped
    tolerance: float
    @overload
    def __init__(self, *, start: _geometry_msgs.PoseStamped | None = ..., goal: _geometry_msgs.PoseStamped | None = ..., tolerance: float | None = ...) -> None: ...
    @overload
    def __init__(self, start: _geometry_msgs.PoseStamped | None, goal: _geometry_msgs.PoseStamped | None, tolerance: float | None, /) -> None: ...

class GetPlanResponse(_Message):
    plan: _nav_msgs.Path
    @overload
    def __init__(self, *, plan: _nav_msgs.Path | None = ...) -> None: ...
    @overload
    def __init__(self, plan: _nav_msgs.Path | None, /) -> None: ...

class LoadMapRequest(_Message):
    map_url: str
    @overload
    def __init__(self, *, map_url: str | None = ...) -> None: ...
    @overload
    def __init__(self, map_url: str | None, /) -> None: ...

class LoadMapResponse(_Message):
    RESULT_SUCCESS: ClassVar[int]
    RESULT_MAP_DOES_NOT_EXIST: ClassVar[int]
    RESULT_INVALID_MAP_DATA: ClassVar[int]
    RESULT_INVALID_MAP_METADATA: ClassVar[int]
    RESULT_UNDEFINED_FAILURE: ClassVar[int]
    map: _nav_msgs.OccupancyGrid
    result: int
    @overload
    def __init__(self, *, map: _nav_msgs.OccupancyGrid | None = ..., result: int | None = ...) -> None: ...
    @overload
    def __init__(self, map: _nav_msgs.OccupancyGrid | None, result: int | None, /) -> None: ...

class SetMapRequest(_Message):
    map: _nav_msgs.OccupancyGrid
    initial_pose: _geometry_msgs.PoseWithCovarianceStamped
    @overload
    def __init__(self, *, map: _nav_msgs.OccupancyGrid | None = ..., initial_pose: _geometry_msgs.PoseWithCovarianceStamped | None = ...) -> None: ...
    @overload
    def __init__(self, map: _nav_msgs.OccupancyGrid | None, initial_pose: _geometry_msgs.PoseWithCovarianceStamped | None, /) -> None: ...

class SetMapResponse(_Message):
    success: bool
    @overload
    def __init__(self, *, success: bool | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, /) -> None: ...

class GetMap(_Service):
    _request_class: ClassVar[type[GetMapRequest]]
    _response_class: ClassVar[type[GetMapResponse]]

class GetPlan(_Service):
    _request_class: ClassVar[type[GetPlanRequest]]
    _response_class: ClassVar[type[GetPlanResponse]]

class LoadMap(_Service):
    _request_class: ClassVar[type[LoadMapRequest]]
    _response_class: ClassVar[type[LoadMapResponse]]

class SetMap(_Service):
    _request_class: ClassVar[type[SetMapRequest]]
    _response_class: ClassVar[type[SetMapResponse]]
