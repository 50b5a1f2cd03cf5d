# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.actionlib_msgs import msg as _actionlib_msgs
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class ExploreTaskAction(_Message):
    action_goal: ExploreTaskActionGoal
    action_result: ExploreTaskActionResult
    action_feedback: ExploreTaskActionFeedback
    @overload
    def __init__(self, *, action_goal: ExploreTaskActionGoal | None = ..., action_result: ExploreTaskActionResult | None = ..., action_feedback: ExploreTaskActionFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, action_goal: ExploreTaskActionGoal | None, action_result: ExploreTaskActionResult | None, action_feedback: ExploreTaskActionFeedback | None, /) -> None: ...

class ExploreTaskActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: ExploreTaskFeedback
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: ExploreTaskFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, feedback: ExploreTaskFeedback | None, /) -> None: ...

class ExploreTaskActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: ExploreTaskGoal
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: ExploreTaskGoal | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, goal_id: _actionlib_msgs.GoalID | None, goal: ExploreTaskGoal | None, /) -> None: ...

class ExploreTaskActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: ExploreTaskResult
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: ExploreTaskResult | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, result: ExploreTaskResult | None, /) -> None: ...

class ExploreTaskFeedback(_Message):
    next_frontier: _geometry_msgs.PoseStamped
    base_position: _geometry_msgs.PoseStamped
    @overload
    def __init__(self, *, next_frontier: _geometry_msgs.PoseStamped | None = ..., base_position: _geometry_msgs.PoseStamped | None = ...) -> None: ...
    @overload
    def __init__(self, next_frontier: _geometry_msgs.PoseStamped | None, base_position: _geometry_msgs.PoseStamped | None, /) -> None: ...

class ExploreTaskGoal(_Message):
    explore_boundary: _geometry_msgs.PolygonStamped
    explore_center: _geometry_msgs.PointStamped
    @overload
    def __init__(self, *, explore_boundary: _geometry_msgs.PolygonStamped | None = ..., explore_center: _geometry_msgs.PointStamped | None = ...) -> None: ...
    @overload
    def __init__(self, explore_boundary: _geometry_msgs.PolygonStamped | None, explore_center: _geometry_msgs.PointStamped | None, /) -> None: ...

class ExploreTaskResult(_Message):
    def __init__(self) -> None: ...

class Frontier(_Message):
    size: int
    min_distance: float
    initial: _geometry_msgs.Point
    centroid: _geometry_msgs.Point
    middle: _geometry_msgs.Point
    @overload
    def __init__(self, *, size: int | None = ..., min_distance: float | None = ..., initial: _geometry_msgs.Point | None = ..., centroid: _geometry_msgs.Point | None = ..., middle: _geometry_msgs.Point | None = ...) -> None: ...
    @overload
    def __init__(self, size: int | None, min_distance: float | None, initial: _geometry_msgs.Point | None, centroid: _geometry_msgs.Point | None, middle: _geometry_msgs.Point | None, /) -> None: ...
