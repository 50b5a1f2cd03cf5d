"""The stepped players of the book's chapters: algorithms step by step, and parameters with their effects.

Each function computes the frames of one `rosmini.viz.stepped_player.SteppedPlayer`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.core.geometry.products import matrix_product, scalar_product
from rosmini.core.maps import GridMap
from rosmini.core.maps.map_io import MODES, Fields, MapFile, Mode, occupancy_of
from rosmini.navigation.base_local_planner.trajectory import Samples
from rosmini.navigation.costmap_2d.costmap import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION, Costmap2D
from rosmini.navigation.costmap_2d.inflation import cell_distance, cost_at, inflated
from rosmini.navigation.hector_mapping import OccupancyGrid, match
from rosmini.navigation.navfn import Search
from rosmini.viz import map_pictures
from rosmini.viz.costmap_pictures import cells_of, published, shares
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_colours import painted
from rosmini.viz.map_pictures import cells_element
from rosmini.viz.rounding import fixed, points_to_keep, snap
from rosmini.viz.rviz.gifs import gif, gif_url
from rosmini.viz.search_pictures import WAITING, describe_search, greys_of, path_of, shades
from rosmini.viz.stepped_player import GAP, Axis, Frame, Panel, SteppedPlayer
from rosmini.viz.style import LABEL_SIZE, variable
from rosmini.viz.svg import element, escape
from rosmini.viz.view import ViewError
from rosmini.viz.words import plural
from rosmini.viz.world_pictures import pose_of, pose_text

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

WHITE = element("rect", width="100%", height="100%", fill="#fefefe")
"""A background for cells that are transparent where they are free; pure white would follow the theme of the page."""


def _image(pixels: Bytes, width: float, height: float) -> str:
    """Return pixels (h, w, 4), row 0 at the top, as an image in a panel's top left corner."""
    return cells_element(gif_url(gif(pixels)[0]), width=width, height=height)


def _path(points: ArrayLike, kind: str, close: str = "") -> str:
    """Return a line through points (n, 2) [px]."""
    line = "L".join(f"{x:.1f} {y:.1f}" for x, y in np.asarray(points).tolist())
    return element("path", d=f"M{line}{close}", class_=kind)


# -- chapter on maps: thresholds -----------------------------------------------------------------------------------

MAX_IMAGE = 256
"""Maximum side of a map image [px]."""
FREE_THRESHOLDS = (0.1, 0.196, 0.25, 0.3, 0.4)
OCCUPIED_THRESHOLDS = (0.3, 0.4, 0.5, 0.65, 0.8)


def map_steps(file: MapFile, *, title: str | None = None) -> SteppedPlayer:
    """Show the image of a map and the map that map_server makes of it, for several thresholds and modes.

    Args:
        file: the description of a map: `map_file("house.yaml")`.
        title: a caption, and the first words of the text form.

    Raises:
        MapError: the image cannot be read.
        ViewError: the image has colours, or is too large.

    """
    if not isinstance(file, MapFile):
        raise ViewError(f"map_steps needs the description of a map, map_file(...), not a {type(file).__name__}")
    fields, pixels, image = file.fields, file.pixels(), file.image.name
    height, width, channels = pixels.shape
    if channels != 1:
        raise ViewError(f"{image} has {channels} channels, but only grey images can be shown for several thresholds")
    if max(height, width) > MAX_IMAGE:
        raise ViewError(f"{image} has {width} x {height} pixels; at most {MAX_IMAGE} a side can be shown")
    wide = (WIDTH - GAP) / 2
    high = wide * height / width
    frees = sorted({*FREE_THRESHOLDS, fields.free_thresh})
    occupieds = sorted({*OCCUPIED_THRESHOLDS, fields.occupied_thresh})

    def frame(free: float, occupied: float, mode: Mode, negate: bool) -> Frame:
        given = Fields(image, fields.resolution, fields.origin, occupied, free, negate, mode)
        grid = GridMap(occupancy_of(pixels, given), fields.resolution, fields.origin)
        drawn = _image(painted(grid.occupancy.view(np.uint8)[::-1], "map"), wide, high)
        text = ", ".join(map_pictures.shares(grid))
        if occupied < free and mode != "raw":
            text += "\noccupied_thresh is below free_thresh, so the greys between are occupied."
        return Frame(["", drawn], text)

    axes = [
        Axis("free_thresh", [f"{value:g}" for value in frees]),
        Axis("occupied_thresh", [f"{value:g}" for value in occupieds]),
        Axis("mode", MODES),
        Axis("negate", ["0", "1"]),
    ]
    frames = [frame(*values) for values in itertools.product(frees, occupieds, MODES, (False, True))]
    first = (
        frees.index(fields.free_thresh),
        occupieds.index(fields.occupied_thresh),
        MODES.index(fields.mode),
        int(fields.negate),
    )
    name = title or "map image"
    numbers = (
        f"mode {fields.mode}, negate {int(fields.negate)}, free_thresh {fields.free_thresh:g}, "
        f"occupied_thresh {fields.occupied_thresh:g}"
    )
    parts = frame(fields.free_thresh, fields.occupied_thresh, fields.mode, fields.negate).text.partition("\n")[0]
    ground = _image(painted(pixels[::-1, :, 0], "raw"), wide, high)
    return SteppedPlayer(
        name, [Panel("image", wide, high, ground), Panel("map", wide, high)], axes, frames,
        text=f"{name}: {image}, {width} x {height} pixels\n{numbers}\n{parts}",
        alt=f"On the left a grey image, {image}; on the right the map made from it. With {numbers}: {parts}.",
        title=title, first=first,
    )  # fmt: skip


# -- chapter on costmaps: inflation --------------------------------------------------------------------------------

MAX_COSTMAP = 400
"""Maximum side of a costmap [cells]."""
INFLATION_RADII = (0.2, 0.4, 0.6, 1.0)
SCALING_FACTORS = (1.0, 5.0, 10.0, 25.0)
INSCRIBED_RADII = (0.15, 0.3, 0.45)
CURVE = (330.0, 150.0)
"""Size of the panel with the cost by distance [CSS px]."""


def inflation_steps(
    grid: Costmap2D,
    *,
    inscribed_radius: float = 0.105,
    inflation_radius: float = 0.55,
    cost_scaling_factor: float = 10.0,
    window: Sequence[int] | None = None,
    title: str | None = None,
) -> SteppedPlayer:
    """Show how inflation changes a costmap, for several values of its three numbers.

    Args:
        grid: the costs. Obstacles (254) and unknown cells (255) are used, all other costs are ignored.
        inscribed_radius: initial inscribed radius of the robot [m].
        inflation_radius: initial inflation radius, the largest distance with a cost [m].
        cost_scaling_factor: initial exponent of the decay [1/m].
        window: show only these cells: first column, first row, and the column and row after the last.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: `grid` is not a costmap, or is too large.

    """
    cells = cells_of(grid, window)
    height, width = cells.values.shape
    if max(height, width) > MAX_COSTMAP:
        raise ViewError(
            f"the costmap has {width} x {height} cells, but at most {MAX_COSTMAP} a side can be shown: give window="
        )
    obstacles = np.isin(cells.values, (LETHAL_OBSTACLE, NO_INFORMATION))
    base = Costmap2D.of(np.where(obstacles, cells.values, FREE_SPACE), cells.resolution, cells.origin[:2])
    radii = sorted({*INFLATION_RADII, inflation_radius})
    factors = sorted({*SCALING_FACTORS, cost_scaling_factor})
    inscribed = sorted({*INSCRIBED_RADII, inscribed_radius})
    scale = min(WIDTH / width, 480 / height)

    def frame(radius: float, factor: float, inner: float) -> Frame:
        reach = cell_distance(radius, cells.resolution)
        costs = inflated(base, inscribed_radius=inner, inflation_radius=radius, cost_scaling_factor=factor).costs
        text = ", ".join(shares(costs))
        if radius < inner:
            text += "\nThe inflation radius is below the inscribed radius: plans lead where the robot does not fit."
        pixels = painted(published(costs)[::-1], "costmap")
        curve = _cost_curve(reach * cells.resolution, factor, inner)
        return Frame([_image(pixels, width * scale, height * scale), curve], text)

    axes = [
        Axis("inflation_radius", [f"{value:g} m" for value in radii]),
        Axis("cost_scaling_factor", [f"{value:g}" for value in factors]),
        Axis("inscribed radius", [f"{value:g} m" for value in inscribed]),
    ]
    first = (radii.index(inflation_radius), factors.index(cost_scaling_factor), inscribed.index(inscribed_radius))
    name = title or "inflation"
    numbers = (
        f"inflation_radius {inflation_radius:g} m, cost_scaling_factor {cost_scaling_factor:g}, "
        f"inscribed radius {inscribed_radius:g} m"
    )
    parts = frame(inflation_radius, cost_scaling_factor, inscribed_radius).text.partition("\n")[0]
    return SteppedPlayer(
        name,
        [
            Panel("", width * scale, height * scale, WHITE),
            Panel("cost by distance from the nearest obstacle [m]", *CURVE, _curve_axes()),
        ],
        axes,
        [frame(*values) for values in itertools.product(radii, factors, inscribed)],
        text=f"{name}: {width} x {height} cells of {cells.resolution:g} m\n{numbers}\n{parts}",
        alt=f"A costmap from above, inflated with {numbers}. Of its cells are {parts}.",
        title=title,
        first=first,
        css=f".rosmini-svg .rm-curve{{fill:none;stroke:{variable('blue')};stroke-width:2}}"
        f".rosmini-svg .rm-axis{{stroke:{variable('group-line')}}}.rosmini-svg .rm-tick{{fill:{variable('muted')}}}",
        colours=["blue", "group-line", "muted"],
    )


def _on_curve(distance: float, cost: float) -> tuple[float, float]:
    return 34 + 280 * distance / 1.5, 125 - 110 * cost / 254


def _curve_axes() -> str:
    (left, low), (right, high) = _on_curve(0, 0), _on_curve(1.5, 254)
    ticks = [(f"{d:g}", _on_curve(d, 0)[0], low + 16, "middle") for d in (0.0, 0.5, 1.0, 1.5)]
    ticks += [("0", left - 6, low + 4, "end"), ("254", left - 6, high + 4, "end")]
    return element("path", d=f"M{left:g} {high:g}V{low:g}H{right:g}", fill="none", class_="rm-axis") + "".join(
        element("text", word, x=x, y=y, text_anchor=anchor, font_size=LABEL_SIZE, class_="rm-tick")
        for word, x, y, anchor in ticks
    )


def _cost_curve(reach: float, factor: float, inner: float) -> str:
    """Return the cost by distance up to 1.5 m; `reach` is the inflation radius, rounded up to whole cells."""
    distances = np.linspace(0, min(reach, 1.5), 40).tolist()
    points = [_on_curve(distance, cost_at(distance, inner, factor)) for distance in distances]
    return _path([*points, _on_curve(reach, 0), _on_curve(max(reach, 1.5), 0)], "rm-curve")


# -- chapter on global planners: searches --------------------------------------------------------------------------

MAX_GRID = 16_384
"""Maximum number of cells of a grid."""
BATCHES = 2_000
"""Approximate number of batches in which a search is recorded."""
SEARCH_FRAMES = 60
"""Maximum number of frames of a search."""


def search_steps(searches: Mapping[str, Search], *, title: str | None = None) -> SteppedPlayer:
    """Run searches to their ends and show them side by side, each after the same number of expanded cells.

    Args:
        searches: the searches by name, none of them started, on grids of the same size.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: there is no search, a search has started, or the grids differ in size or are too large.

    """
    if not searches or not all(isinstance(each, Search) for each in searches.values()):
        raise ViewError("searches are given by name: {'Dijkstra': NavfnSearch(...), 'A*': ...}")
    sizes = {(each.width, each.height) for each in searches.values()}
    if len(sizes) > 1:
        raise ViewError(f"searches that are shown side by side need grids of one size, not of {sorted(sizes)}")
    ((width, height),) = sizes
    if width * height > MAX_GRID:
        raise ViewError(f"a grid of {width} x {height} cells is too large: at most {MAX_GRID} cells can be shown")
    for name, each in searches.items():
        if each.expanded:
            raise ViewError(f"the search {name!r} has started: give one that has not been expanded")
    reached_after = [_recorded(each) for each in searches.values()]
    longest = max(each.expanded for each in searches.values())
    step = max(1, math.ceil(longest / SEARCH_FRAMES))
    expanded = [min(n * step, longest) for n in range(math.ceil(longest / step) + 1)]
    wide = (WIDTH - (len(searches) - 1) * GAP) / len(searches)
    scale = wide / width
    frames = []
    for count in expanded:
        drawn = [
            _search_frame(search, after, count, longest, scale)
            for search, after in zip(searches.values(), reached_after, strict=True)
        ]
        frames.append(Frame([picture for picture, _ in drawn], "\n".join(
            f"{name}: {text}" for name, (_, text) in zip(searches, drawn, strict=True)
        )))  # fmt: skip
    title_or_kind = title or "searches"
    lines = [f"{name}: {describe_search(each)}" for name, each in searches.items()]
    return SteppedPlayer(
        title_or_kind,
        [Panel(name, wide, height * scale) for name in searches],
        [Axis("step", [f"{n} of {len(frames) - 1}" for n in range(len(frames))])],
        frames,
        text="\n".join([title_or_kind, *lines]),
        alt=f"Searches side by side, from above. {'. '.join(lines)}.",
        title=title,
        still=[len(frames) - 1],
        css=".rosmini-svg .rm-route{fill:none;stroke:#d55e00;stroke-width:2.5}"
        ".rosmini-svg .rm-from{fill:#009e73}.rosmini-svg .rm-to{fill:#d55e00}",
        period=150,
    )


def _recorded(search: Search) -> NDArray[np.int64]:
    """Run a search to its end. Return the number of expanded cells after which each cell (h, w) was reached, or -1."""
    batch = max(1, search.width * search.height // BATCHES)
    after = np.where(search.reached, 0, -1).astype(np.int64)
    finished = False
    while not finished:
        finished = search.expand(batch)
        after[search.reached & (after < 0)] = search.expanded
    return after


def _search_frame(search: Search, after: NDArray[np.int64], count: int, longest: int, scale: float) -> tuple[str, str]:
    """Return the picture and the text of a search after `count` expanded cells."""
    reached = (after >= 0) & (after <= count)
    pixels = np.full((search.height, search.width, 4), 255, dtype=np.uint8)
    pixels[..., :3] = greys_of(search)[..., None]
    palette = shades()[:: len(shades()) // 50]  # few colours make small images
    pixels[reached, :3] = palette[after[reached] * (len(palette) - 1) // max(longest, 1)]
    done = count >= search.expanded
    if not done:
        pixels[reached & _beside(after > count), :3] = WAITING
    high = search.height * scale

    def at(points: ArrayLike) -> Floats:
        return (np.asarray(points, dtype=float) + 0.5) * (scale, -scale) + (0, high)

    path = path_of(search) if done else None
    parts = [_image(pixels[::-1], search.width * scale, high)]
    if path is not None:
        parts.append(_path(at(path), "rm-route"))
    for point, kind in ((search.start, "rm-from"), (search.goal, "rm-to")):
        x, y = at(point).tolist()
        parts.append(element("circle", cx=x, cy=y, r=max(3.0, scale / 4), class_=kind))
    end = "" if not done else ", no path" if path is None else ", arrived"
    return "".join(parts), f"{min(count, search.expanded)} cells taken up, {int(reached.sum())} reached{end}"


def _beside(cells: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the four neighbours of the given cells."""
    rim = np.pad(cells, 1)
    return rim[:-2, 1:-1] | rim[2:, 1:-1] | rim[1:-1, :-2] | rim[1:-1, 2:]


# -- chapter on local planners: trajectories -----------------------------------------------------------------------

SIDE = 440.0
"""Length of the longer side of the picture [CSS px]."""
LEGEND = 24.0
"""Height of the legend above it [CSS px]."""
MARGIN = 0.15
"""Space around the trajectories [m]."""
TOLERANCE = 0.004
"""Maximum distance of a drawn line from its points [m]."""
MAX_WINDOW = 200
"""Maximum side of a costmap below trajectories [cells]."""
SHADES = 5
OUTLINES = 2
"""Number of footprints along the chosen trajectory, without its start."""


def trajectory_steps(
    samples: Samples,
    *,
    costmap: Costmap2D | None = None,
    plan: ArrayLike | None = None,
    footprint: ArrayLike | None = None,
    chosen: int | None = None,
    title: str | None = None,
) -> SteppedPlayer:
    """Show the trajectories that a local planner tried in one cycle, with one of them highlighted.

    Cheap trajectories are dark blue, expensive ones are pale, and rejected ones are thin and vermilion. The slider goes
    from the cheapest to the most expensive and then to the rejected ones.

    Args:
        samples: `planner.samples`.
        costmap: the costs on which they were scored: `planner.costmap.grid`.
        plan: the plan (n, 2) or (n, 3) [m].
        footprint: the robot's outline (n, 2) [m] in its base frame.
        chosen: index of the trajectory that is shown first, by default the best.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: there are no trajectories, none has this index, or the costmap is too large.

    """
    if not isinstance(samples, Samples) or not len(samples):
        raise ViewError(
            "there are no trajectories to show: `samples` of a local planner has them after its first command"
        )
    if chosen is not None and not 0 <= chosen < len(samples):
        raise ViewError(f"there is no trajectory {chosen}: they have the numbers 0 to {len(samples) - 1}")
    if costmap is not None and max(costmap.width, costmap.height) > MAX_WINDOW:
        raise ViewError(
            f"the costmap has {costmap.width} x {costmap.height} cells, but at most {MAX_WINDOW} a side can be "
            "shown; the costmap of a local planner is a small window"
        )
    totals = np.array([float(fixed(value, 6)) for value in samples.totals])
    # the cheapest first, then the rejected ones, critic by critic
    rank = np.where(samples.accepted, -1, samples.rejected_by)
    order = np.lexsort((np.arange(len(totals)), np.where(samples.accepted, totals, 0.0), rank))
    if chosen is None:
        chosen = samples.best if samples.best is not None else int(order[0])
    outline = None if footprint is None else np.asarray(footprint, dtype=float)
    fan = _Fan(samples, costmap, outline)
    counts = {name: count for name, count in samples.counts().items() if name != "generator"}
    name = title or "trajectories"
    head = f"{name}: {len(samples)} of {len(samples) + samples.refused} velocities driven"
    rejected = "rejected: " + (", ".join(f"{critic} {count}" for critic, count in counts.items()) or "none")
    said = _trajectory_text(samples, chosen)
    return SteppedPlayer(
        name,
        [Panel("", fan.width, fan.height, fan.ground(order, plan))],
        [Axis("trajectory", [f"{n + 1} of {len(order)}" for n in range(len(order))])],
        [Frame([fan.drawn(int(n))], _trajectory_text(samples, int(n))) for n in order],
        text=f"{head}\n{said}\n{rejected}",
        alt=f"A fan of trajectories, {head}; {said}; {rejected}.",
        title=title,
        first=[int(np.flatnonzero(order == chosen)[0])],
        css=_FAN_CSS,
        colours=["ink", "muted", "blue", "vermilion", "green", "orange"],
    )


def _trajectory_text(samples: Samples, number: int) -> str:
    x, y, theta = (fixed(value, 3) for value in samples.commands[number])
    aside = f", {y} m/s to the left" if float(y) else ""
    word = "best" if number == samples.best else f"number {number}"
    said = f"{word}: {x} m/s ahead{aside}, {theta} rad/s"
    if samples.rejected_by[number] >= 0:
        return f"{said}, rejected by {samples.reason(number)}"
    row = samples.explain(number)
    total = row.pop("total") or 0.0
    parts = ", ".join(f"{critic} {fixed(value or 0.0, 2)}" for critic, value in row.items())
    return f"{said}, cost {fixed(total, 2)}: {parts}"


class _Fan:
    """The picture of a planner's trajectories, to scale."""

    def __init__(self, samples: Samples, costmap: Costmap2D | None, footprint: Floats | None) -> None:
        self._samples, self._footprint = samples, footprint
        self._costs: Bytes | None = None
        points = np.vstack([samples.trajectory(n)[:, :2] for n in range(len(samples))])
        reach = MARGIN if footprint is None else MARGIN + float(np.hypot(*footprint.T).max())
        low, high = snap(points.min(axis=0) - reach), snap(points.max(axis=0) + reach)
        if costmap is not None:  # show whole cells
            x0, y0 = costmap.world_to_map_clamped(*low)
            x1, y1 = costmap.world_to_map_clamped(*high)
            self._costs = published(costmap.costs[y0 : y1 + 1, x0 : x1 + 1])[::-1]
            low = np.array(costmap.origin) + np.array([x0, y0]) * costmap.resolution
            high = np.array(costmap.origin) + np.array([x1 + 1, y1 + 1]) * costmap.resolution
        self._low, self._high = low, high
        self._scale = SIDE / float((high - low).max())
        self.width = float(high[0] - low[0]) * self._scale
        self.height = float(high[1] - low[1]) * self._scale + LEGEND

    def _at(self, points: Floats) -> Floats:
        placed: Floats = (snap(points) - (self._low[0], self._high[1])) * (self._scale, -self._scale)
        placed += np.array([0.0, LEGEND])
        return placed

    def _line(self, points: Floats, kind: str) -> str:
        if len(points) < 2 or np.ptp(points, axis=0).max() < TOLERANCE:
            return ""
        placed = snap(points)
        return _path(self._at(placed[points_to_keep(placed, TOLERANCE)] if len(placed) > 2 else placed), kind)

    def ground(self, order: NDArray[np.int64], plan: ArrayLike | None) -> str:
        """Return the costs, all trajectories, and the plan."""
        x, parts = 0.0, []
        for text, kind in (("cheap", "t0"), ("dear", f"t{SHADES - 1}"), ("rejected", "tx"), ("chosen", "tb")):
            parts.append(_path([(x, 12.0), (x + 20, 12.0)], kind))
            parts.append(element("text", escape(text), x=x + 26, y=16.0, font_size=LABEL_SIZE, class_="tt"))
            x += 26 + 8.0 * len(text) + 12
        if self._costs is not None:
            address = gif_url(gif(painted(self._costs, "costmap"))[0])
            parts.append(cells_element(address, y=LEGEND, width=self.width, height=self.height - LEGEND, opacity="0.6"))
        accepted = int(self._samples.accepted.sum())
        for place, number in reversed(list(enumerate(order.tolist()))):
            kind = f"t{place * SHADES // accepted}" if place < accepted else "tx"
            parts.append(self._line(self._samples.trajectory(number)[:, :2], kind))
        if plan is not None:
            points = np.asarray(plan, dtype=float)[:, :2]
            parts.append(self._line(points[np.all((points >= self._low) & (points <= self._high), axis=1)], "tp"))
        return "".join(parts)

    def drawn(self, number: int) -> str:
        """Return one trajectory, highlighted, with footprints along it."""
        track = self._samples.trajectory(number)
        parts = [self._line(track[:, :2], "tb")]
        if self._footprint is not None and len(self._footprint) > 2:
            along = sorted({round((len(track) - 1) * n / OUTLINES) for n in range(OUTLINES + 1)})
            for place in along:
                x, y, yaw = track[place].tolist()
                points = self._at(transform_points((x, y, yaw), self._footprint))
                parts.append(_path(points, "tf te" if place == along[-1] else "tf", "Z"))
        return "".join(parts)


_FAN_CSS = (
    "".join(
        f".rosmini-svg .t{n}{{fill:none;stroke:{variable('blue')};stroke-width:1.2;"
        f"stroke-opacity:{0.9 - 0.17 * n:.2f}}}"
        for n in range(SHADES)
    )
    + f".rosmini-svg .tx{{fill:none;stroke:{variable('vermilion')};stroke-width:.7;stroke-opacity:.55}}"
    f".rosmini-svg .tp{{fill:none;stroke:{variable('green')};stroke-width:2;stroke-dasharray:5 3}}"
    f".rosmini-svg .tb{{fill:none;stroke:{variable('orange')};stroke-width:3}}"
    f".rosmini-svg .tf{{fill:none;stroke:{variable('ink')};stroke-width:1.4;stroke-opacity:.6}}"
    f".rosmini-svg .te{{stroke:{variable('orange')};stroke-opacity:1}}.rosmini-svg .tt{{fill:{variable('muted')}}}"
)


# -- chapter on amcl: particles ------------------------------------------------------------------------------------

MAX_PARTICLES = 400
"""Maximum number of particles that are drawn for a step."""
HEAVY_PARTICLES = 100
"""Number of the heaviest particles among these; the others are a sample of the rest."""
MAX_STEPS = 200
"""Maximum number of steps."""
STROKE = 0.25
"""Length of the stroke of a particle [m]."""
WEIGHTS = ("rm-light", "rm-middle", "rm-heavy")
"""Classes of the strokes, by weight."""


def filter_steps(
    grid: GridMap, *, steps: Sequence[tuple[str, ArrayLike, ArrayLike | None, Any]], title: str | None = None
) -> SteppedPlayer:
    """Show the steps of a particle filter on a map.

    Args:
        grid: the map; particles are in its frame.
        steps: (name, particles (n, 3), weights (n,) or None if all are equal, the robot's true pose or None), in order.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: `grid` is not a map, there are no steps or too many, or the arrays of a step do not match.

    """
    if not isinstance(grid, GridMap):
        raise ViewError(f"steps of a filter are shown on a GridMap, not on a {type(grid).__name__}")
    if not 1 <= len(steps) <= MAX_STEPS:
        raise ViewError(f"1 to {MAX_STEPS} steps of a filter can be shown, not {len(steps)}")
    rows, columns = grid.occupancy.shape
    scale = WIDTH / (columns * grid.resolution)
    high = rows * grid.resolution * scale
    frames = [_filter_frame(grid, scale, *each) for each in steps]
    name = title or "particle filter"
    texts = [frame.text for frame in frames]
    ends = [texts[0], texts[-1]][: len(texts)]
    head = f"{name}: {plural(len(steps), 'step')}"
    return SteppedPlayer(
        name,
        [Panel("", WIDTH, high, _image(painted(grid.occupancy.view(np.uint8)[::-1], "map"), WIDTH, high))],
        [Axis("step", [f"{n} of {len(steps)}" for n in range(1, len(steps) + 1)])],
        frames,
        text="\n".join([head, *ends]),
        alt=f"Particles on a map from above. {head}. First, {'. In the end, '.join(ends)}.",
        title=title,
        still=[len(steps) - 1],
        css=".rosmini-svg .rm-light{stroke:#e69f00;stroke-width:1.2}"
        ".rosmini-svg .rm-middle{stroke:#dd7e00;stroke-width:1.5}"
        ".rosmini-svg .rm-heavy{stroke:#d55e00;stroke-width:2}"
        ".rosmini-svg .rm-truth{fill:none;stroke:#009e73;stroke-width:3}",
    )


def _filter_frame(
    grid: GridMap, scale: float, name: str, particles: ArrayLike, weights: ArrayLike | None, truth: Any
) -> Frame:
    poses = np.asarray(particles, dtype=float)
    if poses.ndim != 2 or poses.shape[1] != 3 or not len(poses) or not np.isfinite(poses).all():
        raise ViewError(f"particles of the step {name!r} must be rows of finite x, y and heading, not {poses.shape}")
    given = np.ones(len(poses)) if weights is None else np.asarray(weights, dtype=float)
    if given.shape != (len(poses),) or not np.isfinite(given).all() or (given < 0).any() or given.sum() <= 0:
        raise ViewError(
            f"weights of the step {name!r} must be {len(poses)} numbers >= 0, at least one above 0, not {given.shape}"
        )
    pose = None if truth is None else pose_of(truth, "the true pose")
    portions = given / given.sum()
    mean = matrix_product(portions, poses[:, :2])
    spread = math.sqrt(scalar_product(portions, np.square(poses[:, :2] - mean).sum(axis=1)))
    off = "" if pose is None else f", mean {fixed(math.dist(mean, pose[:2]), 1)} m from the truth"
    corner = np.array([grid.origin[0], grid.origin[1] + len(grid.occupancy) * grid.resolution])

    def at(points: Floats) -> Floats:
        return snap((points - corner) * (scale, -scale), 1.0)

    relative = np.round(given / given.max(), 3)
    drawn = _thinned(relative)
    starts = at(poses[drawn, :2])
    headings = poses[drawn, 2]
    strokes = snap(np.column_stack([np.cos(headings), -np.sin(headings)]) * STROKE * scale, 1.0)
    level = np.minimum((relative[drawn] * len(WEIGHTS)).astype(int), len(WEIGHTS) - 1)
    parts = []
    for number, kind in enumerate(WEIGHTS):
        chosen = np.hstack([starts, strokes])[level == number].astype(int).tolist()
        if chosen:
            parts.append(element("path", d="".join(f"M{x} {y}l{dx} {dy}" for x, y, dx, dy in chosen), class_=kind))
    if pose is not None:
        x, y = at(np.array(pose[:2])).tolist()
        parts.append(element("circle", cx=x, cy=y, r=7, class_="rm-truth"))
    said = f"{name}: {plural(len(poses), 'particle')}, spread {fixed(spread, 1)} m{off}"
    return Frame(["".join(parts)], said)


def _thinned(weights: Floats) -> NDArray[np.int64]:
    """Return the indices of the particles that are drawn, the heaviest last."""
    order = np.argsort(weights, kind="stable").astype(np.int64)
    if len(order) <= MAX_PARTICLES:
        return order
    rest, heavy = np.sort(order[:-HEAVY_PARTICLES]), order[-HEAVY_PARTICLES:]
    every = np.linspace(0, len(rest) - 1, MAX_PARTICLES - HEAVY_PARTICLES).astype(np.int64)
    return np.concatenate([rest[every], heavy])


# -- chapter on hector_mapping: matching ---------------------------------------------------------------------------

UNKNOWN = 255
AROUND = 0.3
"""Space around the ends of the beams [m]."""


def match_steps(
    grid: OccupancyGrid, points: Floats, pose: Pose, *, steps: int = 8, title: str | None = None
) -> SteppedPlayer:
    """Show how hector_mapping matches a scan to its map, one Gauss-Newton step after another.

    The darker a cell of the map, the more likely it is occupied.

    Args:
        grid: the map.
        points: the ends of the beams (n, 2) [m], in the robot's frame.
        pose: the pose at which the search starts.
        steps: number of steps.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: there are no points.

    """
    if not len(points):
        raise ViewError("a scan without points cannot be matched to a map")
    poses = list(itertools.accumulate(range(steps), lambda here, _: match(grid, points, here, 0).pose, initial=pose))
    ends = [transform_points(here, points) for here in poses]
    every = np.concatenate(ends)
    low, high = snap(every.min(axis=0) - AROUND, 0.1), snap(every.max(axis=0) + AROUND, 0.1)
    scale = WIDTH / float((high - low).max())
    wide, tall = ((high - low) * scale).tolist()

    def at(places: ArrayLike) -> Floats:
        placed: Floats = (snap(places) - (low[0], high[1])) * (scale, -scale)
        return placed

    likely = np.where(grid.odds == 0, UNKNOWN, np.rint(100 * grid.probabilities)).astype(np.uint8)
    rows, columns = likely.shape
    left, top = at((grid.origin[0] - grid.resolution / 2, grid.origin[1] + (rows - 0.5) * grid.resolution)).tolist()
    size = grid.resolution * scale
    image = cells_element(
        gif_url(gif(painted(likely[::-1], "map"))[0]), x=left, y=top, width=columns * size, height=rows * size
    )

    def frame(here: Pose, beams: Floats, number: int) -> Frame:
        dots = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in at(beams).tolist())
        (x, y), (nose_x, nose_y) = at([here[:2], transform_points(here, np.array([(0.2, 0.0)]))[0]]).tolist()
        robot = element("circle", cx=x, cy=y, r=0.1 * scale, class_="rm-robot") + _path(
            [(x, y), (nose_x, nose_y)], "rm-robot"
        )
        return Frame([element("path", d=dots, class_="rm-ends") + robot], f"step {number}: robot at {pose_text(here)}")

    name = title or "match"
    said = (
        f"{plural(steps, 'step')}\nrobot: start {pose_text(poses[0])}, end {pose_text(poses[-1])}\n"
        f"map: {columns} x {rows} cells of {grid.resolution:.3f} m\nends of the beams: {plural(len(points), 'point')}"
    )
    return SteppedPlayer(
        name, [Panel("", wide, tall, image)], [Axis("step", [f"{n} of {steps}" for n in range(steps + 1)])],
        [frame(here, beams, n) for n, (here, beams) in enumerate(zip(poses, ends, strict=True))],
        text=f"{name}: {said}", alt=f"A scan on a map from above. {name}: {'; '.join(said.splitlines())}.", title=title,
        css=".rosmini-svg .rm-ends{stroke:#d55e00;stroke-width:4;stroke-linecap:round}"
        ".rosmini-svg .rm-robot{fill:none;stroke:#0072b2;stroke-width:2}", still=[steps], period=1000,
    )  # fmt: skip
