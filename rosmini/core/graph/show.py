"""Display of objects without a dependency on renderers: a renderer is found by name when it is needed.

Renderers are entry points of the group `rosmini.renderers` (`computation_graph = "rosmini.viz.rqt.graph:rqt_graph"`),
as nodes are of `rosmini.nodes`. The parts below `rosmini.viz` therefore need not import it, and other packages can add
renderers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.entry_points import entry_points
from rosmini.core.errors import RosminiError, nearest

if TYPE_CHECKING:
    from .graph import Graph

GROUP = "rosmini.renderers"


class UnknownExtension(RosminiError):
    """No installed package has registered the requested extension."""


def find_extension(group: str, name: str) -> Any:
    """Return the object that an installed package registered under a name in a group of entry points.

    Raises `UnknownExtension` if no package has.
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
    """Return the view of an object from the renderer that is registered for its kind; `options` go to that renderer.

    Raises `UnknownExtension` if no installed package has one.
    """
    return find_extension(GROUP, kind)(thing, **options)


def has_own_process(graph: Graph) -> bool:
    """Return True if this process is one of several of a graph in wall-clock time, and does not run the graph live."""
    return not (graph.simulated or graph.master.is_local or graph.is_live)
