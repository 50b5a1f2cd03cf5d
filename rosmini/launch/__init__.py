"""roslaunch: from launch files to a plan that can be looked at, and from the plan to running nodes.

>>> from rosmini.launch import read
>>> plan = read(text='<launch><group ns="robot1"><node pkg="tf" type="tf_monitor" name="monitor"/></group></launch>')
>>> [node.full_name for node in plan.nodes]
['/robot1/monitor']
"""

from __future__ import annotations

from .by_name import plan_of, roslaunch
from .errors import LaunchError, Missing, Place
from .plan import LaunchFile, Machine, NodePlan, Plan, Setting, TestPlan
from .reader import find_file, read
from .running import Launch

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
