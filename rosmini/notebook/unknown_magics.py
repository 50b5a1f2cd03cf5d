"""Advice on a name, magic or module that a cell does not find: which cell to run first, or the correct name.

It is a separate IPython extension, because the need to load occurs before ``%load_ext rosmini``: ``rosmini lab`` starts
its kernels with it. ``%load_ext rosmini`` registers it as well.
"""

from __future__ import annotations

import re
import sys
from typing import Any

_UNKNOWN = re.compile(r"`(%%?\w+)`")
"""How IPython's error names the magic."""
_NOT_WRITTEN = re.compile(r"package [\[']notebook\b|(No module named|cannot import name \S+ from) 'notebook\b")
"""How errors say that the package of the notebook lacks a script, a launch file or a message."""
_IMPORTED = ("check", "np", "plt", "rosmini", "rospy")
"""Names that chapters import near the top."""
LOAD = "comes with rosmini: run `%load_ext rosmini` in a cell first"


def load_ipython_extension(shell: Any) -> None:
    """Give advice after each cell that fails with an unknown name, magic or module; harmless when repeated."""
    shell.events.register("post_run_cell", advise)


def advise(result: Any) -> None:
    """Print advice on the unknown name, magic or module in a failed cell, if there is any."""
    error, advice = result.error_in_exec, ""
    if type(error).__name__ == "UsageError":
        from IPython.core.getipython import get_ipython

        advice = advice_on(str(error), get_ipython())
    elif _NOT_WRITTEN.search(str(error)) and "did you mean" not in str(error):
        advice = "cells with %%node, %%launch, %%msg, %%srv or %%action write the package notebook: run them first"
    elif isinstance(error, ModuleNotFoundError) and error.name:
        advice = advice_on_module(error.name)
    elif type(error) is NameError and error.name:
        advice = advice_on_name(error.name)
    if advice:
        print(f"rosmini: {advice}", file=sys.stderr)


def advice_on(message: str, shell: Any) -> str:
    """Return advice on IPython's error message; empty if it names no magic similar to one of rosmini's."""
    from rosmini.core.errors import nearest
    from rosmini.tools.main import COMMANDS

    from .extension import OWN_MAGICS, is_loaded

    found = _UNKNOWN.search(message)
    if found is None or "not found" not in message or "exists" in message:
        return ""
    marks = {"line": "%", "cell": "%%"}
    own = {marks[kind] + name for kind, name, _ in OWN_MAGICS}
    own |= {f"%{name}" for name, entry in COMMANDS.items() if entry.is_magic}
    typed = found[1]
    if is_loaded(shell):
        return nearest(typed, {name for name in own if name.count("%") == typed.count("%")})
    if typed in own:
        return f"{typed} {LOAD}"
    hint = nearest(typed, own)
    return hint and f"{hint} It {LOAD}"


def advice_on_module(name: str) -> str:
    """Return advice on a module that Python does not find; empty if it is not in ROS, or rosmini is loaded."""
    from rosmini.core.packages import PackageIndex
    from rosmini.ros.rospy.importer import homes, installed

    package = name.partition(".")[0]
    if installed() or (package not in homes() and package not in PackageIndex()):
        return ""
    return f"the module {package} {LOAD}"


def advice_on_name(name: str) -> str:
    """Return advice on a variable that no cell has defined yet."""
    if name in _IMPORTED:
        return f"the cell near the top of the chapter that imports `{name}` has not run: run it first"
    return f"if a cell above defines `{name}`, run that cell first"
