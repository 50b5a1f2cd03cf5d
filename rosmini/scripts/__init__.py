"""Scripts written for rospy, unmodified and several at once, inside one process.

:func:`run_scripts` is `rosmini run`; :func:`run_source` runs a text, for tests and notebooks; :func:`rosrun` starts what a
package has.
"""

from __future__ import annotations

from .by_name import rosrun
from .context import ScriptContext, current_script
from .runner import NodeSpec, RunResult, ScriptSpec, run_scripts, run_source

__all__ = [
    "NodeSpec",
    "RunResult",
    "ScriptContext",
    "ScriptSpec",
    "current_script",
    "rosrun",
    "run_scripts",
    "run_source",
]
