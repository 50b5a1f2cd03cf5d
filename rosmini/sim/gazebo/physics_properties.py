"""The physics of a world in Gazebo's services and parameters: step, rate, gravity, and the settings of ODE's solver."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rosmini.core.parameters import Parameters, parameter

from .errors import GazeboError

MIN_STEP_S, MAX_STEP_S = 1e-6, 1.0
"""Bounds of the physics step [s]."""

ODE = (
    "auto_disable_bodies", "sor_pgs_precon_iters", "sor_pgs_iters", "sor_pgs_w", "sor_pgs_rms_error_tol",
    "contact_surface_layer", "contact_max_correcting_vel", "cfm", "erp", "max_contacts",
)  # fmt: skip
"""The fields of gazebo_msgs/ODEPhysics. They are stored and reported, but rosmini's engine has another solver."""


def _ode(default: Any, what: str, maximum: float | None = None, minimum: float | None = None) -> Any:
    low = 0.0 if minimum is None and maximum is not None else minimum
    return parameter(default, f"{what} (no effect here)", minimum=low, maximum=maximum)


@dataclass(frozen=True)
class PhysicsProperties(Parameters):
    """The physics settings of a world; also the parameters of gazebo_ros/Physics, changed while the server runs.

    `time_step` is the duration of one step of `gz world -s`, `max_update_rate` the number of steps per second of
    real time: their product is the world's real-time factor. A rate of 0 means as fast as possible, which a graph in
    simulated time always is. Gravity points down, or is zero. Raises `GazeboError` for other numbers.
    """

    time_step: float = parameter(0.001, "time step of the physics", unit="s", minimum=MIN_STEP_S, maximum=MAX_STEP_S)
    max_update_rate: float = parameter(
        1000.0, "steps a second; 0: as many as possible", unit="Hz", minimum=0.0, maximum=1e6
    )
    gravity_x: float = parameter(0.0, "gravity along x", unit="m/s2", minimum=-100.0, maximum=100.0)
    gravity_y: float = parameter(0.0, "gravity along y", unit="m/s2", minimum=-100.0, maximum=100.0)
    gravity_z: float = parameter(-9.8, "gravity along z", unit="m/s2", minimum=-100.0, maximum=100.0)
    auto_disable_bodies: bool = _ode(False, "let bodies that rest sleep")
    sor_pgs_precon_iters: int = _ode(0, "of ODE's solver", 10000)
    sor_pgs_iters: int = _ode(50, "of ODE's solver", 10000, 1)
    sor_pgs_w: float = _ode(1.3, "of ODE's solver", 5.0)
    sor_pgs_rms_error_tol: float = _ode(0.0, "of ODE's solver", 10.0)
    contact_surface_layer: float = _ode(0.001, "of ODE's contacts", 10.0)
    contact_max_correcting_vel: float = _ode(100.0, "of ODE's contacts", 10000.0)
    cfm: float = _ode(0.0, "of ODE's constraints", 10.0)
    erp: float = _ode(0.2, "of ODE's constraints", 10.0)
    max_contacts: int = _ode(20, "of ODE's contacts", 10000)

    def __post_init__(self) -> None:
        numbers = {"time_step": self.time_step, "max_update_rate": self.max_update_rate}
        numbers |= {f"gravity.{axis}": part for axis, part in zip("xyz", self.gravity, strict=True)}
        for name, value in numbers.items():
            if not math.isfinite(value):
                raise GazeboError(f"{name} is {value}; it must be a finite number")
        if not MIN_STEP_S <= self.time_step <= MAX_STEP_S:
            span = f"from {MIN_STEP_S:g} to {MAX_STEP_S:g} s"
            raise GazeboError(f"time_step is {self.time_step} s; it must be {span}")
        if self.max_update_rate < 0:
            what = f"max_update_rate is {self.max_update_rate} Hz"
            raise GazeboError(f"{what}; it must be 0 (as fast as it can) or more")
        x, y, z = self.gravity
        if x or y or z > 0:
            why = "the ground is level here, so it has to point down (0, 0, -9.8), or be zero"
            raise GazeboError(f"gravity is ({x}, {y}, {z}) m/s2; {why}")

    @property
    def gravity(self) -> tuple[float, float, float]:
        """Gravity along x, y and z [m/s2]."""
        return (self.gravity_x, self.gravity_y, self.gravity_z)

    @property
    def speed(self) -> float:
        """Real-time factor: simulated seconds per second of real time."""
        return self.time_step * self.max_update_rate or 1.0

    def fill(self, response: Any) -> None:
        """Fill in a gazebo_msgs/GetPhysicsProperties."""
        response.time_step, response.max_update_rate = self.time_step, self.max_update_rate
        response.gravity.x, response.gravity.y, response.gravity.z = self.gravity
        for name in ODE:
            setattr(response.ode_config, name, getattr(self, name))

    @classmethod
    def of_request(cls, request: Any) -> PhysicsProperties:
        """Return the settings in a gazebo_msgs/SetPhysicsProperties. Raises `GazeboError`."""
        gravity = request.gravity
        ode = {name: getattr(request.ode_config, name) for name in ODE}
        return cls(request.time_step, request.max_update_rate, gravity.x, gravity.y, gravity.z, **ode)
