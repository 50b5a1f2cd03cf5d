"""Wrong answers to the exercises of the chapter TurtleBot3."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.core.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.sim.simulator import Simulator


def _speed(
    distance: float, period: float = 0.2, acceleration: float = 1.0, *, halves: float = 2.0, most: float = 0.22
) -> float:
    a, t = acceleration, period
    return min(most, a * (math.sqrt(t * t + halves * distance / a) - t))


def _twist(v: float, w: float) -> Any:
    twist = message_class("geometry_msgs/Twist")()
    twist.linear.x, twist.angular.z = v, w
    return twist


# ---- circle: a circle ----


def _circle(v: Callable[[float, float], float], w: Callable[[float, float], float]) -> Callable[[], Any]:
    return lambda: lambda radius, seconds: _twist(v(radius, seconds), w(radius, seconds))


def _front(
    *,
    wrap: bool = True,
    angles: bool = True,
    good: Callable[[Any], Any] = lambda s: (s.ranges >= s.range_min) & (s.ranges <= s.range_max),
    nothing: Any = math.inf,
) -> Callable[[], Any]:
    def distance(scan: Any, half_width: float) -> Any:
        at = (scan.angle_min if angles else 0.0) + np.arange(len(scan.ranges)) * scan.angle_increment
        off = np.abs((at + math.pi) % (2 * math.pi) - math.pi) if wrap else np.abs(at)
        chosen = scan.ranges[good(scan) & (off <= half_width)]
        return chosen.min() if len(chosen) else nothing

    return lambda: distance


def _calibration(measure: Callable[[float, float], float]) -> Callable[[], Any]:
    """An answer that spins; `measure` gets the difference of the wheels' ways [m] and the turn [rad]."""

    def separation(graph: Graph, sim: Simulator) -> float:
        node = graph.node("calibration")
        ways: dict[str, Any] = {}
        node.subscriber("joint_states", message_class("sensor_msgs/JointState"), lambda m: ways.update(now=m))
        cmd_vel = node.publisher("cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)
        cmd_vel.wait_for_subscribers()
        command = _twist(0.0, 1.0)
        for _ in range(300):
            cmd_vel.publish(command)
            graph.run(0.1)
        graph.run(1.0)
        left, right = sim.model.wheel_radius * ways["now"].position
        return measure(right - left, sim.truth()[2])

    return lambda: separation


def _mast(
    *, middle: float = 0.5, foot: str = "-0.09 0 0.15", top: float | None = None, size: float = 1.0,
    hold: str = "fixed", parent: str = "mast_link", extra: str = "",
) -> Callable[[], Any]:  # fmt: skip
    """An answer with the cylinder's middle at a part of the height, and the beacon at `top` instead of on top."""

    def text(height: float) -> str:
        return f"""
        <link name="mast_link"><visual><origin xyz="0 0 {middle * height}"/>
          <geometry><cylinder radius="{0.005 * size}" length="{height}"/></geometry></visual></link>
        <joint name="mast_joint" type="{hold}">
          <parent link="base_link"/><child link="mast_link"/><origin xyz="{foot}"/></joint>
        <link name="beacon_link"><visual><geometry><sphere radius="{0.015 * size}"/></geometry></visual></link>
        <joint name="beacon_joint" type="{hold}"><parent link="{parent}"/><child link="beacon_link"/>
          <origin xyz="0 0 {height if top is None else top}"/></joint>{extra}"""

    return lambda: text


MISTAKES = {
    "circle": [
        _circle(lambda r, t: 2 * math.pi * r / t, lambda _r, t: -2 * math.pi / t),
        _circle(lambda r, t: 2 * math.pi * r / t, lambda r, t: 2 * math.pi * r / t),
        _circle(lambda r, t: 2 * math.pi * r / t, lambda _r, t: 360 / t),
        _circle(lambda r, t: math.pi * r / t, lambda _r, t: math.pi / t),
        _circle(lambda r, t: 2 * r / t, lambda _r, t: 2 * math.pi / t),
        _circle(lambda _r, _t: 0.157, lambda _r, _t: 0.314),
        lambda: lambda radius, seconds: (2 * math.pi * radius / seconds, 2 * math.pi / seconds),
    ],
    "front_distance": [
        _front(wrap=False),
        _front(angles=False),
        _front(good=lambda scan: np.isfinite(scan.ranges)),
        _front(good=lambda scan: scan.ranges >= scan.range_min),
        _front(good=lambda scan: scan.ranges == scan.ranges),
        _front(nothing=3.5),
        _front(nothing=None),
        lambda: lambda scan, _half_width: scan.ranges[0],
        lambda: lambda scan, _half_width: scan.ranges.min(),
        lambda: lambda scan, _half_width: min(scan.ranges[:31].min(), scan.ranges[-30:].min()),
    ],
    "wheel_separation": [
        lambda: lambda _graph, sim: sim.model.wheel_separation,
        lambda: lambda _graph, _sim: 0.16,
        _calibration(lambda way, turn: 0.16**2 * turn / way),
        _calibration(lambda way, turn: way / (turn % (2 * math.pi))),
        _calibration(lambda way, turn: way / turn / 2),
        _calibration(lambda way, turn: 1000 * way / turn),
    ],
    "safe_speed": [
        lambda: lambda distance, period=0.2, acceleration=1.0: _speed(distance, period, acceleration, most=9.0),
        lambda: lambda distance, period=0.2, acceleration=1.0: _speed(distance, period, acceleration, halves=1.0),
        lambda: lambda distance, _period=0.2, acceleration=1.0: min(0.22, math.sqrt(2 * acceleration * distance)),
        lambda: lambda distance, period=0.2, _acceleration=1.0: min(0.22, distance / period),
        lambda: lambda distance, _period=0.2, acceleration=1.0: _speed(distance, 0.2, acceleration),
        lambda: lambda distance, period=0.2, _acceleration=1.0: _speed(distance, period, 1.0),
        lambda: lambda _distance, _period=0.2, _acceleration=1.0: 0.22,
    ],
    "mast": [
        _mast(middle=0.0),
        _mast(middle=1.0),
        _mast(foot="-0.09 0 0.16"),
        _mast(foot="0.09 0 0.15"),
        _mast(top=0.3),
        _mast(parent="base_link"),
        _mast(size=2.0),
        _mast(size=1000.0),
        _mast(hold="continuous"),
        _mast(extra="<joint>"),
        lambda: lambda height: _mast()()(height).replace("beacon_link", "beacon"),
        lambda: lambda height: _mast()()(height).replace("sphere", "cylinder length='0.03'"),
        lambda: lambda height: _mast()()(height).partition("<joint")[0],
        lambda: lambda _height: _mast()()(0.3),
        lambda: lambda height: ("mast_link", height),
    ],
}
