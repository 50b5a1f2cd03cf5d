"""Generates Python modules for ``.cfg`` files: ``from my_package.cfg import NameConfig``."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator
from pathlib import Path
from pprint import pformat
from typing import Any

from rosmini.core import files
from rosmini.core.errors import DefinitionError, nearest

from .findings import Finding, warning
from .generation import MADE
from .project import Project

PACKAGE = "dynamic_reconfigure"


def check_reconfigurable(project: Project) -> Iterator[Finding]:
    """Yield the problems of the ``.cfg`` files of a package."""
    if not project.reconfigurable:
        return
    from rosmini.ros.catkin.cfg_file import read_cfg

    words = project.reconfigurable
    if PACKAGE not in {word.text for word in project.components}:
        message = f"{PACKAGE} is missing among the components of find_package(catkin REQUIRED COMPONENTS ...)"
        yield warning(message, project.path, words[0].line)
    for word in words:
        path = project.folder / word.text
        if not path.resolve().is_relative_to(project.folder.resolve()):
            yield Finding(f"{word.text} is outside the package", project.path, word.line)
        elif not files.is_file(path):
            hint = nearest(path.name, files.names_in(path.parent)) or "make it, or take the line out"
            yield Finding(f"there is no file {word.text}; {hint}", project.path, word.line)
        else:
            try:
                found = read_cfg(path)
            except DefinitionError as error:
                yield Finding(error.message, path, error.line)
                continue
            if os.name != "nt" and not os.access(path, os.X_OK):
                yield warning(f"may not be run, as a real catkin_make does: chmod +x {shlex.quote(str(path))}", path)
            if found.name != path.stem:
                message = f"makes {found.name}Config, while CMake expects {path.stem}Config, as the file is named"
                yield warning(message, path, found.line)
            for note, line in found.notes:
                yield warning(note, path, line)


def module(path: Path) -> tuple[str, str]:
    """Return the name and text of the module for a valid ``.cfg`` file."""
    from rosmini.core.dynamic_reconfigure.description import Description
    from rosmini.ros.catkin.cfg_file import read_cfg

    found = read_cfg(path)
    parameters = Description.of(found.tree).parameters
    tables: dict[str, Any] = {
        "config_description": found.tree,
        **{
            table: {each.name: getattr(each, field) for each in parameters}
            for table, field in (("defaults", "default"), ("min", "min"), ("max", "max"))
        },
        "type": {each.name: each.type for each in parameters},
        "level": {each.name: each.level for each in parameters},
        "all_level": 0,
    }
    for each in parameters:
        tables["all_level"] |= each.level
    tables |= {f"{found.name}_{name}": value for name, value in found.constants.items()}
    lines = [f"{name} = {pformat(value, width=110, sort_dicts=False)}\n" for name, value in tables.items()]
    source = MADE.format(source=repr(str(path))[1:-1])  # one line, even for unusual folder names
    return f"{found.name}Config", f'{source}\ninf = float("inf")\n\n{"".join(lines)}'
