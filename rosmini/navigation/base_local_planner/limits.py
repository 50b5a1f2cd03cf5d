"""Velocity limits and goal tolerances: the parameters that local planners have in common."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.parameters import Parameters, parameter


@dataclass(frozen=True)
class LocalPlannerLimits(Parameters):
    """The parameters of `base_local_planner/local_planner_limits`, all of which can change at run time."""

    max_vel_trans: float = parameter(0.55, "the highest speed", unit="m/s", minimum=0.0)
    min_vel_trans: float = parameter(0.1, "the minimum translational speed", unit="m/s", minimum=0.0)
    max_vel_x: float = parameter(0.55, "the highest velocity ahead", unit="m/s")
    min_vel_x: float = parameter(0.0, "the lowest velocity ahead; negative values allow reversing", unit="m/s")
    max_vel_y: float = parameter(0.1, "the highest velocity to the left", unit="m/s")
    min_vel_y: float = parameter(-0.1, "the lowest velocity to the left; negative: to the right", unit="m/s")
    max_vel_theta: float = parameter(1.0, "the fastest turn", unit="rad/s", minimum=0.0)
    min_vel_theta: float = parameter(0.4, "the minimum turning speed", unit="rad/s", minimum=0.0)
    acc_lim_x: float = parameter(2.5, "acceleration ahead", unit="m/s2", minimum=0.0, maximum=20.0)
    acc_lim_y: float = parameter(2.5, "acceleration to the side", unit="m/s2", minimum=0.0, maximum=20.0)
    acc_lim_theta: float = parameter(3.2, "acceleration of turns", unit="rad/s2", minimum=0.0, maximum=20.0)
    acc_lim_trans: float = parameter(0.1, "acceleration in any direction; not used", unit="m/s2", minimum=0.0)
    prune_plan: bool = parameter(False, "drop the part of the plan more than 1 m behind the robot")
    xy_goal_tolerance: float = parameter(0.1, "tolerance of the position at the goal", unit="m")
    yaw_goal_tolerance: float = parameter(0.1, "tolerance of the heading at the goal", unit="rad")
    trans_stopped_vel: float = parameter(0.1, "the robot counts as stopped up to this speed", unit="m/s")
    theta_stopped_vel: float = parameter(0.1, "the robot counts as stopped up to this turning speed", unit="rad/s")

    @property
    def accelerations(self) -> NDArray[np.float64]:
        """Maximum accelerations in x, y and theta (3) [m/s2, m/s2, rad/s2]."""
        return np.array([self.acc_lim_x, self.acc_lim_y, self.acc_lim_theta])
