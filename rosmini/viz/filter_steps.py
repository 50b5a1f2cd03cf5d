"""A particle filter on a map, step by step: a slider in the page, and as a still picture its last step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.geometry.poses import Pose
from rosmini.geometry.products import matrix_product, scalar_product
from rosmini.navigation.map_server import GridMap
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_colours import painted
from rosmini.viz.map_pictures import cells_element, gif_address
from rosmini.viz.moving_view import MovingView
from rosmini.viz.rounding import fixed
from rosmini.viz.rviz.gifs import gif
from rosmini.viz.svg import document, element
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural
from rosmini.viz.world_pictures import pose_of

Floats = NDArray[np.float64]

MOST = 400
"""Particles of one step that are shown."""
HEAVIEST = 100
"""Of these, so many are the heaviest; the others stand for the rest."""
LONGEST = 200
"""Steps."""
TICK = 0.25
"""How long a particle's stroke is [m]."""
CONTROLS = 90
"""The height of the slider, about [px]."""
LEVELS = 255


@dataclass(frozen=True, eq=False)
class Step:
    """What there is after one step."""

    name: str
    particles: Floats
    weights: Floats
    truth: Pose | None
    count: int
    """Of all particles, of which some are shown."""
    spread: float
    """The root of the mean square of their distances from their mean [m]."""
    off: float | None
    """How far their mean is from the truth [m]."""

    def text(self) -> str:
        """How many there are, how far apart, and how far from the truth."""
        off = "" if self.off is None else f", mean {fixed(self.off, 1)} m from the truth"
        return f"{self.name}: {plural(self.count, 'particle')}, spread {fixed(self.spread, 1)} m{off}"


def filter_steps(
    grid: GridMap, *, steps: Sequence[tuple[str, ArrayLike, ArrayLike | None, Any]], title: str | None = None
) -> FilterSteps:
    """Show what a filter did on a map, step by step.

    Args:
        grid: the map; its frame is the particles'.
        steps: (name, particles (n, 3), weights (n,) or None if all are equal, the robot's true pose or None), in order.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: it is no map, or there are no steps or too many, or one has arrays that do not fit together.

    """
    if not isinstance(grid, GridMap):
        raise ViewError(f"steps of a filter are shown on a GridMap, not on a {type(grid).__name__}")
    if not 1 <= len(steps) <= LONGEST:
        raise ViewError(f"of a filter 1 to {LONGEST} steps can be shown, not {len(steps)}")
    return FilterSteps(grid, [_step(*each) for each in steps], title)


def _step(name: str, particles: ArrayLike, weights: ArrayLike | None, truth: Any) -> Step:
    poses = np.asarray(particles, dtype=float)
    if poses.ndim != 2 or poses.shape[1] != 3 or not len(poses) or not np.isfinite(poses).all():
        raise ViewError(
            f"particles of the step {name!r} are rows of finite x, y and heading, not {poses.shape}"
        )
    given = np.ones(len(poses)) if weights is None else np.asarray(weights, dtype=float)
    if given.shape != (len(poses),) or not np.isfinite(given).all() or (given < 0).any() or given.sum() <= 0:
        raise ViewError(
            f"weights of the step {name!r} are {len(poses)} numbers, none below 0 and one above, not {given.shape}"
        )
    pose = None if truth is None else pose_of(truth, "the true pose")
    shares = given / given.sum()
    mean = matrix_product(shares, poses[:, :2])
    spread = math.sqrt(scalar_product(shares, np.square(poses[:, :2] - mean).sum(axis=1)))
    off = None if pose is None else math.dist(mean, pose[:2])
    shown = _shown(np.round(given / given.max(), 3))
    return Step(name, poses[shown], given[shown] / given.max(), pose, len(poses), spread, off)


def _shown(weights: Floats) -> NDArray[np.int64]:
    """Which particles are drawn, the heaviest last."""
    order = np.argsort(weights, kind="stable").astype(np.int64)
    if len(order) <= MOST:
        return order
    rest, heavy = np.sort(order[:-HEAVIEST]), order[-HEAVIEST:]
    every = np.linspace(0, len(rest) - 1, MOST - HEAVIEST).astype(np.int64)
    return np.concatenate([rest[every], heavy])


class FilterSteps(MovingView):
    """What `filter_steps` gives."""

    scripts = ("rosmini-filter-steps.js",)
    call = "rosminiFilterSteps.mount"
    usual_name = "particle filter"

    def __init__(self, grid: GridMap, steps: list[Step], title: str | None) -> None:
        self._grid, self._steps, self.title = grid, steps, title
        height, width = grid.occupancy.shape
        self._size = width * grid.resolution, height * grid.resolution
        self._ground = gif_address(gif(painted(grid.occupancy.view(np.uint8), "map")[::-1])[0])

    @property
    def text(self) -> str:
        """How many steps, and what there was after the first and the last."""
        lines = [f"{self.name}: {plural(len(self._steps), 'step')}"]
        ends = self._steps if len(self._steps) == 1 else (self._steps[0], self._steps[-1])
        return "\n".join([*lines, *(each.text() for each in ends)])

    @property
    def alt(self) -> str:
        """The same in sentences."""
        head, *lines = self.text.split("\n")
        return f"Particles on a map from above. {head}. First, {'. In the end, '.join(lines)}."

    @property
    def svg(self) -> str:
        """The still picture: the last step."""
        wide, high = self._size
        scale = WIDTH / wide
        left, low, _ = self._grid.origin
        last = self._steps[-1]

        def at(x: float, y: float) -> str:
            return f"{(x - left) * scale:.1f} {(high - y + low) * scale:.1f}"

        image = cells_element(self._ground, width=WIDTH, height=high * scale)
        strokes = "".join(
            f"M{at(x, y)}L{at(x + TICK * math.cos(yaw), y + TICK * math.sin(yaw))}"
            for x, y, yaw in last.particles.tolist()
        )
        parts = [image, element("path", d=strokes, class_="rm-particles")]
        if last.truth is not None:
            x, y = at(*last.truth[:2]).split()
            parts.append(element("circle", cx=x, cy=y, r=7, class_="rm-truth"))
        css = ".rosmini-svg .rm-particles{stroke:#d55e00;stroke-width:1.5}"
        css += ".rosmini-svg .rm-truth{fill:none;stroke:#009e73;stroke-width:3}"
        title = self.name
        return document(
            "".join(parts), width=WIDTH, height=high * scale, title=title, alt=self.alt, css=css, colours=[]
        )

    @property
    def height(self) -> int:
        """With the controls, about [CSS px]."""
        return int(round(WIDTH * self._size[1] / self._size[0]) + CONTROLS)

    @property
    def data(self) -> dict[str, Any]:
        """What the page's script gets: centimetres from the map's corner, headings and weights as bytes."""
        left, low, _ = self._grid.origin

        def centimetres(poses: Floats) -> NDArray[np.int64]:
            found = np.rint((poses[:, :2] - (left, low)) * 100).astype(np.int64)
            return np.clip(found, -32_768, 32_767)

        def turns(headings: Floats) -> NDArray[np.uint8]:
            return (np.rint(headings / math.tau * (LEVELS + 1)).astype(np.int64) % (LEVELS + 1)).astype(
                np.uint8
            )

        poses = np.concatenate([each.particles for each in self._steps])
        weights = np.concatenate([each.weights for each in self._steps])
        return {
            "ground": self._ground,
            "size": [round(side, 3) for side in self._size],
            "tick": TICK,
            "steps": [
                {
                    "said": each.text(),
                    "shown": len(each.particles),
                    "truth": None
                    if each.truth is None
                    else [round(v, 2) for v in (each.truth[0] - left, each.truth[1] - low, each.truth[2])],
                }
                for each in self._steps
            ],
            "places": centimetres(poses).astype("<i2").tobytes(),
            "headings": turns(poses[:, 2]).tobytes(),
            "weights": np.rint(weights * LEVELS).astype(np.uint8).tobytes(),
        }
