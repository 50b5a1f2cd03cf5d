"""Searches side by side, step by step: a slider in the page, and as a still picture their ends."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.navfn import Search
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_pictures import cells_element, gif_address
from rosmini.viz.moving_view import MovingView
from rosmini.viz.rviz.gifs import gif
from rosmini.viz.search_pictures import SHADES, WAITING, greys_of, path_of, said_of, shades
from rosmini.viz.style import LABEL_SIZE
from rosmini.viz.svg import document, element, escape
from rosmini.viz.view import ViewError

LARGEST = 16_384
"""Cells of a grid that is stepped in a page, at most: a byte of each is in it."""
FINEST = 2_000
"""In so many steps a search is recorded, at most about."""
GAP, HEAD = 20.0, 22.0
CONTROLS = 90


def search_steps(searches: Mapping[str, Search], *, title: str | None = None) -> SearchSteps:
    """Run searches to their ends and show them beside each other, each after as many cells as the others.

    Args:
        searches: by name; none has begun, and they are on grids of one size.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: there is none, one has begun, or the grids differ or are too large.

    """
    if not searches or not all(isinstance(each, Search) for each in searches.values()):
        raise ViewError("searches are given by name: {'Dijkstra': NavfnSearch(...), 'A*': ...}")
    sizes = {(each.width, each.height) for each in searches.values()}
    if len(sizes) > 1:
        raise ViewError(f"searches beside each other need grids of one size, not of {sorted(sizes)}")
    ((width, height),) = sizes
    if width * height > LARGEST:
        raise ViewError(
            f"a grid of {width} x {height} cells is too large to be stepped in a page: {LARGEST} cells at most"
        )
    for name, each in searches.items():
        if each.expanded:
            raise ViewError(f"the search {name!r} has begun: give one that was just made")
    return SearchSteps(dict(searches), title)


def recorded(search: Search) -> NDArray[np.int64]:
    """Run a search to its end; after how many cells taken up each cell (h, w) was reached, roughly; -1 if never."""
    batch = max(1, search.width * search.height // FINEST)
    when = np.where(search.reached, 0, -1).astype(np.int64)
    finished = False
    while not finished:
        finished = search.expand(batch)
        when[search.reached & (when < 0)] = search.expanded
    return when


class SearchSteps(MovingView):
    """What `search_steps` gives."""

    scripts = ("rosmini-search-steps.js",)
    call = "rosminiSearchSteps.mount"
    usual_name = "searches"

    def __init__(self, searches: dict[str, Search], title: str | None) -> None:
        self._searches, self.title = searches, title
        taken = {name: recorded(each) for name, each in searches.items()}
        longest = max(each.expanded for each in searches.values())
        self.step = max(1, math.ceil(longest / (SHADES - 1)))
        """So many cells are taken up from one position of the slider to the next."""
        self.frames = math.ceil(longest / self.step)
        self._when = {name: self._frame(when) for name, when in taken.items()}

    def _frame(self, when: NDArray[np.int64]) -> NDArray[np.uint8]:
        """The frame (1 to `frames` + 1) in which each cell appears; 0 if in none."""
        return np.where(when < 0, 0, 1 + -(-when // self.step)).astype(np.uint8)

    @property
    def text(self) -> str:
        """How each search ended."""
        lines = [f"{name}: {said_of(each)}" for name, each in self._searches.items()]
        return "\n".join([self.name, *lines])

    @property
    def alt(self) -> str:
        """The same in sentences."""
        _, *lines = self.text.split("\n")
        return f"Searches side by side, from above. {'. '.join(lines)}."

    @property
    def svg(self) -> str:
        """The still picture: the last step."""
        count = len(self._searches)
        first = next(iter(self._searches.values()))
        wide = (WIDTH - (count - 1) * GAP) / count
        high = wide * first.height / first.width
        parts = []
        for number, (name, search) in enumerate(self._searches.items()):
            x = number * (wide + GAP)
            pixels = np.full((search.height, search.width, 4), 255, dtype=np.uint8)
            pixels[..., :3] = greys_of(search)[..., None]
            seen = self._when[name] > 0
            pixels[seen, :3] = shades()[self._shade(self._when[name][seen])]
            address = gif_address(gif(pixels[::-1])[0])
            parts.append(
                element("text", escape(name), x=x, y=HEAD - 7, font_size=LABEL_SIZE, class_="rm-what")
            )
            parts.append(cells_element(address, x=x, y=HEAD, width=wide, height=high))
            path = path_of(search)
            if path is not None:
                scale = wide / search.width
                line = "L".join(
                    f"{x + (a + 0.5) * scale:.1f} {HEAD + high - (b + 0.5) * scale:.1f}"
                    for a, b in path.tolist()
                )
                parts.append(element("path", d=f"M{line}", class_="rm-path"))
        css = ".rosmini-svg .rm-what{fill:var(--rosmini-muted)}"
        css += ".rosmini-svg .rm-path{fill:none;stroke:#d55e00;stroke-width:2}"
        return document(
            "".join(parts), width=WIDTH, height=HEAD + high + 1, title=self.name, alt=self.alt,
            css=css, colours=["muted"],
        )  # fmt: skip

    def _shade(self, frames: NDArray[np.uint8]) -> NDArray[np.int64]:
        return np.minimum((frames.astype(np.int64) - 1) * (SHADES - 1) // max(self.frames, 1), SHADES - 1)

    @property
    def height(self) -> int:
        """With the controls, about [CSS px]."""
        first = next(iter(self._searches.values()))
        wide = (WIDTH - (len(self._searches) - 1) * GAP) / len(self._searches)
        return round(wide * first.height / first.width) + CONTROLS

    @property
    def data(self) -> dict[str, Any]:
        """What the page's script gets: upper rows first."""
        first = next(iter(self._searches.values()))
        return {
            "size": [first.width, first.height],
            "step": self.step,
            "frames": self.frames,
            "shades": shades().tobytes(),
            "waiting": list(WAITING),
            "searches": [
                {
                    "name": name,
                    "ground": greys_of(search)[::-1].tobytes(),
                    "when": self._when[name][::-1].tobytes(),
                    "taken": search.expanded,
                    "path": self._path(search),
                    "start": list(search.start),
                    "goal": list(search.goal),
                }
                for name, search in self._searches.items()
            ],
        }

    @staticmethod
    def _path(search: Search) -> list[float]:
        path = path_of(search)
        return [] if path is None else [round(value, 1) for value in path.ravel().tolist()]
