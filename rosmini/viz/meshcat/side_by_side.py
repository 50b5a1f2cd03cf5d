"""Runs side by side in three dimensions, by one clock."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.viz.embed import MESHCAT
from rosmini.viz.moving_view import MovingView
from rosmini.viz.svg import element

from .squeezed import squeezed
from .view import MeshcatView


class RunsView(MovingView):
    """Several runs, each in a viewer of its own, with one bar of controls; its image is that of the first."""

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
        """Its title, or what is played."""
        return self.title or f"{len(self.runs)} runs in 3D, side by side"

    @property
    def text(self) -> str:
        """What happened in each, in numbers."""
        told = (f"{name}: {run.text}" for name, run in zip(self.names, self.runs, strict=True))
        return "\n".join([self.name, *told])

    @property
    def alt(self) -> str:
        """The runs in a few sentences."""
        told = " ".join(f"{name}: {run.alt}" for name, run in zip(self.names, self.runs, strict=True))
        return f"{len(self.runs)} runs side by side, by one clock. {told}"

    @property
    def svg(self) -> str:
        """The first run in one picture."""
        return self.runs[0].svg

    @property
    def fallback(self) -> str:
        """The runs in pictures, side by side."""
        drawn = [element("div", run.svg, style="flex:1 1 18rem;min-width:0") for run in self.runs]
        return element("div", "".join(drawn), style="display:flex;flex-wrap:wrap;gap:8px")

    @property
    def height(self) -> int:
        """That of one viewer [CSS px]."""
        return self.runs[0].height

    @property
    def data(self) -> dict[str, Any]:
        """What the script of the viewers takes: the commands of all together, since they repeat one another."""
        return {
            "commands": squeezed(command for run in self.runs for command in run.scene.commands),
            "duration": max(run.scene.duration for run in self.runs),
            "runs": [
                {**run.parts, "count": len(run.scene.commands), "title": name}
                for name, run in zip(self.names, self.runs, strict=True)
            ],
        }
