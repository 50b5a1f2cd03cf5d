"""Scripts written for rospy, unmodified and several at once, inside one process.

:func:`run_scripts` is `rosmini run`; :func:`run_source` runs a text, for tests and notebooks.
"""

from __future__ import annotations

from .context import ScriptContext, current_script
from .runner import RunResult, ScriptSpec, run_scripts, run_source

__all__ = ["RunResult", "ScriptContext", "ScriptSpec", "current_script", "run_scripts", "run_source"]
