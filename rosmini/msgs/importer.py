"""Import hooks for messages: ``rosmini.msgs.std_msgs.msg`` always, ``std_msgs.msg`` after :func:`install`.

Modules are created on demand, and so are the classes in them. Both paths lead to the same
class objects, because both use the same registry.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import SOURCE_SUFFIXES, FileFinder, ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from rosmini.core.errors import UnknownPackage, UnknownType, nearest

from .registry import MODULE_PREFIX, registry
from .sources import PackageSource

_KINDS = ("msg", "srv", "action")


class UnknownImport(UnknownType, ImportError):
    """An import of a message or service type that does not exist."""


class UnknownPackageImport(UnknownPackage, ModuleNotFoundError):
    """An import from a package that does not exist, or that defines no messages."""


def how_to_import(text: object) -> str:
    """Return how a script imports the type named by ``text`` ("std_msgs/String", "std_msgs.String").

    Returns an empty text if there is no such type.
    """
    parts = [part for part in re.split(r"[/.]", text) if part not in _KINDS] if isinstance(text, str) else []
    if len(parts) != 2:
        return ""
    package, name = parts
    known = {"msg": registry().messages(package), "srv": registry().services(package)}
    wanted = (name, f"{name}Action")
    found = [(kind, each) for each in wanted for kind, names in known.items() if each in names]
    if not found:
        return nearest(name, [each for names in known.values() for each in names])
    kind, each = found[0]
    return f"write `from {package}.{kind} import {each}` and give {each} itself, without quotation marks"


class _DefinitionsModule(ModuleType):
    """``<package>.msg`` or ``<package>.srv``: its attributes are the message or service classes."""

    def __init__(self, name: str, package: str, kind: str) -> None:
        super().__init__(name, f"The {'messages' if kind == 'msg' else 'services'} of the ROS package {package}.")
        self.__dict__["_package"], self.__dict__["_kind"] = package, kind

    @property
    def __all__(self) -> list[str]:
        return self._names()

    def _names(self) -> list[str]:
        if self._kind == "msg":
            return registry().messages(self._package)
        services = registry().services(self._package)
        return sorted({*services, *(f"{name}{half}" for name in services for half in ("Request", "Response"))})

    def __dir__(self) -> list[str]:
        return [*self._names(), "__name__", "__doc__"]

    def __getattr__(self, name: str) -> Any:
        # Tools look up many attributes; only a possible type name deserves an error that is not AttributeError.
        if name.startswith("_"):
            raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'", name=name, obj=self)
        full_name = f"{self._package}/{name}"
        if name not in self._names():
            if not name[:1].isupper():
                raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'", name=name, obj=self)
            kind = "message" if self._kind == "msg" else "service"
            hint = nearest(name, self._names()) or f"it has {', '.join(self._names()[:12]) or 'none'}"
            raise UnknownImport(f"package '{self._package}' has no {kind} type '{name}': {hint}")
        is_service = self._kind == "srv" and name in registry().services(self._package)
        cls = registry().service_class(full_name) if is_service else registry().message_class(full_name)
        self.__dict__[name] = cls
        return cls


class _PackageModule(ModuleType):
    """A package; its submodules ``msg`` and ``srv`` are imported on first use."""

    def __init__(self, name: str, package: str) -> None:
        super().__init__(name, f"The messages and services of the ROS package {package}.")
        self.__dict__["_package"] = package

    def __dir__(self) -> list[str]:
        return [*_kinds(self._package), "__name__", "__doc__"]

    def __getattr__(self, name: str) -> Any:
        if name in _kinds(self._package):
            from importlib import import_module

            return import_module(f"{self.__name__}.{name}")
        if name[:1].isupper():  # a type, as in `from std_msgs import String` and `std_msgs.String`
            hint = how_to_import(f"{self._package}.{name}").partition(" and give")[0]
            where = "in its modules " + " and ".join(f"{self._package}.{kind}" for kind in _kinds(self._package))
            raise UnknownImport(
                f"the types of package '{self._package}' are {where}: {hint or f'none is called {name}'}"
            )
        raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'", name=name, obj=self)


def _kinds(package: str) -> list[str]:
    """Return the submodules of a package."""
    found = registry()
    return [kind for kind, names in (("msg", found.messages(package)), ("srv", found.services(package))) if names]


class _DefinitionsLoader(Loader):
    def __init__(self, package: str, kind: str | None) -> None:
        self.package, self.kind = package, kind

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        if self.kind is None:
            return _PackageModule(spec.name, self.package)
        return _DefinitionsModule(spec.name, self.package, self.kind)

    def exec_module(self, module: ModuleType) -> None:
        """Do nothing: classes are made on demand."""


def _spec(fullname: str, package: str, kind: str | None) -> ModuleSpec:
    return ModuleSpec(fullname, _DefinitionsLoader(package, kind), is_package=kind is None)


class _RebuiltLoader(SourceFileLoader):
    """Reads the source each time: bytecode would be stale if a file was made twice within a second."""

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        return self.source_to_code(self.get_data(path), path)


def _reconfigure_folder(package: str) -> Path | None:
    """Return the folder in which catkin_make has made ``PACKAGE.cfg``."""
    source = registry().source
    return source.reconfigure_folder(package) if isinstance(source, PackageSource) else None


def _reconfigure_spec(fullname: str) -> ModuleSpec | None:
    """Return the spec of ``PACKAGE.cfg`` or a module in it, or None if there is none, or no such ROS package."""
    package, *inner = fullname.split(".")
    folder = _reconfigure_folder(package) if isinstance(sys.modules.get(package), _PackageModule) else None
    if folder is None:
        return None
    home = folder.parent if len(inner) == 1 else folder
    return FileFinder(str(home), (_RebuiltLoader, SOURCE_SUFFIXES)).find_spec(fullname)


class _OwnFinder(MetaPathFinder):
    """Finds ``rosmini.msgs.<package>`` and its submodules."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find a module, as in :class:`importlib.abc.MetaPathFinder`. Raises :class:`UnknownPackageImport`."""
        if not fullname.startswith(f"{MODULE_PREFIX}."):
            return None
        package, _, kind = fullname.removeprefix(f"{MODULE_PREFIX}.").partition(".")
        if not kind:
            own = PathFinder.find_spec(fullname, path, target)
            if own is not None and own.loader is not None and own.origin is not None:
                return None  # a module of ours, such as rosmini.msgs.registry
            source = registry().source
            if source.has_package(package) or any(source.names(package, kind) for kind in ("msg", "srv", "action")):
                return _spec(fullname, package, None)
            hint = nearest(package, source.packages()) or "is it on ROS_PACKAGE_PATH?"
            raise UnknownPackageImport(f"no package '{package}' defines messages or services: {hint}", name=fullname)
        if kind in _kinds(package):
            return _spec(fullname, package, kind)
        there = " and ".join(f"{package}.{each}" for each in _kinds(package))
        hint = how_to_import(f"{package}.{kind}").partition(" and give")[0] or f"it has {there}"
        raise UnknownPackageImport(f"package '{package}' has no module '{kind}': {hint}", name=fullname)


class _TopLevelFinder(MetaPathFinder):
    """Finds ``<package>.msg``, ``<package>.srv`` and ``<package>.cfg`` of ROS packages."""

    def __init__(self, *, shadow: bool) -> None:
        self.shadow = shadow

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find a module, as in :class:`importlib.abc.MetaPathFinder`."""
        package, _, kind = fullname.partition(".")
        if kind.partition(".")[0] == "cfg":
            return _reconfigure_spec(fullname)
        if "." in kind or (kind and kind not in ("msg", "srv")):
            return None
        if not registry().source.has_package(package) and (kind or _reconfigure_folder(package) is None):
            return None
        if not self.shadow and _is_real(fullname, path, target):
            return None
        if not kind:
            return _spec(fullname, package, None)
        return _spec(fullname, package, kind) if kind in _kinds(package) else None


class _LastFinder(MetaPathFinder):
    """Runs after all other finders: finds new packages, and gives hints for mistyped names."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,  # noqa: ARG002 (the protocol's signature)
        target: ModuleType | None = None,  # noqa: ARG002
    ) -> ModuleSpec | None:
        """Find a new package. Raises :class:`UnknownPackageImport` for another name that looks like one of messages."""
        if "." in fullname or not fullname.endswith(("_msgs", "_msg", "_srvs", "_srv", "_interfaces")):
            return None
        source = registry().source
        if any(source.names(fullname, kind) for kind in ("msg", "srv", "action")):
            return _spec(fullname, fullname, None)
        hint = nearest(fullname, source.packages()) or "is it on ROS_PACKAGE_PATH?"
        raise UnknownPackageImport(f"no package '{fullname}' defines messages or services: {hint}", name=fullname)


def _is_real(fullname: str, path: Sequence[str] | None, target: ModuleType | None) -> bool:
    """True if Python itself finds such a module; a folder of that name without ``__init__.py`` does not count."""
    found = PathFinder.find_spec(fullname, path, target)
    return found is not None and found.loader is not None and found.origin is not None


def install(*, shadow: bool = False) -> None:
    """Let ``from std_msgs.msg import String`` find our classes, for every ROS package on the path.

    Real Python modules of such a name (those of a ROS installation) take precedence, unless ``shadow`` is
    true. A second call changes ``shadow``.
    """
    uninstall()
    finders: list[MetaPathFinder] = [_TopLevelFinder(shadow=shadow), _LastFinder()]
    sys.meta_path.insert(0, finders[0])
    sys.meta_path.append(finders[1])


def uninstall() -> None:
    """Undo :func:`install`: remove the finders and the modules that they loaded."""
    sys.meta_path[:] = [finder for finder in sys.meta_path if not isinstance(finder, (_TopLevelFinder, _LastFinder))]
    ours = (_PackageModule, _DefinitionsModule)
    for name, module in list(sys.modules.items()):
        if isinstance(module, ours) and not name.startswith(f"{MODULE_PREFIX}."):
            del sys.modules[name]
    _forget_reconfigure()


def forget(package: str) -> None:
    """Let imports use the current files of a package's types; classes in use do not change."""
    packages = registry().forget(package)
    for module in list(sys.modules.values()):
        if isinstance(module, _DefinitionsModule) and vars(module)["_package"] in packages:
            for name in [name for name, value in vars(module).items() if isinstance(value, type)]:
                delattr(module, name)
    _forget_reconfigure(f"{package}.cfg")


def _forget_reconfigure(start: str = "") -> None:
    """Unload modules of ``PACKAGE.cfg`` made by catkin_make whose names begin with ``start``."""
    for name, module in list(sys.modules.items()):
        if name.startswith(start) and isinstance(getattr(module, "__loader__", None), _RebuiltLoader):
            del sys.modules[name]


def installed() -> bool:
    """True between :func:`install` and :func:`uninstall`."""
    return any(isinstance(finder, _TopLevelFinder) for finder in sys.meta_path)


def enable_own_imports() -> None:
    """Make ``rosmini.msgs.<package>`` importable. Called once, by ``rosmini.msgs``."""
    if not any(isinstance(finder, _OwnFinder) for finder in sys.meta_path):
        # first, because the folders with the stubs would count as namespace packages
        sys.meta_path.insert(0, _OwnFinder())
