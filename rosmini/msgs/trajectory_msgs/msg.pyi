# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Duration as _Duration
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class JointTrajectory(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    points: list[JointTrajectoryPoint]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., joint_names: Sequence[str] | None = ..., points: Sequence[JointTrajectoryPoint] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, joint_names: Sequence[str] | None, points: Sequence[JointTrajectoryPoint] | None, /) -> None: ...

class JointTrajectoryPoint(_Message):
    positions: Any
    velocities: Any
    accelerations: Any
    effort: Any
    time_from_start: _Duration
    @overload
    def __init__(self, *, positions: Sequence[float] | Any | None = ..., velocities: Sequence[float] | Any | None = ..., accelerations: Sequence[float] | Any | None = ..., effort: Sequence[float] | Any | None = ..., time_from_start: _Duration | None = ...) -> None: ...
    @overload
    def __init__(self, positions: Sequence[float] | Any | None, velocities: Sequence[float] | Any | None, accelerations: Sequence[float] | Any | None, effort: Sequence[float] | Any | None, time_from_start: _Duration | None, /) -> None: ...

class MultiDOFJointTrajectory(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    points: list[MultiDOFJointTrajectoryPoint]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., joint_names: Sequence[str] | None = ..., points: Sequence[MultiDOFJointTrajectoryPoint] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, joint_names: Sequence[str] | None, points: Sequence[MultiDOFJointTrajectoryPoint] | None, /) -> None: ...

class MultiDOFJointTrajectoryPoint(_Message):
    transforms: list[_geometry_msgs.Transform]
    velocities: list[_geometry_msgs.Twist]
    accelerations: list[_geometry_msgs.Twist]
    time_from_start: _Duration
    @overload
    def __init__(self, *, transforms: Sequence[_geometry_msgs.Transform] | None = ..., velocities: Sequence[_geometry_msgs.Twist] | None = ..., accelerations: Sequence[_geometry_msgs.Twist] | None = ..., time_from_start: _Duration | None = ...) -> None: ...
    @overload
    def __init__(self, transforms: Sequence[_geometry_msgs.Transform] | None, velocities: Sequence[_geometry_msgs.Twist] | None, accelerations: Sequence[_geometry_msgs.Twist] | None, time_from_start: _Duration | None, /) -> None: ...
