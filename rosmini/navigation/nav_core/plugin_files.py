"""Plugins of workspace packages, found through their plugin XML as in pluginlib (http://wiki.ros.org/pluginlib).

A package in a workspace names the file in its manifest:

    <export>
      <nav_core plugin="${prefix}/planner_plugin.xml"/>
    </export>

and the file names the classes. Instead of the path of a C++ library it contains the name of a Python module of the
package (in its folder `src/`, or beside its manifest):

    <library path="my_pkg.planner">
      <class name="my_pkg/MyPlanner" type="MyPlanner" base_class_type="nav_core::BaseGlobalPlanner"/>
    </library>

The module is reloaded each time one of its plugins is created, so that edits take effect.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from rosmini.core.errors import RosminiError
from rosmini.core.graph.show import find_extension
from rosmini.core.markup import Element, parse_file
from rosmini.core.packages import Package, PackageIndex
from rosmini.core.plugins import Plugin, PluginError

T = TypeVar("T", bound=Plugin)

EXPORT = "nav_core"


class DeclaredPlugin(NamedTuple):
    """A class declared in a plugin XML file."""

    name: str
    module: str
    type: str
    folder: Path
    file: Path

    @property
    def is_compiled(self) -> bool:
        """True if the library is a C++ library (`lib/libmy_planner`)."""
        return "/" in self.module or self.module.endswith(".so")


def create(interface: type[T], name: str) -> T:
    """Return a new plugin of this name: one declared in a plugin XML file, or else a registered one.

    A C++ library is ignored if a plugin of the same name is registered, because the sources of the Navigation Stack
    may be in the workspace. Raises `PluginError` for a plugin that cannot be loaded or created, and for an unknown
    one, with similar names and the unreadable packages; and another `RosminiError` if the files of the plugin's own
    package are invalid.
    """
    found = _plugin_class(interface, name)
    try:
        return found()
    except Exception as error:
        raise PluginError(
            f"the plugin {name} cannot be created: {type(error).__name__}: {error}; a plugin is created without "
            "arguments, and is set up in initialize()"
        ) from error


def _plugin_class(interface: type[T], name: str) -> type[T]:
    canonical = name.replace("::", "/")
    unread: list[str] = []
    declared = next((each for each in declared_plugins(canonical, unread) if each.name == canonical), None)
    if declared is not None and not (declared.is_compiled and canonical in interface.names()):
        return _load(interface, declared)
    try:
        return interface.named(name)
    except PluginError as error:
        if not unread:
            raise
        raise PluginError("\n  ".join([f"{error}; and these packages could not be read:", *unread])) from error


def short_name(name: str) -> str:
    """Return a plugin's name without its package, which is the namespace of its parameters.

    >>> short_name("dwa_local_planner/DWAPlannerROS"), short_name("my_pkg::MyPlanner")
    ('DWAPlannerROS', 'MyPlanner')
    """
    return name.replace(":", "/").rpartition("/")[2]


def declared_plugins(name: str, unread: list[str]) -> Iterator[DeclaredPlugin]:
    """Yield the plugins that workspace packages declare: first the package that the name begins with, then all others.

    Raises a `RosminiError` if the files of the first package are invalid; errors of the others are added to `unread`.
    """
    index = PackageIndex()
    first = name.partition("/")[0]
    for package in sorted(index.names(), key=lambda each: (each != first, each)):
        if package in index and (package == first or not _is_ours(index.path(package))):
            try:
                yield from _declared(index.find(package))
            except RosminiError as error:
                if package == first:
                    raise
                unread.append(str(error))


def _is_ours(folder: Path) -> bool:
    """Return whether a package, by its folder, is part of rosmini, whose plugins are registered."""
    from rosmini.core.packages import assets_dir

    return folder.is_relative_to(assets_dir())


def _declared(package: Package) -> Iterator[DeclaredPlugin]:
    for export in package.exports:
        path = export.get("plugin")
        if export.tag != EXPORT or not path or _is_ours(package.path):
            continue
        file = Path(path.replace("${prefix}", str(package.path)))
        if not file.is_file():
            raise PluginError(
                f"the manifest of {package.name} exports the plugin description {file}, which does not exist: "
                f"create it, or correct the line <{EXPORT} plugin=.../> of {package.manifest}"
            )
        root = parse_file(file)
        libraries = [root] if root.tag == "library" else root.all("library")
        for library in libraries:
            for each in library.all("class"):
                yield _class(each, library, package, file)


def _class(element: Element, library: Element, package: Package, file: Path) -> DeclaredPlugin:
    kind = element.attribute("type")
    name = element.attributes.get("name") or kind
    return DeclaredPlugin(
        name.replace("::", "/"), library.attribute("path"), short_name(kind.replace(".", "/")), package.path, file
    )


def _load(interface: type[T], declared: DeclaredPlugin) -> type[T]:
    module = _module(declared)
    found = getattr(module, declared.type, None)
    if found is None:
        raise PluginError(
            f"{declared.file} declares {declared.name} as the class {declared.type} of {declared.module}, but that "
            f"module has no class of this name"
        )
    if not (isinstance(found, type) and issubclass(found, interface)):
        raise PluginError(
            f"{declared.name} ({declared.module}.{declared.type}) does not derive from {interface.__name__}: "
            f"class {declared.type}({interface.__name__})"
        )
    return found


def _module(declared: DeclaredPlugin) -> Any:
    folder, name = declared.folder, declared.module
    if declared.is_compiled:
        raise PluginError(
            f"{declared.file} names the library {name!r}: C++ libraries cannot be loaded here. Write the plugin in "
            'Python, and name its module: <library path="my_pkg.planner">'
        )
    roots = [each for each in (folder / "src", folder) if (each / name.partition(".")[0]).exists()]
    roots += [each for each in (folder / "src", folder) if (each / f"{name}.py").is_file()]
    if not roots:
        raise PluginError(f"{declared.file} names the module {name}, which is not in {folder / 'src'} or {folder}")
    with _importing_from(roots[0], name.partition(".")[0]):
        try:
            return import_module(name)
        except RosminiError:
            raise
        except Exception as error:
            raise PluginError(
                f"the module {name} of the plugin {declared.name} cannot be loaded: {type(error).__name__}: {error}"
            ) from error


@contextmanager
def _importing_from(root: Path, top: str) -> Iterator[None]:
    """Make a folder's modules and ROS's modules importable, after unloading those of the folder and of `top`."""
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if name.partition(".")[0] == top or (file and Path(file).is_relative_to(root)):
            del sys.modules[name]
    sys.path.insert(0, str(root))
    try:
        with find_extension("rosmini.imports", "rospy")():
            yield
    finally:
        sys.path.remove(str(root))
