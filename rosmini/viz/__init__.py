"""Pictures and views: RViz, rqt, replay, 3D scenes and live widgets.

Modules that draw with numpy and matplotlib are imported on first use.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rosmini.viz.view import Picture, View, ViewError, matplotlib_picture

if TYPE_CHECKING:
    from rosmini.viz.byte_maps import byte_map
    from rosmini.viz.parameter_trees import parameter_tree
    from rosmini.viz.plots import plot
    from rosmini.viz.rqt.bag import rqt_bag
    from rosmini.viz.rqt.graph import rqt_graph
    from rosmini.viz.sequences import sequence_diagram
    from rosmini.viz.state_machine import action_states

__all__ = [
    "Picture",
    "View",
    "ViewError",
    "action_states",
    "byte_map",
    "matplotlib_picture",
    "parameter_tree",
    "plot",
    "rqt_bag",
    "rqt_graph",
    "sequence_diagram",
]

_LATER = {
    "rqt_graph": "rosmini.viz.rqt.graph",
    "action_states": "rosmini.viz.state_machine",
    "byte_map": "rosmini.viz.byte_maps",
    "parameter_tree": "rosmini.viz.parameter_trees",
    "plot": "rosmini.viz.plots",
    "rqt_bag": "rosmini.viz.rqt.bag",
    "sequence_diagram": "rosmini.viz.sequences",
}


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
