"""Forces on things: what the service apply_body_wrench does.

While a force F [N] and a torque T [N m] act on a thing of mass m and inertia I, each step dt adds F dt / m to its
velocity and T dt / I to its angular velocity. Friction acts as on any sliding thing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rosmini.sim.sdf import Pose6

from .errors import GazeboError
from .model import GazeboWorld, Model
from .plugins import Update

RATE = 200.0
"""How often forces act [Hz]: once in each step of the engine."""


@dataclass
class Wrench:
    """A force and a torque on a thing, in the frame of the world."""

    model: Model
    body: str
    force: tuple[float, float]
    torque: float
    start: float
    end: float
    mass: float
    inertia: float


@dataclass(frozen=True)
class WrenchState:
    """A wrench as plain data, with the name of its model."""

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
        self._acting: list[Wrench] = []
        self._update: Update | None = None

    def apply(self, model: Model, link: str, frame: Pose6, request: Any) -> None:
        """Apply what a gazebo_msgs/ApplyBodyWrench asks for.

        Raises `GazeboError` for what wheels or the ground hold, and for no finite force.
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
            raise GazeboError("a force has to be finite")
        c, s = math.cos(frame[5]), math.sin(frame[5])
        fx, fy = c * force.x - s * force.y, s * force.x + c * force.y
        turn = torque.z + point.x * force.y - point.y * force.x
        now = self._world.now
        start = max(now, request.start_time.to_sec())
        lasting = request.duration.to_sec()
        mass, inertia = model.weight
        end = math.inf if lasting < 0 else start + lasting
        self._acting.append(Wrench(model, f"{model.name}::{link}", (fx, fy), turn, start, end, mass, inertia))
        self._schedule()

    def _schedule(self) -> None:
        """Have `_push` called while something acts."""
        host = self._world.host
        if self._acting and self._update is None:
            self._update = host.add(Update(host, "forces on bodies", RATE, self._push))
        elif not self._acting and self._update is not None:
            host.remove(self._update)
            self._update = None

    def clear(self, body: str) -> None:
        """Stop everything that acts on a body."""
        self._acting = [each for each in self._acting if body not in (each.body, each.model.name)]

    def _push(self, now: float) -> None:
        dt = 1 / RATE
        there = self._world.models
        self._acting = [
            each for each in self._acting if each.end > now - dt and there.get(each.model.name) is each.model
        ]
        for each in self._acting:
            span = min(now, each.end) - max(now - dt, each.start)
            if span > 1e-9:
                vx, vy, w = each.model.velocity
                fx, fy = each.force
                each.model.set_velocity(
                    (
                        vx + fx * span / each.mass,
                        vy + fy * span / each.mass,
                        w + each.torque * span / each.inertia,
                    )
                )
        self._schedule()

    def state(self) -> tuple[WrenchState, ...]:
        """Return all that act, as plain data."""
        there = self._world.models
        return tuple(
            WrenchState(each.model.name, each.body, each.force, each.torque, each.start, each.end)
            for each in self._acting
            if there.get(each.model.name) is each.model
        )

    def restore(self, state: tuple[WrenchState, ...]) -> None:
        """Make those act that acted then."""
        models = [self._world.model(each.model) for each in state]
        self._acting = [
            Wrench(model, each.body, each.force, each.torque, each.start, each.end, *model.weight)
            for model, each in zip(models, state, strict=True)
        ]
        self._schedule()
