"""Completion of command lines: verbs, options, and the names that currently exist.

Shells call `rosmini aliases --complete`, IPython calls :func:`candidates`. Nothing here reports errors: if no
Master answers, there are no names.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.core.verbs import Tool

from .main import COMMANDS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from rosmini.core.peers import Peers
    from rosmini.core.verbs import Verb

_OPTIONS = re.compile(r"(?<![\w-])--?[A-Za-z][\w-]*")


def candidates(words: Sequence[str], peers: Peers) -> list[str]:
    """Return the completions of the last word, sorted; ``words`` begins with a command, or with `rosmini`."""
    given = list(words[1:] if words[:1] == ["rosmini"] else words)
    if len(given) < 2:
        return _beginning(given[0] if given else "", COMMANDS)
    name, *before, last = given
    if name == "rosrun":
        return _beginning(last, _executables([word for word in before if word[:1] != "-"]))
    found = _tool(name)
    if found is None:
        return []
    if not before and not found.only_verb:
        return _beginning(last, [verb.name for verb in found.verbs.values() if verb.is_listed])
    verb = found.verbs.get(found.only_verb or before[0])
    if verb is None:
        return []
    if last.startswith("-"):
        return _beginning(last, _options(verb))
    try:
        words = before if found.only_verb else before[1:]
        return _beginning(last, _names(verb, [word for word in words if word[:1] != "-"], peers))
    except RosminiError:
        return []


def _tool(name: str) -> Tool | None:
    entry = COMMANDS.get(name)
    if entry is None or entry.folder is not None:
        return None
    return entry.tool()


def _beginning(start: str, words: Iterable[str]) -> list[str]:
    return sorted({word for word in words if word.startswith(start)})


def _options(verb: Verb) -> list[str]:
    """Return the options in a verb's help: the left column."""
    lines = (line.strip() for line in verb.parser().format_help().splitlines() if line.startswith("  "))
    return [option for line in lines if line[:1] == "-" for option in _OPTIONS.findall(line.partition("  ")[0])]


def _names(verb: Verb, before: Sequence[str], peers: Peers) -> list[str]:
    """Return the names that may follow the words ``before``. Raises an error if the Master does not answer."""
    kinds = verb.takes.split()
    if not kinds:
        return []
    if kinds[0] == "launch":
        return _of_launch_files(before)
    kind = kinds[min(len(before), len(kinds) - 1)]
    if kind == "msg" and kinds[0] == "topic":
        from rosmini.ros.introspection import topics

        try:
            return [dict(topics.types(peers))[before[0]]]
        except (KeyError, RosminiError):
            return _of_kind(kind, peers)
    return _of_kind(kind, peers)


def _executables(before: Sequence[str]) -> list[str]:
    """Return the completions for `rosrun`: a package, and then its executables."""
    from rosmini.core.packages import PackageIndex

    packages = PackageIndex()
    if not before:
        return packages.names()
    try:
        return packages.executables(before[0]) if len(before) == 1 else []
    except RosminiError:
        return []


def _of_launch_files(before: Sequence[str]) -> list[str]:
    """Return the completions for `roslaunch`: a package, its launch files, and the arguments of such a file."""
    from rosmini.core.packages import PackageIndex
    from rosmini.core.packages.executables import files_of
    from rosmini.ros.launch import read

    packages = PackageIndex()
    if not before:
        return packages.names()
    direct = Path(before[0])
    if direct.is_file():
        file: Path | None = direct
    else:
        inside = [path for path in files_of(packages.path(before[0])) if path.suffix in (".launch", ".test")]
        if len(before) == 1:
            return [path.name for path in inside]
        file = next((path for path in inside if path.name == before[1]), None)
    return [] if file is None else [f"{name}:=" for name in read(file, packages=packages, lenient=True).arguments]


def _of_kind(kind: str, peers: Peers) -> list[str]:
    from rosmini.ros.introspection import nodes, services, topics
    from rosmini.ros.introspection.types import MESSAGE, SERVICE

    match kind:
        case "topic":
            return topics.topics(peers).names()
        case "node":
            return nodes.names(peers)
        case "machine":
            return nodes.machines(peers)
        case "service":
            return [service.name for service in services.services(peers)]
        case "parameter":
            return list(peers.ask_as("/rosparam").ask("getParamNames"))
        case "msg":
            return MESSAGE.all()
        case "srv":
            return SERVICE.all()
        case "package":
            return [*MESSAGE.packages(), *SERVICE.packages()]
        case "location":
            from rosmini.core.packages import PackageIndex

            return PackageIndex().names()
    return []
