"""A recorded run: what one robot did, meant and saw, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .models import RobotModel
from .world import World


@dataclass(frozen=True, eq=False)
class Recording:
    """A run of one robot. All times are seconds since the begin of the run, all poses x [m], y [m], heading [rad].

    `truth` and `odom` are sampled at `times`; each of them is in its own frame (`map` and `odom`), as the messages were.
    """

    world: World
    model: RobotModel
    times: NDArray[np.float64]
    """(n,)"""
    truth: NDArray[np.float64]
    """(n, 3): where the robot was."""
    odom: NDArray[np.float64]
    """(n, 3): where its odometry said that it was; headings are not wrapped."""
    commands: NDArray[np.float64]
    """(m, 3): time, linear [m/s] and angular [rad/s] velocity of each command."""
    scan_times: NDArray[np.float64]
    """(k,)"""
    scans: NDArray[np.float64]
    """(k, beams): ranges [m], inf where nothing was hit; beam i looks at 2 pi i / beams from ahead, counter-clockwise."""
