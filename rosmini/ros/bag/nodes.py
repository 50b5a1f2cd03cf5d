"""The executables of the package ``rosbag``: ``rosrun rosbag record -O trip /scan``, ``rosrun rosbag play t.bag``."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import nearest
from rosmini.core.files import names_in

from .errors import ROSBagException
from .keys import Keys
from .options import play_options, record_options
from .player import Player
from .recorder import Recorder

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.core.graph import Node


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
