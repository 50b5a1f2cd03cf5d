# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.actionlib_msgs import msg as _actionlib_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class ShapeAction(_Message):
    action_goal: ShapeActionGoal
    action_result: ShapeActionResult
    action_feedback: ShapeActionFeedback
    @overload
    def __init__(self, *, action_goal: ShapeActionGoal | None = ..., action_result: ShapeActionResult | None = ..., action_feedback: ShapeActionFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, action_goal: ShapeActionGoal | None, action_result: ShapeActionResult | None, action_feedback: ShapeActionFeedback | None, /) -> None: ...

class ShapeActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: ShapeFeedback
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: ShapeFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, feedback: ShapeFeedback | None, /) -> None: ...

class ShapeActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: ShapeGoal
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: ShapeGoal | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, goal_id: _actionlib_msgs.GoalID | None, goal: ShapeGoal | None, /) -> None: ...

class ShapeActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: ShapeResult
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: ShapeResult | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, result: ShapeResult | None, /) -> None: ...

class ShapeFeedback(_Message):
    def __init__(self) -> None: ...

class ShapeGoal(_Message):
    edges: int
    radius: float
    @overload
    def __init__(self, *, edges: int | None = ..., radius: float | None = ...) -> None: ...
    @overload
    def __init__(self, edges: int | None, radius: float | None, /) -> None: ...

class ShapeResult(_Message):
    interior_angle: float
    apothem: float
    @overload
    def __init__(self, *, interior_angle: float | None = ..., apothem: float | None = ...) -> None: ...
    @overload
    def __init__(self, interior_angle: float | None, apothem: float | None, /) -> None: ...

class Velocity(_Message):
    linear: float
    angular: float
    @overload
    def __init__(self, *, linear: float | None = ..., angular: float | None = ...) -> None: ...
    @overload
    def __init__(self, linear: float | None, angular: float | None, /) -> None: ...
