# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Duration as _Duration, Time as _Time
from rosmini.msgs.actionlib_msgs import msg as _actionlib_msgs
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class LookupTransformAction(_Message):
    action_goal: LookupTransformActionGoal
    action_result: LookupTransformActionResult
    action_feedback: LookupTransformActionFeedback
    @overload
    def __init__(self, *, action_goal: LookupTransformActionGoal | None = ..., action_result: LookupTransformActionResult | None = ..., action_feedback: LookupTransformActionFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, action_goal: LookupTransformActionGoal | None, action_result: LookupTransformActionResult | None, action_feedback: LookupTransformActionFeedback | None, /) -> None: ...

class LookupTransformActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: LookupTransformFeedback
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: LookupTransformFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, feedback: LookupTransformFeedback | None, /) -> None: ...

class LookupTransformActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: LookupTransformGoal
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: LookupTransformGoal | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, goal_id: _actionlib_msgs.GoalID | None, goal: LookupTransformGoal | None, /) -> None: ...

class LookupTransformActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: LookupTransformResult
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: LookupTransformResult | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, result: LookupTransformResult | None, /) -> None: ...

class LookupTransformFeedback(_Message):
    def __init__(self) -> None: ...

class LookupTransformGoal(_Message):
    target_frame: str
    source_frame: str
    source_time: _Time
    timeout: _Duration
    target_time: _Time
    fixed_frame: str
    advanced: bool
    @overload
    def __init__(self, *, target_frame: str | None = ..., source_frame: str | None = ..., source_time: _Time | None = ..., timeout: _Duration | None = ..., target_time: _Time | None = ..., fixed_frame: str | None = ..., advanced: bool | None = ...) -> None: ...
    @overload
    def __init__(self, target_frame: str | None, source_frame: str | None, source_time: _Time | None, timeout: _Duration | None, target_time: _Time | None, fixed_frame: str | None, advanced: bool | None, /) -> None: ...

class LookupTransformResult(_Message):
    transform: _geometry_msgs.TransformStamped
    error: TF2Error
    @overload
    def __init__(self, *, transform: _geometry_msgs.TransformStamped | None = ..., error: TF2Error | None = ...) -> None: ...
    @overload
    def __init__(self, transform: _geometry_msgs.TransformStamped | None, error: TF2Error | None, /) -> None: ...

class TF2Error(_Message):
    NO_ERROR: ClassVar[int]
    LOOKUP_ERROR: ClassVar[int]
    CONNECTIVITY_ERROR: ClassVar[int]
    EXTRAPOLATION_ERROR: ClassVar[int]
    INVALID_ARGUMENT_ERROR: ClassVar[int]
    TIMEOUT_ERROR: ClassVar[int]
    TRANSFORM_ERROR: ClassVar[int]
    error: int
    error_string: str
    @overload
    def __init__(self, *, error: int | None = ..., error_string: str | None = ...) -> None: ...
    @overload
    def __init__(self, error: int | None, error_string: str | None, /) -> None: ...

class TFMessage(_Message):
    transforms: list[_geometry_msgs.TransformStamped]
    @overload
    def __init__(self, *, transforms: Sequence[_geometry_msgs.TransformStamped] | None = ...) -> None: ...
    @overload
    def __init__(self, transforms: Sequence[_geometry_msgs.TransformStamped] | None, /) -> None: ...
