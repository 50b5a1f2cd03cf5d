# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Time as _Time
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class GoalID(_Message):
    stamp: _Time
    id: str
    @overload
    def __init__(self, *, stamp: _Time | None = ..., id: str | None = ...) -> None: ...
    @overload
    def __init__(self, stamp: _Time | None, id: str | None, /) -> None: ...

class GoalStatus(_Message):
    PENDING: ClassVar[int]
    ACTIVE: ClassVar[int]
    PREEMPTED: ClassVar[int]
    SUCCEEDED: ClassVar[int]
    ABORTED: ClassVar[int]
    REJECTED: ClassVar[int]
    PREEMPTING: ClassVar[int]
    RECALLING: ClassVar[int]
    RECALLED: ClassVar[int]
    LOST: ClassVar[int]
    goal_id: GoalID
    status: int
    text: str
    @overload
    def __init__(self, *, goal_id: GoalID | None = ..., status: int | None = ..., text: str | None = ...) -> None: ...
    @overload
    def __init__(self, goal_id: GoalID | None, status: int | None, text: str | None, /) -> None: ...

class GoalStatusArray(_Message):
    header: _std_msgs.Header
    status_list: list[GoalStatus]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status_list: Sequence[GoalStatus] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status_list: Sequence[GoalStatus] | None, /) -> None: ...
