"""Setup files of a workspace for shells: ``devel/setup.sh``, ``.bash``, ``.zsh`` and ``.ps1``, and ``env.sh``.

Unlike catkin's, they remove nothing from the environment: a workspace that was already in use follows this one.
"""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path

from rosmini.core import files

from .template import filled
from .workspace import Workspace, package_folders, python_folder

MADE = "# Made by rosmini's catkin_make; changes here are lost.\n"


def setup_files(workspace: Workspace, underlays: Sequence[Path]) -> dict[Path, str]:
    """Return the text of each file. ``underlays`` are the spaces below this one, in search order."""
    entries: list[tuple[str, Path]] = []
    for prefix in reversed([workspace.devel, *underlays]):
        sources = [workspace.source] if prefix == workspace.devel else package_folders(prefix)
        entries.append(("CMAKE_PREFIX_PATH", prefix))
        entries += [("ROS_PACKAGE_PATH", each) for each in reversed(sources)]
        entries.append(("PYTHONPATH", python_folder(prefix)))
    posix = "".join(f"_rosmini_first {name} {shlex.quote(str(path))}\n" for name, path in entries)
    power = "".join(f"Set-RosminiFirst '{name}' {_quoted(path)}\n" for name, path in entries)
    devel = workspace.devel
    source_it = f". {shlex.quote(str(devel / 'setup.sh'))}\n"
    return {
        devel / "setup.sh": MADE + filled("setup.sh", entries=posix),
        devel / "setup.bash": MADE + source_it,
        devel / "setup.zsh": MADE + source_it,
        devel / "setup.ps1": MADE + filled("setup.ps1", entries=power),
        devel / "env.sh": f'#!/usr/bin/env sh\n{MADE}{source_it}exec "$@"\n',
    }


def folders_in(setup_file: Path) -> list[tuple[str, Path]] | None:
    """Return the (variable, folder) pairs that a setup file made here prepends, in order.

    Return None for any other file. Raises ``OSError`` if it cannot be read.
    """
    if not files.read(setup_file).decode("utf-8", "replace").startswith((MADE, f"#!/usr/bin/env sh\n{MADE}")):
        return None
    text = files.read(setup_file.with_name("setup.sh")).decode("utf-8", "replace")
    rows = [shlex.split(line) for line in text.splitlines() if line.startswith("_rosmini_first ")]
    return [(row[1], Path(row[2])) for row in rows if len(row) == 3]


def _quoted(path: Path) -> str:
    """Return a path quoted for PowerShell."""
    return "'" + str(path).replace("'", "''") + "'"
