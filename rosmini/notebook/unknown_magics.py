"""Advice on a magic that IPython does not find: load rosmini first, or correct the name.

It is a separate IPython extension, because the first case occurs before ``%load_ext rosmini``: ``rosmini lab`` starts
its kernels with it. ``%load_ext rosmini`` registers it as well.
"""

from __future__ import annotations

import re
import sys
from typing import Any

_UNKNOWN = re.compile(r"`(%%?\w+)`")
"""How IPython's error names the magic."""


def load_ipython_extension(shell: Any) -> None:
    """Give advice after each cell of a shell that fails with an unknown magic; harmless when repeated."""
    shell.events.register("post_run_cell", advise)


def advise(result: Any) -> None:
    """Print advice on the unknown magic in a failed cell, if rosmini has a similar one."""
    if type(result.error_in_exec).__name__ == "UsageError":
        from IPython.core.getipython import get_ipython

        advice = advice_on(str(result.error_in_exec), get_ipython())
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
    load = "run `%load_ext rosmini` in a cell first"
    if typed in own:
        return f"{typed} comes with rosmini: {load}"
    hint = nearest(typed, own)
    return hint and f"{hint} It comes with rosmini: {load}"
