"""Checks of a package: its ``package.xml``, its ``CMakeLists.txt``, and whether the two agree."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from rosmini.core import files
from rosmini.core.errors import DefinitionError, nearest
from rosmini.core.markup import Element, parse_file
from rosmini.core.packages import BUILT_IN, MANIFEST, Package, PackageIndex, read_package

from .cmake import CMakeError
from .findings import Finding, warning
from .project import CMAKE, Project, read_project
from .reconfigure import check_reconfigurable
from .scripts import check_scripts

GOOD_NAME = re.compile(r"[a-z][a-z0-9_-]*\Z")

BUILD = ("depend", "build_depend")
RUN = ("depend", "exec_depend", "run_depend")
EXPORT = (*RUN, "build_export_depend")


def read(folder: Path) -> tuple[Package | None, Project | None, list[Finding]]:
    """Return the package and the project in a folder, as far as they are readable, and the problems found."""
    try:
        package = read_package(folder)
    except DefinitionError as error:
        return None, None, [_of(error, folder / MANIFEST)]
    if not files.exists(folder / CMAKE):
        if package.is_metapackage:
            hint = f"a metapackage needs one with catkin_metapackage(): {CMAKE} is missing"
            return package, None, [warning(hint, package.manifest)]
        message = f"the package has no {CMAKE}; `catkin_create_pkg` makes one, or put CATKIN_IGNORE into the folder"
        return package, None, [Finding(message, package.manifest)]
    try:
        project = read_project(folder)
    except CMakeError as error:
        return package, None, [_of(error, folder / CMAKE)]
    return package, project, project.findings


def _of(error: DefinitionError, file: Path) -> Finding:
    return Finding(error.message, Path(error.file) if error.file else file, error.line)


def check(package: Package, project: Project, index: PackageIndex) -> list[Finding]:
    """Return all problems of a package whose files are readable; ``index`` has the packages that it may use."""
    root = parse_file(package.manifest)
    found = [
        *_names(package, project, root),
        *_calls(package, project, root),
        *_components(project, root, index),
        *_messages(project, root),
        *_definition_files(project),
        *check_scripts(project),
        *check_reconfigurable(project),
        *_not_here(project),
    ]
    return sorted(set(found), key=lambda each: (not each.is_error, str(each.file), each.line or 0, each.message))


def _depends(root: Element, tags: Iterable[str]) -> dict[str, int]:
    """Return the packages that a manifest names in these tags, with the line of each."""
    return {child.text: child.line for child in root.all(*tags)}


def _place(root: Element) -> int:
    """Return the line of a manifest at which a dependency could be added."""
    lines = [child.line for child in root if child.tag.endswith("depend")]
    return max(lines, default=root.line)


def _names(package: Package, project: Project, root: Element) -> Iterator[Finding]:
    name = root.find("name")
    line = name.line if name is not None else root.line
    if not GOOD_NAME.match(package.name):
        rule = "begin with a lower case letter, and have only lower case letters, digits, underscores and dashes"
        yield warning(f"the package name {package.name!r} breaks the naming conventions: it should {rule}",
                      package.manifest, line)  # fmt: skip
    if project.name is None:
        yield Finding(f"project({package.name}) is missing", project.path, 1)
    elif project.name.text != package.name:
        message = f"this is project({project.name.text}), but the package is named {package.name!r} in {MANIFEST}"
        yield Finding(message, project.path, project.name.line)


def _calls(package: Package, project: Project, root: Element) -> Iterator[Finding]:
    """Check for the calls that every catkin package needs."""
    if "catkin" not in _depends(root, ("buildtool_depend",)):
        message = "<buildtool_depend>catkin</buildtool_depend> is missing"
        yield warning(message, package.manifest, root.line)
    if project.finds_catkin is None:
        yield Finding("find_package(catkin REQUIRED ...) is missing", project.path, 1)
    if package.is_metapackage:
        if not project.is_metapackage:
            yield warning("catkin_metapackage() is missing, and this is a metapackage", project.path, 1)
    elif project.exports is None:
        yield Finding("catkin_package() is missing", project.path, 1)


def _components(project: Project, root: Element, index: PackageIndex) -> Iterator[Finding]:
    """Check that the components that CMake requires exist and are in the manifest."""
    manifest = Path(root.path)
    build, run = _depends(root, (*BUILD, "buildtool_depend", "test_depend")), _depends(root, EXPORT)
    known = {*index.names(), *BUILT_IN}
    for word in project.components:
        if word.text not in build:
            hint = nearest(word.text, build) or f"add <build_depend>{word.text}</build_depend> to {manifest}"
            message = f"{word.text} is a component of find_package(), but {MANIFEST} does not need it for building"
            yield warning(f"{message}; {hint}", project.path, word.line)
        if word.text not in known:
            hint = nearest(word.text, known) or "is it on ROS_PACKAGE_PATH?"
            yield warning(f"there is no package {word.text!r} here: {hint}", project.path, word.line)
    for word in project.exported:
        if word.text not in run:
            message = f"catkin_package() exports {word.text}, which is therefore needed to run: add "
            yield Finding(f"{message}<exec_depend>{word.text}</exec_depend> to {manifest}", project.path, word.line)


def _messages(project: Project, root: Element) -> Iterator[Finding]:
    """Check the declarations needed to generate messages."""
    manifest, place = Path(root.path), _place(root)
    if project.definitions and project.generates is None:
        message = "generate_messages() is missing: nothing is made of the files that are added here"
        yield Finding(message, project.path, project.definitions[0].line)
    if project.generates is None:
        return
    if not project.definitions:
        message = "generate_messages() without add_message_files(), add_service_files() or add_action_files() before it"
        yield Finding(message, project.path, project.generates)
        return
    components = {word.text for word in project.components}
    if "message_generation" not in components:
        message = "message_generation is missing among the components of find_package(catkin REQUIRED COMPONENTS ...)"
        yield Finding(message, project.path, project.finds_catkin)
    if "message_generation" not in _depends(root, BUILD):
        message = "messages are generated: <build_depend>message_generation</build_depend> is missing"
        yield warning(message, manifest, place)
    if "message_runtime" not in _depends(root, RUN):
        message = "messages are generated: <exec_depend>message_runtime</exec_depend> is missing"
        yield warning(message, manifest, place)
    for word in project.message_packages:
        if word.text not in components:
            message = f"generate_messages() depends on {word.text}, which is not a component of find_package(); add it"
            yield Finding(message, project.path, word.line)
        if word.text not in _depends(root, BUILD):
            message = f"generate_messages() depends on {word.text}: add <depend>{word.text}</depend> to {manifest}"
            yield warning(message, project.path, word.line)


def _definition_files(project: Project) -> Iterator[Finding]:
    """Check that each added file exists, and that each file is added, in the folder where it belongs."""
    there = _definitions_in(project.folder)
    added = {definition.path for definition in project.definitions}
    for definition in project.definitions:
        path = project.folder / definition.path
        if not path.resolve().is_relative_to(project.folder.resolve()):
            yield Finding(f"{definition.path} is outside the package", project.path, definition.line)
        elif path.suffix != f".{definition.kind}":
            message = f"{definition.path} is no .{definition.kind} file"
            yield Finding(message, project.path, definition.line)
        elif not files.is_file(path):
            strayed = [each for each in there if Path(each).name == path.name]
            hint = f"{strayed[0]} is in the wrong folder: move it to {definition.path}" if strayed else ""
            hint = hint or nearest(path.name, files.names_in(path.parent)) or f"make it, or take it out of {CMAKE}"
            yield Finding(f"there is no file {definition.path}; {hint}", project.path, definition.line)
    names = {Path(each).name for each in added}
    for each in there:
        kind = Path(each).suffix[1:]
        if each not in added and Path(each).name not in names:
            call = {"msg": "message", "srv": "service", "action": "action"}[kind]
            moved = "" if Path(each).parent.name == kind else f"move it into the folder {kind}, and "
            message = f"not built: {moved}name it in add_{call}_files() of {project.path}"
            yield warning(message, project.folder / each)


def _definitions_in(folder: Path) -> list[str]:
    """Return the .msg, .srv and .action files of a package, relative to it; links are not followed."""
    found: list[str] = []
    for parent, names, inside in os.walk(folder):
        names[:] = sorted(name for name in names if not name.startswith(".") and name != "node_modules")
        wanted = (Path(parent, name) for name in sorted(inside) if name.endswith((".msg", ".srv", ".action")))
        found += [path.relative_to(folder).as_posix() for path in wanted]
    return found


def _not_here(project: Project) -> Iterator[Finding]:
    """Warn of features of catkin that rosmini does not support."""
    for word in project.compiled:
        message = f"{word.text} is C++, which rosmini does not compile; the rest of the package is built"
        yield warning(message, project.path, word.line)


def nested(folder: Path) -> list[Finding]:
    """Return a finding for each package nested in a package, where no tool finds it."""
    found = []
    for parent, names, inside in os.walk(folder):
        names[:] = sorted(name for name in names if not name.startswith("."))
        if MANIFEST in inside and Path(parent) != folder:
            message = f"a package in the package {folder.name}, which is not found there: move it beside {folder}"
            found.append(warning(message, Path(parent, MANIFEST)))
    return found
