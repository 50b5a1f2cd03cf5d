# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.map_msgs import msg as _map_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.nav_msgs import msg as _nav_msgs
from rosmini.msgs.registry import Service as _Service
from rosmini.msgs.sensor_msgs import msg as _sensor_msgs
from rosmini.msgs.std_msgs import msg as _std_msgs

class GetMapROIRequest(_Message):
    x: float
    y: float
    l_x: float
    l_y: float
    @overload
    def __init__(self, *, x: float | None = ..., y: float | None = ..., l_x: float | None = ..., l_y: float | None = ...) -> None: ...
    @overload
    def __init__(self, x: float | None, y: float | None, l_x: float | None, l_y: float | None, /) -> None: ...

class GetMapROIResponse(_Message):
    sub_map: _nav_msgs.OccupancyGrid
    @overload
    def __init__(self, *, sub_map: _nav_msgs.OccupancyGrid | None = ...) -> None: ...
    @overload
    def __init__(self, sub_map: _nav_msgs.OccupancyGrid | None, /) -> None: ...

class GetPointMapRequest(_Message):
    def __init__(self) -> None: ...

class GetPointMapResponse(_Message):
    map: _sensor_msgs.PointCloud2
    @overload
    def __init__(self, *, map: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
    @overload
    def __init__(self, map: _sensor_msgs.PointCloud2 | None, /) -> None: ...

class GetPointMapROIRequest(_Message):
    x: float
    y: float
    z: float
    r: float
    l_x: float
    l_y: float
    l_z: float
    @overload
    def __init__(self, *, x: float | None = ..., y: float | None = ..., z: float | None = ..., r: float | None = ..., l_x: float | None = ..., l_y: float | None = ..., l_z: float | None = ...) -> None: ...
    @overload
    def __init__(self, x: float | None, y: float | None, z: float | None, r: float | None, l_x: float | None, l_y: float | None, l_z: float | None, /) -> None: ...

class GetPointMapROIResponse(_Message):
    sub_map: _sensor_msgs.PointCloud2
    @overload
    def __init__(self, *, sub_map: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
    @overload
    def __init__(self, sub_map: _sensor_msgs.PointCloud2 | None, /) -> None: ...

class ProjectedMapsInfoRequest(_Message):
    projected_maps_info: list[_map_msgs.ProjectedMapInfo]
    @overload
    def __init__(self, *, projected_maps_info: Sequence[_map_msgs.ProjectedMapInfo] | None = ...) -> None: ...
    @overload
    def __init__(self, projected_maps_info: Sequence[_map_msgs.ProjectedMapInfo] | None, /) -> None: ...

class ProjectedMapsInfoResponse(_Message):
    def __init__(self) -> None: ...

class SaveMapRequest(_Message):
    filename: _std_msgs.String
    @overload
    def __init__(self, *, filename: _std_msgs.String | None = ...) -> None: ...
    @overload
    def __init__(self, filename: _std_msgs.String | None, /) -> None: ...

class SaveMapResponse(_Message):
    def __init__(self) -> None: ...

class SetMapProjectionsRequest(_Message):
    def __init__(self) -> None: ...

class SetMapProjectionsResponse(_Message):
    projected_maps_info: list[_map_msgs.ProjectedMapInfo]
    @overload
    def __init__(self, *, projected_maps_info: Sequence[_map_msgs.ProjectedMapInfo] | None = ...) -> None: ...
    @overload
    def __init__(self, projected_maps_info: Sequence[_map_msgs.ProjectedMapInfo] | None, /) -> None: ...

class GetMapROI(_Service):
    _request_class: ClassVar[type[GetMapROIRequest]]
    _response_class: ClassVar[type[GetMapROIResponse]]

class GetPointMap(_Service):
    _request_class: ClassVar[type[GetPointMapRequest]]
    _response_class: ClassVar[type[GetPointMapResponse]]

class GetPointMapROI(_Service):
    _request_class: ClassVar[type[GetPointMapROIRequest]]
    _response_class: ClassVar[type[GetPointMapROIResponse]]

class ProjectedMapsInfo(_Service):
    _request_class: ClassVar[type[ProjectedMapsInfoRequest]]
    _response_class: ClassVar[type[ProjectedMapsInfoResponse]]

class SaveMap(_Service):
    _request_class: ClassVar[type[SaveMapRequest]]
    _response_class: ClassVar[type[SaveMapResponse]]

class SetMapProjections(_Service):
    _request_class: ClassVar[type[SetMapProjectionsRequest]]
    _response_class: ClassVar[type[SetMapProjectionsResponse]]
