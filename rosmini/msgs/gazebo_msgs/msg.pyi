# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class ContactState(_Message):
    info: str
    collision1_name: str
    collision2_name: str
    wrenches: list[_geometry_msgs.Wrench]
    total_wrench: _geometry_msgs.Wrench
    contact_positions: list[_geometry_msgs.Vector3]
    contact_normals: list[_geometry_msgs.Vector3]
    depths: Any
    @overload
    def __init__(self, *, info: str | None = ..., collision1_name: str | None = ..., collision2_name: str | None = ..., wrenches: Sequence[_geometry_msgs.Wrench] | None = ..., total_wrench: _geometry_msgs.Wrench | None = ..., contact_positions: Sequence[_geometry_msgs.Vector3] | None = ..., contact_normals: Sequence[_geometry_msgs.Vector3] | None = ..., depths: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, info: str | None, collision1_name: str | None, collision2_name: str | None, wrenches: Sequence[_geometry_msgs.Wrench] | None, total_wrench: _geometry_msgs.Wrench | None, contact_positions: Sequence[_geometry_msgs.Vector3] | None, contact_normals: Sequence[_geometry_msgs.Vector3] | None, depths: Sequence[float] | Any | None, /) -> None: ...

class ContactsState(_Message):
    header: _std_msgs.Header
    states: list[ContactState]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., states: Sequence[ContactState] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, states: Sequence[ContactState] | None, /) -> None: ...

class LinkState(_Message):
    link_name: str
    pose: _geometry_msgs.Pose
    twist: _geometry_msgs.Twist
    reference_frame: str
    @overload
    def __init__(self, *, link_name: str | None = ..., pose: _geometry_msgs.Pose | None = ..., twist: _geometry_msgs.Twist | None = ..., reference_frame: str | None = ...) -> None: ...
    @overload
    def __init__(self, link_name: str | None, pose: _geometry_msgs.Pose | None, twist: _geometry_msgs.Twist | None, reference_frame: str | None, /) -> None: ...

class LinkStates(_Message):
    name: list[str]
    pose: list[_geometry_msgs.Pose]
    twist: list[_geometry_msgs.Twist]
    @overload
    def __init__(self, *, name: Sequence[str] | None = ..., pose: Sequence[_geometry_msgs.Pose] | None = ..., twist: Sequence[_geometry_msgs.Twist] | None = ...) -> None: ...
    @overload
    def __init__(self, name: Sequence[str] | None, pose: Sequence[_geometry_msgs.Pose] | None, twist: Sequence[_geometry_msgs.Twist] | None, /) -> None: ...

class ModelState(_Message):
    model_name: str
    pose: _geometry_msgs.Pose
    twist: _geometry_msgs.Twist
    reference_frame: str
    @overload
    def __init__(self, *, model_name: str | None = ..., pose: _geometry_msgs.Pose | None = ..., twist: _geometry_msgs.Twist | None = ..., reference_frame: str | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, pose: _geometry_msgs.Pose | None, twist: _geometry_msgs.Twist | None, reference_frame: str | None, /) -> None: ...

class ModelStates(_Message):
    name: list[str]
    pose: list[_geometry_msgs.Pose]
    twist: list[_geometry_msgs.Twist]
    @overload
    def __init__(self, *, name: Sequence[str] | None = ..., pose: Sequence[_geometry_msgs.Pose] | None = ..., twist: Sequence[_geometry_msgs.Twist] | None = ...) -> None: ...
    @overload
    def __init__(self, name: Sequence[str] | None, pose: Sequence[_geometry_msgs.Pose] | None, twist: Sequence[_geometry_msgs.Twist] | None, /) -> None: ...

class ODEJointProperties(_Message):
    damping: Any
    hiStop: Any
    loStop: Any
    erp: Any
    cfm: Any
    stop_erp: Any
    stop_cfm: Any
    fudge_factor: Any
    fmax: Any
    vel: Any
    @overload
    def __init__(self, *, damping: Sequence[float] | Any | None = ..., hiStop: Sequence[float] | Any | None = ..., loStop: Sequence[float] | Any | None = ..., erp: Sequence[float] | Any | None = ..., cfm: Sequence[float] | Any | None = ..., stop_erp: Sequence[float] | Any | None = ..., stop_cfm: Sequence[float] | Any | None = ..., fudge_factor: Sequence[float] | Any | None = ..., fmax: Sequence[float] | Any | None = ..., vel: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, damping: Sequence[float] | Any | None, hiStop: Sequence[float] | Any | None, loStop: Sequence[float] | Any | None, erp: Sequence[float] | Any | None, cfm: Sequence[float] | Any | None, stop_erp: Sequence[float] | Any | None, stop_cfm: Sequence[float] | Any | None, fudge_factor: Sequence[float] | Any | None, fmax: Sequence[float] | Any | None, vel: Sequence[float] | Any | None, /) -> None: ...

class ODEPhysics(_Message):
    auto_disable_bodies: bool
    sor_pgs_precon_iters: int
    sor_pgs_iters: int
    sor_pgs_w: float
    sor_pgs_rms_error_tol: float
    contact_surface_layer: float
    contact_max_correcting_vel: float
    cfm: float
    erp: float
    max_contacts: int
    @overload
    def __init__(self, *, auto_disable_bodies: bool | None = ..., sor_pgs_precon_iters: int | None = ..., sor_pgs_iters: int | None = ..., sor_pgs_w: float | None = ..., sor_pgs_rms_error_tol: float | None = ..., contact_surface_layer: float | None = ..., contact_max_correcting_vel: float | None = ..., cfm: float | None = ..., erp: float | None = ..., max_contacts: int | None = ...) -> None: ...
    @overload
    def __init__(self, auto_disable_bodies: bool | None, sor_pgs_precon_iters: int | None, sor_pgs_iters: int | None, sor_pgs_w: float | None, sor_pgs_rms_error_tol: float | None, contact_surface_layer: float | None, contact_max_correcting_vel: float | None, cfm: float | None, erp: float | None, max_contacts: int | None, /) -> None: ...

class PerformanceMetrics(_Message):
    header: _std_msgs.Header
    real_time_factor: float
    sensors: list[SensorPerformanceMetric]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., real_time_factor: float | None = ..., sensors: Sequence[SensorPerformanceMetric] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, real_time_factor: float | None, sensors: Sequence[SensorPerformanceMetric] | None, /) -> None: ...

class SensorPerformanceMetric(_Message):
    name: str
    sim_update_rate: float
    real_update_rate: float
    fps: float
    @overload
    def __init__(self, *, name: str | None = ..., sim_update_rate: float | None = ..., real_update_rate: float | None = ..., fps: float | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, sim_update_rate: float | None, real_update_rate: float | None, fps: float | None, /) -> None: ...

class WorldState(_Message):
    header: _std_msgs.Header
    name: list[str]
    pose: list[_geometry_msgs.Pose]
    twist: list[_geometry_msgs.Twist]
    wrench: list[_geometry_msgs.Wrench]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., name: Sequence[str] | None = ..., pose: Sequence[_geometry_msgs.Pose] | None = ..., twist: Sequence[_geometry_msgs.Twist] | None = ..., wrench: Sequence[_geometry_msgs.Wrench] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, name: Sequence[str] | None, pose: Sequence[_geometry_msgs.Pose] | None, twist: Sequence[_geometry_msgs.Twist] | None, wrench: Sequence[_geometry_msgs.Wrench] | None, /) -> None: ...
