"""Positions of joints that do not move, or move from limit to limit. Contains no node."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rosmini.core.errors import ParameterError, nearest
from rosmini.sim.urdf import Joint, Robot


@dataclass
class Free:
    """A joint with an independent position [rad or m]."""

    lower: float
    upper: float
    continuous: bool
    position: float | None
    velocity: float | None = None
    effort: float | None = None
    forward: bool = True

    def move(self, step: float) -> None:
        """Advance by `step`; reverse at a limit, or wrap around if the joint is continuous."""
        if self.position is None:
            return
        self.position += step if self.forward else -step
        if self.forward and self.position > self.upper:
            self.position = self.lower if self.continuous else self.upper
            self.forward = self.continuous
        elif not self.forward and self.position < self.lower:
            self.position, self.forward = self.lower, True


@dataclass(frozen=True)
class Dependent:
    """A joint that follows another: ``factor * position + offset``."""

    parent: str
    factor: float = 1.0
    offset: float = 0.0


class Positions:
    """The positions of a robot's joints; dependent joints follow others, also in a chain.

    Raises `ParameterError` if a joint depends on one that does not exist or does not move, or on itself through others.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        zeros: Mapping[str, float] | None = None,
        dependent: Mapping[str, Mapping[str, Any]] | None = None,
        use_mimic: bool = True,
    ) -> None:
        self.robot = robot
        self.names = [joint.name for joint in robot.joints.values() if joint.moves]
        self.free: dict[str, Free] = {}
        self.dependent: dict[str, Dependent] = {
            name: Dependent(str(each["parent"]), float(each.get("factor", 1)), float(each.get("offset", 0)))
            for name, each in (dependent or {}).items()
        }
        for name in self.names:
            joint = robot.joints[name]
            if use_mimic and joint.mimic is not None:
                mimic = joint.mimic
                self.dependent[name] = Dependent(mimic.joint, mimic.multiplier, mimic.offset)
            elif name not in self.dependent:
                self.free[name] = _free(joint, (zeros or {}).get(name))
        self._follows = {name: self._root(name) for name in self.names if name in self.dependent}

    def _root(self, name: str) -> Dependent:
        """Return the free joint at the end of a joint's chain of dependencies, with factor and offset."""
        chain = [name]
        found = self.dependent[name]
        while found.parent in self.dependent:
            chain.append(found.parent)
            if chain.count(found.parent) > 1:
                raise ParameterError(f"joints depend on one another in a circle: {' -> '.join(chain)}")
            up = self.dependent[found.parent]
            found = Dependent(up.parent, found.factor * up.factor, found.offset + found.factor * up.offset)
        if found.parent not in self.free:
            hint = nearest(found.parent, self.free)
            raise ParameterError(
                f"the joint {name!r} depends on {found.parent!r}, which is no joint that "
                f"moves{f'; {hint}' if hint else ''}"
            )
        return found

    def take(self, name: str, position: float | None, velocity: float | None, effort: float | None) -> None:
        """Adopt the state of a joint from another source; None leaves a value. Joints that are not free are ignored."""
        joint = self.free.get(name)
        if joint is None:
            return
        joint.position = joint.position if position is None else position
        joint.velocity = joint.velocity if velocity is None else velocity
        joint.effort = joint.effort if effort is None else effort

    def move(self, step: float) -> None:
        """Advance all free joints by `step` [rad or m]."""
        for joint in self.free.values():
            joint.move(step)

    def table(self) -> list[tuple[str, float | None, float | None, float | None]]:
        """Return name, position, velocity and effort of every moving joint, in the order of the description."""
        rows: list[tuple[str, float | None, float | None, float | None]] = []
        for name in self.names:
            if name in self.free:
                joint = self.free[name]
                rows.append((name, joint.position, joint.velocity, joint.effort))
                continue
            follows = self._follows[name]
            joint = self.free[follows.parent]
            rows.append(
                (
                    name,
                    None if joint.position is None else joint.position * follows.factor + follows.offset,
                    None if joint.velocity is None else joint.velocity * follows.factor,
                    joint.effort,
                )
            )
        return rows


def _free(joint: Joint, zero: float | None) -> Free:
    limit = joint.limit
    bounded = joint.type != "continuous" and limit is not None
    lower, upper = (limit.lower, limit.upper) if bounded and limit is not None else (-math.pi, math.pi)
    return Free(lower, upper, not bounded, joint.rest if zero is None else float(zero))
