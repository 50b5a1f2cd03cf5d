"""The executables of the package ``rosbag``: ``rosrun rosbag record -O trip /scan``, ``rosrun rosbag play t.bag``.

In a terminal, keys control ``play`` (space pauses and resumes, s steps), and a status line shows its progress.
"""

from __future__ import annotations

import os
import sys
import threading
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from rosmini.core.errors import nearest
from rosmini.core.files import names_in

from .errors import ROSBagException
from .options import play_options, record_options
from .player import Player
from .recorder import Recorder

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.core.graph import Node

PERIOD_NS = 100_000_000
"""Period of the status line [ns]."""


def record(node: Node, *args: str) -> Recorder:
    """Record as the arguments say.

    Raises ``UsageError`` for invalid arguments, ``ROSBagException`` for a bag that cannot be opened, and the errors of
    `Recorder`.
    """
    options = record_options(args)
    with _opening():
        return Recorder(node, options)


def play(node: Node, *args: str) -> Player:
    """Play as the arguments say; with ``--keys`` the terminal pauses and steps.

    Raises ``UsageError`` for invalid arguments, ``ROSBagException`` for a bag that cannot be opened, and the errors of
    `Player`.
    """
    keys = "--keys" in args
    bags, options = play_options([word for word in args if word != "--keys"])
    with _opening():
        player = Player(node, bags, options)
    if keys and not options.quiet:
        Keys(player)
    return player


@contextmanager
def _opening() -> Iterator[None]:
    """Turn errors on opening a file into ``ROSBagException``, which suggests similar file names."""
    try:
        yield
    except OSError as error:
        path = Path(error.filename or "")
        hint = nearest(path.name, names_in(path.parent)) if isinstance(error, FileNotFoundError) else ""
        raise ROSBagException(f"Error opening file: {path}: {error.strerror}{f'; {hint}' if hint else ''}") from None


class Keys:
    """Reads keys for a player until its node ends; does nothing without a terminal.

    A thread waits for keys, so that the graph is not blocked; the graph carries out the actions.
    """

    def __init__(self, player: Player, stdin: TextIO | None = None, stdout: TextIO | None = None) -> None:
        self._player = player
        self._stdout = stdout or sys.stdout
        self._scheduler = player.node.scheduler
        self._restore: Callable[[], object] = _nothing
        stdin = stdin or sys.stdin
        if not stdin.isatty():
            return
        try:
            self._restore = _read_keys_at_once(stdin.fileno())
        except (ImportError, OSError):
            return  # not a POSIX terminal
        self._stdout.write("\nHit space to toggle paused, or 's' to step.\n")
        player.node.on_shutdown(self.close)
        self._file = stdin.fileno()
        threading.Thread(target=self._read, name="keys of rosbag play", daemon=True).start()
        self._scheduler.run_in_scheduler(self._show)

    def close(self) -> None:
        """Restore the terminal; may be called repeatedly."""
        restore, self._restore = self._restore, _nothing
        if restore is not _nothing:
            restore()
            self._stdout.write("\nDone.\n")
            self._stdout.flush()

    def _read(self) -> None:
        while not self._player.done:
            try:
                key = os.read(self._file, 1)
            except OSError:
                return
            if not key:
                return
            press = lambda key=key: self.press(key.decode("ascii", "ignore"))  # noqa: E731
            self._scheduler.call_soon_threadsafe(press)

    def press(self, key: str) -> None:
        """Carry out the action of a key."""
        player = self._player
        if player.done:
            return
        if key == " ":
            (player.resume if player.paused else player.pause)()
        elif key == "s" and player.paused:
            player.step()
        self._write()

    def _show(self) -> None:
        if not self._player.done:
            self._write()
            self._scheduler.call_at(self._scheduler.now_ns() + PERIOD_NS, self._show)

    def _write(self) -> None:
        self._stdout.write("\r" + status_line(self._player))
        self._stdout.flush()


def status_line(player: Player) -> str:
    """Return the status line of a player, in the words of ROS's tool."""
    now = player.position.to_nsec()
    state = "PAUSED " if player.paused else "RUNNING"
    passed, length = (now - player.start) / 1e9, (player.end - player.start) / 1e9
    return f" [{state}]  Bag Time: {now / 1e9:13.6f}   Duration: {passed:.6f} / {length:.6f}               "


def _read_keys_at_once(file: int) -> Callable[[], object]:
    """Make a terminal deliver keys at once without echo; return a function that undoes it. Ctrl-C still works."""
    import termios
    import tty

    before = termios.tcgetattr(file)
    tty.setcbreak(file)

    def restore() -> None:
        with suppress(termios.error, OSError):
            termios.tcsetattr(file, termios.TCSADRAIN, before)

    return restore


def _nothing() -> None:
    """Restore nothing."""
