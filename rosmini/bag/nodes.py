"""The executables of the package ``rosbag``: ``rosrun rosbag record -O trip /scan``, ``rosrun rosbag play t.bag``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .keys import Keys
from .options import play_options, record_options
from .player import Player
from .recorder import Recorder

if TYPE_CHECKING:
    from rosmini.graph import Node


def record(node: Node, *args: str) -> Recorder:
    """Record what the arguments say. Raises ``UsageError`` for arguments that make no sense, else as `Recorder`."""
    return Recorder(node, record_options(args))


def play(node: Node, *args: str) -> Player:
    """Play what the arguments say; with ``--keys`` the terminal pauses and steps.

    Raises ``UsageError`` for arguments that make no sense, else as `Player`.
    """
    keys = "--keys" in args
    bags, options = play_options([word for word in args if word != "--keys"])
    player = Player(node, bags, options)
    if keys and not options.quiet:
        Keys(player)
    return player
