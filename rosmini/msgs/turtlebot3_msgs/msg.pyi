# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class SensorState(_Message):
    BUMPER_FORWARD: ClassVar[int]
    BUMPER_BACKWARD: ClassVar[int]
    CLIFF: ClassVar[int]
    SONAR: ClassVar[int]
    ILLUMINATION: ClassVar[int]
    BUTTON0: ClassVar[int]
    BUTTON1: ClassVar[int]
    ERROR_LEFT_MOTOR: ClassVar[int]
    ERROR_RIGHT_MOTOR: ClassVar[int]
    TORQUE_ON: ClassVar[int]
    TORQUE_OFF: ClassVar[int]
    header: _std_msgs.Header
    bumper: int
    cliff: float
    sonar: float
    illumination: float
    led: int
    button: int
    torque: bool
    left_encoder: int
    right_encoder: int
    battery: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., bumper: int | None = ..., cliff: float | None = ..., sonar: float | None = ..., illumination: float | None = ..., led: int | None = ..., button: int | None = ..., torque: bool | None = ..., left_encoder: int | None = ..., right_encoder: int | None = ..., battery: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, bumper: int | None, cliff: float | None, sonar: float | None, illumination: float | None, led: int | None, button: int | None, torque: bool | None, left_encoder: int | None, right_encoder: int | None, battery: float | None, /) -> None: ...

class Sound(_Message):
    OFF: ClassVar[int]
    ON: ClassVar[int]
    LOW_BATTERY: ClassVar[int]
    ERROR: ClassVar[int]
    BUTTON1: ClassVar[int]
    BUTTON2: ClassVar[int]
    value: int
    @overload
    def __init__(self, *, value: int | None = ...) -> None: ...
    @overload
    def __init__(self, value: int | None, /) -> None: ...

class VersionInfo(_Message):
    hardware: str
    firmware: str
    software: str
    @overload
    def __init__(self, *, hardware: str | None = ..., firmware: str | None = ..., software: str | None = ...) -> None: ...
    @overload
    def __init__(self, hardware: str | None, firmware: str | None, software: str | None, /) -> None: ...
