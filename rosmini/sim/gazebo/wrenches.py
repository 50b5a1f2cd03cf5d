"""Forces on models, for the service apply_body_wrench.

While a force F [N] and a torque T [N m] act on a model of mass m and inertia I, each step dt adds F dt / m to its
velocity and T dt / I to its angular velocity. Friction acts as on any sliding obstacle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rosmini.sim.sdf.document import Pose6

from .errors import GazeboError
from .model import GazeboWorld, Model
from .plugins import Update

RATE = 200.0
"""Rate at which forces are applied [Hz]: once in each step of the engine."""


@dataclass(frozen=True)
class Wrench:
    """A force and a torque on a model, in the frame of the world."""

    model: str
    body: str
    force: tuple[float, float]
    torque: float
    start: float
    end: float


class Wrenches:
    """All wrenches that act in a world."""

    def __init__(self, world: GazeboWorld) -> None:
        self._world = world
        self._acting: list[tuple[Wrench, Model, tuple[float, float]]] = []
        """Each wrench with the model that it acts on, and the model's mass and inertia."""
        self._update: Update | None = None

    def apply(self, model: Model, link: str, frame: Pose6, request: Any) -> None:
        """Apply the wrench in a gazebo_msgs/ApplyBodyWrench.

        Raises `GazeboError` for a model held by its wheels or the ground, and for a force that is not finite.
        """
        if model.fixed is not None or model.static:
            raise GazeboError(f"the model {model.name!r} is static: no force moves it")
        if model.body is not None and model.body.drive:
            raise GazeboError(
                f"the model {model.name!r} stands on its wheels, which hold it where its drive wants it; give it a "
                "velocity on cmd_vel, or push it with another model"
            )
        force, torque, point = request.wrench.force, request.wrench.torque, request.reference_point
        if not all(math.isfinite(each) for each in (force.x, force.y, torque.z, point.x, point.y)):
            raise GazeboError("a force must be finite")
        c, s = math.cos(frame[5]), math.sin(frame[5])
        fx, fy = c * force.x - s * force.y, s * force.x + c * force.y
        turn = torque.z + point.x * force.y - point.y * force.x
        now = self._world.now
        start = max(now, request.start_time.to_sec())
        lasting = request.duration.to_sec()
        end = math.inf if lasting < 0 else start + lasting
        wrench = Wrench(model.name, f"{model.name}::{link}", (fx, fy), turn, start, end)
        self._acting.append((wrench, model, model.weight))
        self._schedule()

    def _schedule(self) -> None:
        """Schedule `_push` while a wrench acts."""
        host = self._world.host
        if self._acting and self._update is None:
            self._update = host.add(Update(host, "forces on bodies", RATE, self._push))
        elif not self._acting and self._update is not None:
            host.remove(self._update)
            self._update = None

    def clear(self, body: str) -> None:
        """Stop all wrenches on a body."""
        self._acting = [each for each in self._acting if body not in (each[0].body, each[0].model)]

    def _push(self, now: float) -> None:
        dt = 1 / RATE
        self._acting = [each for each in self._acting if each[0].end > now - dt and self._is_there(each[1])]
        for wrench, model, (mass, inertia) in self._acting:
            span = min(now, wrench.end) - max(now - dt, wrench.start)
            if span > 1e-9:
                (vx, vy, w), (fx, fy) = model.velocity, wrench.force
                model.set_velocity((vx + fx * span / mass, vy + fy * span / mass, w + wrench.torque * span / inertia))
        self._schedule()

    def _is_there(self, model: Model) -> bool:
        return self._world.models.get(model.name) is model
