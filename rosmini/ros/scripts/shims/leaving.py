"""``os`` for one script: ``_exit``, ``abort`` and a signal to itself end the script, never the process.

Everything else is the process's: other processes get their signals, and a forked child exits as usual.
"""

from __future__ import annotations

import os as real_os
import signal
from types import ModuleType
from typing import TYPE_CHECKING, Any

from . import as_builtins

if TYPE_CHECKING:
    from rosmini.ros.scripts.context import ScriptContext


class _ScriptOs(ModuleType):
    """A script's ``os``; other attributes come from the real module, whose ``environ`` is swapped."""

    def __init__(self) -> None:
        super().__init__("os", real_os.__doc__)

    def __getattr__(self, name: str) -> Any:
        return getattr(real_os, name)

    def __dir__(self) -> list[str]:
        return sorted({*dir(real_os), *self.__dict__})


def make_os(context: ScriptContext) -> ModuleType:
    """Create the ``os`` of one script."""
    module = _ScriptOs()
    home = real_os.getpid()

    def leave(status: int) -> None:
        if real_os.getpid() != home:  # the child of a forking script
            real_os._exit(status)
        context.leave_process(status & 0xFF)

    def abort() -> None:
        if real_os.getpid() != home:
            real_os.abort()
        context.leave_process(-signal.SIGABRT)

    def kill(pid: int, signum: int, /) -> None:
        own = real_os.getpid()
        if own != home or pid not in (own, 0):  # 0: all of the group, of which the script knows itself
            real_os.kill(pid, signum)
        elif signum:
            context.raise_signal(signum)

    as_builtins(module, _exit=leave, abort=abort, kill=kill)
    if hasattr(real_os, "killpg"):

        def killpg(group: int, signum: int, /) -> None:
            if group in (real_os.getpgrp(), 0):
                kill(0, signum)
            else:
                real_os.killpg(group, signum)

        as_builtins(module, killpg=killpg)
    return module
