"""``command="..."`` of ``<param>``: the output of the command becomes the parameter.

ROS runs any program there. Here no program or shell is run: the commands that launch files need in practice are
functions of rosmini, and any other command is refused with a suggestion.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Sequence
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError, UsageError
from rosmini.core.files import read
from rosmini.core.graph.show import find_extension

if TYPE_CHECKING:
    from rosmini.core.packages import PackageIndex

MAX_BYTES = 16_000_000
"""Maximum number of bytes that ``cat`` reads."""

PYTHONS = ("python", "python3", "python2")


class NotAllowed(RosminiError):
    """A command that rosmini does not support."""


def output_of(command: str, packages: PackageIndex) -> str:
    """Return the output of a command.

    Supported are ``xacro`` (also by its path, or after ``rosrun xacro`` or ``python``), ``cat``, ``echo`` and
    ``rospack find``. Raises ``NotAllowed`` for any other, ``OSError`` for a file, and the errors of xacro.
    """
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise UsageError(f"command [{command}] cannot be split into words: {error}") from error
    if words and PurePath(words[0]).name in PYTHONS:
        words = words[1:]
    if words[:1] == ["rosrun"]:
        words = words[2:]
    name = PurePath(words[0]).name.removesuffix(".py") if words else ""
    act = ALLOWED.get(name)
    if act is None:
        raise NotAllowed(
            f"command [{command}] is not run: in a launch file rosmini does {', '.join(sorted(ALLOWED))} itself, "
            'and no other program. Run it beforehand, write what it prints to a file, and load that with textfile="..."'
        )
    return act(words[1:], packages)


def _xacro(words: Sequence[str], packages: PackageIndex) -> str:
    mappings = dict(word.split(":=", 1) for word in words if ":=" in word)
    files = [word for word in words if ":=" not in word and not word.startswith("-")]
    if len(files) != 1:
        raise UsageError(f"xacro takes one file, not {' '.join(files) or 'none'}")
    expand = find_extension("rosmini.launch_commands", "xacro")
    expanded: str = expand(files[0], mappings, packages=packages)
    return expanded


def _cat(words: Sequence[str], packages: PackageIndex) -> str:  # noqa: ARG001 - alike
    return "".join(read(Path(word), MAX_BYTES).decode("utf-8") for word in words if word != "-")


def _echo(words: Sequence[str], packages: PackageIndex) -> str:  # noqa: ARG001 - alike
    newline = words[:1] != ["-n"]
    return " ".join(words if newline else words[1:]) + ("\n" if newline else "")


def _rospack(words: Sequence[str], packages: PackageIndex) -> str:
    if len(words) != 2 or words[0] != "find":
        raise NotAllowed(f"rospack {' '.join(words)}: in a launch file there is `rospack find PACKAGE`")
    return f"{packages.path(words[1])}\n"


ALLOWED: dict[str, Callable[[Sequence[str], PackageIndex], str]] = {
    "cat": _cat,
    "echo": _echo,
    "rospack": _rospack,
    "xacro": _xacro,
}
