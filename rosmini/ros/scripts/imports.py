"""The import system of one script.

Each script has its own ``__import__`` in its builtins. Modules beside the script (or in a folder that it added to
``sys.path``) are loaded for this script alone, with ticks in their loops. Some modules of the standard library that
block or keep global state (``threading``, ``time``, ``random``, ``logging``, ...) are replaced by
shims or by private copies. ``rospy`` (provided by the runner) and the messages are rosmini's. Everything
else is the host's, imported without the script's context, so that it keeps no state of the script.
"""

from __future__ import annotations

import builtins
import importlib
import importlib.util
import sys
from importlib.machinery import EXTENSION_SUFFIXES, SOURCE_SUFFIXES, ExtensionFileLoader, FileFinder, SourceFileLoader
from types import ModuleType
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.msgs.registry import registry
from rosmini.msgs.sources import PackageSource

from .shims import BUILDERS, PRIVATE_COPIES, finish_copy
from .source import compile_script

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from importlib.machinery import ModuleSpec
    from pathlib import Path

    from .context import ScriptContext

_NEVER_LOCAL = frozenset(sys.builtin_module_names) | {"rosmini", "builtins", "os", "io", "abc", "codecs"}
"""Names that are loaded before any script, so that a file beside it cannot hide them."""


_MESSAGES = "rosmini.msgs."
_LIKE_MESSAGES = ("_msgs", "_msg", "_srvs", "_srv", "_interfaces")


class Importer:
    """The modules of one script, and its ``__import__``."""

    def __init__(self, context: ScriptContext, given: Mapping[str, ModuleType]) -> None:
        self._context = context
        self._given = given
        self.local: dict[str, ModuleType] = {}
        self.private: dict[str, ModuleType] = {
            name: module for name, module in given.items() if name.rpartition(".")[0] in ("", *given)
        }
        self._finders: dict[str, FileFinder] = {}
        self._hosted: set[str] = set()
        self._hosted_for: tuple[str, ...] = ()
        self._real_import = builtins.__import__

    # -- the function in the script's builtins -------------------------------------------------------------------

    def import_name(
        self,
        name: str,
        globals: Mapping[str, Any] | None = None,
        locals: Mapping[str, Any] | None = None,
        fromlist: Sequence[str] | None = (),
        level: int = 0,
    ) -> ModuleType:
        """Import like ``builtins.__import__``, searching the script's modules first."""
        absolute = name if level == 0 else self._absolute(name, globals, level)
        package, _, child = absolute.partition(".")
        if child.partition(".")[0] != "cfg":
            return self._import(absolute, name, globals, locals, fromlist, level)
        try:
            module = self._import(absolute, name, globals, locals, fromlist, level)
            missing = next((each for each in fromlist or () if each != "*" and not hasattr(module, each)), None)
            if missing is not None:
                raise ImportError(f"cannot import name {missing!r} from {absolute!r}", name=absolute)
        except ImportError as error:
            files = self._reconfigure_files(package)
            if files and not isinstance(error, RosminiError):
                raise type(error)(
                    f"{error}. catkin_make makes {package}.cfg from {', '.join(files)}: run catkin_make in the "
                    "workspace, and source its devel/setup.bash",
                    name=error.name,
                ) from None
            raise
        return module

    def _import(
        self,
        absolute: str,
        name: str,
        globals: Mapping[str, Any] | None,
        locals: Mapping[str, Any] | None,
        fromlist: Sequence[str] | None,
        level: int,
    ) -> ModuleType:
        top = absolute.partition(".")[0]
        if not self._owns(top):
            return self._from_host(name if level == 0 else absolute, globals, locals, fromlist)
        module = self.load(absolute)
        if fromlist:
            self._load_children(module, absolute, fromlist)
            return module
        if level == 0:
            return self._found(top)
        if not name:
            return module
        return self._found(absolute[: len(absolute) - len(name) + len(name.partition(".")[0])])

    def load(self, name: str) -> ModuleType:
        """Return the module ``name`` (absolute), loading it and its parents if needed: ``importlib.import_module``."""
        known = self.private.get(name) or self.local.get(name)
        if known is not None:
            return known
        parent_name, _, child = name.rpartition(".")
        if not parent_name:
            return self._load_top(name)
        parent = self.load(parent_name)
        known = self.private.get(name) or self.local.get(name)  # the parent may have imported it
        if known is not None:
            return known
        if name in self._given:  # a module beside messages, such as sensor_msgs.point_cloud2
            module = self.private[name] = self._given[name]
        elif name in PRIVATE_COPIES:
            module = self._copy(name)
        elif name in BUILDERS:
            module = self.private[name] = BUILDERS[name](self._context)
        elif child == "cfg" and (folder := self._reconfigure_folder(parent_name)) is not None:
            module = self._load_reconfigure(name, folder)
            if parent_name not in self.local:  # the message module, which is not the script's
                return module
        elif parent_name in self.local and child in ("msg", "srv") and self._is_of_messages(name, parent):
            module = self._message_module(name)
        elif parent_name in self.local:
            module = self._load_local_child(name, parent)
        elif parent_name in self._given and not self._defines_messages(parent_name):
            _explain(name)
            raise self._not_in_ours(name, parent_name)
        elif parent_name in self._given or parent.__name__.startswith(_MESSAGES):
            return self._message_module(name)
        else:
            return self._host_module(name, parent if parent_name in self.private else None)
        setattr(parent, child, module)
        return module

    # -- where a name belongs ------------------------------------------------------------------------------------

    def _owns(self, top: str) -> bool:
        folders = self._context.local_folders()
        if folders is not self._hosted_for:
            self._hosted_for = folders
            self._hosted.clear()
        elif top in self._hosted:
            return False
        if top in self.private or top in self.local or top in BUILDERS or top in PRIVATE_COPIES:
            return True
        if self._local_spec(top) is not None or self._defines_messages(top):
            return True
        if top in sys.modules:
            self._hosted.add(top)
        return False

    def _found(self, name: str) -> ModuleType:
        return self.private.get(name) or self.local.get(name) or self.load(name)

    def _load_top(self, name: str) -> ModuleType:
        spec = self._local_spec(name)
        if spec is not None:
            return self._load_spec(spec)
        if name in BUILDERS:
            module = self.private[name] = BUILDERS[name](self._context)
            return module
        if name in PRIVATE_COPIES:
            return self._copy(name)
        if self._defines_messages(name):
            return self._message_module(name)
        return self._host_module(name, None)

    def _defines_messages(self, package: str) -> bool:
        if package in sys.stdlib_module_names:
            return False
        known = registry()
        return bool(known.messages(package) or known.services(package))

    def _is_of_messages(self, name: str, parent: ModuleType) -> bool:
        """Return True if ``my_package.msg`` is made from the definitions: the Python package has no such module."""
        own = self._find(name, list(getattr(parent, "__path__", ())))
        return self._defines_messages(parent.__name__) and (own is None or own.loader is None)

    def _message_module(self, name: str) -> ModuleType:
        """Return ``std_msgs.msg`` from :mod:`rosmini.msgs`, even if a ROS is installed, to match our rospy."""
        try:
            module = self.private[name] = importlib.import_module(_MESSAGES + name)
        except ModuleNotFoundError as error:
            _explain(name)
            if isinstance(error, RosminiError):
                raise
            raise ModuleNotFoundError(f"No module named {name!r}", name=name) from None
        return module

    def _not_in_ours(self, name: str, package: str) -> ModuleNotFoundError:
        """Return the error for a submodule that rosmini's ``package`` lacks."""
        inner = sorted(each.removeprefix(f"{package}.") for each in self._given if each.startswith(f"{package}."))
        has = f"rosmini's {package} has the modules {', '.join(inner)}" if inner else f"{package} has no modules here"
        return ModuleNotFoundError(f"No module named {name!r}: {has}", name=name)

    def _local_spec(self, name: str) -> ModuleSpec | None:
        """Return the location of the top-level module ``name`` in the script's folders, or None."""
        if name in _NEVER_LOCAL or name in sys.builtin_module_names:
            return None
        found = self._find(name, self._context.local_folders())
        if found is not None and found.loader is not None:
            return found
        return self._package_spec(name) or found  # a plain folder gives way to a package

    def _package_spec(self, name: str) -> ModuleSpec | None:
        """Return the location of a ROS package's Python package: in ``src``, as for ``catkin_python_setup()``.

        The script's own package may have any name there, another package only its own.
        """
        source, homes = registry().source, [self._context.package]
        if isinstance(source, PackageSource) and name in source.index:
            homes.append(source.index.path(name))
        for home in homes:
            if home is not None and (home / "src" / name / "__init__.py").is_file():
                return self._find(name, [str(home / "src")])
        folder = self._reconfigure_folder(name)
        if folder is None or self._defines_messages(name):
            return None
        return self._find(name, [str(folder.parent.parent)])

    def _reconfigure_folder(self, package: str) -> Path | None:
        """Return the folder in which catkin_make has made ``my_package.cfg``."""
        source = registry().source
        return source.reconfigure_folder(package) if isinstance(source, PackageSource) else None

    def _reconfigure_files(self, package: str) -> list[str]:
        """Return the ``.cfg`` files of a package, relative to its folder."""
        source = registry().source
        if not isinstance(source, PackageSource) or package not in source.index:
            return []
        home = source.index.path(package)
        return sorted(str(file.relative_to(home)) for file in home.glob("cfg/*.cfg"))

    def _load_reconfigure(self, name: str, folder: Path) -> ModuleType:
        spec = self._find(name, [str(folder.parent)])
        if spec is None:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return self._load_spec(spec)

    def _find(self, name: str, folders: Sequence[str]) -> ModuleSpec | None:
        portions: list[str] = []
        for folder in folders:
            finder = self._finders.get(folder)
            if finder is None:
                loaders = [(ExtensionFileLoader, EXTENSION_SUFFIXES), (SourceFileLoader, SOURCE_SUFFIXES)]
                finder = self._finders[folder] = FileFinder(folder, *loaders)
            spec = finder.find_spec(name)
            if spec is None:
                continue
            if spec.loader is not None:
                return spec
            portions += spec.submodule_search_locations or []
        if not portions or self._host_has(name):  # a plain folder beside the script gives way to a real package
            return None
        spec = importlib.machinery.ModuleSpec(name, None, is_package=True)
        spec.submodule_search_locations = portions
        return spec

    def _host_has(self, name: str) -> bool:
        if name in sys.modules or name in BUILDERS or name in PRIVATE_COPIES:
            return True
        try:
            return importlib.util.find_spec(name) is not None
        except (ImportError, ValueError):
            return False

    @staticmethod
    def _absolute(name: str, globals: Mapping[str, Any] | None, level: int) -> str:
        package = (globals or {}).get("__package__")
        if not package:
            raise ImportError("attempted relative import with no known parent package")
        return importlib.util.resolve_name("." * level + name, package)

    # -- loading -------------------------------------------------------------------------------------------------

    def _from_host(
        self,
        name: str,
        globals: Mapping[str, Any] | None,
        locals: Mapping[str, Any] | None,
        fromlist: Sequence[str] | None,
    ) -> ModuleType:
        module = sys.modules.get(name)
        if module is not None and not (fromlist and hasattr(module, "__path__")):
            self._context.after_import(name)
            return self._real_import(name, globals, locals, fromlist or ())
        try:
            with self._context.put_aside():
                found = self._real_import(name, globals, locals, fromlist or ())
        except ModuleNotFoundError as error:
            if error.name == name and name.endswith(_LIKE_MESSAGES):
                self._message_module(name)  # raises an error that suggests the nearest package
            _explain(error.name)
            raise
        self._context.after_import(name)
        return found

    def _host_module(self, name: str, private_parent: ModuleType | None) -> ModuleType:
        try:
            with self._context.put_aside():
                module = importlib.import_module(name)
        except ModuleNotFoundError as error:
            _explain(error.name)
            raise
        self._context.after_import(name)
        if private_parent is not None:
            setattr(private_parent, name.rpartition(".")[2], module)
        return module

    def _load_children(self, module: ModuleType, name: str, fromlist: Sequence[str]) -> None:
        if not hasattr(module, "__path__"):
            return
        wanted = list(getattr(module, "__all__", ())) if "*" in fromlist else list(fromlist)
        for child in wanted:
            if child == "*" or hasattr(module, child):
                continue
            full = f"{name}.{child}"
            try:
                self.load(full)
            except ModuleNotFoundError as error:
                if error.name != full or isinstance(error, RosminiError):
                    raise

    def _load_local_child(self, name: str, parent: ModuleType) -> ModuleType:
        folders = getattr(parent, "__path__", None)
        if folders is None:
            raise ModuleNotFoundError(f"No module named {name!r}; {parent.__name__!r} is not a package", name=name)
        spec = self._find(name, list(folders))
        if spec is None:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return self._load_spec(spec)

    def _load_spec(self, spec: ModuleSpec) -> ModuleType:
        module = importlib.util.module_from_spec(spec)
        self.local[spec.name] = module
        self._context.module_added(spec.name, module)
        loader = spec.loader
        try:
            if isinstance(loader, SourceFileLoader) and spec.origin is not None:
                source = compile_script(loader.get_data(spec.origin), spec.origin)
                module.__dict__["__builtins__"] = self._context.builtins
                exec(source.code, module.__dict__)  # noqa: S102 - this is what importing is
            elif loader is not None:
                loader.exec_module(module)
        except BaseException:
            self.local.pop(spec.name, None)
            self._context.module_removed(spec.name)
            raise
        return self.local.get(spec.name, module)

    def _copy(self, name: str) -> ModuleType:
        """Return a private copy of a pure-Python standard library module that uses this script's shims."""
        spec = importlib.util.find_spec(name)
        if spec is None or spec.loader is None:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        module = importlib.util.module_from_spec(spec)
        module.__dict__["__builtins__"] = self._context.library_builtins
        self.private[name] = module
        code = spec.loader.get_code(name)  # type: ignore[attr-defined]
        try:
            exec(code, module.__dict__)  # noqa: S102 - this is what importing is
        except BaseException:
            del self.private[name]
            raise
        finish_copy(self._context, name, module)
        return module


def _explain(name: str | None) -> None:
    """Raise an error with an alternative, if this is a ROS module that rosmini lacks."""
    from rosmini.ros.rospy.absent import absent_module

    known = absent_module(name or "")
    if known is not None:
        raise known from None
