# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.core.time import Time as _Time
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message
from rosmini.msgs.std_msgs import msg as _std_msgs

class BatteryState(_Message):
    POWER_SUPPLY_STATUS_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_STATUS_CHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_DISCHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_NOT_CHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_FULL: ClassVar[int]
    POWER_SUPPLY_HEALTH_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_HEALTH_GOOD: ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERHEAT: ClassVar[int]
    POWER_SUPPLY_HEALTH_DEAD: ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: ClassVar[int]
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: ClassVar[int]
    POWER_SUPPLY_HEALTH_COLD: ClassVar[int]
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: ClassVar[int]
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NIMH: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LION: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIPO: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIFE: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NICD: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIMN: ClassVar[int]
    header: _std_msgs.Header
    voltage: float
    temperature: float
    current: float
    charge: float
    capacity: float
    design_capacity: float
    percentage: float
    power_supply_status: int
    power_supply_health: int
    power_supply_technology: int
    present: bool
    cell_voltage: Any
    cell_temperature: Any
    location: str
    serial_number: str
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., voltage: float | None = ..., temperature: float | None = ..., current: float | None = ..., charge: float | None = ..., capacity: float | None = ..., design_capacity: float | None = ..., percentage: float | None = ..., power_supply_status: int | None = ..., power_supply_health: int | None = ..., power_supply_technology: int | None = ..., present: bool | None = ..., cell_voltage: Sequence[float] | Any | None = ..., cell_temperature: Sequence[float] | Any | None = ..., location: str | None = ..., serial_number: str | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, voltage: float | None, temperature: float | None, current: float | None, charge: float | None, capacity: float | None, design_capacity: float | None, percentage: float | None, power_supply_status: int | None, power_supply_health: int | None, power_supply_technology: int | None, present: bool | None, cell_voltage: Sequence[float] | Any | None, cell_temperature: Sequence[float] | Any | None, location: str | None, serial_number: str | None, /) -> None: ...

class CameraInfo(_Message):
    header: _std_msgs.Header
    height: int
    width: int
    distortion_model: str
    D: Any
    K: Any
    R: Any
    P: Any
    binning_x: int
    binning_y: int
    roi: RegionOfInterest
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., height: int | None = ..., width: int | None = ..., distortion_model: str | None = ..., D: Sequence[float] | Any | None = ..., K: Sequence[float] | Any | None = ..., R: Sequence[float] | Any | None = ..., P: Sequence[float] | Any | None = ..., binning_x: int | None = ..., binning_y: int | None = ..., roi: RegionOfInterest | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, height: int | None, width: int | None, distortion_model: str | None, D: Sequence[float] | Any | None, K: Sequence[float] | Any | None, R: Sequence[float] | Any | None, P: Sequence[float] | Any | None, binning_x: int | None, binning_y: int | None, roi: RegionOfInterest | None, /) -> None: ...

class ChannelFloat32(_Message):
    name: str
    values: Any
    @overload
    def __init__(self, *, name: str | None = ..., values: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, values: Sequence[float] | Any | None, /) -> None: ...

class CompressedImage(_Message):
    header: _std_msgs.Header
    format: str
    data: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., format: str | None = ..., data: bytes | Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, format: str | None, data: bytes | Sequence[int] | Any | None, /) -> None: ...

class FluidPressure(_Message):
    header: _std_msgs.Header
    fluid_pressure: float
    variance: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., fluid_pressure: float | None = ..., variance: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, fluid_pressure: float | None, variance: float | None, /) -> None: ...

class Illuminance(_Message):
    header: _std_msgs.Header
    illuminance: float
    variance: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., illuminance: float | None = ..., variance: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, illuminance: float | None, variance: float | None, /) -> None: ...

class Image(_Message):
    header: _std_msgs.Header
    height: int
    width: int
    encoding: str
    is_bigendian: int
    step: int
    data: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., height: int | None = ..., width: int | None = ..., encoding: str | None = ..., is_bigendian: int | None = ..., step: int | None = ..., data: bytes | Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, height: int | None, width: int | None, encoding: str | None, is_bigendian: int | None, step: int | None, data: bytes | Sequence[int] | Any | None, /) -> None: ...

class Imu(_Message):
    header: _std_msgs.Header
    orientation: _geometry_msgs.Quaternion
    orientation_covariance: Any
    angular_velocity: _geometry_msgs.Vector3
    angular_velocity_covariance: Any
    linear_acceleration: _geometry_msgs.Vector3
    linear_acceleration_covariance: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., orientation: _geometry_msgs.Quaternion | None = ..., orientation_covariance: Sequence[float] | Any | None = ..., angular_velocity: _geometry_msgs.Vector3 | None = ..., angular_velocity_covariance: Sequence[float] | Any | None = ..., linear_acceleration: _geometry_msgs.Vector3 | None = ..., linear_acceleration_covariance: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, orientation: _geometry_msgs.Quaternion | None, orientation_covariance: Sequence[float] | Any | None, angular_velocity: _geometry_msgs.Vector3 | None, angular_velocity_covariance: Sequence[float] | Any | None, linear_acceleration: _geometry_msgs.Vector3 | None, linear_acceleration_covariance: Sequence[float] | Any | None, /) -> None: ...

class JointState(_Message):
    header: _std_msgs.Header
    name: list[str]
    position: Any
    velocity: Any
    effort: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., name: Sequence[str] | None = ..., position: Sequence[float] | Any | None = ..., velocity: Sequence[float] | Any | None = ..., effort: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, name: Sequence[str] | None, position: Sequence[float] | Any | None, velocity: Sequence[float] | Any | None, effort: Sequence[float] | Any | None, /) -> None: ...

class Joy(_Message):
    header: _std_msgs.Header
    axes: Any
    buttons: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., axes: Sequence[float] | Any | None = ..., buttons: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, axes: Sequence[float] | Any | None, buttons: Sequence[int] | Any | None, /) -> None: ...

class JoyFeedback(_Message):
    TYPE_LED: ClassVar[int]
    TYPE_RUMBLE: ClassVar[int]
    TYPE_BUZZER: ClassVar[int]
    type: int
    id: int
    intensity: float
    @overload
    def __init__(self, *, type: int | None = ..., id: int | None = ..., intensity: float | None = ...) -> None: ...
    @overload
    def __init__(self, type: int | None, id: int | None, intensity: float | None, /) -> None: ...

class JoyFeedbackArray(_Message):
    array: list[JoyFeedback]
    @overload
    def __init__(self, *, array: Sequence[JoyFeedback] | None = ...) -> None: ...
    @overload
    def __init__(self, array: Sequence[JoyFeedback] | None, /) -> None: ...

class LaserEcho(_Message):
    echoes: Any
    @overload
    def __init__(self, *, echoes: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, echoes: Sequence[float] | Any | None, /) -> None: ...

class LaserScan(_Message):
    header: _std_msgs.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    ranges: Any
    intensities: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., angle_min: float | None = ..., angle_max: float | None = ..., angle_increment: float | None = ..., time_increment: float | None = ..., scan_time: float | None = ..., range_min: float | None = ..., range_max: float | None = ..., ranges: Sequence[float] | Any | None = ..., intensities: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, angle_min: float | None, angle_max: float | None, angle_increment: float | None, time_increment: float | None, scan_time: float | None, range_min: float | None, range_max: float | None, ranges: Sequence[float] | Any | None, intensities: Sequence[float] | Any | None, /) -> None: ...

class MagneticField(_Message):
    header: _std_msgs.Header
    magnetic_field: _geometry_msgs.Vector3
    magnetic_field_covariance: Any
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., magnetic_field: _geometry_msgs.Vector3 | None = ..., magnetic_field_covariance: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, magnetic_field: _geometry_msgs.Vector3 | None, magnetic_field_covariance: Sequence[float] | Any | None, /) -> None: ...

class MultiDOFJointState(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    transforms: list[_geometry_msgs.Transform]
    twist: list[_geometry_msgs.Twist]
    wrench: list[_geometry_msgs.Wrench]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., joint_names: Sequence[str] | None = ..., transforms: Sequence[_geometry_msgs.Transform] | None = ..., twist: Sequence[_geometry_msgs.Twist] | None = ..., wrench: Sequence[_geometry_msgs.Wrench] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, joint_names: Sequence[str] | None, transforms: Sequence[_geometry_msgs.Transform] | None, twist: Sequence[_geometry_msgs.Twist] | None, wrench: Sequence[_geometry_msgs.Wrench] | None, /) -> None: ...

class MultiEchoLaserScan(_Message):
    header: _std_msgs.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    ranges: list[LaserEcho]
    intensities: list[LaserEcho]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., angle_min: float | None = ..., angle_max: float | None = ..., angle_increment: float | None = ..., time_increment: float | None = ..., scan_time: float | None = ..., range_min: float | None = ..., range_max: float | None = ..., ranges: Sequence[LaserEcho] | None = ..., intensities: Sequence[LaserEcho] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, angle_min: float | None, angle_max: float | None, angle_increment: float | None, time_increment: float | None, scan_time: float | None, range_min: float | None, range_max: float | None, ranges: Sequence[LaserEcho] | None, intensities: Sequence[LaserEcho] | None, /) -> None: ...

class NavSatFix(_Message):
    COVARIANCE_TYPE_UNKNOWN: ClassVar[int]
    COVARIANCE_TYPE_APPROXIMATED: ClassVar[int]
    COVARIANCE_TYPE_DIAGONAL_KNOWN: ClassVar[int]
    COVARIANCE_TYPE_KNOWN: ClassVar[int]
    header: _std_msgs.Header
    status: NavSatStatus
    latitude: float
    longitude: float
    altitude: float
    position_covariance: Any
    position_covariance_type: int
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., status: NavSatStatus | None = ..., latitude: float | None = ..., longitude: float | None = ..., altitude: float | None = ..., position_covariance: Sequence[float] | Any | None = ..., position_covariance_type: int | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, status: NavSatStatus | None, latitude: float | None, longitude: float | None, altitude: float | None, position_covariance: Sequence[float] | Any | None, position_covariance_type: int | None, /) -> None: ...

class NavSatStatus(_Message):
    STATUS_NO_FIX: ClassVar[int]
    STATUS_FIX: ClassVar[int]
    STATUS_SBAS_FIX: ClassVar[int]
    STATUS_GBAS_FIX: ClassVar[int]
    SERVICE_GPS: ClassVar[int]
    SERVICE_GLONASS: ClassVar[int]
    SERVICE_COMPASS: ClassVar[int]
    SERVICE_GALILEO: ClassVar[int]
    status: int
    service: int
    @overload
    def __init__(self, *, status: int | None = ..., service: int | None = ...) -> None: ...
    @overload
    def __init__(self, status: int | None, service: int | None, /) -> None: ...

class PointCloud(_Message):
    header: _std_msgs.Header
    points: list[_geometry_msgs.Point32]
    channels: list[ChannelFloat32]
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., points: Sequence[_geometry_msgs.Point32] | None = ..., channels: Sequence[ChannelFloat32] | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, points: Sequence[_geometry_msgs.Point32] | None, channels: Sequence[ChannelFloat32] | None, /) -> None: ...

class PointCloud2(_Message):
    header: _std_msgs.Header
    height: int
    width: int
    fields: list[PointField]
    is_bigendian: bool
    point_step: int
    row_step: int
    data: Any
    is_dense: bool
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., height: int | None = ..., width: int | None = ..., fields: Sequence[PointField] | None = ..., is_bigendian: bool | None = ..., point_step: int | None = ..., row_step: int | None = ..., data: bytes | Sequence[int] | Any | None = ..., is_dense: bool | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, height: int | None, width: int | None, fields: Sequence[PointField] | None, is_bigendian: bool | None, point_step: int | None, row_step: int | None, data: bytes | Sequence[int] | Any | None, is_dense: bool | None, /) -> None: ...

class PointField(_Message):
    INT8: ClassVar[int]
    UINT8: ClassVar[int]
    INT16: ClassVar[int]
    UINT16: ClassVar[int]
    INT32: ClassVar[int]
    UINT32: ClassVar[int]
    FLOAT32: ClassVar[int]
    FLOAT64: ClassVar[int]
    name: str
    offset: int
    datatype: int
    count: int
    @overload
    def __init__(self, *, name: str | None = ..., offset: int | None = ..., datatype: int | None = ..., count: int | None = ...) -> None: ...
    @overload
    def __init__(self, name: str | None, offset: int | None, datatype: int | None, count: int | None, /) -> None: ...

class Range(_Message):
    ULTRASOUND: ClassVar[int]
    INFRARED: ClassVar[int]
    header: _std_msgs.Header
    radiation_type: int
    field_of_view: float
    min_range: float
    max_range: float
    range: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., radiation_type: int | None = ..., field_of_view: float | None = ..., min_range: float | None = ..., max_range: float | None = ..., range: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, radiation_type: int | None, field_of_view: float | None, min_range: float | None, max_range: float | None, range: float | None, /) -> None: ...

class RegionOfInterest(_Message):
    x_offset: int
    y_offset: int
    height: int
    width: int
    do_rectify: bool
    @overload
    def __init__(self, *, x_offset: int | None = ..., y_offset: int | None = ..., height: int | None = ..., width: int | None = ..., do_rectify: bool | None = ...) -> None: ...
    @overload
    def __init__(self, x_offset: int | None, y_offset: int | None, height: int | None, width: int | None, do_rectify: bool | None, /) -> None: ...

class RelativeHumidity(_Message):
    header: _std_msgs.Header
    relative_humidity: float
    variance: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., relative_humidity: float | None = ..., variance: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, relative_humidity: float | None, variance: float | None, /) -> None: ...

class Temperature(_Message):
    header: _std_msgs.Header
    temperature: float
    variance: float
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., temperature: float | None = ..., variance: float | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, temperature: float | None, variance: float | None, /) -> None: ...

class TimeReference(_Message):
    header: _std_msgs.Header
    time_ref: _Time
    source: str
    @overload
    def __init__(self, *, header: _std_msgs.Header | None = ..., time_ref: _Time | None = ..., source: str | None = ...) -> None: ...
    @overload
    def __init__(self, header: _std_msgs.Header | None, time_ref: _Time | None, source: str | None, /) -> None: ...
