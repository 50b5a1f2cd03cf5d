"""The state of gmapping: a particle's map, its path, and the tree of all paths; as a picture or a player.

Paths of particles that died exist only where a living particle shares them; resampling discards the rest.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.gmapping import Film, GridSlam, known
from rosmini.viz.figures import WIDTH, house_style, legend, legend_width
from rosmini.viz.map_pictures import Cells, cells_image
from rosmini.viz.replay import Body, Grid, Grids, ReplayView, Run, Shape, Shapes, replay
from rosmini.viz.rounding import fixed
from rosmini.viz.style import LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.words import plural
from rosmini.viz.world_drawing import draw_strokes
from rosmini.viz.world_pictures import HEIGHT, LEFT, length_of, map_axes

Floats = NDArray[np.float64]
BEST, OTHERS = "blue", "orange"
"""Colours of the path of the particle shown, and of all others."""
OCC_THRESH = 0.25
"""The default of `occ_thresh`."""


def slam_picture(
    slam: GridSlam,
    *,
    particle: int | None = None,
    threshold: float = OCC_THRESH,
    title: str | None = None,
    size: tuple[float, float] = (WIDTH, HEIGHT),
) -> Picture:
    """Draw the map of a particle and, above it, the paths of all particles.

    Args:
        slam: the filter, after its first scan.
        particle: the index of the particle; by default the best.
        threshold: cells are occupied if more than this share of their visits are ends of beams (`occ_thresh`).
        title: a caption, and the first words of the text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: it is not a filter, has no such particle, or has not processed a scan.

    """
    if not isinstance(slam, GridSlam):
        raise ViewError(
            f"slam_picture needs a GridSlam, not a {type(slam).__name__}; for a node, use node.program.slam"
        )
    count = len(slam.poses)
    which = slam.best if particle is None else particle
    if not 0 <= which < count:
        raise ViewError(f"there are particles 0 to {count - 1}, not {particle}")
    if not slam.processed:
        raise ViewError("no scan has been processed yet: there is no map to draw")
    shares, extent = known(slam, which)
    cells = np.where(shares < 0, 255, np.where(shares > threshold, 100, 0)).astype(np.uint8)
    delta = slam.settings.delta
    drawn = Cells(cells, delta, (extent.column * delta, extent.row * delta, 0.0))
    own = np.array([node.pose[:2] for node in slam.path(which)])
    said = _text(slam, which, cells, own)
    with house_style():
        from matplotlib.lines import Line2D

        handles = [
            Line2D([], [], color=LIGHT[colour], linewidth=2.0, label=label)
            for colour, label in ((BEST, "its path"), (OTHERS, "paths of the others"))
        ]
        (x0, y0), (x1, y1) = drawn.corners()[[0, 2]].tolist()
        figure, axes, _ = map_axes((x0, y0, x1, y1), size, legend_width(handles))
        image = cells_image(figure, axes, drawn, "map")
        pairs = [np.stack([line[:-1], line[1:]], axis=1) for line in slam.branches()]
        if pairs:
            draw_strokes(axes, np.concatenate(pairs), OTHERS, 1.2)
        if len(own) > 1:
            draw_strokes(axes, np.stack([own[:-1], own[1:]], axis=1), BEST, 2.0)
        legend(figure, handles, LEFT)
        return matplotlib_picture(
            figure, text=f"{title or 'gmapping'}: {said}", form="svg", caption=title, under=image,
            steady=(BEST, OTHERS),
            alt=f"A map from above, and on it the paths of all particles as a tree. {said}",
        )  # fmt: skip


def _text(slam: GridSlam, which: int, cells: NDArray[np.uint8], own: Floats) -> str:
    height, width = (n * slam.settings.delta for n in cells.shape)
    name = "the best particle" if which == slam.best else f"particle {which}"
    return (
        f"the map of {name}: {fixed(width, 1)} x {fixed(height, 1)} m, "
        f"{fixed(100 * float(np.mean(cells == 100)), 0)} % of it occupied; its path: {plural(len(own), 'scan')}, "
        f"{fixed(length_of(own), 1)} m; {slam.surviving_counts()[0]} of the first {len(slam.poses)} particles live on"
    )


def slam_film(film: Film, *, title: str | None = None) -> ReplayView:
    """Play how a map grew: the best particle's map, the paths of all, and its estimate of the robot's pose.

    Raises:
        ViewError: it is not a film, or it is empty.

    """
    if not isinstance(film, Film):
        raise ViewError(
            f"slam_film needs a Film, not a {type(film).__name__}; add the reports of GridSlam.process to it"
        )
    if not film.frames:
        raise ViewError("the film is empty: call film.take(report) for each processed scan")
    times = np.array([frame.time for frame in film.frames])
    delta = film.slam.settings.delta
    grids = tuple(Grid(frame.cells.view(np.uint8), delta, (*frame.corner, 0.0)) for frame in film.frames)
    paths = tuple(tuple(Shape("line", line, OTHERS) for line in frame.branches) for frame in film.frames)
    robot = Body("best particle", times, np.array([frame.pose for frame in film.frames]))
    layers = Grids("map", times, grids, scheme="map"), Shapes("paths of all particles", times, paths)
    run = Run("gmapping", float(times[0]), float(times[-1]), (robot,), layers, frame="map")
    return replay(run, title=title)
