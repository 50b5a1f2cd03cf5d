# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Duration as _Duration
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class ImageMarker(_Message):
    CIRCLE: ClassVar[int]
    LINE_STRIP: ClassVar[int]
    LINE_LIST: ClassVar[int]
    POLYGON: ClassVar[int]
    POINTS: ClassVar[int]
    ADD: ClassVar[int]
    REMOVE: ClassVar[int]
    header: _std_msgs.Header
    ns: str
    id: int
    type: int
    action: int
    position: _geometry_msgs.Point
    scale: float
    outline_color: _std_msgs.ColorRGBA
    filled: int
    fill_color: _std_msgs.ColorRGBA
    lifetime: _Duration
    points: list[_geometry_msgs.Point]
    outline_colors: list[_std_msgs.ColorRGBA]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., ns: str | None = ..., id: int | None = ..., type: int | None = ..., action: int | None = ..., position: _geometry_msgs.Point | None = ..., scale: float | None = ..., outline_color: _std_msgs.ColorRGBA | None = ..., filled: int | None = ..., fill_color: _std_msgs.ColorRGBA | None = ..., lifetime: _Duration | None = ..., points: Sequence[_geometry_msgs.Point] | None = ..., outline_colors: Sequence[_std_msgs.ColorRGBA] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, ns: str | None, id: int | None, type: int | None, action: int | None, position: _geometry_msgs.Point | None, scale: float | None, outline_color: _std_msgs.ColorRGBA | None, filled: int | None, fill_color: _std_msgs.ColorRGBA | None, lifetime: _Duration | None, points: Sequence[_geometry_msgs.Point] | None, outline_colors: Sequence[_std_msgs.ColorRGBA] | None, /) -> None: ...

class InteractiveMarker(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    name: str
    description: str
    scale: float
    menu_entries: list[MenuEntry]
    controls: list[InteractiveMarkerControl]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., name: str | None = ..., description: str | None = ..., scale: float | None = ..., menu_entries: Sequence[MenuEntry] | None = ..., controls: Sequence[InteractiveMarkerControl] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, pose: _geometry_msgs.Pose | None, name: str | None, description: str | None, scale: float | None, menu_entries: Sequence[MenuEntry] | None, controls: Sequence[InteractiveMarkerControl] | None, /) -> None: ...

class InteractiveMarkerControl(_Message):
    INHERIT: ClassVar[int]
    FIXED: ClassVar[int]
    VIEW_FACING: ClassVar[int]
    NONE: ClassVar[int]
    MENU: ClassVar[int]
    BUTTON: ClassVar[int]
    MOVE_AXIS: ClassVar[int]
    MOVE_PLANE: ClassVar[int]
    ROTATE_AXIS: ClassVar[int]
    MOVE_ROTATE: ClassVar[int]
    MOVE_3D: ClassVar[int]
    ROTATE_3D: ClassVar[int]
    MOVE_ROTATE_3D: ClassVar[int]
    name: str
    orientation: _geometry_msgs.Quaternion
    orientation_mode: int
    interaction_mode: int
    always_visible: bool
    markers: list[Marker]
    independent_marker_orientation: bool
    description: str
    @overload
    def __init__(self, *, name: str | None = ..., orientation: _geometry_msgs.Quaternion | None = ..., orientation_mode: int | None = ..., interaction_mode: int | None = ..., always_visible: bool | None = ..., markers: Sequence[Marker] | None = ..., independent_marker_orientation: bool | None = ..., description: str | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, orientation: _geometry_msgs.Quaternion | None, orientation_mode: int | None, interaction_mode: int | None, always_visible: bool | None, markers: Sequence[Marker] | None, independent_marker_orientation: bool | None, description: str | None, /) -> None: ...

class InteractiveMarkerFeedback(_Message):
    KEEP_ALIVE: ClassVar[int]
    POSE_UPDATE: ClassVar[int]
    MENU_SELECT: ClassVar[int]
    BUTTON_CLICK: ClassVar[int]
    MOUSE_DOWN: ClassVar[int]
    MOUSE_UP: ClassVar[int]
    header: _std_msgs.Header
    client_id: str
    marker_name: str
    control_name: str
    event_type: int
    pose: _geometry_msgs.Pose
    menu_entry_id: int
    mouse_point: _geometry_msgs.Point
    mouse_point_valid: bool
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., client_id: str | None = ..., marker_name: str | None = ..., control_name: str | None = ..., event_type: int | None = ..., pose: _geometry_msgs.Pose | None = ..., menu_entry_id: int | None = ..., mouse_point: _geometry_msgs.Point | None = ..., mouse_point_valid: bool | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, client_id: str | None, marker_name: str | None, control_name: str | None, event_type: int | None, pose: _geometry_msgs.Pose | None, menu_entry_id: int | None, mouse_point: _geometry_msgs.Point | None, mouse_point_valid: bool | None, /) -> None: ...

class InteractiveMarkerInit(_Message):
    server_id: str
    seq_num: int
    markers: list[InteractiveMarker]
    @overload
    def __init__(self, *, server_id: str | None = ..., seq_num: int | None = ..., markers: Sequence[InteractiveMarker] | None = ...) -> None: ...
    @overload
    def __init__(self, server_id: str | None, seq_num: int | None, markers: Sequence[InteractiveMarker] | None, /) -> None: ...

class InteractiveMarkerPose(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    name: str
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., name: str | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, pose: _geometry_msgs.Pose | None, name: str | None, /) -> None: ...

class InteractiveMarkerUpdate(_Message):
    KEEP_ALIVE: ClassVar[int]
    UPDATE: ClassVar[int]
    server_id: str
    seq_num: int
    type: int
    markers: list[InteractiveMarker]
    poses: list[InteractiveMarkerPose]
    erases: list[str]
    @overload
    def __init__(self, *, server_id: str | None = ..., seq_num: int | None = ..., type: int | None = ..., markers: Sequence[InteractiveMarker] | None = ..., poses: Sequence[InteractiveMarkerPose] | None = ..., erases: Sequence[str] | None = ...) -> None: ...
    @overload
    def __init__(self, server_id: str | None, seq_num: int | None, type: int | None, markers: Sequence[InteractiveMarker] | None, poses: Sequence[InteractiveMarkerPose] | None, erases: Sequence[str] | None, /) -> None: ...

class Marker(_Message):
    ARROW: ClassVar[int]
    CUBE: ClassVar[int]
    SPHERE: ClassVar[int]
    CYLINDER: ClassVar[int]
    LINE_STRIP: ClassVar[int]
    LINE_LIST: ClassVar[int]
    CUBE_LIST: ClassVar[int]
    SPHERE_LIST: ClassVar[int]
    POINTS: ClassVar[int]
    TEXT_VIEW_FACING: ClassVar[int]
    MESH_RESOURCE: ClassVar[int]
    TRIANGLE_LIST: ClassVar[int]
    ADD: ClassVar[int]
    MODIFY: ClassVar[int]
    DELETE: ClassVar[int]
    DELETEALL: ClassVar[int]
    header: _std_msgs.Header
    ns: str
    id: int
    type: int
    action: int
    pose: _geometry_msgs.Pose
    scale: _geometry_msgs.Vector3
    color: _std_msgs.ColorRGBA
    lifetime: _Duration
    frame_locked: bool
    points: list[_geometry_msgs.Point]
    colors: list[_std_msgs.ColorRGBA]
    text: str
    mesh_resource: str
    mesh_use_embedded_materials: bool
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., ns: str | None = ..., id: int | None = ..., type: int | None = ..., action: int | None = ..., pose: _geometry_msgs.Pose | None = ..., scale: _geometry_msgs.Vector3 | None = ..., color: _std_msgs.ColorRGBA | None = ..., lifetime: _Duration | None = ..., frame_locked: bool | None = ..., points: Sequence[_geometry_msgs.Point] | None = ..., colors: Sequence[_std_msgs.ColorRGBA] | None = ..., text: str | None = ..., mesh_resource: str | None = ..., mesh_use_embedded_materials: bool | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, ns: str | None, id: int | None, type: int | None, action: int | None, pose: _geometry_msgs.Pose | None, scale: _geometry_msgs.Vector3 | None, color: _std_msgs.ColorRGBA | None, lifetime: _Duration | None, frame_locked: bool | None, points: Sequence[_geometry_msgs.Point] | None, colors: Sequence[_std_msgs.ColorRGBA] | None, text: str | None, mesh_resource: str | None, mesh_use_embedded_materials: bool | None, /) -> None: ...

class MarkerArray(_Message):
    markers: list[Marker]
    @overload
    def __init__(self, *, markers: Sequence[Marker] | None = ...) -> None: ...
    @overload
    def __init__(self, markers: Sequence[Marker] | None, /) -> None: ...

class MenuEntry(_Message):
    FEEDBACK: ClassVar[int]
    ROSRUN: ClassVar[int]
    ROSLAUNCH: ClassVar[int]
    id: int
    parent_id: int
    title: str
    command: str
    command_type: int
    @overload
    def __init__(self, *, id: int | None = ..., parent_id: int | None = ..., title: str | None = ..., command: str | None = ..., command_type: int | None = ...) -> None: ...
    @overload
    def __init__(self, id: int | None, parent_id: int | None, title: str | None, command: str | None, command_type: int | None, /) -> None: ...
