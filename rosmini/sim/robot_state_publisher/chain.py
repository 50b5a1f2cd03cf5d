"""A robot's joints as rigid transforms: what `robot_state_publisher` sends. No node in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache

from rosmini.core.tf.rigid import Rigid, compose, from_rpy, rigid
from rosmini.sim.urdf import Joint, Robot

Sent = tuple[str, str, Rigid]
"""Parent, child, and where the child is in it."""


def joint_transform(joint: Joint, position: float = 0.0) -> Rigid:
    """The child's frame in the parent's with the joint at `position` [rad or m]."""
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
    """Where a joint is attached; asked again and again for the same few."""
    return from_rpy(xyz, *rpy)


class Chain:
    """The moving and the fixed joints of a robot.

    As in KDL, with which the real node computes, a planar joint is taken as fixed, and nobody but the program that
    knows where it is can tell of a floating one.
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
        """The transforms of the joints whose positions are known, and of those that mimic one of them.

        A mimic whose own position is given stands there, as in the real node. Names that are no moving joint are passed
        over.
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
        """Those that mimic a joint that mimics none first."""
        done: list[Joint] = []
        left = list(self.mimics)
        while left:
            waiting = {joint.name for joint in left}
            ready = [joint for joint in left if joint.mimic is not None and joint.mimic.joint not in waiting]
            done += ready
            left = [joint for joint in left if joint not in ready]
        return done
