"""The message that amcl publishes on `/diagnostics`: standard deviations, and whether one is too large."""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from rosmini.core.time import Time
from rosmini.msgs import message_class

from .parameters import AmclParameters

AXES = ("x", "y", "yaw")


def deviations(node_name: str, covariance: NDArray[Any], limits: AmclParameters, stamp: Time) -> Any:
    """Return a `diagnostic_msgs/DiagnosticArray` for a covariance (3, 3) of x, y [m2] and heading [rad2]."""
    spread = [math.sqrt(max(0.0, float(covariance[axis, axis]))) for axis in range(3)]
    allowed = [getattr(limits, f"std_warn_level_{axis}") for axis in AXES]
    status = message_class("diagnostic_msgs/DiagnosticStatus")()
    too_large = any(0 < limit < value for value, limit in zip(spread, allowed, strict=True))
    status.level = status.WARN if too_large else status.OK
    status.name = f"{node_name.lstrip('/')}: Standard deviation"
    status.message = "Too large" if too_large else "OK"
    status.hardware_id = "None"
    pairs = [
        *zip(AXES, spread, strict=True),
        *((f"warn_level_{a}", v) for a, v in zip(AXES, allowed, strict=True)),
    ]
    pair = message_class("diagnostic_msgs/KeyValue")
    status.values = [pair(key=f"std_{name}", value=f"{value:.6g}") for name, value in pairs]
    message = message_class("diagnostic_msgs/DiagnosticArray")()
    message.header.stamp = stamp
    message.status = [status]
    return message
