"""``%save_package FOLDER``: save the files that a notebook's cells wrote as a catkin package for real ROS 1."""

from __future__ import annotations

import ast
import re
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core import files
from rosmini.core.errors import RosminiError, UsageError
from rosmini.core.packages import BUILT_IN, MANIFEST, PackageIndex
from rosmini.msgs.registry import registry
from rosmini.ros.catkin import NewPackage
from rosmini.ros.catkin.creation import manifest

from .package import FOLDERS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from .session import Session

MARK = "written by %save_package"
"""Text in the description of a package that may be overwritten."""

TYPES = {"msg": "message", "srv": "service", "action": "action"}
"""Folders of types, and their names in catkin's commands."""

SYSTEM = {"cv2": "python3-opencv", "matplotlib": "python3-matplotlib", "numpy": "python3-numpy", "yaml": "python3-yaml"}
"""Python modules from system packages, and rosdep's names for these."""

_PKG = re.compile(r"\bpkg\s*=\s*[\"']([^\"'$]+)[\"']|\$\(find\s+([^)\s]+)\)")


def save_package(session: Session, line: str) -> None:
    """Write the notebook's package into a folder: `%save_package ~/catkin_ws/src`.

    On a real ROS 1, `catkin_make` builds it and `rosrun notebook talker.py` runs it. A package written earlier
    is replaced. Raises ``UsageError`` without a folder, and ``RosminiError`` if it cannot be written there.
    """
    where = line.strip().strip("\"'")
    if not where:
        raise UsageError("usage: %save_package FOLDER, such as the src of a catkin workspace")
    package = session.package
    target = Path(where).expanduser() / package.name
    try:
        written = save(package.folder, target)
    except OSError as error:
        raise RosminiError(f"{where}: {error.strerror}; choose a writable folder") from error
    session.say(f"{Path(where) / package.name}: {', '.join(written)}")
    if any("import rosmini" in path.read_text(encoding="utf-8") for path in sorted((target / "scripts").glob("*.py"))):
        session.say("WARNING: a script imports rosmini, which then has to be installed on the robot as well")


def save(source: Path, target: Path) -> list[str]:
    """Write the package in ``source`` with a new manifest and build file; return the names of its files.

    Raises ``RosminiError`` if there is a different package, and ``OSError`` if it cannot be written.
    """
    if target.exists() and MARK not in _text(target / MANIFEST):
        raise RosminiError(f"{target} already exists, and %save_package did not write it: move it away")
    found = {kind: [path for path in sorted((source / kind).glob("*")) if path.is_file()] for kind in FOLDERS}
    if not any(found.values()):
        raise RosminiError("no cell has written a file yet; %%node, %%launch, %%msg, %%srv and %%action write files")
    if target.exists():
        shutil.rmtree(target)
    for kind, paths in found.items():
        for path in paths:
            (target / kind).mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target / kind)
    packages, system = dependencies(target.name, found)
    only_run = launched(target.name, found["launch"]) - {*packages}
    new = NewPackage(target.name, tuple(packages), f"Nodes of a notebook, {MARK}", system_dependencies=tuple(system))
    tags = "".join(f"  <exec_depend>{name}</exec_depend>\n" for name in sorted(only_run))
    _write(target / MANIFEST, manifest(new).replace("  <build_depend>", f"{tags}  <build_depend>", 1))
    _write(target / "CMakeLists.txt", cmake(target.name, packages, found))
    return [f"{kind}/{path.name}" for kind, paths in found.items() for path in paths]


def dependencies(own: str, found: dict[str, list[Path]]) -> tuple[list[str], list[str]]:
    """Return the packages that scripts and types need, and the packages of the system, sorted."""
    known = {*PackageIndex().names(), *BUILT_IN}
    modules = {name for path in found["scripts"] for name in imports(_text(path))}
    packages = {*modules & known, "rospy"}
    for kind in TYPES:
        for path in found[kind]:
            packages |= set(_used(own, kind, path.stem))
    if any(found[kind] for kind in TYPES):
        packages |= {"message_generation", "message_runtime"}
    if found["action"]:
        packages |= {"actionlib_msgs"}
    return sorted(packages - {own}), sorted({SYSTEM[name] for name in modules & SYSTEM.keys()})


def launched(own: str, paths: Sequence[Path]) -> set[str]:
    """Return the packages that launch files name."""
    return {part for path in paths for pair in _PKG.findall(_text(path)) for part in pair if part} - {own}


def imports(text: str) -> set[str]:
    """Return the top-level modules that a script imports, without Python's own; empty if it is not valid Python."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return set()
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {each.name.partition(".")[0] for each in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.add(node.module.partition(".")[0])
    return names - sys.stdlib_module_names


def _used(own: str, kind: str, name: str) -> Iterable[str]:
    """Yield the packages whose types a type contains."""
    types = registry()
    if kind == "srv":
        service = types.service_definition(f"{own}/{name}")
        specs = [service.request, service.response]
    else:
        ends = ("Goal", "Result", "Feedback") if kind == "action" else ("",)
        specs = [types.definition(f"{own}/{name}{end}") for end in ends]
    for spec in specs:
        yield from (field.base.partition("/")[0] for field in spec.fields if not field.builtin)


def cmake(name: str, packages: Sequence[str], found: dict[str, list[Path]]) -> str:
    """Return the text of the ``CMakeLists.txt``."""
    build = [each for each in packages if each != "message_runtime"]
    run = [each for each in packages if each != "message_generation"]
    uses = [each for each in packages if each.endswith("_msgs")]
    lines = ["cmake_minimum_required(VERSION 3.0.2)", f"project({name})", ""]
    lines += [f"find_package(catkin REQUIRED COMPONENTS {' '.join(build)})", ""]
    for kind, called in TYPES.items():
        if found[kind]:
            lines += [f"add_{called}_files(FILES {' '.join(path.name for path in found[kind])})"]
    if any(found[kind] for kind in TYPES):
        lines += [f"generate_messages({' '.join(['DEPENDENCIES', *uses] if uses else [])})", ""]
    lines += [f"catkin_package(CATKIN_DEPENDS {' '.join(run)})"]
    if found["scripts"]:
        programs = " ".join(f"scripts/{path.name}" for path in found["scripts"])
        lines += ["", f"catkin_install_python(PROGRAMS {programs}"]
        lines += ["  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})"]
    if found["launch"]:
        lines += ["", "install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})"]
    return "\n".join([*lines, ""])


def _text(path: Path) -> str:
    """Return the text of a file; empty if it does not exist."""
    try:
        return files.read(path).decode("utf-8", "replace")
    except OSError:
        return ""


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")
