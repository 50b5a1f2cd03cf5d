"""A search on a cost grid from above: reached cells with their potentials, the frontier, parents, and the path."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.nav_core import PlanningFailure
from rosmini.navigation.navfn import Search
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_pictures import cells_element
from rosmini.viz.rounding import fixed
from rosmini.viz.rviz.gifs import gif, gif_url
from rosmini.viz.svg import document, element
from rosmini.viz.view import Picture, ViewError

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]

NEAR, FAR = (214, 234, 248), (0, 84, 148)
"""Colours of reached cells, from the start to the farthest one."""
WAITING = (230, 159, 0)
BLOCKED, UNKNOWN = 60, 170
"""Greys of impassable cells, and of unknown ones that are passable."""
SHADES = 200
MAX_CELLS = 2_500
"""Above this number of cells parents are not drawn, because they would be too small."""
HEIGHT = 460.0


def search_picture(search: Search, *, parents: bool = False, title: str | None = None, width: float = WIDTH) -> Picture:
    """Draw a search in its current state, to scale, row 0 at the bottom.

    Args:
        search: the search, finished or not.
        parents: True to draw a line from each cell to the cell that its potential comes from.
        title: a caption, and the first words of the text form.
        width: maximum width [CSS px].

    Raises:
        ViewError: it is not a search, or it has too many cells to show their parents.

    """
    if not isinstance(search, Search):
        raise ViewError(f"a search must be a NavfnSearch or another Search, not a {type(search).__name__}")
    cells = search.width * search.height
    if parents and cells > MAX_CELLS:
        raise ViewError(
            f"the parents of {cells} cells would be too small: use at most {MAX_CELLS} cells, or parents=False"
        )
    scale = min(width / search.width, HEIGHT / search.height)
    w, h = search.width * scale, search.height * scale
    address = gif_url(gif(_painted(search)[::-1])[0])
    parts = [cells_element(address, x=0, y=0, width=w, height=h)]
    if parents:
        parts.append(_line(_parent_lines(search, scale), "rm-parents"))
    path = path_of(search)
    if path is not None:
        parts.append(_line(_polyline(path, search.height, scale), "rm-path"))
    for point, kind in ((search.start, "rm-start"), (search.goal, "rm-goal")):
        x, y = _placed(np.array([point]), search.height, scale)[0]
        parts.append(element("circle", cx=fixed(x, 1), cy=fixed(y, 1), r=max(4.0, scale / 3), class_=kind))
    said = describe_search(search)
    svg = document(
        "".join(parts), width=w, height=h, title=title or "search", alt=f"A search from above. {said}.",
        css=STYLE, colours=["page", "vermilion", "green", "ink"],
    )  # fmt: skip
    return Picture(
        svg, text=f"{title or 'search'}: {said}", alt=f"A search on a grid, from above. {said}.", caption=title
    )


STYLE = (
    ".rosmini-svg .rm-path{fill:none;stroke:#d55e00;stroke-width:2.5}"
    ".rosmini-svg .rm-parents{fill:none;stroke:#333;stroke-width:1}"
    ".rosmini-svg .rm-start{fill:#009e73;stroke:#fefefe;stroke-width:1.5}"
    ".rosmini-svg .rm-goal{fill:#d55e00;stroke:#fefefe;stroke-width:1.5}"
)


def path_of(search: Search) -> Floats | None:
    """Return the path, if the search has arrived."""
    if not search.arrived:
        return None
    try:
        return search.path()
    except PlanningFailure:
        return None


def describe_search(search: Search) -> str:
    """Describe a search in words."""
    said = f"{search.expanded} cells taken up, {int(search.reached.sum())} of {search.width * search.height} reached"
    path = path_of(search)
    if path is not None:
        length = float(np.hypot(*np.diff(path, axis=0).T).sum())
        column, row = np.floor(np.array(search.goal) + 0.5).astype(int)
        cost = search.potential_at((int(column), int(row)))
        return f"{said}, path of {fixed(length, 1)} cells, potential {fixed(cost, 0)} at the goal"
    if search.finished and not search.arrived:
        return f"{said}, the goal not among them"
    return said if search.arrived else f"{said}, {len(search.frontier)} waiting"


def greys_of(search: Search) -> Bytes:
    """Return the ground (h, w) in grey: darker with increasing cost, and nearly black if impassable."""
    costs = search.costs[1:-1, 1:-1]
    greys = (255 - 0.35 * np.minimum(costs, 252)).astype(np.uint8)
    greys[costs == 255] = UNKNOWN
    greys[~np.isfinite(search.table[costs])] = BLOCKED
    return greys


def shades() -> Bytes:
    """Return the colours (SHADES, 3) of reached cells."""
    share = np.linspace(0, 1, SHADES)[:, None]
    return np.rint((1 - share) * NEAR + share * FAR).astype(np.uint8)


def _painted(search: Search) -> Bytes:
    pixels = np.full((search.height, search.width, 4), 255, dtype=np.uint8)
    pixels[..., :3] = greys_of(search)[..., None]
    reached = search.reached
    highest = max(1.0, float(np.max(search.potential, where=reached, initial=0.0)))
    rank = np.floor(search.potential[reached] / highest * (SHADES - 1) + 1e-6).astype(int)
    pixels[reached, :3] = shades()[rank]
    if not search.finished:
        columns, rows = search.frontier.T
        pixels[rows, columns, :3] = WAITING
    return pixels


def _placed(points: Floats, rows: int, scale: float) -> Floats:
    return np.stack([(points[:, 0] + 0.5) * scale, (rows - points[:, 1] - 0.5) * scale], axis=-1)


def _polyline(points: Floats, rows: int, scale: float) -> str:
    return "M" + "L".join(f"{fixed(x, 1)} {fixed(y, 1)}" for x, y in _placed(points, rows, scale))


def _parent_lines(search: Search, scale: float) -> str:
    parents = search.parents
    rows, columns = np.nonzero(parents[..., 0] >= 0)
    begin = _placed(np.stack([columns, rows], axis=-1).astype(float), search.height, scale)
    end = _placed(parents[rows, columns].astype(float), search.height, scale)
    end = begin + 0.75 * (end - begin)
    return "".join(
        f"M{fixed(a, 1)} {fixed(b, 1)}L{fixed(c, 1)} {fixed(d, 1)}"
        for (a, b), (c, d) in zip(begin.tolist(), end.tolist(), strict=True)
    )


def _line(path: str, kind: str) -> str:
    return element("path", d=path or "M0 0", class_=kind)
