"""How a thing shows itself without knowing who draws: a renderer is found by name when it is needed.

Renderers are entry points of the group `rosmini.renderers` (`"computation_graph" = "rosmini.viz.rqt:rqt_graph"`), as
executables are of `rosmini.nodes`. So no floor below `rosmini.viz` imports it, and another package can bring its own.
"""

from __future__ import annotations

from importlib.metadata import entry_points
from typing import Any

from rosmini.errors import RosminiError, nearest

GROUP = "rosmini.renderers"


class UnknownRenderer(RosminiError):
    """No installed package says that it can draw this kind of thing."""


def show(kind: str, thing: object, **options: Any) -> Any:
    """The view of a thing, made by the renderer that is registered for its kind; `options` go to that renderer.

    Raises `UnknownRenderer` if no installed package has one.
    """
    found = entry_points(group=GROUP)
    if kind not in found.names:
        hint = nearest(kind, found.names)
        raise UnknownRenderer(
            f"nothing is registered to show a {kind!r}{': ' + hint if hint else ''}. Renderers are entry points of "
            f"the group {GROUP!r}; if rosmini was installed before it had this one, install it again (`uv sync`)."
        )
    return found[kind].load()(thing, **options)
