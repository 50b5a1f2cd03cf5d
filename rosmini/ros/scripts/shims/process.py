"""Replacements for modules with process state: ``sys``, ``builtins``, ``atexit``, ``signal``, ``importlib``."""

from __future__ import annotations

import atexit as real_atexit
import builtins as real_builtins
import importlib as real_importlib
import signal as real_signal
import sys as real_sys
from types import ModuleType
from typing import TYPE_CHECKING, Any, NoReturn

from . import as_builtins, copy_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.ros.scripts.context import ScriptContext

_OWN = ("argv", "path", "stdin", "stdout", "stderr")


class _ScriptSys(ModuleType):
    """A script's ``sys``: its arguments, path and streams, also in its real threads; otherwise the real module."""

    def __init__(self, context: ScriptContext) -> None:
        super().__init__("sys", real_sys.__doc__)
        self.__dict__["_context"] = context
        self.__dict__["excepthook"] = real_sys.excepthook

    def __getattr__(self, name: str) -> Any:
        if name in _OWN:
            return self.__dict__["_context"].get_own(name)
        return getattr(real_sys, name)

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _OWN:
            self.__dict__["_context"].set_own(name, value)
        else:
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*dir(real_sys), *self.__dict__})


def make_sys(context: ScriptContext) -> ModuleType:
    """Create the ``sys`` of one script."""
    return _ScriptSys(context)


def make_builtins(context: ScriptContext) -> ModuleType:
    """Return the script's builtins; its changes stay private."""
    return context.builtins_module


def make_importlib(context: ScriptContext) -> ModuleType:
    """Create an ``importlib`` that finds the modules beside the script."""
    module = copy_of(real_importlib)
    load = context.importer.load

    def import_module(name: str, package: str | None = None) -> ModuleType:
        """Import a module; a relative name is relative to ``package``."""
        if name.startswith("."):
            if not package:
                raise TypeError(f"the 'package' argument is required to perform a relative import for {name!r}")
            from importlib.util import resolve_name

            name = resolve_name(name, package)
        return load(name)

    module.__dict__.update(import_module=import_module, __import__=context.importer.import_name)
    return module


def make_atexit(context: ScriptContext) -> ModuleType:
    """Create an ``atexit`` whose functions run when this script ends, last in, first out."""
    module = copy_of(real_atexit)
    calls = context.exit_calls

    def register(function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Callable[..., Any]:
        if not callable(function):
            raise TypeError("the first argument must be callable")
        calls.append((function, args, kwargs))
        return function

    def unregister(function: Callable[..., Any], /) -> None:
        calls[:] = [call for call in calls if call[0] != function]

    as_builtins(
        module,
        register=register,
        unregister=unregister,
        _clear=calls.clear,
        _ncallbacks=lambda: len(calls),
        _run_exitfuncs=context.run_exit_calls,
    )
    return module


def make_signal(context: ScriptContext) -> ModuleType:
    """Create a ``signal`` that stores handlers for this script; on Ctrl-C the runner calls them."""
    module = copy_of(real_signal)
    handlers = context.handlers
    defaults = {real_signal.SIGINT: real_signal.default_int_handler}
    alarm = _Alarm(context)

    def handle(signum: int, handler: Any, /) -> Any:
        number = real_signal.Signals(signum)
        if not callable(handler) and handler not in (real_signal.SIG_DFL, real_signal.SIG_IGN):
            raise TypeError("signal handler must be signal.SIG_IGN, signal.SIG_DFL, or a callable object")
        previous = getsignal(number)
        handlers[number] = handler
        return previous

    def getsignal(signum: int, /) -> Any:
        number = real_signal.Signals(signum)
        return handlers.get(number, defaults.get(number, real_signal.SIG_DFL))

    as_builtins(
        module,
        signal=handle,
        getsignal=getsignal,
        raise_signal=context.raise_signal,
        pause=context.await_signal,
        siginterrupt=lambda _signum, _flag: None,
    )
    if hasattr(real_signal, "SIGALRM"):
        as_builtins(module, setitimer=alarm.set_timer, getitimer=alarm.get_timer, alarm=alarm.alarm)
    return module


class _Alarm:
    """``alarm`` and ``setitimer`` in graph time; only ``ITIMER_REAL``, since a script has no processor time."""

    def __init__(self, context: ScriptContext) -> None:
        self._context = context
        self._timer: Any = None
        self._interval = 0.0

    def set_timer(self, which: int, seconds: float, interval: float = 0.0, /) -> tuple[float, float]:
        if which != real_signal.ITIMER_REAL:
            raise ValueError("a script in rosmini has ITIMER_REAL only")
        before = self.get_timer(which)
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._interval = interval
        if seconds > 0:
            scheduler = self._context.scheduler
            self._timer = scheduler.call_at(scheduler.now_ns() + round(seconds * 1e9), self._fire)
        return before

    def get_timer(self, _which: int, /) -> tuple[float, float]:
        if self._timer is None:
            return (0.0, 0.0)
        return (max(self._timer.when_ns - self._context.scheduler.now_ns(), 0) / 1e9, self._interval)

    def alarm(self, seconds: int, /) -> int:
        return round(self.set_timer(real_signal.ITIMER_REAL, seconds)[0])

    def _fire(self) -> None:
        self._timer = None
        if self._context.ended:
            return
        if self._interval > 0:
            self.set_timer(real_signal.ITIMER_REAL, self._interval, self._interval)
        self._context.process.signal_itself(real_signal.SIGALRM, in_place=False)


def make_builtins_module(context: ScriptContext) -> ModuleType:
    """Create the builtins of one script, with its own ``__import__``, ``input``, ``print``, ``exit`` and ``quit``."""
    module = copy_of(real_builtins)

    def read_input(prompt: object = "", /) -> str:
        stdout, stdin = context.get_own("stdout"), context.get_own("stdin")
        if prompt != "":
            stdout.write(str(prompt))
        stdout.flush()
        line: str = stdin.readline()
        if not line:
            raise EOFError("EOF when reading a line")
        return line.removesuffix("\n")

    def print_line(*values: object, file: Any = None, **options: Any) -> None:
        real_builtins.print(*values, file=context.get_own("stdout") if file is None else file, **options)

    def leave(code: object = None, /) -> NoReturn:
        raise SystemExit(code)  # IPython hides Python's own while a cell runs

    as_builtins(module, input=read_input, print=print_line, exit=leave, quit=leave)
    module.__dict__["__import__"] = context.importer.import_name
    for name in ("get_ipython", "display"):  # IPython's, missing on a robot
        module.__dict__.pop(name, None)
    return module
