# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Duration as _Duration
from rosmini.msgs.actionlib_msgs import msg as _actionlib_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class TestAction(_Message):
    action_goal: TestActionGoal
    action_result: TestActionResult
    action_feedback: TestActionFeedback
    @overload
    def __init__(self, *, action_goal: TestActionGoal | None = ..., action_result: TestActionResult | None = ..., action_feedback: TestActionFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, action_goal: TestActionGoal | None, action_result: TestActionResult | None, action_feedback: TestActionFeedback | None, /) -> None: ...

class TestActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TestFeedback
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TestFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, feedback: TestFeedback | None, /) -> None: ...

class TestActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TestGoal
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TestGoal | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, goal_id: _actionlib_msgs.GoalID | None, goal: TestGoal | None, /) -> None: ...

class TestActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TestResult
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TestResult | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, result: TestResult | None, /) -> None: ...

class TestFeedback(_Message):
    feedback: int
    @overload
    def __init__(self, *, feedback: int | None = ...) -> None: ...
    @overload
    def __init__(self, feedback: int | None, /) -> None: ...

class TestGoal(_Message):
    goal: int
    @overload
    def __init__(self, *, goal: int | None = ...) -> None: ...
    @overload
    def __init__(self, goal: int | None, /) -> None: ...

class TestRequestAction(_Message):
    action_goal: TestRequestActionGoal
    action_result: TestRequestActionResult
    action_feedback: TestRequestActionFeedback
    @overload
    def __init__(self, *, action_goal: TestRequestActionGoal | None = ..., action_result: TestRequestActionResult | None = ..., action_feedback: TestRequestActionFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, action_goal: TestRequestActionGoal | None, action_result: TestRequestActionResult | None, action_feedback: TestRequestActionFeedback | None, /) -> None: ...

class TestRequestActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TestRequestFeedback
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TestRequestFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, feedback: TestRequestFeedback | None, /) -> None: ...

class TestRequestActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TestRequestGoal
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TestRequestGoal | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, goal_id: _actionlib_msgs.GoalID | None, goal: TestRequestGoal | None, /) -> None: ...

class TestRequestActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TestRequestResult
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TestRequestResult | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, result: TestRequestResult | None, /) -> None: ...

class TestRequestFeedback(_Message):
    def __init__(self) -> None: ...

class TestRequestGoal(_Message):
    TERMINATE_SUCCESS: ClassVar[int]
    TERMINATE_ABORTED: ClassVar[int]
    TERMINATE_REJECTED: ClassVar[int]
    TERMINATE_LOSE: ClassVar[int]
    TERMINATE_DROP: ClassVar[int]
    TERMINATE_EXCEPTION: ClassVar[int]
    terminate_status: int
    ignore_cancel: bool
    result_text: str
    the_result: int
    is_simple_client: bool
    delay_accept: _Duration
    delay_terminate: _Duration
    pause_status: _Duration
    @overload
    def __init__(self, *, terminate_status: int | None = ..., ignore_cancel: bool | None = ..., result_text: str | None = ..., the_result: int | None = ..., is_simple_client: bool | None = ..., delay_accept: _Duration | None = ..., delay_terminate: _Duration | None = ..., pause_status: _Duration | None = ...) -> None: ...
    @overload
    def __init__(self, terminate_status: int | None, ignore_cancel: bool | None, result_text: str | None, the_result: int | None, is_simple_client: bool | None, delay_accept: _Duration | None, delay_terminate: _Duration | None, pause_status: _Duration | None, /) -> None: ...

class TestRequestResult(_Message):
    the_result: int
    is_simple_server: bool
    @overload
    def __init__(self, *, the_result: int | None = ..., is_simple_server: bool | None = ...) -> None: ...
    @overload
    def __init__(self, the_result: int | None, is_simple_server: bool | None, /) -> None: ...

class TestResult(_Message):
    result: int
    @overload
    def __init__(self, *, result: int | None = ...) -> None: ...
    @overload
    def __init__(self, result: int | None, /) -> None: ...

class TwoIntsAction(_Message):
    action_goal: TwoIntsActionGoal
    action_result: TwoIntsActionResult
    action_feedback: TwoIntsActionFeedback
    @overload
    def __init__(self, *, action_goal: TwoIntsActionGoal | None = ..., action_result: TwoIntsActionResult | None = ..., action_feedback: TwoIntsActionFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, action_goal: TwoIntsActionGoal | None, action_result: TwoIntsActionResult | None, action_feedback: TwoIntsActionFeedback | None, /) -> None: ...

class TwoIntsActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TwoIntsFeedback
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TwoIntsFeedback | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, feedback: TwoIntsFeedback | None, /) -> None: ...

class TwoIntsActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TwoIntsGoal
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TwoIntsGoal | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, goal_id: _actionlib_msgs.GoalID | None, goal: TwoIntsGoal | None, /) -> None: ...

class TwoIntsActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TwoIntsResult
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TwoIntsResult | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: _actionlib_msgs.GoalStatus | None, result: TwoIntsResult | None, /) -> None: ...

class TwoIntsFeedback(_Message):
    def __init__(self) -> None: ...

class TwoIntsGoal(_Message):
    a: int
    b: int
    @overload
    def __init__(self, *, a: int | None = ..., b: int | None = ...) -> None: ...
    @overload
    def __init__(self, a: int | None, b: int | None, /) -> None: ...

class TwoIntsResult(_Message):
    sum: int
    @overload
    def __init__(self, *, sum: int | None = ...) -> None: ...
    @overload
    def __init__(self, sum: int | None, /) -> None: ...
