"""Group: displays that are switched on and off together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from rosmini.core.plugins import PluginError
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Display, FailedDisplay, Level
from rosmini.viz.rviz.primitives import Primitive


class Group(Display, plugin="rviz/Group"):
    """Displays in order; what is drawn is drawn by them."""

    def __init__(self, name: str = "", tree: Mapping[str, Any] | None = None) -> None:
        super().__init__(name, tree)
        found = (tree or {}).get("Displays")
        parts = found if isinstance(found, list) else []
        self.displays: list[Display] = [display_from(each) for each in parts if isinstance(each, dict)]

    def walk(self) -> Iterator[Display]:
        """All displays in it, in order, groups before what is in them."""
        for display in self.displays:
            yield display
            if isinstance(display, Group):
                yield from display.walk()

    def start(self, context: Context) -> None:
        """Begin, and all in it."""
        for display in self.displays:
            display.attach(context)

    def detach(self) -> None:
        """Leave the graph, and all in it."""
        for display in self.displays:
            display.detach()
        super().detach()

    def reset(self) -> None:
        """Forget what was received."""
        for display in self.displays:
            display.reset()

    @property
    def level(self) -> Level:
        """The worst of all in it that are switched on."""
        return max((each.level for each in self.displays if each.enabled), default=Level.OK)

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Nothing of its own."""
        del context
        return ()

    def unknown(self) -> list[str]:
        """What its part of a file has beside the displays."""
        return [each for each in super().unknown() if each != "Displays"]

    def tree(self) -> dict[str, Any]:
        """Its part of a file, with those of its displays."""
        return {**super().tree(), "Displays": [each.tree() for each in self.displays]}


def display_from(tree: Mapping[str, Any]) -> Display:
    """A display by its part of a file; one of a class that is not known here is kept as it is."""
    kind = str(tree.get("Class", ""))
    try:
        return Display.named(kind)(tree=tree)
    except PluginError as error:
        return FailedDisplay(kind, tree, str(error).partition("; there are")[0])
