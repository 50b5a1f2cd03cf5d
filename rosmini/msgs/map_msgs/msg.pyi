# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.nav_msgs import msg as _nav_msgs
from rosmini.msgs.sensor_msgs import msg as _sensor_msgs
from rosmini.msgs.std_msgs import msg as _std_msgs

class OccupancyGridUpdate(_Message):
    header: _std_msgs.Header
    x: int
    y: int
    width: int
    height: int
    data: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., x: int | None = ..., y: int | None = ..., width: int | None = ..., height: int | None = ..., data: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, x: int | None, y: int | None, width: int | None, height: int | None, data: Sequence[int] | Any | None, /) -> None: ...

class PointCloud2Update(_Message):
    ADD: ClassVar[int]
    DELETE: ClassVar[int]
    header: _std_msgs.Header
    type: int
    points: _sensor_msgs.PointCloud2
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., type: int | None = ..., points: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, type: int | None, points: _sensor_msgs.PointCloud2 | None, /) -> None: ...

class ProjectedMap(_Message):
    map: _nav_msgs.OccupancyGrid
    min_z: float
    max_z: float
    @overload
    def __init__(self, *, map: _nav_msgs.OccupancyGrid | None = ..., min_z: float | None = ..., max_z: float | None = ...) -> None: ...
    @overload
    def __init__(self, map: _nav_msgs.OccupancyGrid | None, min_z: float | None, max_z: float | None, /) -> None: ...

class ProjectedMapInfo(_Message):
    frame_id: str
    x: float
    y: float
    width: float
    height: float
    min_z: float
    max_z: float
    @overload
    def __init__(self, *, frame_id: str | None = ..., x: float | None = ..., y: float | None = ..., width: float | None = ..., height: float | None = ..., min_z: float | None = ..., max_z: float | None = ...) -> None: ...
    @overload
    def __init__(self, frame_id: str | None, x: float | None, y: float | None, width: float | None, height: float | None, min_z: float | None, max_z: float | None, /) -> None: ...
