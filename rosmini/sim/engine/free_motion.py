"""The drives: a robot's path in closed form, from its commanded velocity.

A wheel's rim has a speed u [m/s] and changes to the target speed at the rate a [m/s2]: a linear ramp. So results do not
depend on the time step. With b the wheel separation, v and w the speed ahead [m/s] and to the left [rad/s]:

    u_left = v - w b / 2,   u_right = v + w b / 2;   v = (u_left + u_right) / 2,   w = (u_right - u_left) / b

(Siegwart, Nourbakhsh and Scaramuzza, Introduction to Autonomous Mobile Robots, 2011, section 3.2.) If the robot's
speeds v and w have limits too, at most a_v and a_w, each changes to its target at its limit, and both change
more slowly if a rim cannot follow.

A holonomic robot also has a speed vy to its left side, and each of v, vy and w changes to its target
independently. Headings are counter-clockwise and never wrapped.
"""

from __future__ import annotations

import math

from rosmini.core.geometry.poses import Pose, arc

Phase = tuple[float, float, float]
"""Its duration [s], and the rates at which the left and the right rim change their speeds [m/s2]."""

# Four-point Gauss-Legendre quadrature: nodes and weights on (0, 1).
_NODES = (
    (0.06943184420297371, 0.17392742256872692),
    (0.33000947820757187, 0.32607257743127307),
    (0.6699905217924281, 0.32607257743127307),
    (0.9305681557970263, 0.17392742256872692),
)

ROUNDING = 1e-12
"""Speeds that differ by less [m/s, rad/s] count as equal."""

PANEL = 0.2
"""The largest turn [rad] within one panel of the quadrature: four points are then exact to a part in 1e11."""


def limited(v: float, w: float, max_linear: float, max_angular: float) -> tuple[float, float]:
    """Limit each part of a commanded velocity to what the robot can do, as TurtleBot3's firmware does."""
    return (max(-max_linear, min(max_linear, v)), max(-max_angular, min(max_angular, w)))


def rim_speeds(v: float, w: float, separation: float) -> tuple[float, float]:
    """Return the speeds [m/s] of the left and the right wheel at the rim."""
    half = w * separation / 2
    return (v - half, v + half)


def body_velocity(left: float, right: float, separation: float) -> tuple[float, float]:
    """Return the speeds ahead [m/s] and to the left [rad/s] of a robot whose wheels roll."""
    return ((left + right) / 2, (right - left) / separation)


def phases(
    left: float, right: float, left_target: float, right_target: float, acceleration: float, dt: float
) -> list[Phase]:
    """Divide `dt` seconds into one to three phases, at the times when the rims reach their target speeds."""
    rises = (left_target - left, right_target - right)
    ends = [abs(rise) / acceleration for rise in rises]
    found: list[Phase] = []
    begin = 0.0
    for end in sorted({*(end for end in ends if end < dt), dt}):
        if end > begin:
            rates = [
                math.copysign(acceleration, rise) if arrival > begin else 0.0
                for rise, arrival in zip(rises, ends, strict=True)
            ]
            found.append((end - begin, rates[0], rates[1]))
            begin = end
    return found


def limited_phases(
    left: float,
    right: float,
    left_target: float,
    right_target: float,
    separation: float,
    limits: tuple[float, float, float],
    dt: float,
) -> list[Phase]:
    """Divide `dt` seconds into one to three phases in which a robot's v and w approach their targets within limits.

    The limits are those of v [m/s2], of w [rad/s2] and of a rim [m/s2].
    """
    v, w = body_velocity(left, right, separation)
    goal_v, goal_w = body_velocity(left_target, right_target, separation)
    linear, angular, rim = limits
    half = separation / 2
    found: list[Phase] = []
    while dt > 0:
        rise_v, rise_w = goal_v - v, goal_w - w
        a = min(linear, rim) if abs(rise_v) > ROUNDING else 0.0
        b = min(angular, rim / half) if abs(rise_w) > ROUNDING else 0.0
        if a and b:
            slower = min(1.0, rim / (a + b * half))
            a, b = a * slower, b * slower
        ends = [abs(rise) / rate for rise, rate in ((rise_v, a), (rise_w, b)) if rate]
        if not ends or min(ends) == 0:  # infinite limits were applied when the command arrived
            found.append((dt, 0.0, 0.0))
            break
        h = min(*ends, dt)
        dv, dw = math.copysign(a, rise_v), math.copysign(b, rise_w)
        found.append((h, dv - dw * half, dv + dw * half))
        v, w = v + dv * h, w + dw * h
        dt -= h
    return found


Speeds = tuple[float, float, float]
"""Speeds ahead and to the left side [m/s], and rate of turn to the left [rad/s]."""


def ramps(speeds: Speeds, targets: Speeds, limits: Speeds, dt: float) -> list[tuple[float, Speeds]]:
    """Divide `dt` seconds into phases in which each speed approaches its target at its limit: durations and rates."""
    rises = tuple(target - speed for speed, target in zip(speeds, targets, strict=True))
    ends = [abs(rise) / limit for rise, limit in zip(rises, limits, strict=True)]
    found: list[tuple[float, Speeds]] = []
    begin = 0.0
    for end in sorted({*(end for end in ends if end < dt), dt}):
        if end > begin:
            a, b, c = (
                math.copysign(limit, rise) if arrival > begin else 0.0
                for rise, limit, arrival in zip(rises, limits, ends, strict=True)
            )
            found.append((end - begin, (a, b, c)))
            begin = end
    return found


def glide(pose: Pose, speeds: Speeds, rates: Speeds, dt: float) -> Pose:
    """Return a holonomic robot's pose after `dt` seconds at these speeds, which change at these rates.

    At constant speeds its path is an arc too: that of a unicycle whose heading is turned by the direction of
    (v, vy).
    """
    v, vy, w = speeds
    dv, dvy, dw = rates
    x, y, theta = pose
    if not (dv or dvy or dw):
        aside = math.atan2(vy, v)
        px, py, _ = arc((x, y, theta + aside), math.hypot(v, vy), w, dt)
        return (px, py, theta + w * dt)
    if w == 0 and dw == 0:
        ahead, left = v * dt + dv * dt * dt / 2, vy * dt + dvy * dt * dt / 2
        c, s = math.cos(theta), math.sin(theta)
        return (x + c * ahead - s * left, y + s * ahead + c * left, theta)
    # a speed to the left is a speed ahead with the heading turned by 90 degrees
    px, py, heading = unicycle(pose, v, w, dv, dw, dt)
    qx, qy, _ = unicycle((0.0, 0.0, theta + math.pi / 2), vy, w, dvy, dw, dt)
    return (px + qx, py + qy, heading)


def unicycle(pose: Pose, v: float, w: float, dv: float, dw: float, dt: float) -> Pose:
    """Return a robot's pose after `dt` seconds with the speeds v + dv t ahead [m/s] and w + dw t to the left [rad/s].

    At constant speeds the path is an arc, without a turn a line, both exact. Otherwise x is the integral of (v + dv t)
    cos(theta + w t + dw t^2 / 2), a Fresnel integral without an elementary form: Gauss-Legendre quadrature, exact to
    the last digits.
    """
    if dv == 0 and dw == 0:
        return arc(pose, v, w, dt)
    x, y, theta = pose
    if w == 0 and dw == 0:
        way = v * dt + dv * dt * dt / 2
        return (x + way * math.cos(theta), y + way * math.sin(theta), theta)
    turned = w * dt + dw * dt * dt / 2
    count = math.ceil(max(abs(w), abs(w + dw * dt), math.sqrt(abs(dw))) * dt / PANEL) or 1
    step = dt / count
    for panel in range(count):
        for node, weight in _NODES:
            t = (panel + node) * step
            way = (v + dv * t) * weight * step
            heading = theta + w * t + dw * t * t / 2
            x += way * math.cos(heading)
            y += way * math.sin(heading)
    return (x, y, theta + turned)
