"""Runs side by side in three dimensions, with one clock."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.viz.embed import MESHCAT
from rosmini.viz.moving_view import MovingView
from rosmini.viz.svg import element

from .compression import compress
from .view import MeshcatView


class RunsView(MovingView):
    """Several runs, each in its own viewer, with one bar of controls; the image is that of the first."""

    assets = (MESHCAT,)
    call = "rosminiMeshcat.mount"

    def __init__(
        self, runs: Sequence[MeshcatView], names: Sequence[str], *, title: str | None = None
    ) -> None:
        self.runs = tuple(runs)
        self.names = tuple(names)
        self.title = title
        self.scripts = max((run.scripts for run in runs), key=len)

    @property
    def name(self) -> str:
        """The title, or a short description."""
        return self.title or f"{len(self.runs)} runs in 3D, side by side"

    @property
    def text(self) -> str:
        """The result of each run, in numbers."""
        told = (f"{name}: {run.text}" for name, run in zip(self.names, self.runs, strict=True))
        return "\n".join([self.name, *told])

    @property
    def alt(self) -> str:
        """The runs in a few sentences."""
        told = " ".join(f"{name}: {run.alt}" for name, run in zip(self.names, self.runs, strict=True))
        return f"{len(self.runs)} runs side by side, by one clock. {told}"

    @property
    def svg(self) -> str:
        """A picture of the first run."""
        return self.runs[0].svg

    @property
    def fallback(self) -> str:
        """Pictures of the runs, side by side."""
        drawn = [element("div", run.svg, style="flex:1 1 18rem;min-width:0") for run in self.runs]
        return element("div", "".join(drawn), style="display:flex;flex-wrap:wrap;gap:8px")

    @property
    def height(self) -> int:
        """The height of one viewer [CSS px]."""
        return self.runs[0].height

    @property
    def data(self) -> dict[str, Any]:
        """The data for the viewers' script: the commands of all runs together, since much is the same in each."""
        return {
            "commands": compress(command for run in self.runs for command in run.scene.commands),
            "duration": max(run.scene.duration for run in self.runs),
            "runs": [
                {**run.parts, "count": len(run.scene.commands), "title": name}
                for name, run in zip(self.names, self.runs, strict=True)
            ],
        }
