"""How a thing shows itself without knowing who draws: a renderer is found by name when it is needed.

Renderers are entry points of the group `rosmini.renderers` (`"computation_graph" = "rosmini.viz.rqt:rqt_graph"`), as
executables are of `rosmini.nodes`. So no floor below `rosmini.viz` imports it, and another package can bring its own.
"""

from __future__ import annotations

from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, nearest

if TYPE_CHECKING:
    from .graph import Graph

GROUP = "rosmini.renderers"


class UnknownExtension(RosminiError):
    """No installed package says that it has what was asked for."""


def find_extension(group: str, name: str) -> Any:
    """Return what an installed package registered under a name in a group of entry points.

    Raises `UnknownExtension` if none has.
    """
    found = entry_points(group=group)
    if name not in found.names:
        hint = nearest(name, found.names)
        raise UnknownExtension(
            f"nothing is registered as {name!r}{': ' + hint if hint else ''} among the entry points of the group "
            f"{group!r}; if rosmini was installed before it had this one, install it again (`uv sync`)."
        )
    return found[name].load()


def show(kind: str, thing: object, **options: Any) -> Any:
    """The view of a thing, made by the renderer that is registered for its kind; `options` go to that renderer.

    Raises `UnknownExtension` if no installed package has one.
    """
    return find_extension(GROUP, kind)(thing, **options)


def has_own_process(graph: Graph) -> bool:
    """Return whether this process is but one of a graph's, in wall time, and no notebook that goes on by itself."""
    return not (graph.simulated or graph.master.is_local or graph.is_live)
