"""roslaunch: reads launch files into a plan that can be inspected, and starts the nodes of a plan.

>>> from rosmini.ros.launch import read
>>> plan = read(text='<launch><group ns="robot1"><node pkg="tf" type="tf_monitor" name="monitor"/></group></launch>')
>>> [node.full_name for node in plan.nodes]
['/robot1/monitor']

Names are imported on first use, so that scripts that import ``roslaunch`` start as quickly as others.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .errors import LaunchError, Missing, Place
    from .plan import LaunchFile, Machine, NodePlan, Plan, Setting, TestPlan
    from .reader import find_file, plan_of, read
    from .running import Launch, roslaunch

__all__ = [
    "Launch",
    "LaunchError",
    "LaunchFile",
    "Machine",
    "Missing",
    "NodePlan",
    "Place",
    "Plan",
    "Setting",
    "TestPlan",
    "find_file",
    "plan_of",
    "read",
    "roslaunch",
]

_HOMES = {
    "errors": "LaunchError Missing Place",
    "plan": "LaunchFile Machine NodePlan Plan Setting TestPlan",
    "reader": "find_file plan_of read",
    "running": "Launch roslaunch",
}


def __getattr__(name: str) -> Any:
    for module, names in _HOMES.items():
        if name in names.split():
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
