# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Duration as _Duration, Time as _Time
from rosmini.msgs.gazebo_msgs import msg as _gazebo_msgs
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.registry import Service as _Service
from rosmini.msgs.std_msgs import msg as _std_msgs
from rosmini.msgs.trajectory_msgs import msg as _trajectory_msgs

class ApplyBodyWrenchRequest(_Message):
    body_name: str
    reference_frame: str
    reference_point: _geometry_msgs.Point
    wrench: _geometry_msgs.Wrench
    start_time: _Time
    duration: _Duration
    @overload
    def __init__(self, *, body_name: str | None = ..., reference_frame: str | None = ..., reference_point: _geometry_msgs.Point | None = ..., wrench: _geometry_msgs.Wrench | None = ..., start_time: _Time | None = ..., duration: _Duration | None = ...) -> None: ...
    @overload
    def __init__(self, body_name: str | None, reference_frame: str | None, reference_point: _geometry_msgs.Point | None, wrench: _geometry_msgs.Wrench | None, start_time: _Time | None, duration: _Duration | None, /) -> None: ...

class ApplyBodyWrenchResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class ApplyJointEffortRequest(_Message):
    joint_name: str
    effort: float
    start_time: _Time
    duration: _Duration
    @overload
    def __init__(self, *, joint_name: str | None = ..., effort: float | None = ..., start_time: _Time | None = ..., duration: _Duration | None = ...) -> None: ...
    @overload
    def __init__(self, joint_name: str | None, effort: float | None, start_time: _Time | None, duration: _Duration | None, /) -> None: ...

class ApplyJointEffortResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class BodyRequestRequest(_Message):
    body_name: str
    @overload
    def __init__(self, *, body_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, body_name: str | None, /) -> None: ...

class BodyRequestResponse(_Message):
    def __init__(self) -> None: ...

class DeleteLightRequest(_Message):
    light_name: str
    @overload
    def __init__(self, *, light_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, light_name: str | None, /) -> None: ...

class DeleteLightResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class DeleteModelRequest(_Message):
    model_name: str
    @overload
    def __init__(self, *, model_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, /) -> None: ...

class DeleteModelResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class GetJointPropertiesRequest(_Message):
    joint_name: str
    @overload
    def __init__(self, *, joint_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, joint_name: str | None, /) -> None: ...

class GetJointPropertiesResponse(_Message):
    REVOLUTE: ClassVar[int]
    CONTINUOUS: ClassVar[int]
    PRISMATIC: ClassVar[int]
    FIXED: ClassVar[int]
    BALL: ClassVar[int]
    UNIVERSAL: ClassVar[int]
    type: int
    damping: Any
    position: Any
    rate: Any
    success: bool
    status_message: str
    @overload
    def __init__(self, *, type: int | None = ..., damping: Sequence[float] | Any | None = ..., position: Sequence[float] | Any | None = ..., rate: Sequence[float] | Any | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, type: int | None, damping: Sequence[float] | Any | None, position: Sequence[float] | Any | None, rate: Sequence[float] | Any | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetLightPropertiesRequest(_Message):
    light_name: str
    @overload
    def __init__(self, *, light_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, light_name: str | None, /) -> None: ...

class GetLightPropertiesResponse(_Message):
    diffuse: _std_msgs.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    success: bool
    status_message: str
    @overload
    def __init__(self, *, diffuse: _std_msgs.ColorRGBA | None = ..., attenuation_constant: float | None = ..., attenuation_linear: float | None = ..., attenuation_quadratic: float | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, diffuse: _std_msgs.ColorRGBA | None, attenuation_constant: float | None, attenuation_linear: float | None, attenuation_quadratic: float | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetLinkPropertiesRequest(_Message):
    link_name: str
    @overload
    def __init__(self, *, link_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, link_name: str | None, /) -> None: ...

class GetLinkPropertiesResponse(_Message):
    com: _geometry_msgs.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    success: bool
    status_message: str
    @overload
    def __init__(self, *, com: _geometry_msgs.Pose | None = ..., gravity_mode: bool | None = ..., mass: float | None = ..., ixx: float | None = ..., ixy: float | None = ..., ixz: float | None = ..., iyy: float | None = ..., iyz: float | None = ..., izz: float | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, com: _geometry_msgs.Pose | None, gravity_mode: bool | None, mass: float | None, ixx: float | None, ixy: float | None, ixz: float | None, iyy: float | None, iyz: float | None, izz: float | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetLinkStateRequest(_Message):
    link_name: str
    reference_frame: str
    @overload
    def __init__(self, *, link_name: str | None = ..., reference_frame: str | None = ...) -> None: ...
    @overload
    def __init__(self, link_name: str | None, reference_frame: str | None, /) -> None: ...

class GetLinkStateResponse(_Message):
    link_state: _gazebo_msgs.LinkState
    success: bool
    status_message: str
    @overload
    def __init__(self, *, link_state: _gazebo_msgs.LinkState | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, link_state: _gazebo_msgs.LinkState | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetModelPropertiesRequest(_Message):
    model_name: str
    @overload
    def __init__(self, *, model_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, /) -> None: ...

class GetModelPropertiesResponse(_Message):
    parent_model_name: str
    canonical_body_name: str
    body_names: list[str]
    geom_names: list[str]
    joint_names: list[str]
    child_model_names: list[str]
    is_static: bool
    success: bool
    status_message: str
    @overload
    def __init__(self, *, parent_model_name: str | None = ..., canonical_body_name: str | None = ..., body_names: Sequence[str] | None = ..., geom_names: Sequence[str] | None = ..., joint_names: Sequence[str] | None = ..., child_model_names: Sequence[str] | None = ..., is_static: bool | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, parent_model_name: str | None, canonical_body_name: str | None, body_names: Sequence[str] | None, geom_names: Sequence[str] | None, joint_names: Sequence[str] | None, child_model_names: Sequence[str] | None, is_static: bool | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetModelStateRequest(_Message):
    model_name: str
    relative_entity_name: str
    @overload
    def __init__(self, *, model_name: str | None = ..., relative_entity_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, relative_entity_name: str | None, /) -> None: ...

class GetModelStateResponse(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    twist: _geometry_msgs.Twist
    success: bool
    status_message: str
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., twist: _geometry_msgs.Twist | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, pose: _geometry_msgs.Pose | None, twist: _geometry_msgs.Twist | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetPhysicsPropertiesRequest(_Message):
    def __init__(self) -> None: ...

class GetPhysicsPropertiesResponse(_Message):
    time_step: float
    pause: bool
    max_update_rate: float
    gravity: _geometry_msgs.Vector3
    ode_config: _gazebo_msgs.ODEPhysics
    success: bool
    status_message: str
    @overload
    def __init__(self, *, time_step: float | None = ..., pause: bool | None = ..., max_update_rate: float | None = ..., gravity: _geometry_msgs.Vector3 | None = ..., ode_config: _gazebo_msgs.ODEPhysics | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, time_step: float | None, pause: bool | None, max_update_rate: float | None, gravity: _geometry_msgs.Vector3 | None, ode_config: _gazebo_msgs.ODEPhysics | None, success: bool | None, status_message: str | None, /) -> None: ...

class GetWorldPropertiesRequest(_Message):
    def __init__(self) -> None: ...

class GetWorldPropertiesResponse(_Message):
    sim_time: float
    model_names: list[str]
    rendering_enabled: bool
    success: bool
    status_message: str
    @overload
    def __init__(self, *, sim_time: float | None = ..., model_names: Sequence[str] | None = ..., rendering_enabled: bool | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, sim_time: float | None, model_names: Sequence[str] | None, rendering_enabled: bool | None, success: bool | None, status_message: str | None, /) -> None: ...

class JointRequestRequest(_Message):
    joint_name: str
    @overload
    def __init__(self, *, joint_name: str | None = ...) -> None: ...
    @overload
    def __init__(self, joint_name: str | None, /) -> None: ...

class JointRequestResponse(_Message):
    def __init__(self) -> None: ...

class SetJointPropertiesRequest(_Message):
    joint_name: str
    ode_joint_config: _gazebo_msgs.ODEJointProperties
    @overload
    def __init__(self, *, joint_name: str | None = ..., ode_joint_config: _gazebo_msgs.ODEJointProperties | None = ...) -> None: ...
    @overload
    def __init__(self, joint_name: str | None, ode_joint_config: _gazebo_msgs.ODEJointProperties | None, /) -> None: ...

class SetJointPropertiesResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetJointTrajectoryRequest(_Message):
    model_name: str
    joint_trajectory: _trajectory_msgs.JointTrajectory
    model_pose: _geometry_msgs.Pose
    set_model_pose: bool
    disable_physics_updates: bool
    @overload
    def __init__(self, *, model_name: str | None = ..., joint_trajectory: _trajectory_msgs.JointTrajectory | None = ..., model_pose: _geometry_msgs.Pose | None = ..., set_model_pose: bool | None = ..., disable_physics_updates: bool | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, joint_trajectory: _trajectory_msgs.JointTrajectory | None, model_pose: _geometry_msgs.Pose | None, set_model_pose: bool | None, disable_physics_updates: bool | None, /) -> None: ...

class SetJointTrajectoryResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetLightPropertiesRequest(_Message):
    light_name: str
    cast_shadows: bool
    diffuse: _std_msgs.ColorRGBA
    specular: _std_msgs.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    direction: _geometry_msgs.Vector3
    pose: _geometry_msgs.Pose
    @overload
    def __init__(self, *, light_name: str | None = ..., cast_shadows: bool | None = ..., diffuse: _std_msgs.ColorRGBA | None = ..., specular: _std_msgs.ColorRGBA | None = ..., attenuation_constant: float | None = ..., attenuation_linear: float | None = ..., attenuation_quadratic: float | None = ..., direction: _geometry_msgs.Vector3 | None = ..., pose: _geometry_msgs.Pose | None = ...) -> None: ...
    @overload
    def __init__(self, light_name: str | None, cast_shadows: bool | None, diffuse: _std_msgs.ColorRGBA | None, specular: _std_msgs.ColorRGBA | None, attenuation_constant: float | None, attenuation_linear: float | None, attenuation_quadratic: float | None, direction: _geometry_msgs.Vector3 | None, pose: _geometry_msgs.Pose | None, /) -> None: ...

class SetLightPropertiesResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetLinkPropertiesRequest(_Message):
    link_name: str
    com: _geometry_msgs.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    @overload
    def __init__(self, *, link_name: str | None = ..., com: _geometry_msgs.Pose | None = ..., gravity_mode: bool | None = ..., mass: float | None = ..., ixx: float | None = ..., ixy: float | None = ..., ixz: float | None = ..., iyy: float | None = ..., iyz: float | None = ..., izz: float | None = ...) -> None: ...
    @overload
    def __init__(self, link_name: str | None, com: _geometry_msgs.Pose | None, gravity_mode: bool | None, mass: float | None, ixx: float | None, ixy: float | None, ixz: float | None, iyy: float | None, iyz: float | None, izz: float | None, /) -> None: ...

class SetLinkPropertiesResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetLinkStateRequest(_Message):
    link_state: _gazebo_msgs.LinkState
    @overload
    def __init__(self, *, link_state: _gazebo_msgs.LinkState | None = ...) -> None: ...
    @overload
    def __init__(self, link_state: _gazebo_msgs.LinkState | None, /) -> None: ...

class SetLinkStateResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetModelConfigurationRequest(_Message):
    model_name: str
    urdf_param_name: str
    joint_names: list[str]
    joint_positions: Any
    @overload
    def __init__(self, *, model_name: str | None = ..., urdf_param_name: str | None = ..., joint_names: Sequence[str] | None = ..., joint_positions: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, urdf_param_name: str | None, joint_names: Sequence[str] | None, joint_positions: Sequence[float] | Any | None, /) -> None: ...

class SetModelConfigurationResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetModelStateRequest(_Message):
    model_state: _gazebo_msgs.ModelState
    @overload
    def __init__(self, *, model_state: _gazebo_msgs.ModelState | None = ...) -> None: ...
    @overload
    def __init__(self, model_state: _gazebo_msgs.ModelState | None, /) -> None: ...

class SetModelStateResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SetPhysicsPropertiesRequest(_Message):
    time_step: float
    max_update_rate: float
    gravity: _geometry_msgs.Vector3
    ode_config: _gazebo_msgs.ODEPhysics
    @overload
    def __init__(self, *, time_step: float | None = ..., max_update_rate: float | None = ..., gravity: _geometry_msgs.Vector3 | None = ..., ode_config: _gazebo_msgs.ODEPhysics | None = ...) -> None: ...
    @overload
    def __init__(self, time_step: float | None, max_update_rate: float | None, gravity: _geometry_msgs.Vector3 | None, ode_config: _gazebo_msgs.ODEPhysics | None, /) -> None: ...

class SetPhysicsPropertiesResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class SpawnModelRequest(_Message):
    model_name: str
    model_xml: str
    robot_namespace: str
    initial_pose: _geometry_msgs.Pose
    reference_frame: str
    @overload
    def __init__(self, *, model_name: str | None = ..., model_xml: str | None = ..., robot_namespace: str | None = ..., initial_pose: _geometry_msgs.Pose | None = ..., reference_frame: str | None = ...) -> None: ...
    @overload
    def __init__(self, model_name: str | None, model_xml: str | None, robot_namespace: str | None, initial_pose: _geometry_msgs.Pose | None, reference_frame: str | None, /) -> None: ...

class SpawnModelResponse(_Message):
    success: bool
    status_message: str
    @overload
    def __init__(self, *, success: bool | None = ..., status_message: str | None = ...) -> None: ...
    @overload
    def __init__(self, success: bool | None, status_message: str | None, /) -> None: ...

class ApplyBodyWrench(_Service):
    _request_class: ClassVar[type[ApplyBodyWrenchRequest]]
    _response_class: ClassVar[type[ApplyBodyWrenchResponse]]

class ApplyJointEffort(_Service):
    _request_class: ClassVar[type[ApplyJointEffortRequest]]
    _response_class: ClassVar[type[ApplyJointEffortResponse]]

class BodyRequest(_Service):
    _request_class: ClassVar[type[BodyRequestRequest]]
    _response_class: ClassVar[type[BodyRequestResponse]]

class DeleteLight(_Service):
    _request_class: ClassVar[type[DeleteLightRequest]]
    _response_class: ClassVar[type[DeleteLightResponse]]

class DeleteModel(_Service):
    _request_class: ClassVar[type[DeleteModelRequest]]
    _response_class: ClassVar[type[DeleteModelResponse]]

class GetJointProperties(_Service):
    _request_class: ClassVar[type[GetJointPropertiesRequest]]
    _response_class: ClassVar[type[GetJointPropertiesResponse]]

class GetLightProperties(_Service):
    _request_class: ClassVar[type[GetLightPropertiesRequest]]
    _response_class: ClassVar[type[GetLightPropertiesResponse]]

class GetLinkProperties(_Service):
    _request_class: ClassVar[type[GetLinkPropertiesRequest]]
    _response_class: ClassVar[type[GetLinkPropertiesResponse]]

class GetLinkState(_Service):
    _request_class: ClassVar[type[GetLinkStateRequest]]
    _response_class: ClassVar[type[GetLinkStateResponse]]

class GetModelProperties(_Service):
    _request_class: ClassVar[type[GetModelPropertiesRequest]]
    _response_class: ClassVar[type[GetModelPropertiesResponse]]

class GetModelState(_Service):
    _request_class: ClassVar[type[GetModelStateRequest]]
    _response_class: ClassVar[type[GetModelStateResponse]]

class GetPhysicsProperties(_Service):
    _request_class: ClassVar[type[GetPhysicsPropertiesRequest]]
    _response_class: ClassVar[type[GetPhysicsPropertiesResponse]]

class GetWorldProperties(_Service):
    _request_class: ClassVar[type[GetWorldPropertiesRequest]]
    _response_class: ClassVar[type[GetWorldPropertiesResponse]]

class JointRequest(_Service):
    _request_class: ClassVar[type[JointRequestRequest]]
    _response_class: ClassVar[type[JointRequestResponse]]

class SetJointProperties(_Service):
    _request_class: ClassVar[type[SetJointPropertiesRequest]]
    _response_class: ClassVar[type[SetJointPropertiesResponse]]

class SetJointTrajectory(_Service):
    _request_class: ClassVar[type[SetJointTrajectoryRequest]]
    _response_class: ClassVar[type[SetJointTrajectoryResponse]]

class SetLightProperties(_Service):
    _request_class: ClassVar[type[SetLightPropertiesRequest]]
    _response_class: ClassVar[type[SetLightPropertiesResponse]]

class SetLinkProperties(_Service):
    _request_class: ClassVar[type[SetLinkPropertiesRequest]]
    _response_class: ClassVar[type[SetLinkPropertiesResponse]]

class SetLinkState(_Service):
    _request_class: ClassVar[type[SetLinkStateRequest]]
    _response_class: ClassVar[type[SetLinkStateResponse]]

class SetModelConfiguration(_Service):
    _request_class: ClassVar[type[SetModelConfigurationRequest]]
    _response_class: ClassVar[type[SetModelConfigurationResponse]]

class SetModelState(_Service):
    _request_class: ClassVar[type[SetModelStateRequest]]
    _response_class: ClassVar[type[SetModelStateResponse]]

class SetPhysicsProperties(_Service):
    _request_class: ClassVar[type[SetPhysicsPropertiesRequest]]
    _response_class: ClassVar[type[SetPhysicsPropertiesResponse]]

class SpawnModel(_Service):
    _request_class: ClassVar[type[SpawnModelRequest]]
    _response_class: ClassVar[type[SpawnModelResponse]]
