"""Runs unmodified rospy scripts, several at once, inside one process.

:func:`run_scripts` is `rosmini run`; :func:`run_source` runs a text; :func:`rosrun` starts an executable of a
package and returns its handle.
"""

from __future__ import annotations

from .console import Console
from .context import current_script
from .handle import StillRunning
from .node_handle import NodeHandle, NodeSpec
from .runner import RunResult, find, rosrun, run_scripts, run_source
from .script_handle import ScriptHandle, ScriptSpec

__all__ = [
    "Console",
    "NodeHandle",
    "NodeSpec",
    "RunResult",
    "ScriptHandle",
    "ScriptSpec",
    "StillRunning",
    "current_script",
    "find",
    "rosrun",
    "run_scripts",
    "run_source",
]
