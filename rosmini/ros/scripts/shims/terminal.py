"""``select``, ``termios``, ``tty`` and ``msvcrt`` for keyboard scripts that poll for a key.

With a real terminal they act on it. With supplied input, or input from a pipe, terminal settings are
accepted without effect, so that the same script runs in a test.
"""

from __future__ import annotations

import importlib
import select as real_select
from types import ModuleType
from typing import TYPE_CHECKING, Any

from rosmini.ros.scripts.stdin import ConsoleFeed, ScriptInput

from . import as_builtins, copy_of

if TYPE_CHECKING:
    from rosmini.ros.scripts.context import ScriptContext


def _own_input(context: ScriptContext, item: object) -> ScriptInput | None:
    """Return the script's standard input if ``item`` (a file or a descriptor) refers to it."""
    stdin = context.get_own("stdin")
    if isinstance(item, ScriptInput):
        return item
    if isinstance(stdin, ScriptInput) and isinstance(item, int) and item == stdin.fileno():
        return stdin
    return None


def make_select(context: ScriptContext) -> ModuleType:
    """Create a ``select`` whose ``select()`` parks the lane; ``poll`` and the others are the real ones."""
    module = copy_of(real_select)
    scheduler = context.scheduler

    def real(readable: list[Any], writable: list[Any], wrong: list[Any], timeout_ns: int | None) -> Any:
        if timeout_ns == 0:
            return real_select.select(readable, writable, wrong, 0)
        if scheduler.simulated and timeout_ns is not None:
            found = real_select.select(readable, writable, wrong, 0)
            if any(found):
                return found
            context.pause("select() to end", timeout_ns)
            return real_select.select(readable, writable, wrong, 0)
        seconds = None if timeout_ns is None else timeout_ns / 1e9 / scheduler.rate
        return scheduler.in_thread(lambda: real_select.select(readable, writable, wrong, seconds))

    def select(readable: Any, writable: Any, wrong: Any, timeout: float | None = None, /) -> Any:
        if timeout is not None and timeout < 0:
            raise ValueError("timeout must be non-negative")
        timeout_ns = None if timeout is None else round(timeout * 1e9)
        readable, writable, wrong = list(readable), list(writable), list(wrong)
        inputs = [(item, own) for item in readable if (own := _own_input(context, item)) is not None]
        if not inputs and not readable and not writable and not wrong:
            context.pause("select() to end", timeout_ns)
            return [], [], []
        if not inputs:
            return real(readable, writable, wrong, timeout_ns)
        others = [item for item in readable if _own_input(context, item) is None]
        if others or writable or wrong:
            # Sockets beside the keyboard: check what is ready now, then wait for the keyboard.
            found = real(others, writable, wrong, 0)
            keys = [item for item, own in inputs if own.ready(0)]
            if any(found) or keys:
                return found[0] + keys, found[1], found[2]
        keys = [item for item, own in inputs if own.ready(timeout_ns)]
        found = real(others, writable, wrong, 0) if others or writable or wrong else ([], [], [])
        return found[0] + keys, found[1], found[2]

    as_builtins(module, select=select)
    return module


def _optional(name: str) -> ModuleType | None:
    try:
        return importlib.import_module(name)
    except ImportError:  # Windows
        return None


def _console(stdin: object) -> ConsoleFeed | None:
    """Return the console of Windows, if it is the script's standard input."""
    feed = stdin.feed if isinstance(stdin, ScriptInput) else None
    return feed if isinstance(feed, ConsoleFeed) else None


def make_msvcrt(context: ScriptContext) -> ModuleType:
    """Create an ``msvcrt`` whose keys park the lane. Raises ``ModuleNotFoundError`` except on Windows."""
    real = _optional("msvcrt")
    if real is None:
        raise ModuleNotFoundError("No module named 'msvcrt'", name="msvcrt")
    module = copy_of(real)
    stdin = context.get_own("stdin")
    console = _console(stdin)

    def kbhit() -> bool:
        if console is not None:
            console.takes_keys = True
        return bool(stdin.ready(0))

    def getwch() -> str:
        if console is not None:
            console.takes_keys = True
        return str(stdin.read(1))

    def getch() -> bytes:
        return getwch().encode()

    if isinstance(stdin, ScriptInput):
        as_builtins(module, kbhit=kbhit, getwch=getwch, getwche=getwch, getch=getch, getche=getch)
    return module


def make_termios(context: ScriptContext) -> ModuleType:
    """Create a ``termios`` that ignores input which is not a terminal.

    On Windows, which has no termios, it switches between lines and keys. Raises ``ModuleNotFoundError`` if neither
    is possible.
    """
    real = _optional("termios")
    stdin = context.get_own("stdin")
    console = _console(stdin)
    if real is None and console is None and (not isinstance(stdin, ScriptInput) or stdin.isatty()):
        raise ModuleNotFoundError(
            "No module named 'termios': this terminal has none. Run the script in a Windows console, or pipe its input",
            name="termios",
        )
    module: Any = ModuleType("termios") if real is None else copy_of(real)
    if real is None:
        module.error = type("error", (Exception,), {"__module__": "termios"})
        for number, name in enumerate(("TCSANOW", "TCSADRAIN", "TCSAFLUSH", "TCIFLUSH", "TCOFLUSH", "TCIOFLUSH")):
            setattr(module, name, number % 3)
        module.ECHO, module.ICANON, module.VMIN, module.VTIME = 8, 2, 6, 5

    def pretended(item: object) -> bool:
        own = _own_input(context, item)
        return own is not None and not own.isatty()

    def tcgetattr(fd: Any, /) -> list[Any]:
        if console is not None:
            return [0, 0, 0, 0 if console.takes_keys else module.ICANON | module.ECHO, 0, 0, [b"\0"] * 32]
        if pretended(fd):
            return [0, 0, 0, 0, 0, 0, [b"\0"] * 32]
        return list(real.tcgetattr(_descriptor(fd)))  # type: ignore[union-attr]

    def wrap(name: str) -> Any:
        function = getattr(real, name, None)

        def call(fd: Any, *args: Any) -> Any:
            if console is not None:
                if name == "tcsetattr":
                    console.takes_keys = not args[1][3] & module.ICANON
                return None
            return None if pretended(fd) or function is None else function(_descriptor(fd), *args)

        call.__name__ = name
        return call

    module.tcgetattr = tcgetattr
    for name in ("tcsetattr", "tcflush", "tcdrain", "tcflow", "tcsendbreak"):
        setattr(module, name, wrap(name))
    return module  # type: ignore[no-any-return]


def _descriptor(item: Any) -> int:
    return item if isinstance(item, int) else int(item.fileno())


def make_tty(context: ScriptContext) -> ModuleType:
    """Create a ``tty`` to go with :func:`make_termios`."""
    termios: Any = context.importer.load("termios")
    real = _optional("tty")
    module: Any = ModuleType("tty") if real is None else copy_of(real)

    def wrap(name: str) -> Any:
        function = getattr(real, name, None)

        def call(fd: Any, when: int = termios.TCSAFLUSH) -> Any:
            console = _console(context.get_own("stdin"))
            if console is not None:
                console.takes_keys = True
                return None
            own = _own_input(context, fd)
            if function is None or (own is not None and not own.isatty()):
                return None
            return function(_descriptor(fd), when)

        call.__name__ = name
        return call

    module.setraw, module.setcbreak = wrap("setraw"), wrap("setcbreak")
    return module  # type: ignore[no-any-return]
