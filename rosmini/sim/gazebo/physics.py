"""The physics of a world as Gazebo's services tell it: step, rate, gravity, and the numbers of the solver ODE."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from rosmini.sim.parameters import Parameters, parameter

from .errors import GazeboError

Vector = tuple[float, float, float]

TIME_STEPS = (1e-6, 1.0)
"""The shortest and the longest step of the physics that makes sense [s]."""


@dataclass(frozen=True)
class Ode:
    """The numbers of Gazebo's solver, with its defaults. They are kept and told, but rosmini's engine has another solver."""

    auto_disable_bodies: bool = False
    sor_pgs_precon_iters: int = 0
    sor_pgs_iters: int = 50
    sor_pgs_w: float = 1.3
    sor_pgs_rms_error_tol: float = 0.0
    contact_surface_layer: float = 0.001
    contact_max_correcting_vel: float = 100.0
    cfm: float = 0.0
    erp: float = 0.2
    max_contacts: int = 20


@dataclass(frozen=True)
class PhysicsProperties:
    """How a world is stepped.

    `time_step` [s] is what one step of `gz world -s` takes and `max_update_rate` [Hz] how many of them are made in a second of the wall's time, so their
    product is the speed of the world; a rate of 0 means as fast as it can, which a graph in simulated time does anyhow. `gravity` [m/s2] points down, or
    is zero. Raises `GazeboError` for numbers that make no sense.
    """

    time_step: float = 0.001
    max_update_rate: float = 1000.0
    gravity: Vector = (0.0, 0.0, -9.8)
    ode: Ode = Ode()

    def __post_init__(self) -> None:
        numbers = {"time_step": self.time_step, "max_update_rate": self.max_update_rate}
        numbers |= {f"gravity.{axis}": part for axis, part in zip("xyz", self.gravity, strict=True)}
        for name, value in numbers.items():
            if not math.isfinite(value):
                msg = f"{name} is {value}; it has to be a finite number"
                raise GazeboError(msg)
        shortest, longest = TIME_STEPS
        if not shortest <= self.time_step <= longest:
            msg = f"time_step is {self.time_step} s; it has to be from {shortest:g} to {longest:g} s"
            raise GazeboError(msg)
        if self.max_update_rate < 0:
            msg = f"max_update_rate is {self.max_update_rate} Hz; it has to be 0 (as fast as it can) or more"
            raise GazeboError(msg)
        x, y, z = self.gravity
        if x or y or z > 0:
            msg = f"gravity is ({x}, {y}, {z}) m/s2; the ground is level here, so it has to point down (0, 0, -9.8), or be zero"
            raise GazeboError(msg)

    @property
    def speed(self) -> float:
        """So many seconds of the world pass in one of the clock."""
        return self.time_step * self.max_update_rate or 1.0

    def to_messages(self, ode_config: Any, gravity: Any) -> None:
        """Fill a gazebo_msgs/ODEPhysics and a geometry_msgs/Vector3."""
        for name, value in asdict(self.ode).items():
            setattr(ode_config, name, value)
        gravity.x, gravity.y, gravity.z = self.gravity

    @classmethod
    def of_request(cls, request: Any) -> PhysicsProperties:
        """What a gazebo_msgs/SetPhysicsProperties asks for. Raises `GazeboError`."""
        gravity = request.gravity
        ode = Ode(**{each.name: getattr(request.ode_config, each.name) for each in fields(Ode)})
        return cls(request.time_step, request.max_update_rate, (gravity.x, gravity.y, gravity.z), ode)


@dataclass(frozen=True)
class PhysicsConfig(Parameters):
    """The same as parameters that are changed while the server runs, by the names of gazebo_ros/Physics."""

    time_step: float = parameter(0.001, "time step of the physics", unit="s", minimum=1e-6, maximum=1.0)
    max_update_rate: float = parameter(
        1000.0, "steps a second; 0: as fast as it can", unit="Hz", minimum=0.0, maximum=1e6
    )
    gravity_x: float = parameter(0.0, "gravity along x", unit="m/s2", minimum=-100.0, maximum=100.0)
    gravity_y: float = parameter(0.0, "gravity along y", unit="m/s2", minimum=-100.0, maximum=100.0)
    gravity_z: float = parameter(-9.8, "gravity along z", unit="m/s2", minimum=-100.0, maximum=100.0)
    auto_disable_bodies: bool = parameter(False, "let bodies that rest sleep (no effect here)")
    sor_pgs_precon_iters: int = parameter(0, "of ODE's solver (no effect here)", minimum=0, maximum=10000)
    sor_pgs_iters: int = parameter(50, "of ODE's solver (no effect here)", minimum=1, maximum=10000)
    sor_pgs_w: float = parameter(1.3, "of ODE's solver (no effect here)", minimum=0.0, maximum=5.0)
    sor_pgs_rms_error_tol: float = parameter(
        0.0, "of ODE's solver (no effect here)", minimum=0.0, maximum=10.0
    )
    contact_surface_layer: float = parameter(
        0.001, "of ODE's contacts (no effect here)", minimum=0.0, maximum=10.0
    )
    contact_max_correcting_vel: float = parameter(
        100.0, "of ODE's contacts (no effect here)", minimum=0.0, maximum=10000.0
    )
    cfm: float = parameter(0.0, "of ODE's constraints (no effect here)", minimum=0.0, maximum=10.0)
    erp: float = parameter(0.2, "of ODE's constraints (no effect here)", minimum=0.0, maximum=10.0)
    max_contacts: int = parameter(20, "of ODE's contacts (no effect here)", minimum=0, maximum=10000)

    @staticmethod
    def values(physics: PhysicsProperties) -> dict[str, Any]:
        """The values of these parameters."""
        x, y, z = physics.gravity
        steps = {"time_step": physics.time_step, "max_update_rate": physics.max_update_rate}
        return {**steps, "gravity_x": x, "gravity_y": y, "gravity_z": z, **asdict(physics.ode)}

    @staticmethod
    def applied(physics: PhysicsProperties, values: Any) -> PhysicsProperties:
        """The physics with these values. Raises `GazeboError`."""
        ode = replace(physics.ode, **{each.name: values[each.name] for each in fields(Ode)})
        gravity = (values["gravity_x"], values["gravity_y"], values["gravity_z"])
        return PhysicsProperties(values["time_step"], values["max_update_rate"], gravity, ode)
