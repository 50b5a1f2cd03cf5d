"""A robot's joints as rigid transforms, for `robot_state_publisher`. Contains no node."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache

from rosmini.core.tf.rigid import Rigid, compose, from_rpy, rigid
from rosmini.sim.urdf import Joint, Robot

Sent = tuple[str, str, Rigid]
"""Parent, child, and the child's pose in the parent."""


def joint_transform(joint: Joint, position: float = 0.0) -> Rigid:
    """Return the child's frame in the parent's, with the joint at `position` [rad or m]."""
    origin = _origin(tuple(joint.origin.xyz), tuple(joint.origin.rpy))
    x, y, z = joint.axis
    if joint.type == "prismatic":
        return compose(origin, rigid((x * position, y * position, z * position)))
    if joint.moves:
        half = math.remainder(position, 2 * math.tau) / 2
        s = math.sin(half)
        return compose(origin, (0.0, 0.0, 0.0, x * s, y * s, z * s, math.cos(half)))
    return origin


@lru_cache(maxsize=1024)
def _origin(xyz: tuple[float, ...], rpy: tuple[float, ...]) -> Rigid:
    """Return the origin of a joint; cached, because the same few are used repeatedly."""
    return from_rpy(xyz, *rpy)


class Chain:
    """The moving and the fixed joints of a robot.

    As in KDL, which the real node uses, a planar joint is treated as fixed, and only a program that
    knows the pose of a floating joint can publish it.
    """

    def __init__(self, robot: Robot) -> None:
        self.moving = {name: robot.joints[name] for name in sorted(robot.joints) if robot.joints[name].moves}
        self.floating = [joint.name for joint in robot.joints.values() if joint.type == "floating"]
        self.mimics = [joint for joint in self.moving.values() if joint.mimic is not None]
        self.fixed: list[Sent] = [
            (joint.parent, joint.child, joint_transform(joint))
            for _, joint in sorted(robot.joints.items())
            if joint.type in {"fixed", "planar"}
        ]

    def transforms(self, positions: Mapping[str, float]) -> list[Sent]:
        """Return the transforms of the joints with known positions, and of those that mimic one of them.

        A given position of a mimic joint takes precedence, as in the real node. Names that are not moving joints are
        ignored.
        """
        known = dict(positions)
        for joint in self._mimics_in_order():
            mimic = joint.mimic
            if mimic is not None and mimic.joint in known:
                known.setdefault(joint.name, known[mimic.joint] * mimic.multiplier + mimic.offset)
        return [
            (joint.parent, joint.child, joint_transform(joint, known[name]))
            for name, joint in self.moving.items()
            if name in known
        ]

    def _mimics_in_order(self) -> list[Joint]:
        """Return the mimic joints in order of dependency."""
        done: list[Joint] = []
        left = list(self.mimics)
        while left:
            waiting = {joint.name for joint in left}
            ready = [joint for joint in left if joint.mimic is not None and joint.mimic.joint not in waiting]
            done += ready
            left = [joint for joint in left if joint not in ready]
        return done
