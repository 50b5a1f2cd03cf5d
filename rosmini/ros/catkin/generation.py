"""Generates Python modules for the messages, services and actions of a package, for rosmini and real rospy.

A module does not contain the serialisation code: in rosmini it uses rosmini's class, and in a
process of real ROS it lets genpy generate one from the text of the definition.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rosmini.core.errors import DefinitionError, UnknownPackage, UnknownType
from rosmini.core.packages import PackageIndex
from rosmini.msgs.definition import ACTION_SUFFIXES
from rosmini.msgs.registry import Registry

from .findings import Finding
from .project import Definition, Project
from .template import filled

MADE = "# Made by rosmini's catkin_make from {source}; changes here are lost.\n"

INDEX = """
_FOLDER = {folder!r}


def __getattr__(name):
    if name.startswith("_"):
        raise AttributeError(name)
    from .._catkin import missing

    return missing({package!r}, {kind!r}, name, _FOLDER)
"""


def modules(name: str, project: Project, registry: Registry) -> dict[str, str]:
    """Return the text of each file of the Python package ``name``, by its path; the definitions must be valid."""
    made: dict[str, str] = {}
    names: dict[str, list[str]] = {"msg": [], "srv": []}
    for definition in project.definitions:
        source = MADE.format(source=project.folder / definition.path)
        if definition.kind == "srv":
            names["srv"].append(definition.name)
            made[f"srv/_{definition.name}.py"] = source + _service(f"{name}/{definition.name}", registry)
            continue
        suffixes = ACTION_SUFFIXES if definition.kind == "action" else ("",)
        for suffix in suffixes:
            short = definition.name + suffix
            names["msg"].append(short)
            made[f"msg/_{short}.py"] = source + _message(f"{name}/{short}", registry)
    if made:
        made["_catkin.py"] = MADE.format(source=project.path) + filled("_catkin.py")
    for kind, found in names.items():
        if found:
            lines = "".join(f"from ._{each} import *\n" for each in sorted(found))
            index = INDEX.format(folder=str(project.folder / kind), package=name, kind=kind)
            made[f"{kind}/__init__.py"] = MADE.format(source=project.path) + lines + index
    return made


def _message(name: str, registry: Registry) -> str:
    cls, short = registry.message_class(name), name.partition("/")[2]
    return (
        f"from .._catkin import message\n\n__all__ = [{short!r}]\n\n"
        f"{short} = message({name!r}, {cls._md5sum!r}, {cls._full_text!r})\n"
    )


def _service(name: str, registry: Registry) -> str:
    cls, short = registry.service_class(name), name.partition("/")[2]
    halves = {"Request": cls._request_class, "Response": cls._response_class}
    lines = [
        f"{short}{half} = message({name + half!r}, {each._md5sum!r}, {each._full_text!r})\n"
        for half, each in halves.items()
    ]
    listed = [short, f"{short}Request", f"{short}Response"]
    return (
        f"from .._catkin import message, service\n\n__all__ = {listed!r}\n\n{''.join(lines)}"
        f"{short} = service({name!r}, {cls._md5sum!r}, {short}Request, {short}Response)\n"
    )


def check_definitions(name: str, project: Project, registry: Registry, index: PackageIndex) -> list[Finding]:
    """Return errors in definitions, and undeclared packages that they use."""
    allowed = _closure((word.text for word in project.message_packages), index)
    own = {
        definition.name + suffix
        for definition in project.definitions
        for suffix in (ACTION_SUFFIXES if definition.kind == "action" else ("",))
    }
    found: list[Finding] = []
    for definition in project.definitions:
        file = project.folder / definition.path
        try:
            found += _check_definition(name, definition, registry, allowed, own)
        except DefinitionError as error:
            found.append(Finding(error.message, Path(error.file) if error.file else file, error.line))
        except (UnknownType, UnknownPackage) as error:
            found.append(Finding(str(error), project.path, definition.line))
    if any(each.kind == "action" for each in project.definitions) and "actionlib_msgs" not in allowed:
        message = "actions need generate_messages(DEPENDENCIES actionlib_msgs std_msgs)"
        found.append(Finding(message, project.path, project.generates))
    return found


def _check_definition(
    name: str, definition: Definition, registry: Registry, allowed: set[str], own: set[str]
) -> list[Finding]:
    full = f"{name}/{definition.name}"
    if definition.kind == "srv":
        service = registry.service_definition(full)
        specs = [service.request, service.response]
    elif definition.kind == "action":
        specs = [registry.definition(full + suffix) for suffix in ("Goal", "Result", "Feedback")]
    else:
        specs = [registry.definition(full)]
    found = []
    for spec in specs:
        for field in spec.fields:
            if field.builtin:
                continue
            package, _, short = field.base.partition("/")
            file = Path(spec.file or definition.path)
            if package == name and short not in own:
                message = f"{field.base} is used here, but is not added in CMakeLists.txt"
                found.append(Finding(message, file, field.line))
            elif package not in (name, *allowed):
                message = f"{field.base} is used here: add {package} to generate_messages(DEPENDENCIES ...)"
                found.append(Finding(message, file, field.line))
    return found


def _closure(names: Iterable[str], index: PackageIndex) -> set[str]:
    """Return these packages and all their dependencies."""
    found: set[str] = set()
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        if name not in found and name in index:
            found.add(name)
            waiting += index.find(name).depends
    return found
