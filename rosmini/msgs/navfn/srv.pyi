# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service

class MakeNavPlanRequest(_Message):
    start: _geometry_msgs.PoseStamped
    goal: _geometry_msgs.PoseStamped
    @overload
    def __init__(self, *, start: _geometry_msgs.PoseStamped | None = ..., goal: _geometry_msgs.PoseStamped | None = ...) -> None: ...
    @overload
    def __init__(self, start: _geometry_msgs.PoseStamped | None, goal: _geometry_msgs.PoseStamped | None, /) -> None: ...

class MakeNavPlanResponse(_Message):
    plan_found: int
    error_message: str
    path: list[_geometry_msgs.PoseStamped]
    @overload
    def __init__(self, *, plan_found: int | None = ..., error_message: str | None = ..., path: Sequence[_geometry_msgs.PoseStamped] | None = ...) -> None: ...
    @overload
    def __init__(self, plan_found: int | None, error_message: str | None, path: Sequence[_geometry_msgs.PoseStamped] | None, /) -> None: ...

class SetCostmapRequest(_Message):
    costs: Any
    height: int
    width: int
    @overload
    def __init__(self, *, costs: bytes | Sequence[int] | Any | None = ..., height: int | None = ..., width: int | None = ...) -> None: ...
    @overload
    def __init__(self, costs: bytes | Sequence[int] | Any | None, height: int | None, width: int | None, /) -> None: ...

class SetCostmapResponse(_Message):
    def __init__(self) -> None: ...

class MakeNavPlan(_Service):
    _request_class: ClassVar[type[MakeNavPlanRequest]]
    _response_class: ClassVar[type[MakeNavPlanResponse]]

class SetCostmap(_Service):
    _request_class: ClassVar[type[SetCostmapRequest]]
    _response_class: ClassVar[type[SetCostmapResponse]]
