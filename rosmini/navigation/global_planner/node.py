"""`global_planner/planner`: see `rosmini.navigation.navfn.node`."""

from __future__ import annotations

from typing import ClassVar

from rosmini.navigation.navfn.node import PlannerNode


class Planner(PlannerNode):
    """`global_planner/planner`."""

    plugin: ClassVar[str] = "global_planner/GlobalPlanner"
    name: ClassVar[str] = "planner"
