"""Robot models. Lengths in metres, masses in kilograms, angles in radians, frames according to REP 103 and REP 105.

The numbers are published ones, each with its source:

- *e-manual*: https://emanual.robotis.com/docs/en/platform/turtlebot3/features/ (the table of hardware specifications);
- *description*: the package `turtlebot3_description` of https://github.com/ROBOTIS-GIT/turtlebot3, its URDF;
- *gazebo*: the same package's files `turtlebot3_*.gazebo.xacro`, which Gazebo simulates;
- *firmware*: `turtlebot3_core` of https://github.com/ROBOTIS-GIT/OpenCR, which runs on the robot's controller;
- *MPU-9250*: the gyroscope on its board, by the maker's product specification (PS-MPU-9250A-01, table 1); later boards
  have an ICM-20648;
- *navigation*: the package `turtlebot3_navigation`, the costmaps' parameters;
- *LDS-01*: https://emanual.robotis.com/docs/en/platform/turtlebot3/appendix_lds_01/.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, get_args

from rosmini.core.errors import RosminiError, nearest

from .shapes import Box, Cylinder, Part, is_finite, reach_of

Point = tuple[float, float, float]

GRAVITY = 9.80665
"""Standard gravity [m/s2]."""

VARIABLE = "TURTLEBOT3_MODEL"
"""The environment variable that selects a model in ROBOTIS's launch files."""


class UnknownModel(RosminiError, ValueError):
    """No robot model has this name."""


class ModelError(RosminiError, ValueError):
    """A robot model is invalid; the message contains the model's name and the invalid number."""


Drive = Literal["differential", "holonomic"]
"""Two driven wheels, or wheels for motion in any direction, as in Gazebo's planar move and Stage's "omni"."""

MAX_BEAMS = 100_000
"""Maximum number of beams of a laser; a file with more is wrong, and would exhaust the memory."""

MAX_PIXELS = 1 << 24
"""Maximum number of pixels of a camera's image: 4096 by 4096."""


@dataclass(frozen=True)
class LidarModel:
    """A laser: either a spinning one, with one scan per revolution, or one with a limited field of view."""

    name: str
    mount: Point
    """Its position relative to base_footprint."""
    beams: int
    rate: float
    """Scans per second."""
    range_min: float
    range_max: float
    noise: float
    """Standard deviation of a range [m]."""
    frame: str = "base_scan"
    angle_min: float = 0.0
    """Angle of the first beam, counter-clockwise from the laser's forward direction [rad]."""
    angle_max: float | None = None
    """Angle of the last beam [rad]; None: full circle, with the last beam one increment before the first."""
    yaw: float = 0.0
    """Direction of the laser relative to base_footprint [rad]."""
    upside_down: bool = False
    """True if it hangs upside down: its z axis points down, so all angles in its messages have the opposite sign."""

    def __post_init__(self) -> None:
        numbers = (*self.mount, self.angle_min, self.yaw, 0.0 if self.angle_max is None else self.angle_max)
        within = 1 <= self.beams <= MAX_BEAMS and 0 <= self.range_min <= self.range_max
        if not within or not all(map(is_finite, numbers)):
            msg = (
                f"the laser {self.name!r} is not possible: it needs 1 to {MAX_BEAMS} beams, finite angles, a mount, "
                "and range_min and range_max with 0 <= range_min <= range_max, "
                f"not beams={self.beams}, mount={self.mount}, angle_min={self.angle_min}, "
                f"angle_max={self.angle_max}, yaw={self.yaw}, range_min={self.range_min}, range_max={self.range_max}"
            )
            raise ModelError(msg)

    @property
    def increment(self) -> float:
        """The angle between neighbouring beams [rad]."""
        if self.angle_max is None:
            return 2 * math.pi / self.beams
        return (self.angle_max - self.angle_min) / (self.beams - 1) if self.beams > 1 else 0.0

    @property
    def message_angles(self) -> tuple[float, float, float]:
        """`angle_min`, `angle_max` and `angle_increment` of its messages [rad]."""
        own = (self.angle_min, self.last_angle, self.increment)
        return (-own[0], -own[1], -own[2]) if self.upside_down else own

    @property
    def beam_time(self) -> float:
        """Time between neighbouring beams of a laser that makes one revolution per scan [s]."""
        return abs(self.increment) / (2 * math.pi) / self.rate

    @property
    def last_angle(self) -> float:
        """Angle of the last beam [rad]."""
        return self.angle_min + (self.beams - 1) * self.increment if self.angle_max is None else self.angle_max


@dataclass(frozen=True)
class CameraModel:
    """A camera without distortion: an image, and, if `depth`, the depth of each pixel."""

    name: str
    mount: Point
    """Its position relative to base_footprint."""
    width: int
    """Width of the image [pixels]."""
    height: int
    horizontal_fov: float
    """The angle between the left and the right border of the image [rad]."""
    near: float = 0.03
    """Minimum visible distance from the plane of the camera [m]."""
    far: float = 100.0
    rate: float = 30.0
    """Images per second."""
    frame: str = "camera_rgb_optical_frame"
    noise: float = 0.0
    """Standard deviation of a pixel's brightness, on a scale from 0 (black) to 1 (white), as in Gazebo."""
    depth: bool = False
    pitch: float = 0.0
    """Its downward inclination [rad]."""
    yaw: float = 0.0
    """Its direction relative to base_footprint [rad]."""
    depth_far: float | None = None
    """Maximum measured depth [m]; None: `far`."""

    def __post_init__(self) -> None:
        if (
            self.width < 1
            or self.height < 1
            or self.width * self.height > MAX_PIXELS
            or not 0 < self.horizontal_fov < math.pi
            or not 0 < self.near < self.far
        ):
            msg = (
                f"the camera {self.name!r} is not possible: it needs pixels, {MAX_PIXELS} at most, 0 < near < far "
                f"and an angle between 0 and pi, not {self.width} x {self.height} pixels, near={self.near}, "
                f"far={self.far}, horizontal_fov={self.horizontal_fov}"
            )
            raise ModelError(msg)

    @property
    def focal_length(self) -> float:
        """Focal length in pixels: fx and fy of a `sensor_msgs/CameraInfo`."""
        return self.width / (2 * math.tan(self.horizontal_fov / 2))


@dataclass(frozen=True)
class ImuModel:
    """An inertial measurement unit."""

    mount: Point
    rate: float
    gyro_noise: float
    """Standard deviation of an angular velocity [rad/s]."""
    accel_noise: float
    """Standard deviation of a linear acceleration [m/s2]."""
    frame: str = "imu_link"
    gyro_bias: float = 0.0
    """Standard deviation, from one unit to another, of the angular velocity at rest [rad/s]."""
    gyro_step: float = 0.0
    """The resolution of its converter [rad/s]: a gyroscope with a zero of whole steps is off by up to one at rest."""
    gyro_scale: float = 0.0
    """Standard deviation of the scale error from one unit to another."""
    accel_bias: float = 0.0
    """Standard deviation, from one unit to another, of the error of a linear acceleration [m/s2]."""
    gravity: float = GRAVITY
    """Its upward acceleration at rest [m/s2] (REP 145); 0: it does not measure gravity."""


@dataclass(frozen=True)
class WheelErrors:
    """Deviations of real wheels from the nominal values in the odometry: standard deviations, as fractions."""

    radius: float = 0.0015
    """Error of each wheel's radius: tyres are not made to a micrometre."""
    separation: float = 0.01
    """Error of the wheel separation: a tyre touches the ground along its width, not in a line."""
    slip: float = 0.002
    """Error of the distance per turn, varying from second to second: the ground is not even."""


@dataclass(frozen=True, kw_only=True)
class RobotModel:
    """A robot with a drive; or, without one, an object that robots push and that may carry sensors.

    Raises `ModelError`, which contains the name of the invalid number.
    """

    name: str
    mass: float
    """Mass [kg]; math.inf for an object that cannot be pushed."""
    inertia: float
    """Moment of inertia about the vertical axis through base_footprint [kg m2]."""
    footprint: tuple[tuple[float, float], ...]
    """Corners of the outline that touches walls, counter-clockwise, relative to base_footprint; a convex polygon."""
    height: float
    drive: Drive | None = "differential"
    wheel_radius: float = 0.033
    wheel_separation: float = 0.16
    max_linear: float = math.inf
    """Maximum speed ahead [m/s]."""
    max_angular: float = math.inf
    """Maximum rate of turn [rad/s]."""
    max_lateral: float | None = None
    """Maximum sideways speed of a holonomic robot [m/s]; None: `max_linear`."""
    wheel_acceleration: float = math.inf
    """Acceleration of a wheel's rim [m/s2]."""
    linear_acceleration: float = math.inf
    """Maximum acceleration ahead [m/s2], and sideways for a holonomic robot."""
    angular_acceleration: float = math.inf
    """Maximum angular acceleration [rad/s2]."""
    ticks_per_turn: int = 4096
    """Encoder counts in one turn of the wheel."""
    lidar: LidarModel | None = None
    imu: ImuModel | None = None
    cameras: tuple[CameraModel, ...] = ()
    rate: float = 30.0
    """Messages per second on odom, tf and joint_states."""
    errors: WheelErrors = WheelErrors()
    body_radius: float = 0.105
    """Without `parts`: radius of the disc, around the laser's axis, that other robots' lasers see."""
    parts: tuple[Part, ...] = ()
    """Parts that other robots' lasers and cameras see, each at its pose relative to base_footprint."""
    title: str = ""

    def __post_init__(self) -> None:
        problem = self._problem()
        if problem:
            raise ModelError(f"the robot model {self.name!r} is not possible: {problem}")

    def _problem(self) -> str:
        if self.drive is not None and self.drive not in get_args(Drive):
            hint = nearest(str(self.drive), get_args(Drive))
            more = f"; {hint}" if hint else ""
            return f"drive is {self.drive!r}; it must be 'differential', 'holonomic' or None{more}"
        for field in ("mass", "inertia", "height", "wheel_radius", "wheel_separation", "body_radius", "rate"):
            value = getattr(self, field)
            if not value > 0 or (math.isinf(value) and (self.drive or field not in ("mass", "inertia"))):
                return f"{field} is {value!r}; it must be a finite number above 0"
        for field in ("wheel_acceleration", "linear_acceleration", "angular_acceleration"):
            if not getattr(self, field) > 0:
                return f"{field} is {getattr(self, field)!r}; it must be above 0; math.inf is no limit"
        for field in ("max_linear", "max_angular", "max_lateral"):
            value = getattr(self, field)
            if value is not None and not value >= 0:
                return f"{field} is {value!r}; it must be 0 or more"
        corners = self.footprint
        if len(corners) < 3 or not all(is_finite(part) for corner in corners for part in corner):
            return f"footprint is {corners!r}; it must be 3 or more corners of finite x and y"
        turns = [
            (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
            for (ax, ay), (bx, by), (cx, cy) in zip(
                corners, corners[1:] + corners[:1], corners[2:] + corners[:2], strict=True
            )
        ]
        if min(turns) < -1e-12 or max(turns) <= 0:
            return f"footprint is {corners!r}; it must be convex, its corners counter-clockwise (see `hull`)"
        return ""

    @cached_property
    def reach(self) -> float:
        """The distance from base_footprint to the farthest corner of the footprint."""
        return max(math.hypot(x, y) for x, y in self.footprint)

    @cached_property
    def extent(self) -> float:
        """The distance from base_footprint to its farthest visible point."""
        return max(math.hypot(*part.pose[:2]) + reach_of(part.shape) for part in self.solid)

    @cached_property
    def own_limits(self) -> bool:
        """True if the robot's speeds have limits besides those of its rims."""
        return not (math.isinf(self.linear_acceleration) and math.isinf(self.angular_acceleration))

    @property
    def laser(self) -> LidarModel:
        """The lidar of a robot that has one. Raises `ModelError`."""
        if self.lidar is None:
            raise ModelError(f"the robot model {self.name!r} has no lidar; give it a LidarModel, or ask for no scan")
        return self.lidar

    @property
    def unit(self) -> ImuModel:
        """The inertial measurement unit of a robot that has one. Raises `ModelError`."""
        if self.imu is None:
            raise ModelError(
                f"the robot model {self.name!r} has no imu; give it an ImuModel, or ask for none of its readings"
            )
        return self.imu

    @cached_property
    def solid(self) -> tuple[Part, ...]:
        """Its parts as others see them: its `parts`, or else a disc of its height."""
        if self.parts:
            return self.parts
        x, y = self.lidar.mount[:2] if self.lidar is not None else (0.0, 0.0)
        return (Part(Cylinder(self.body_radius), (x, y, 0.0), 0.0, math.inf, "grey"),)


def hull(points: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """Return the convex hull of points, counter-clockwise, as required of a footprint.

    Andrew's monotone chain (Information Processing Letters 9, 1979).

    >>> hull([(0, 0), (2, 0), (1, 0.5), (1, 2)])
    ((0, 0), (2, 0), (1, 2))
    """
    ordered = sorted(set(points))
    half: list[list[tuple[float, float]]] = []
    for row in (ordered, ordered[::-1]):
        chain: list[tuple[float, float]] = []
        for x, y in row:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0:
                    break
                chain.pop()
            chain.append((x, y))
        half.append(chain)
    return (*half[0][:-1], *half[1][:-1])


BODY, TYRE, CASE = "#4b4f58", "#2b2d33", "#8a9099"
"""Our colours for TurtleBot3's parts: its plates, its tyres and laser, its camera."""

BURGER = RobotModel(
    name="burger",
    title="TurtleBot3 Burger",
    mass=1.0,  # e-manual, with battery, computer and laser
    # description: base (0.00201), wheels of 28.5 g 8 cm aside (0.00019 each), laser of 114 g 3.2 cm behind (0.00012)
    inertia=0.0025,
    wheel_radius=0.033,  # description, firmware
    wheel_separation=0.160,  # description, firmware
    max_linear=0.22,  # e-manual, firmware
    max_angular=2.84,  # e-manual, firmware
    wheel_acceleration=1.0,  # gazebo
    ticks_per_turn=4096,  # firmware: the 12-bit encoder of the XL430
    footprint=((-0.105, -0.105), (0.041, -0.105), (0.041, 0.105), (-0.105, 0.105)),  # navigation
    height=0.192,  # e-manual: 0.138 x 0.178 x 0.192 m
    lidar=LidarModel(
        name="LDS-01",
        mount=(-0.032, 0.0, 0.182),  # description: 0.172 above base_link, which is 0.010 above base_footprint
        beams=360,  # LDS-01: one a degree
        rate=5.0,  # LDS-01: 300 revolutions a minute
        range_min=0.12,  # LDS-01
        range_max=3.5,  # LDS-01
        noise=0.01,  # gazebo; LDS-01 itself: 10 mm near by, 3.5 % beyond half a metre
    ),
    imu=ImuModel(
        mount=(-0.032, 0.0, 0.078),  # description
        rate=200.0,  # firmware, gazebo
        gyro_noise=math.radians(
            0.01 * math.sqrt(200.0 / 2)
        ),  # MPU-9250: 0.01 deg/s a root of a hertz, up to half the rate
        accel_noise=1.7e-2,  # gazebo
        gyro_step=math.radians(2000.0 / 2**15),  # firmware: 16 bits for 2000 deg/s to either side
        gyro_scale=0.01,  # MPU-9250: at most 3 %, taken as three standard deviations
        accel_bias=0.1,  # gazebo
    ),
    rate=30.0,  # firmware, gazebo
    body_radius=0.105,  # firmware
    parts=(  # description: the collision shapes
        Part(Box(0.140, 0.140), (-0.032, 0.0, 0.0), 0.0085, 0.1515, BODY),
        Part(Box(0.066, 0.018), (0.0, 0.080, 0.0), 0.0, 0.066, TYRE),
        Part(Box(0.066, 0.018), (0.0, -0.080, 0.0), 0.0, 0.066, TYRE),
        Part(Cylinder(0.055), (-0.017, 0.0, 0.0), 0.1515, 0.19125, TYRE),  # the laser, and its foot of 8 mm
    ),
)

_WAFFLES_BODY = (  # description: the collision shapes
    Part(Box(0.266, 0.266), (-0.064, 0.0, 0.0), 0.010, 0.104, BODY),
    Part(Box(0.066, 0.018), (0.0, 0.144, 0.0), 0.0, 0.066, TYRE),
    Part(Box(0.066, 0.018), (0.0, -0.144, 0.0), 0.0, 0.066, TYRE),
    Part(Cylinder(0.055), (-0.049, 0.0, 0.0), 0.104, 0.14125, TYRE),  # the laser, and its foot of 6 mm
)

WAFFLE = RobotModel(
    name="waffle",
    title="TurtleBot3 Waffle",
    mass=1.8,  # e-manual
    # description: base (0.0146), wheels of 28.5 g 14.4 cm aside (0.0006 each), laser of 114 g 6.4 cm behind (0.0005)
    inertia=0.0163,
    wheel_radius=0.033,  # description, firmware
    wheel_separation=0.287,  # firmware, gazebo; the description's wheels are 0.288 apart
    max_linear=0.26,  # e-manual, firmware: 77 turns of a wheel a minute
    max_angular=1.82,  # e-manual, firmware
    wheel_acceleration=1.0,  # gazebo
    ticks_per_turn=4096,  # firmware: the 12-bit encoder of the XM430
    footprint=((-0.205, -0.155), (0.077, -0.155), (0.077, 0.155), (-0.205, 0.155)),  # navigation
    height=0.141,  # e-manual: 0.281 x 0.306 x 0.141 m
    lidar=replace(BURGER.laser, mount=(-0.064, 0.0, 0.132)),  # description; the same LDS-01
    imu=replace(BURGER.unit, mount=(0.0, 0.0, 0.078)),  # description; the same unit
    cameras=(
        CameraModel(  # gazebo: the Intel RealSense R200
            name="camera",
            mount=(0.069, -0.047, 0.117),  # description: camera_rgb_frame
            width=1920,
            height=1080,
            horizontal_fov=1.3439,
            near=0.03,
            far=100.0,
            rate=30.0,
            depth=True,
        ),
    ),
    rate=30.0,  # firmware, gazebo
    body_radius=0.220,  # firmware
    parts=(*_WAFFLES_BODY, Part(Box(0.012, 0.132), (0.067, 0.0, 0.0), 0.101, 0.121, CASE)),
)

WAFFLE_PI = replace(
    WAFFLE,
    name="waffle_pi",
    title="TurtleBot3 Waffle Pi",
    cameras=(
        CameraModel(  # gazebo: the Raspberry Pi camera, version 2
            name="camera",
            mount=(0.076, 0.0, 0.103),  # description: camera_rgb_frame
            width=640,
            height=480,
            horizontal_fov=1.085595,
            near=0.03,
            far=100.0,
            rate=30.0,
        ),
    ),
    parts=(*_WAFFLES_BODY, Part(Box(0.015, 0.030), (0.078, 0.0, 0.0), 0.0935, 0.1205, CASE)),
)

MODELS = {each.name: each for each in (BURGER, WAFFLE, WAFFLE_PI)}


def model(name: str | None = None) -> RobotModel:
    """Return the robot model called `name`.

    Without a name, return the model in the environment variable TURTLEBOT3_MODEL, or else the Burger.

    Raises `UnknownModel`.
    """
    wanted = name or os.environ.get(VARIABLE) or BURGER.name
    if wanted in MODELS:
        return MODELS[wanted]
    where = "" if name else f" (from the environment variable {VARIABLE})"
    hint = nearest(wanted, MODELS) or f"the models are: {', '.join(MODELS)}"
    raise UnknownModel(f"there is no robot model {wanted!r}{where}; {hint}")
