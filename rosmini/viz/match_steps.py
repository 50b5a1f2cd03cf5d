"""How a scan climbs onto a map of hector_mapping: one step of Gauss-Newton after the other, as a player."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose, transform_points
from rosmini.navigation.hector_mapping import OccupancyGrid, match
from rosmini.viz.replay import Body, Grid, Grids, ReplayView, Run, Shape, Shapes, replay
from rosmini.viz.view import ViewError

MARGIN = 0.3
"""Beside what is shown [m]."""
UNKNOWN = 255


def match_steps(
    grid: OccupancyGrid,
    points: NDArray[np.float64],
    pose: Pose,
    *,
    steps: int = 8,
    title: str | None = None,
) -> ReplayView:
    """Play a match: a second of the player is a step; the map is as grey as it is likely to be occupied.

    Args:
        grid: the map.
        points: where the beams ended (n, 2) [m], in the robot's frame.
        pose: where the search begins.
        steps: so many are made.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: there are no points.

    """
    if not len(points):
        raise ViewError("a scan without ends cannot be put on a map")
    poses = list(
        itertools.accumulate(range(steps), lambda here, _: match(grid, points, here, 0).pose, initial=pose)
    )
    times = np.arange(len(poses), dtype=float)
    likely = np.where(grid.odds == 0, UNKNOWN, np.rint(100 * grid.probabilities)).astype(np.uint8)
    half = grid.resolution / 2
    shown = Grid(likely, grid.resolution, (grid.origin[0] - half, grid.origin[1] - half, 0.0))
    ends = [transform_points(here, points) for here in poses]
    every = np.concatenate(ends)
    (x0, y0), (x1, y1) = every.min(axis=0) - MARGIN, every.max(axis=0) + MARGIN
    run = Run(
        "match",
        0.0,
        float(times[-1]),
        (Body("robot", times, np.array(poses)),),
        (
            Grids("probability", times[:1], (shown,), scheme="map"),
            Shapes("ends of the beams", times, tuple((Shape("points", end, "vermilion"),) for end in ends)),
        ),
        frame="map",
        bounds=(float(x0), float(y0), float(x1), float(y1)),
    )
    return replay(run, title=title)
