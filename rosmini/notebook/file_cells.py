"""``%%msg Num``, ``%%srv``, ``%%action`` and ``%%launch start.launch``: cells that are files of the notebook's package.

A cell is checked by the readers of such files before anything is written; an error names the line of the cell.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rosmini.core.errors import UsageError
from rosmini.msgs.importer import forget
from rosmini.msgs.registry import Registry, registry
from rosmini.ros.launch.errors import LaunchError
from rosmini.ros.launch.reader import read

if TYPE_CHECKING:
    from pathlib import Path

    from rosmini.msgs.sources import Source

    from .session import Session

_DECLARATION = re.compile(r"\A\s*<\?xml[^>]*\?>")


@dataclass(frozen=True)
class _Draft:
    """The definitions of another source, and one that is not in a file yet."""

    source: Source
    package: str
    kind: str
    name: str
    text: str

    def packages(self) -> list[str]:
        return sorted({*self.source.packages(), self.package})

    def has_package(self, package: str) -> bool:
        return package == self.package or self.source.has_package(package)

    def names(self, package: str, kind: str) -> list[str]:
        own = {self.name} if (package, kind) == (self.package, self.kind) else set()
        return sorted({*self.source.names(package, kind), *own})

    def read(self, package: str, kind: str, name: str) -> tuple[str, str] | None:
        if (package, kind, name) == (self.package, self.kind, self.name):
            return self.text, f"{name}.{kind}"
        return self.source.read(package, kind, name)


def msg(session: Session, line: str, cell: str) -> None:
    """Write the cell as a message type: after ``%%msg Num``, ``from notebook.msg import Num`` works.

    Raises ``DefinitionError`` with the line of the cell for an invalid definition; then nothing is written.
    """
    _define(session, "msg", line, cell)


def srv(session: Session, line: str, cell: str) -> None:
    """Write the cell as a service type: after ``%%srv Add``, ``from notebook.srv import Add, AddResponse`` works.

    Raises ``DefinitionError`` with the line of the cell for an invalid definition; then nothing is written.
    """
    _define(session, "srv", line, cell)


def action(session: Session, line: str, cell: str) -> None:
    """Write the cell as an action type: after ``%%action Dock``, ``from notebook.msg import DockAction`` works.

    Raises ``DefinitionError`` with the line of the cell for an invalid definition; then nothing is written.
    """
    _define(session, "action", line, cell)


def launch(session: Session, line: str, cell: str) -> None:
    """Write the cell as a launch file: after ``%%launch two.launch``, ``%roslaunch notebook two.launch`` starts it.

    Prints what the file needs and does not exist yet. Raises ``LaunchError`` with the line of the cell for an invalid
    file; then nothing is written.
    """
    name = _the_word(line, "%%launch NAME.launch")
    if not name.endswith(".launch"):
        raise UsageError(f"%%launch writes a launch file: call it {name.partition('.')[0]}.launch, not {name}")
    path = session.package.file("launch", name)
    for complaint in _complaints(path, cell):
        session.say(f"WARNING: {complaint}")
    session.package.write("launch", name, cell)


def _complaints(path: Path, cell: str) -> list[str]:
    """Return warnings about a launch file, and the things that it needs and that are missing."""
    name = path.name
    text = "\n" + _DECLARATION.sub("", cell)  # the line of the magic
    try:
        plan = read(text=text, path=str(path), lenient=True)
    except LaunchError as error:
        if error.missing:  # such as a required argument
            return []
        raise LaunchError(error.message, name, error.line) from None
    missing = [f"{name}:{each.place.line}: {each}" for each in plan.missing if each.kind != "arg"]
    return [*(each.replace(str(path), name) for each in plan.warnings), *missing]


def _define(session: Session, kind: str, line: str, cell: str) -> None:
    name = _the_word(line, f"%%{kind} NAME").removesuffix(f".{kind}")
    package = session.package
    path = package.file(kind, f"{name}.{kind}")
    _check(package.name, kind, name, cell)
    before = path.read_text(encoding="utf-8") if path.is_file() else None
    package.write(kind, f"{name}.{kind}", cell)
    if before is None or _meaning(before) != _meaning(cell):
        forget(package.name)
    if before is not None and _meaning(before) != _meaning(cell):
        session.say(
            f"{package.name}/{name} is now a different type. Earlier imports still have the old one: import it "
            "again, and run the cells of its nodes again."
        )


def _check(package: str, kind: str, name: str, cell: str) -> None:
    """Raise ``DefinitionError`` with the line of the cell for an invalid definition."""
    if not re.fullmatch(r"[A-Z][A-Za-z0-9_]*", name):
        raise UsageError(f"{name!r} is not a name for a type: names begin with a capital letter, such as Num")
    draft = _Draft(registry().source, package, kind, name, "\n" + cell)  # the line of the magic
    types = Registry(draft)
    if kind == "srv":
        types.service_definition(f"{package}/{name}")
    else:
        types.definition(f"{package}/{name}{'Action' if kind == 'action' else ''}")


def _meaning(text: str) -> list[str]:
    """Return the lines of a definition without comments and extra spaces."""
    return [" ".join(line.partition("#")[0].split()) for line in text.splitlines() if line.partition("#")[0].strip()]


def _the_word(line: str, usage: str) -> str:
    words = line.split()
    if len(words) != 1:
        raise UsageError(f"usage: {usage}")
    return words[0]
