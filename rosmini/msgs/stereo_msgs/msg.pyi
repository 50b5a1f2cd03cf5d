# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.sensor_msgs import msg as _sensor_msgs
from rosmini.msgs.std_msgs import msg as _std_msgs

class DisparityImage(_Message):
    header: _std_msgs.Header
    image: _sensor_msgs.Image
    f: float
    T: float
    valid_window: _sensor_msgs.RegionOfInterest
    min_disparity: float
    max_disparity: float
    delta_d: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., image: _sensor_msgs.Image | None = ..., f: float | None = ..., T: float | None = ..., valid_window: _sensor_msgs.RegionOfInterest | None = ..., min_disparity: float | None = ..., max_disparity: float | None = ..., delta_d: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, image: _sensor_msgs.Image | None, f: float | None, T: float | None, valid_window: _sensor_msgs.RegionOfInterest | None, min_disparity: float | None, max_disparity: float | None, delta_d: float | None, /) -> None: ...
