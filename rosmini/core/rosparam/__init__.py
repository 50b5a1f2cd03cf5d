"""Parameters as YAML: the ROS package ``rosparam``, for files and for the Parameter Server.

>>> from rosmini import Graph
>>> from rosmini.core.rosparam import ParamClient
>>> with Graph() as graph:
...     params = ParamClient(graph)
...     params.loads("{gains: {p: 1.0, i: 2}, heading: deg(180)}", "/robot")
...     print(params.dumps("/robot"), end="")
['/robot/gains/p', '/robot/gains/i', '/robot/heading']
gains:
  i: 2
  p: 1.0
heading: 3.141592653589793

Scripts run by rosmini use it as ``import rosparam``, with the functions of ROS's module.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .client import ParamClient
from .errors import RosParamException, RosParamIOException

if TYPE_CHECKING:
    from .documents import NS, assignments, dumps, load_file, load_str, parse, pretty, printed

__all__ = [
    "NS",
    "ParamClient",
    "RosParamException",
    "RosParamIOException",
    "assignments",
    "dumps",
    "load_file",
    "load_str",
    "parse",
    "pretty",
    "printed",
]


def __getattr__(name: str) -> Any:
    """Import the YAML functions on first use."""
    if name in __all__:
        return getattr(import_module(f"{__name__}.documents"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
