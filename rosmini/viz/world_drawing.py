"""Draw on the axes of a map: walls and obstacles, a robot from above, its laser scan, and its path.

Everything is in metres in the frame of the world and rounded to millimetres; `scale` is in pixels per metre.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.sim.models import RobotModel
from rosmini.sim.shapes import Box, Polygon, Simple, outline_at
from rosmini.sim.world import Obstacle, Walk, World
from rosmini.viz.beams import Beams
from rosmini.viz.metrics import text_width
from rosmini.viz.rounding import points_to_keep, snap
from rosmini.viz.style import LABEL_SIZE, LIGHT, LINE_WIDTH

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

Floats = NDArray[np.float64]

TINT = 0.32
"""Opacity of the fill of an obstacle."""
DARKEST, LIGHTEST = 0.2, 0.7
"""A colour whose luma (ITU-R BT.601, 0 to 1) is outside these limits is hard to see on a dark or on a light page."""
SEEN, ONE_BEAM = 0.11, 0.5
"""Opacity of the area of a scan, and of a single beam."""
TRAIL_WIDTH = 2.0
DASHES = (6.0, 4.0)
MIN_ROBOT = 16.0
"""Minimum length of a robot, which is otherwise drawn to scale [px]."""
TOLERANCE = 0.137
"""Maximum deviation of a drawn line [px]: it is invisible, and saves most points."""
WHEEL_WIDTH = 0.55
"""Width of a wheel relative to its radius."""
LASER_LENGTH = 0.2
"""Maximum length of a robot from which the size of its laser is derived [m]: larger robots have the same laser."""


def draw_world(axes: Axes, world: World, scale: float) -> None:
    """Draw walls and obstacles. Walls that enclose solid areas, like those of a traced map, are filled."""
    for obstacle in world.obstacles:
        _obstacle(axes, obstacle)
    if len(world.walls):
        lines = [_thinned(np.array(line), scale) for line in _chained(snap(world.walls).tolist())]
        if world.solid and all(len(line) > 3 and (line[0] == line[-1]).all() for line in lines):
            blocks = _path([line[:-1] for line in lines], closed=True)
            _patch(axes, blocks, fill="muted", edge="muted", width=1.0, z=3.0)
        else:
            _patch(axes, _path(lines), edge="muted", width=2.5, cap="round", z=3.0)


def _obstacle(axes: Axes, obstacle: Obstacle) -> None:
    solid = obstacle.colour == "wall"
    colour = "muted" if solid else "line" if obstacle.colour == "grey" else obstacle.colour
    over = obstacle.bottom > 0.0  # a robot may pass below it, such as below a table top
    shapes = [_shape_path(shape, pose) for shape, pose in obstacle.parts()]
    for shape in shapes:
        _patch(
            axes,
            shape,
            fill=colour,
            edge=_edge(colour),
            opacity=1.0 if solid else TINT / 2 if over else TINT,
            width=0.5 if solid or over else LINE_WIDTH,
            z=3.1 if over else 3.0,
        )
    if isinstance(obstacle.motion, Walk):
        ways = obstacle.motion.waypoints
        line = snap(np.array([*ways, ways[0]] if obstacle.motion.loop else ways))
        axes.plot(*line.T, color=_paint(_edge(colour)), linewidth=1.2, zorder=2.5, clip_on=False, dashes=(2.0, 3.0))


def _shape_path(shape: Simple, pose: Pose) -> Path:
    if isinstance(shape, (Box, Polygon)):
        return _path([snap(outline_at(shape, pose))], closed=True)
    return _circle(pose[:2], shape.radius)


def _paint(colour: str) -> str:
    """Return a colour of the palette by its name, or any other colour unchanged."""
    return LIGHT.get(colour, colour)


def _edge(colour: str) -> str:
    """Return the colour of an outline: the object's own if visible on light and dark pages, otherwise a neutral one."""
    from matplotlib.colors import to_rgb

    if colour in LIGHT:
        return colour
    r, g, b = to_rgb(colour)
    return colour if DARKEST <= 0.299 * r + 0.587 * g + 0.114 * b <= LIGHTEST else "line"


def draw_scan(axes: Axes, beams: Beams, laser: Pose, scale: float) -> None:
    """Draw the scan of a laser at the pose `laser`: the area of its beams, or its only beam, and a dot for each hit."""
    ends = snap(transform_points(laser, beams.points()))
    if len(ends) == 1:
        axes.plot(
            *np.vstack([snap(laser[:2]), ends]).T, color=_paint("vermilion"), alpha=ONE_BEAM, linewidth=1.2, zorder=2.0
        )
        draw_dots(axes, ends[beams.hits], "vermilion", 3.2)
        return
    whole = len(ends) * float(np.diff(beams.angles[:2]).sum()) > 1.9 * math.pi
    outline = ends if whole else np.vstack([snap(laser[:2]), ends])
    _patch(axes, _path([_thinned(outline, scale)], closed=True), fill="vermilion", opacity=SEEN, z=2.0, clip=True)
    draw_dots(axes, ends[beams.hits], "vermilion", 3.2)


def draw_dots(axes: Axes, points: Floats, colour: str, width: float) -> None:
    """Draw round dots at points (n, 2), as one path."""
    if len(points):
        draw_strokes(axes, np.stack([points, points], axis=1), colour, width, cap="round")


def draw_strokes(axes: Axes, lines: Floats, colour: str, width: float, cap: Any = "butt") -> None:
    """Draw lines (n, 2, 2), as one path."""
    _patch(axes, _path(lines), edge=colour, width=width, cap=cap, z=5.0)


def draw_trail(axes: Axes, points: Floats, scale: float, *, colour: str = "blue", dashed: bool = False) -> None:
    """Draw a line through points (n, 2)."""
    line = _thinned(snap(points), scale)
    dashes: dict[str, Any] = {"dashes": DASHES} if dashed else {}
    axes.plot(*line.T, color=LIGHT[colour], linewidth=TRAIL_WIDTH, zorder=4.0, clip_on=False, **dashes)


def draw_start(axes: Axes, point: ArrayLike, scale: float, *, colour: str = "blue") -> None:
    """Draw a ring at the start of a path."""
    _patch(axes, _circle(point, 4.5 / scale), fill="page", edge=colour, opacity=1.0, width=2.0, z=4.5)


def draw_former_place(axes: Axes, obstacle: Obstacle) -> None:
    """Draw the former place of an object that was moved: a dashed outline."""
    colour = "line" if obstacle.colour in ("grey", "wall") else obstacle.colour
    for shape, pose in obstacle.parts():
        _patch(axes, _shape_path(shape, pose), edge=_edge(colour), width=1.2, dash=(3.0, 2.0), z=2.6)


def draw_moved_path(axes: Axes, points: Floats, colour: str, scale: float) -> None:
    """Draw the path of an object that was moved: a fine line through points (n, 2)."""
    line = _thinned(snap(points), scale)
    colour = "line" if colour in ("grey", "wall") else colour
    paint = _paint(_edge(colour))
    axes.plot(*line.T, color=paint, linewidth=1.2, zorder=2.7, clip_on=False, dashes=(3.0, 2.0))


def name_box(
    model: RobotModel, pose: Pose, name: str, scale: float, *, above: bool
) -> tuple[float, float, float, float]:
    """Return the box of a robot's name, x0, y0, x1, y1 [px], relative to the origin of the world."""
    x, y = scale * pose[0], scale * pose[1]
    half, height = text_width(name, LABEL_SIZE) / 2, 1.2 * LABEL_SIZE
    bottom = y + _aside(model, scale) if above else y - _aside(model, scale) - height
    return (x - half, bottom, x + half, bottom + height)


def draw_name(axes: Axes, model: RobotModel, pose: Pose, name: str, colour: str, scale: float, *, above: bool) -> None:
    """Draw a robot's name below or above it."""
    aside = _aside(model, scale)
    axes.annotate(
        name,
        (float(snap(pose[0])), float(snap(pose[1]))),
        xytext=(0.0, aside if above else -aside),
        textcoords="offset points",
        ha="center",
        va="bottom" if above else "top",
        color=LIGHT[colour],
        size=LABEL_SIZE,
        zorder=8.0,
        bbox={"facecolor": LIGHT["page"], "alpha": 0.75, "edgecolor": "none", "pad": 1.0},
    )


def _aside(model: RobotModel, scale: float) -> float:
    """Return the distance of a robot's name from the robot [px]."""
    return max(model.reach * scale, MIN_ROBOT) + 3.0


def draw_robot(
    axes: Axes, model: RobotModel, pose: Pose, scale: float, *, ghost: bool = False, colour: str = "blue"
) -> None:
    """Draw a robot from above: plate, wheels, laser, and a nose that points ahead. A ghost is a dashed outline."""
    xs, ys = np.array(model.footprint).T
    length = float(xs.max() - xs.min())
    grown = max(1.0, MIN_ROBOT / (length * scale))

    def put(points: Iterable[Sequence[float]]) -> Floats:
        return snap(transform_points(pose, np.array(list(points)) * grown), 1e-4)

    plate = _rounded(put(model.footprint), 0.2 * min(length, float(ys.max() - ys.min())) * grown)
    front, nose = float(xs.max()), max(0.5 * length, 9.0 / (scale * grown))
    gap = 1.5 / (scale * grown)
    half = 0.6 * nose
    arrow = put([(front + gap, -half), (front + gap + nose, 0.0), (front + gap, half)])
    if ghost:
        for outline in (plate, _path([arrow], closed=True)):
            _patch(axes, outline, edge="orange", width=1.6, dash=(3.0, 2.0), z=6.0)
        return
    _patch(axes, plate, fill=colour, edge="page", opacity=1.0, width=1.2, z=7.0)
    _patch(axes, _path([arrow], closed=True), fill=colour, edge="page", opacity=1.0, width=0.8, z=7.0)
    if model.drive == "differential":
        _wheels(axes, model, put)
    if model.lidar is not None:
        centre, size = put([model.lidar.mount[:2]])[0], min(length, LASER_LENGTH) * grown
        _patch(axes, _circle(centre, 0.26 * size), fill="page", opacity=1.0, z=7.2)
        _patch(axes, _circle(centre, 0.11 * size), fill="vermilion", opacity=1.0, z=7.3)


def _wheels(axes: Axes, model: RobotModel, put: Callable[[Iterable[Sequence[float]]], Floats]) -> None:
    r, side, half = model.wheel_radius, model.wheel_separation / 2, WHEEL_WIDTH * model.wheel_radius / 2
    wheels = [put([(-r, y - half), (r, y - half), (r, y + half), (-r, y + half)]) for y in (-side, side)]
    _patch(axes, _path(wheels, closed=True), fill="ink", opacity=1.0, z=7.1)


def _patch(
    axes: Axes,
    path: Path,
    *,
    z: float,
    fill: str = "",
    edge: str = "",
    opacity: float = 1.0,
    width: float = 1.0,
    dash: tuple[float, float] | None = None,
    cap: Any = "butt",
    clip: bool = False,
) -> None:
    from matplotlib.colors import to_rgba
    from matplotlib.patches import PathPatch

    patch = PathPatch(
        path,
        facecolor=to_rgba(_paint(fill), opacity) if fill else "none",
        edgecolor=_paint(edge) if edge else "none",
        linewidth=width if edge else 0.0,
        linestyle=(0, dash) if dash else "-",
        capstyle=cap,
        joinstyle="round",
        zorder=z,
        clip_on=clip,
    )
    axes.add_artist(patch)
    if clip:
        patch.set_clip_path(axes.patch)


def _path(lines: Any, *, closed: bool = False) -> Path:
    """Return lines, each (n, 2), as one path."""
    from matplotlib.path import Path

    vertices: list[Any] = []
    codes: list[Any] = []
    for line in lines:
        vertices += [*line, line[0]] if closed else [*line]
        codes += [Path.MOVETO, *[Path.LINETO] * (len(line) - 1), *([Path.CLOSEPOLY] if closed else [])]
    return Path(vertices, codes)


def _circle(centre: ArrayLike, radius: float) -> Path:
    from matplotlib.path import Path

    x, y = snap(centre, 1e-4)
    unit = Path.unit_circle()
    return Path(np.asarray(unit.vertices, dtype=float) * radius + (x, y), unit.codes)


def _rounded(corners: Floats, radius: float) -> Path:
    """Return a polygon with round corners."""
    from matplotlib.path import Path

    vertices: list[Floats] = []
    codes: list[Any] = []
    for before, corner, after in zip(np.roll(corners, 1, axis=0), corners, np.roll(corners, -1, axis=0), strict=True):
        for end in (before, after):
            side = end - corner
            length = math.hypot(*side)
            cut = min(radius, 0.45 * length) / length if length else 0.0
            vertices.append(corner + cut * side)
            if end is before:
                vertices.append(corner)
        codes += [Path.LINETO, Path.CURVE3, Path.CURVE3]
    codes[0] = Path.MOVETO
    return Path([*vertices, vertices[0]], [*codes, Path.CLOSEPOLY])


def _chained(segments: list[list[float]]) -> list[list[tuple[float, float]]]:
    """Join segments that begin at the end of the previous one to lines; a line ends where it closes."""
    lines: list[list[tuple[float, float]]] = []
    for x1, y1, x2, y2 in segments:
        if not lines or lines[-1][-1] != (x1, y1) or lines[-1][0] == lines[-1][-1]:
            lines.append([(x1, y1)])
        lines[-1].append((x2, y2))
    return lines


def _thinned(line: Floats, scale: float) -> Floats:
    """Return a line without the points that make no visible difference."""
    return line[points_to_keep(line, TOLERANCE / scale)]
