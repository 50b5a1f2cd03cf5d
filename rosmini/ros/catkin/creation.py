"""New packages and workspaces: the files that ``catkin_create_pkg`` and ``catkin_init_workspace`` write."""

from __future__ import annotations

import getpass
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from rosmini.core.packages import MANIFEST, package_around

from .checks import GOOD_NAME
from .findings import CatkinError
from .project import CMAKE
from .template import filled

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*\Z")
VERSION = re.compile(r"\d{1,9}\.\d{1,9}\.\d{1,9}\Z")


@dataclass(frozen=True)
class NewPackage:
    """Description of a package to create."""

    name: str
    dependencies: tuple[str, ...] = ()
    """Packages needed to build and to run it."""
    description: str = ""
    licenses: tuple[str, ...] = ()
    authors: tuple[str, ...] = ()
    maintainers: tuple[str, ...] = ()
    version: str = "0.0.0"
    system_dependencies: tuple[str, ...] = ()
    boost_components: tuple[str, ...] = ()
    is_metapackage: bool = False


def create_package(new: NewPackage, where: Path, say: Callable[[str], object] = print) -> list[str]:
    """Create a package in a new folder in ``where``, and return warnings about it.

    Raises `CatkinError` if it cannot be created; existing files are not overwritten.
    """
    for name in (new.name, *new.dependencies):
        if not NAME.match(name):
            raise CatkinError(f"{name!r} cannot be the name of a package: letters, digits, _ and - can be in one")
    if not VERSION.match(new.version):
        raise CatkinError(f'Package version "{new.version}" does not follow version conventions; write 1.2.3')
    if new.name in new.dependencies:
        raise CatkinError(f"{new.name} cannot need itself")
    folder = where / new.name
    texts = {folder / MANIFEST: manifest(new), folder / CMAKE: cmake_lists(new)}
    for path in texts:
        if path.exists():
            raise CatkinError(f"File exists: {path}")
    folder.mkdir(exist_ok=True)
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
        say(f"Created file {new.name}/{path.name}")
    compiled, scripted = "roscpp" in new.dependencies, "rospy" in new.dependencies
    folders = ([f"include/{new.name}"] if compiled else []) + (["src"] if compiled or scripted else [])
    for each in folders if not new.is_metapackage else []:
        (folder / each).mkdir(parents=True, exist_ok=True)
        say(f"Created folder {new.name}/{each}")
    say(f"Successfully created files in {folder}. Please adjust the values in package.xml.")
    return list(_odd(new, where))


def _odd(new: NewPackage, where: Path) -> list[str]:
    found = []
    if not GOOD_NAME.match(new.name):
        found.append(
            f'Package name "{new.name}" does not follow the naming conventions. It should start with a lower case '
            "letter and only contain lower case letters, digits, underscores, and dashes."
        )
    outer = package_around(where / new.name)
    if outer is not None:
        found.append(f"this is inside the package {outer}, where it is not found: move it beside that one")
    elif (where / "src").is_dir() and where.name != "src":
        found.append(f"packages of a workspace are in its src, where this one is not: mv {new.name} src/")
    return found


def _needed(new: NewPackage) -> tuple[list[str], list[str], list[str]]:
    """Return the dependencies to build, to export and to run; ``message_generation`` is not used at run time."""
    both = sorted({*new.dependencies} - {"message_generation", "message_runtime"})
    build = sorted([*both, *({*new.dependencies} & {"message_generation"})])
    run = sorted([*both, *({*new.dependencies} & {"message_runtime"})])
    system = sorted(new.system_dependencies)
    boost = ["boost"] if new.boost_components else []
    return [*build, *system, *boost], [*both, *system, *boost], [*run, *system, *boost]


def manifest(new: NewPackage) -> str:
    """Return the text of its ``package.xml``, format 2."""
    user = _user()
    build, build_export, run = _needed(new)
    tags = ["  <buildtool_depend>catkin</buildtool_depend>"]
    if new.is_metapackage:
        build, build_export = [], []
    for tag, names in (("build_depend", build), ("build_export_depend", build_export), ("exec_depend", run)):
        tags += [f"  <{tag}>{escape(name)}</{tag}>" for name in names]
    email = quoteattr(f"{user}@todo.todo")
    maintainers = [f"  <maintainer email={email}>{escape(name)}</maintainer>" for name in new.maintainers or (user,)]
    return filled(
        "package.xml",
        name=new.name,
        version=new.version,
        description=escape(new.description or f"The {new.name} package"),
        maintainers="\n".join(maintainers),
        licenses="\n".join(f"  <license>{escape(each)}</license>" for each in new.licenses or ("TODO",)),
        authors="".join(f"  <author>{escape(each)}</author>\n" for each in new.authors),
        depends="\n".join(tags),
        export="    <metapackage/>" if new.is_metapackage else "    <!-- for example, where plugins are described -->",
    )


def cmake_lists(new: NewPackage) -> str:
    """Return the text of its ``CMakeLists.txt``."""
    if new.is_metapackage:
        return filled("metapackage.cmake", name=new.name)
    names = sorted(new.dependencies)
    listed = "".join(f"  {name}\n" for name in names)
    components = f"find_package(catkin REQUIRED COMPONENTS\n{listed})" if names else "find_package(catkin REQUIRED)"
    types = [name for name in names if name.endswith(("_msgs", "_srvs"))] or ["std_msgs"]
    boost = " ".join(new.boost_components)
    return filled(
        "CMakeLists.txt",
        name=new.name,
        components=components,
        boost=f"find_package(Boost REQUIRED COMPONENTS {boost})" if boost else "# find_package(Boost REQUIRED)",
        types="\n".join(f"#   {name}" for name in types),
        exported=" ".join(name for name in names if name != "message_generation") or "other_package",
    )


def _user() -> str:
    try:
        found = re.sub(r"[^A-Za-z0-9_.-]", "", getpass.getuser())
    except (OSError, KeyError, ImportError):  # no such user id
        found = ""
    return found or "user"


def init_workspace(source: Path) -> Path:
    """Make a folder the source space of a workspace: write its ``CMakeLists.txt`` and return that path.

    Raises `CatkinError` if it exists already.
    """
    path = source / CMAKE
    if path.exists() or path.is_symlink():
        raise CatkinError(f'File "{path}" already exists')
    if (source / MANIFEST).exists():
        raise CatkinError(f"{source} is a package; the source space is the folder above it")
    path.write_text(filled("workspace.cmake"), encoding="utf-8")
    return path
