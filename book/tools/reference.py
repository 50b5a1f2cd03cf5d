"""Pages that the build makes: parameters, the public Python API, differences from ROS, and what chapters cost."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
import tomllib
from collections import defaultdict
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

from book.tools import costs
from rosmini.core.parameters import Parameters

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

ROOMS = ("rosmini.navigation", "rosmini.sim")
"""Packages whose nodes and plugins have parameters."""

WIKI = "http://wiki.ros.org/"
NAMES = {
    "gazebo": "gazebo_ros",
    "simulator": "rosmini_sim",
    "stage": "stage_ros",
    "velocity_smoother": "yocs_velocity_smoother",
}
"""The ROS packages whose names differ from those of our modules."""
OURS = ("rosmini_sim",)
"""Packages that ROS does not have."""


def declared() -> dict[str, list[type[Parameters]]]:
    """Return the classes of parameters of each ROS package; those that another class extends are left out."""
    for room in ROOMS:
        package = importlib.import_module(room)
        for module in pkgutil.walk_packages(package.__path__, f"{room}."):
            importlib.import_module(module.name)
    found = defaultdict(set)
    for kind in _below(Parameters):
        if kind.__module__.startswith(ROOMS) and not kind.__subclasses__():
            name = kind.__module__.split(".")[2]
            found[NAMES.get(name, name)].add(kind)
    return {package: sorted(found[package], key=lambda kind: kind.__name__) for package in sorted(found)}


def _below(kind: type[Parameters]) -> Iterator[type[Parameters]]:
    for each in kind.__subclasses__():
        yield each
        yield from _below(each)


def changeable(kind: type[Parameters]) -> set[str]:
    """Return the names of the parameters that dynamic_reconfigure can change while the node runs."""
    return {each.name for base in kind.__mro__ if vars(base).get("dynamic") for each in fields(base)}


class Generated(SphinxDirective):
    """A directive whose content is Markdown that `lines` returns."""

    def lines(self) -> Iterable[str]:
        """Return the Markdown."""
        raise NotImplementedError

    def run(self) -> list[nodes.Node]:
        """Return the content as if it stood in the page."""
        self.env.note_dependency(__file__)
        holder = nodes.section()
        holder.document = self.state.document
        self.state.nested_parse(StringList(list(self.lines())), self.content_offset, holder, match_titles=True)
        return holder.children


class ParameterTables(Generated):
    """The parameters of all nodes and plugins: a section for each package, with a table for each class."""

    def lines(self) -> Iterator[str]:
        """Return the sections."""
        for package, kinds in declared().items():
            yield from (f"## {package}", "")
            if package not in OURS:
                yield from (f"[{package} on the ROS wiki]({WIKI}{package})", "")
            for kind in kinds:
                yield from _table(kind)


def _table(kind: type[Parameters]) -> Iterator[str]:
    now = changeable(kind)
    yield from (_first_line(kind), "", "| parameter | default | meaning |", "|---|---|---|")
    for name, of, default, span, unit, meaning in kind.table(""):
        notes = (f"{of} [{unit}]" if unit else of, span, "at run time" if name in now else "")
        text = f"{meaning} (*{', '.join(filter(None, notes))}*)".replace("|", "or")
        row = f"| `{name}` | {default and f'`{default}`'} | {text} |"
        yield LONG.sub(lambda number: f"{float(number[0]):.4g}", row)
    yield ""


LONG = re.compile(r"\d+\.\d{5,}")
"""A number with many digits, such as pi / 6."""


FIDELITY = Path(__file__).resolve().parents[1] / "about" / "fidelity.toml"


def fidelity() -> dict[str, list[dict[str, str]]]:
    """Return the rows of each area: `subject`, `ros`, `test`, and `rosmini` where that differs from ROS 1."""
    return tomllib.loads(FIDELITY.read_text(encoding="utf-8"))


class FidelityTables(Generated):
    """What ROS 1 and rosmini do, and the tests that show it: a section with a table for each area."""

    def lines(self) -> Iterator[str]:
        """Return the sections."""
        for area, rows in fidelity().items():
            yield from (f"## {area}", "", "| subject | ROS 1 | rosmini | test |", "|---|---|---|---|")
            for row in rows:
                file, _, function = row["test"].partition("::")
                shown = f"*{function.removeprefix('test_').replace('_', ' ')}*, `{file}`"
                yield f"| {row['subject']} | {row['ros']} | {row.get('rosmini', 'The same.')} | {shown} |"
            yield ""

    def run(self) -> list[nodes.Node]:
        """Return the content; the page is built again when a row changes."""
        self.env.note_dependency(str(FIDELITY))
        return super().run()


class ChapterTable(Generated):
    """What a run measured of each chapter, in the order of the book."""

    file: ClassVar[Path]
    columns: ClassVar[dict[str, str]]
    """Titles of the columns by the names of their values; values are numbers, apart from `why`."""

    def lines(self) -> Iterator[str]:
        """Return when and where it was measured, and the table."""
        run, chapters = costs.read(self.file)
        toc = (costs.CHECKOUT / "book" / "_toc.yml").read_text(encoding="utf-8")
        yield from (f"Measured on {run['date']} at commit `{run['commit']}`: {run['machine']}.", "")
        yield f"| chapter | {' | '.join(self.columns.values())} |"
        yield f"|---|{''.join('---|' if key == 'why' else '---:|' for key in self.columns)}"
        for name in re.findall(r"file: (notebooks/\S+)", toc):
            if found := chapters.get(name):
                yield f"| {{doc}}`/{name}` | {' | '.join(str(found.get(key, '')) for key in self.columns)} |"
        yield ""

    def run(self) -> list[nodes.Node]:
        """Return the content; the page is built again after a run."""
        self.env.note_dependency(str(self.file))
        return super().run()


class CostTable(ChapterTable):
    """Time, memory and size of each chapter."""

    file = costs.FILE
    columns: ClassVar[dict[str, str]] = {
        "cells": "code cells",
        "cpu": "processor [s]",
        "memory": "memory [MB]",
        "notebook": "notebook [kB]",
        "page": "page [kB]",
    }


class BrowserRuns(ChapterTable):
    """The manual run of chapters in a browser."""

    file = costs.IN_BROWSER
    columns: ClassVar[dict[str, str]] = {
        "equal": "equal",
        "of": "of cells",
        "first": "first cell [s]",
        "all": "all cells [s]",
        "megabytes": "download [MB]",
        "memory": "memory [MB]",
        "why": "not equal",
    }


class Interface(Generated):
    """The public names of a module, and the methods of its classes, with the first sentence of each docstring."""

    required_arguments = 1

    def lines(self) -> Iterator[str]:
        """Return a table of the functions, and one for each class that has methods."""
        module = importlib.import_module(self.arguments[0])
        public = {name: getattr(module, name) for name in module.__all__}
        yield from _names((name, thing) for name, thing in public.items() if not _members(thing))
        for name, thing in public.items():
            if members := _members(thing):
                yield from (f"### {name}", "", _first_line(thing), "")
                yield from _names(members)


def _members(thing: Any) -> list[tuple[str, Any]]:
    """Return the public methods and properties that a class defines itself; none for an exception."""
    if not inspect.isclass(thing) or issubclass(thing, Exception):
        return []
    found = sorted((name, member) for name, member in vars(thing).items() if not name.startswith("_"))
    return [(name, member) for name, member in found if callable(member) or isinstance(member, PROPERTIES)]


PROPERTIES = (property, classmethod, staticmethod)


def _names(things: Iterable[tuple[str, Any]]) -> Iterator[str]:
    yield from ("| name | what it is or does |", "|---|---|")
    for name, thing in things:
        yield f"| `{name}{_arguments(thing)}` | {_first_line(thing).replace('|', 'or')} |"
    yield ""


def _arguments(thing: Any) -> str:
    """Return the arguments of a function without their types."""
    function = getattr(thing, "__func__", thing)
    if not inspect.isroutine(function):
        return ""
    given = [each for each in inspect.signature(function).parameters.values() if each.name not in {"self", "cls"}]
    plain = inspect.Signature([each.replace(annotation=inspect.Parameter.empty) for each in given])
    return str(plain).replace("|", "or")


def _first_line(thing: Any) -> str:
    """Return the first paragraph of a docstring as Markdown."""
    text = " ".join((inspect.getdoc(thing) or "").partition("\n\n")[0].split())
    return ROLE.sub(lambda role: f"`{role[1] or role[2].removeprefix('~').rpartition('.')[2]}`", text).replace(
        "``", "`"
    )


ROLE = re.compile(r":[a-z]+:`(?:([^`<]+?) <[^`>]+>|([^`]+))`")
"""A reference of Sphinx in a docstring: its text, or its target."""
