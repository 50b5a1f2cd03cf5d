# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message

class BoolParameter(_Message):
    name: str
    value: bool
    @overload
    def __init__(self, *, name: str | None = ..., value: bool | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, value: bool | None, /) -> None: ...

class Config(_Message):
    bools: list[BoolParameter]
    ints: list[IntParameter]
    strs: list[StrParameter]
    doubles: list[DoubleParameter]
    groups: list[GroupState]
    @overload
    def __init__(self, *, bools: Sequence[BoolParameter] | None = ..., ints: Sequence[IntParameter] | None = ..., strs: Sequence[StrParameter] | None = ..., doubles: Sequence[DoubleParameter] | None = ..., groups: Sequence[GroupState] | None = ...) -> None: ...
    @overload
    def __init__(self, bools: Sequence[BoolParameter] | None, ints: Sequence[IntParameter] | None, strs: Sequence[StrParameter] | None, doubles: Sequence[DoubleParameter] | None, groups: Sequence[GroupState] | None, /) -> None: ...

class ConfigDescription(_Message):
    groups: list[Group]
    max: Config
    min: Config
    dflt: Config
    @overload
    def __init__(self, *, groups: Sequence[Group] | None = ..., max: Config | None = ..., min: Config | None = ..., dflt: Config | None = ...) -> None: ...
    @overload
    def __init__(self, groups: Sequence[Group] | None, max: Config | None, min: Config | None, dflt: Config | None, /) -> None: ...

class DoubleParameter(_Message):
    name: str
    value: float
    @overload
    def __init__(self, *, name: str | None = ..., value: float | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, value: float | None, /) -> None: ...

class Group(_Message):
    name: str
    type: str
    parameters: list[ParamDescription]
    parent: int
    id: int
    @overload
    def __init__(self, *, name: str | None = ..., type: str | None = ..., parameters: Sequence[ParamDescription] | None = ..., parent: int | None = ..., id: int | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, type: str | None, parameters: Sequence[ParamDescription] | None, parent: int | None, id: int | None, /) -> None: ...

class GroupState(_Message):
    name: str
    state: bool
    id: int
    parent: int
    @overload
    def __init__(self, *, name: str | None = ..., state: bool | None = ..., id: int | None = ..., parent: int | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, state: bool | None, id: int | None, parent: int | None, /) -> None: ...

class IntParameter(_Message):
    name: str
    value: int
    @overload
    def __init__(self, *, name: str | None = ..., value: int | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, value: int | None, /) -> None: ...

class ParamDescription(_Message):
    name: str
    type: str
    level: int
    description: str
    edit_method: str
    @overload
    def __init__(self, *, name: str | None = ..., type: str | None = ..., level: int | None = ..., description: str | None = ..., edit_method: str | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, type: str | None, level: int | None, description: str | None, edit_method: str | None, /) -> None: ...

class SensorLevels(_Message):
    RECONFIGURE_CLOSE: ClassVar[int]
    RECONFIGURE_STOP: ClassVar[int]
    RECONFIGURE_RUNNING: ClassVar[int]
    def __init__(self) -> None: ...

class StrParameter(_Message):
    name: str
    value: str
    @overload
    def __init__(self, *, name: str | None = ..., value: str | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, value: str | None, /) -> None: ...
