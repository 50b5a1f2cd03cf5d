"""Group: displays that are switched on and off together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from rosmini.core.plugins import PluginError
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Display, FailedDisplay, Level
from rosmini.viz.rviz.primitives import Primitive


class Group(Display, plugin="rviz/Group"):
    """Displays in order; they draw, the group itself does not."""

    def __init__(self, name: str = "", tree: Mapping[str, Any] | None = None) -> None:
        super().__init__(name, tree)
        found = (tree or {}).get("Displays")
        parts = found if isinstance(found, list) else []
        self.displays: list[Display] = [display_from(each) for each in parts if isinstance(each, dict)]

    def walk(self) -> Iterator[Display]:
        """Yield all displays in it, in order, groups before their members."""
        for display in self.displays:
            yield display
            if isinstance(display, Group):
                yield from display.walk()

    def start(self, context: Context) -> None:
        """Start all displays in it."""
        for display in self.displays:
            display.attach(context)

    def detach(self) -> None:
        """Remove all displays in it from the graph."""
        for display in self.displays:
            display.detach()
        super().detach()

    def reset(self) -> None:
        """Discard received messages."""
        for display in self.displays:
            display.reset()

    @property
    def level(self) -> Level:
        """The worst level of the enabled displays in it."""
        return max((each.level for each in self.displays if each.enabled), default=Level.OK)

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return nothing: the group itself draws nothing."""
        del context
        return ()

    def unknown(self) -> list[str]:
        """Return the unknown properties of its part of a file, without the displays."""
        return [each for each in super().unknown() if each != "Displays"]

    def tree(self) -> dict[str, Any]:
        """Return its part of a file, with those of its displays."""
        return {**super().tree(), "Displays": [each.tree() for each in self.displays]}


def display_from(tree: Mapping[str, Any]) -> Display:
    """Return the display for a part of a file; one of an unknown class is preserved as it is."""
    kind = str(tree.get("Class", ""))
    try:
        return Display.named(kind)(tree=tree)
    except PluginError as error:
        return FailedDisplay(kind, tree, str(error).partition("; there are")[0])
