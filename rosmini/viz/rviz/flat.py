"""Scenes as SVG: from above, or in the perspective of a view.

Colours are RViz's, on its background, both on light and on dark pages, because its users know them so. All numbers
are rounded, so that the same scene gives the same bytes on every machine.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

import numpy as np

from rosmini.core.geometry.products import matrix_product, norms
from rosmini.sim.geometry.slices import convex_hull
from rosmini.viz.rounding import snap
from rosmini.viz.style import LABEL_SIZE, variable
from rosmini.viz.svg import document, element, escape

from .clipping import clipped, rectangles
from .gifs import gif, gif_url
from .labels import place_labels
from .primitives import MAX_POINTS, Floats, Ints, Lines, Mesh, Pane, Points, Primitive, Text, Texture
from .projection import Perspective, Projection
from .properties import Colour

KIND = "rosmini-rviz"
MIN_DOT, MIN_LINE = 1.8, 1.0
"""Minimum size of points and minimum width of lines [px]."""
MAX_DOTS = 8000
"""Maximum number of points of a display in a picture: of several points on nearly the same pixel one is drawn."""
MAX_RECTANGLES = 450
"""Maximum number of rectangles of a map in perspective; above this, colours and then cells are joined."""
MANY_FACES = 80
"""A mesh with more faces than this is drawn as its outline from this side."""
MAX_FACES = 600
"""Maximum number of faces of a mesh in a picture; smaller ones become dots."""
GAP, MAX_PANE_HEIGHT = 12.0, 300.0
"""Gap between panes, and maximum height of their pictures [px]."""
OPAQUE = 0.99
MAX_COLOURS = 300
LEVELS = 32
"""Number of steps of each colour channel."""
GROUND = 0.01
"""Maximum height of things that lie on the ground [m]."""
SUN = np.array([0.25, -0.42, 0.87])


def draw(
    shown: Sequence[Primitive],
    projection: Projection,
    background: Colour,
    *,
    title: str,
    alt: str,
    panes: Sequence[Pane] = (),
) -> str:
    """Draw primitives as an SVG: textures first, the rest from far to near, texts last; panes in rows below."""
    words = [each for each in shown if isinstance(each, Text)]
    width, height = projection.width, projection.height
    parts = [element("rect", width=width, height=height, fill=_hex(background.rgba()), rx=4.0)]
    parts += elements(shown, projection)
    ink = _hex(background.rgba())
    parts += [
        element(
            "text", escape(each.shown_text), x=each.x, y=each.base, font_size=each.size, text_anchor="middle",
            fill=_hex(each.text.colour), opacity=_opacity(each.text.colour[3]), stroke=ink, stroke_width=2.5,
            paint_order="stroke",
        )
        for each in place_labels(words, projection)
    ]  # fmt: skip
    body = element(
        "svg", "".join(parts), width=width, height=height, overflow="hidden", stroke_linejoin="round",
    )  # fmt: skip
    below, high = _panes(panes, width, height)
    return document(body + below, width=width, height=high, title=title, alt=alt, css="", colours=["ink"], kind=KIND)


def elements(shown: Sequence[Primitive], projection: Projection) -> list[str]:
    """Return the SVG of primitives without texts: textures first, the rest from far to near."""
    if isinstance(projection, Perspective):
        shown = [clipped(each, projection) for each in shown]
    behind = [each for each in shown if isinstance(each, Texture) and each.behind]
    maps = [each for each in shown if isinstance(each, Texture) and not each.behind]
    others = [each for each in shown if not isinstance(each, Texture | Text)]
    rest = _joined(sorted(others, key=lambda each: (_is_raised(each), _nearness(each, projection))))
    return [part for each in (*behind, *maps, *rest) for part in _elements(each, projection)]


def _panes(panes: Sequence[Pane], width: float, top: float) -> tuple[str, float]:
    """Return panes below a picture, two in a row, each with its title above, and the total height."""
    parts: list[str] = []
    wide = (width - GAP) / 2 if len(panes) > 1 else width
    for start in range(0, len(panes), 2):
        row = panes[start : start + 2]
        highest = 0.0
        for i, pane in enumerate(row):
            tall, across = pane.pixels.shape[:2]
            scale = min(wide / across, MAX_PANE_HEIGHT / tall)
            x = i * (wide + GAP)
            opaque = np.dstack([pane.pixels[..., :3], np.full((tall, across), 255, np.uint8)])
            data, _ = gif(opaque)
            heading = f"{pane.title}: {pane.text}" if pane.text else pane.title
            parts.append(element("text", escape(heading), x=x, y=top + 17, font_size=LABEL_SIZE, fill=variable("ink")))
            parts.append(
                element("image", href=gif_url(data), x=x, y=top + 24, width=across * scale, height=tall * scale)
            )
            if pane.overlay:
                parts.append(
                    element(
                        "svg", pane.overlay, x=x, y=top + 24, width=across * scale, height=tall * scale,
                        viewBox=f"0 0 {across} {tall}", overflow="hidden",
                    )
                )  # fmt: skip
            highest = max(highest, tall * scale)
        top += 24 + highest + GAP
    return "".join(parts), top


def _elements(primitive: Primitive, projection: Projection) -> Iterator[str]:
    if isinstance(primitive, Texture):
        yield from _texture(primitive, projection)
    elif isinstance(primitive, Points):
        yield from _points(primitive, projection)
    elif isinstance(primitive, Lines):
        yield from _lines(primitive, projection)
    elif isinstance(primitive, Mesh):
        yield from _mesh(primitive, projection)


def _joined(shown: Sequence[Primitive]) -> Iterator[Primitive]:
    """Yield primitives in order; consecutive points of the same style, such as old scans, are joined."""
    for alike, group in groupby(shown, key=lambda each: (each.style, each.size) if isinstance(each, Points) else None):
        several = list(group)
        clouds = [each for each in several if isinstance(each, Points)]
        if alike is None or len(clouds) == 1 or sum(len(each.points) for each in clouds) > MAX_POINTS:
            yield from several
            continue
        points = np.vstack([each.points for each in clouds])
        colours = np.vstack([np.broadcast_to(each.colours, (len(each.points), 4)) for each in clouds])
        yield Points(points, colours, clouds[0].size, clouds[0].style)


def _points_of(primitive: Primitive) -> Floats:
    """Return its points (n, 3)."""
    return primitive.placed if isinstance(primitive, Mesh) else getattr(primitive, "points", np.empty((0, 3)))


def _is_raised(primitive: Primitive) -> bool:
    """Return False if it lies entirely on the ground, behind everything else."""
    points = _points_of(primitive)
    return bool(len(points) and snap(points[:, 2].max()) > GROUND)


def _nearness(primitive: Primitive, projection: Projection) -> float:
    """Return the nearness of its nearest point."""
    points = _points_of(primitive)
    return float(projection.nearness(points).max()) if len(points) else -np.inf


def _texture(texture: Texture, projection: Projection) -> Iterator[str]:
    if isinstance(projection, Perspective):
        alphas = texture.pixels[..., 3][texture.pixels[..., 3] > 0] / 255
        found = rectangles(texture, projection, MAX_RECTANGLES)
        warped = "".join(_filled(outlines, colour) for colour, outlines in found)
        if warped:
            yield element("g", warped, opacity=_opacity(float(alphas.mean())))
        return
    origin, right, _, up = projection.pixels(texture.corners)
    data, opacity = gif(texture.pixels)
    if not opacity:
        return
    # Cells smaller than a pixel are blended, because a cell that is left out may be a wall.
    is_large = np.abs(right - origin).max() >= texture.pixels.shape[1]
    rendering = "image-rendering:pixelated" if is_large else None
    a, b, c, d = (f"{value:.6g}" for value in (*(right - origin), *(up - origin)))
    yield element(
        "image", href=gif_url(data), width=1, height=1,
        preserveAspectRatio="none", transform=f"matrix({a} {b} {c} {d} {origin[0]:.6g} {origin[1]:.6g})",
        style=rendering, opacity=_opacity(opacity),
    )  # fmt: skip


def _points(points: Points, projection: Projection) -> Iterator[str]:
    flat = projection.pixels(points.points)
    colours = _quantised(points.colours, len(flat))
    inside = ((flat >= 0) & (flat <= (projection.width, projection.height))).all(axis=1)
    size = points.size if points.style == "Points" else points.size * projection.scale_at(points.points)
    cap = "round" if points.style == "Spheres" else "square"
    width = max(MIN_DOT, min(float(snap(size, 0.1)), projection.width))
    flat, colours = _thinned(flat[inside], colours[inside], width)
    for colour, among in _by_colour(_with_few_colours(colours)):
        path = "".join(f"M{x:.5g},{y:.5g}h0" for x, y in flat[among].tolist())
        yield _path(path, colour, width, cap)


def _thinned(flat: Floats, colours: Floats, width: float) -> tuple[Floats, Floats]:
    """Keep one of the points on the same pixel, or on the same few pixels if there are still too many.

    Wide points are thinned to a third of their width.
    """
    quantum = max(0.5, width / 3)
    kept = _one_per_cell(flat, quantum)
    return flat[kept], colours[kept]


def _one_per_cell(flat: Floats, quantum: float) -> Ints:
    """Return the first of the rows (n, 2 or 4) in each cell of `quantum` pixels; cells grow if there are too many."""
    kept = np.arange(len(flat))
    while True:
        cells = np.clip(np.floor(flat[kept] / quantum), -(2**15), 2**15 - 1).astype(np.int64)
        keys = np.zeros(len(kept), dtype=np.int64)
        for column in cells.T:
            keys = (keys << 16) | (column & 0xFFFF)
        kept = kept[np.sort(np.unique(keys, return_index=True)[1])]
        if len(kept) <= MAX_DOTS:
            return kept
        quantum *= 1.5


def _lines(lines: Lines, projection: Projection) -> Iterator[str]:
    width = max(MIN_LINE, min(float(snap(lines.width * projection.scale_at(lines.points), 0.1)), projection.width))
    if lines.strip and lines.colours.ndim == 1:
        flat = projection.pixels(lines.points)
        data = _path_data(_smoothed(flat))
        if data:
            yield _path(data, _quantised(lines.colours, 1)[0], width, "round")
        return
    ends = projection.pixels(lines.segments().reshape(-1, 3)).reshape(-1, 2, 2)
    seen = ((ends.max(axis=1) >= 0) & (ends.min(axis=1) <= (projection.width, projection.height))).all(axis=1)
    colours = _quantised(lines.segment_colours(), len(ends))
    ends, colours = ends[seen], colours[seen]
    if len(ends) > MAX_DOTS:
        kept = _one_per_cell(ends.reshape(-1, 4), max(0.5, width / 3))
        ends, colours = ends[kept], colours[kept]
    for colour, among in _by_colour(colours):
        yield _path("".join(_path_data(each) for each in _chains(ends[among])), colour, width, "butt")


def _smoothed(flat: Floats) -> Floats:
    """Return a line without the points that nearly coincide with their predecessor, keeping the last one."""
    new = np.ones(len(flat), dtype=bool)
    new[1:] = (np.abs(np.diff(flat, axis=0)) >= 0.1).any(axis=1)
    flat = flat[new]
    quantum = 0.5
    while len(flat) > MAX_DOTS and quantum < 4.0:
        cells = np.floor(flat / quantum)
        new = np.ones(len(flat), dtype=bool)
        new[1:-1] = (np.diff(cells, axis=0) != 0).any(axis=1)[:-1]
        flat = flat[new]
        quantum *= 1.5
    step = -(-len(flat) // MAX_DOTS) or 1
    return flat if step == 1 else np.vstack([flat[:-1:step], flat[-1:]])


def _mesh(mesh: Mesh, projection: Projection) -> Iterator[str]:
    placed = mesh.placed
    if not len(mesh.faces):
        return
    flat = projection.pixels(placed)
    if len(mesh.faces) > MANY_FACES and mesh.lit:
        colour = mesh.colours if mesh.colours.ndim == 1 else mesh.colours.mean(axis=0)
        yield _filled([convex_hull(flat)], _quantised(colour, 1)[0])
        return
    triangles = placed[mesh.faces]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    sizes = norms(normals)
    towards = (normals * projection.towards(triangles[:, 0])).sum(axis=1)
    seen = np.flatnonzero((sizes > 1e-12) & (towards > 1e-9 * sizes if mesh.lit else sizes > 0))
    if len(seen) > MAX_FACES:
        seen, small = _largest(triangles, seen, projection)
        rest = mesh.colours[small] if mesh.colours.ndim == 2 else mesh.colours
        yield from _points(Points(triangles[small].mean(axis=1), rest, MIN_DOT, "Points"), projection)
    order = seen[np.argsort(projection.nearness(triangles[seen].mean(axis=1)), kind="stable")]
    light = np.ones(len(order))
    see_through = mesh.colours.ndim == 1 and mesh.colours[3] < OPAQUE
    if mesh.lit and not see_through:  # otherwise edges would be visible where faces overlap
        light = 0.7 + 0.3 * np.clip(matrix_product(normals[order], SUN) / sizes[order], 0.0, 1.0)
    colours = (mesh.colours[order] if mesh.colours.ndim == 2 else np.tile(mesh.colours, (len(order), 1))).copy()
    colours[:, :3] *= light[:, None]
    steps = _quantised(colours, len(order))
    start = 0
    while start < len(order):
        end = start + 1
        while end < len(order) and (steps[end] == steps[start]).all():
            end += 1
        yield _filled([flat[mesh.faces[i]] for i in order[start:end]], steps[start])
        start = end


def _largest(triangles: Floats, seen: Ints, projection: Projection) -> tuple[Ints, Ints]:
    """Return the `MAX_FACES` of the faces `seen` that are largest in the picture, and the others, both in order."""
    flat = projection.pixels(triangles[seen].reshape(-1, 3)).reshape(-1, 3, 2)
    sizes = np.ptp(flat, axis=1).sum(axis=1)
    by_size = np.argsort(-sizes, kind="stable")
    return np.sort(seen[by_size[:MAX_FACES]]), np.sort(seen[by_size[MAX_FACES:]])


def _quantised(colours: Floats, count: int) -> Floats:
    """Return colours (count, 4) in few steps, so that similar ones share a path."""
    found = np.round(snap(np.atleast_2d(colours) * LEVELS, 0.01)) / LEVELS
    return np.broadcast_to(found, (count, 4)) if len(found) == 1 else found


def _with_few_colours(colours: Floats) -> Floats:
    """Reduce colours (n, 4) to at most `MAX_COLOURS` different ones, since each needs a separate path."""
    levels = LEVELS
    while levels > 4 and len(np.unique(colours, axis=0)) > MAX_COLOURS:
        levels //= 2
        colours = np.round(colours * levels) / levels
    return colours


def _by_colour(colours: Floats) -> Iterator[tuple[Floats, Ints]]:
    """Yield each colour and the indices of the items that have it, sorted by colour."""
    if not len(colours):
        return
    found, places = np.unique(colours, axis=0, return_inverse=True)
    places = places.reshape(-1)
    for i, colour in enumerate(found):
        yield colour, np.flatnonzero(places == i)


def _chains(segments: Floats) -> Iterator[Floats]:
    """Join segments (n, 2, 2) to lines (m, 2) where one begins at the end of the previous one."""
    if len(segments):
        breaks = np.flatnonzero((segments[1:, 0] != segments[:-1, 1]).any(axis=1)) + 1
        for several in np.split(segments, breaks):
            yield np.vstack([several[0, :1], several[:, 1]])


def _path_data(flat: Floats) -> str:
    """Return a line (n, 2) as path data: its start, and steps in tenths of a pixel."""
    if len(flat) < 2:
        return ""
    tenths = np.round(flat * 10)
    steps = " ".join(f"{x:.6g},{y:.6g}" for x, y in (np.diff(tenths, axis=0) / 10).tolist())
    x, y = (tenths[0] / 10).tolist()
    return f"M{x:.6g},{y:.6g}l{steps}"


def _path(data: str, colour: Floats, width: float, cap: str) -> str:
    return element(
        "path", d=data, fill="none", stroke=_hex(colour), stroke_width=width, stroke_linecap=cap,
        stroke_opacity=_opacity(colour[3]),
    )  # fmt: skip


def _filled(outlines: Iterable[Floats], colour: Floats) -> str:
    data = "".join(_path_data(each) + "z" for each in outlines if len(each) > 2)
    paint = _hex(colour)
    opacity = _opacity(colour[3])
    return element("path", d=data, fill=paint, stroke=paint, stroke_width=0.5, opacity=opacity) if data else ""


def _opacity(alpha: float) -> str | None:
    return None if alpha >= 0.999 else f"{alpha:.2f}".rstrip("0").rstrip(".")


def _hex(colour: Floats) -> str:
    return "#" + "".join(f"{int(part * 255 + 0.5371):02x}" for part in np.clip(colour[:3], 0.0, 1.0))
