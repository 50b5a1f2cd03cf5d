"""Reads launch files (http://wiki.ros.org/roslaunch/XML) into a `Plan`."""

from __future__ import annotations

import os
from collections.abc import Callable, Container, Mapping, Sequence
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.files import is_file
from rosmini.core.markup import Element, parse, parse_file
from rosmini.core.names import is_remapping
from rosmini.core.packages import PackageIndex

from .errors import LaunchError, Place, not_there
from .loading import Loading
from .nodes import read_machine, read_node
from .plan import Argument, LaunchFile, NodePlan, Plan, TestPlan
from .scope import Scope
from .settings import read_env, read_param, read_remap, read_rosparam
from .values import flag

MAX_DEPTH = 60
"""Maximum depth of includes."""

MAX_FILES = 2000
"""Maximum number of files read for one launch."""

MAX_NODES = 10_000
"""Maximum number of nodes in a launch."""

TEXT = "<text>"
"""Name of a launch file that is not read from a file."""


def read(
    *files: str | os.PathLike[str],
    args: Mapping[str, str] | None = None,
    text: str | None = None,
    path: str = TEXT,
    namespace: str = "/",
    packages: PackageIndex | None = None,
    environ: Mapping[str, str] | None = None,
    anonymous: Callable[[str], str] | None = None,
    lenient: bool = False,
) -> Plan:
    """Read launch files in order into one plan, without running anything.

    Args:
        files: paths of the files.
        args: values of arguments, like ``name:=value`` on a command line.
        text: a further launch file, as text.
        path: path of the text, which need not exist yet: errors name it, and ``$(dirname)`` is its folder.
        namespace: namespace of everything, like ``ROS_NAMESPACE``.
        packages: the packages; by default `PackageIndex()`.
        environ: variables for ``$(env ...)``; by default ``os.environ``.
        anonymous: creates names for ``$(anon name)``; by default ``name_1``, ``name_2``.
        lenient: continue if something is missing, and list it in ``plan.missing``.

    Raises:
        LaunchError: a file is invalid, with file and line, or something is missing: one error lists everything.

    """
    reader = Reader(
        packages if packages is not None else PackageIndex(),
        os.environ if environ is None else environ,
        anonymous or _counted(),
    )
    given = dict(args or {})
    try:
        for file in files:
            reader.read_root(os.fspath(file), None, namespace, given)
        if text is not None:
            reader.read_root(path, text, namespace, given)
        plan = reader.finish(given)
    except LaunchError as error:
        if reader.is_incomplete(str(error)):  # caused by something missing
            raise not_there(reader.plan.missing) from error
        raise
    if plan.missing and not lenient:
        raise not_there(plan.missing)
    return plan


def _counted() -> Callable[[str], str]:
    """Return a function that creates anonymous names, the same on each run."""
    made = 0

    def make(name: str) -> str:
        nonlocal made
        made += 1
        return f"{name}_{made}"

    return make


class Reader(Loading):
    """Reads files into one plan."""

    def __init__(self, packages: PackageIndex, environ: Mapping[str, str], anonymous: Callable[[str], str]) -> None:
        super().__init__(packages, environ, anonymous)
        self._open: list[LaunchFile] = []
        self._read = 0
        self._names: dict[str, Place] = {}
        self._declared: set[str] = set()

    def read_root(self, path: str, text: str | None, namespace: str, args: Mapping[str, str]) -> None:
        """Read a file named on the command line, or a text. Raises ``LaunchError``."""
        scope = Scope(path, args=dict(args))
        scope.namespace = scope.inside(namespace)
        file = LaunchFile(path, scope.namespace, args=dict(args))
        self.default_machine = ""
        root = self._root(path, text)
        self.plan.roots.append(file)
        self._inside(file, root, scope)
        self._declared |= scope.declared

    def finish(self, args: Mapping[str, str]) -> Plan:
        """Return the plan once all files are read. Raises ``LaunchError``."""
        self.count_warnings()
        for name in args:
            if name not in self._declared:
                hint = nearest(name, self._declared)
                self.plan.warnings.append(f"no launch file has an arg {name!r}{f'; {hint}' if hint else ''}")
        for name, element in self.wanted_machines:
            if name not in self.plan.machines:
                hint = nearest(name, self.plan.machines)
                raise element.error(f"unknown machine [{name}]{f'; {hint}' if hint else ''}")
        return self.plan

    # -- files ---------------------------------------------------------------------------------------------------

    def _root(self, path: str, text: str | None) -> Element:
        self._read += 1
        if self._read > MAX_FILES:
            raise LaunchError(f"more than {MAX_FILES} files are included", path)
        element = parse_file(path, LaunchError) if text is None else parse(text, path, LaunchError)
        if element.tag != "launch":
            hint = nearest(element.tag, ["launch"])
            raise element.error(
                f"Invalid roslaunch XML syntax: no root <launch> tag, this file begins with <{element.tag}>"
                f"{f'; {hint}' if hint else ''}"
            )
        return element

    def _inside(self, file: LaunchFile, root: Element, scope: Scope) -> None:
        """Read the contents of a file."""
        before, self.at = self.at, file
        self._open.append(file)
        try:
            deprecated = root.get("deprecated")
            if deprecated:
                self.warn(root, f"DEPRECATED: {deprecated}")
            self._children(root, scope)
        finally:
            self._open.pop()
            self.at = before

    def _children(self, parent: Element, scope: Scope) -> None:
        for element in parent.children:
            read_tag = TAGS.get(element.tag)
            if read_tag is None:
                self.warn(element, f"unrecognized tag <{element.tag}>", element.tag, TAGS)
            elif self.applies(element, scope):
                read_tag(self, element, scope)

    # -- tags ----------------------------------------------------------------------------------------------------

    def group(self, element: Element, scope: Scope) -> None:
        """Read a ``<group>``."""
        self.check_attributes(element, ("ns", "clear_params"))
        self._children(element, self.scope_inside(element, scope))

    def arg(self, element: Element, scope: Scope) -> None:
        """Declare an argument."""
        name, value, default, doc = self._arg(element, scope, scope.args)
        place = Place(element.path, element.line)
        if len(self._open) == 1 and value is None and name not in self.plan.arguments:
            self.plan.arguments[name] = Argument(name, default, doc, place)
        if name in scope.declared and not scope.takes_all:
            raise element.error(f"arg '{name}' has already been declared")
        scope.declared.add(name)
        if value is not None:
            if name in scope.args and not scope.takes_all:
                raise element.error(
                    f"cannot override arg '{name}', which has already been set: value= is fixed, default= can be given"
                )
            scope.args[name] = value
        elif default is not None:
            scope.args.setdefault(name, default)

    def _arg(self, element: Element, scope: Scope, known: Container[str]) -> tuple[str, str | None, str | None, str]:
        self.check_attributes(element, ("name", "value", "default", "doc"))
        name = self.required(element, scope, "name")
        if "value" in element.attributes and "default" in element.attributes:
            raise element.error("<arg> tag must have one and only one of value/default")
        value, doc = (self.optional(element, scope, each) for each in ("value", "doc"))
        # unlike ROS, skip the default if a value is given: its `$(env NAME)` need not be set then
        default = element.attributes.get("default") if name in known else self.optional(element, scope, "default")
        return name, value, default, doc or ""

    def include(self, element: Element, scope: Scope) -> None:
        """Read an included file."""
        self.check_attributes(element, ("file", "ns", "clear_params", "pass_all_args"))
        path = self.required(element, scope, "file")
        takes_all = flag(element, "pass_all_args", self.optional(element, scope, "pass_all_args"))
        outside = scope.child()
        given = self._given(element, outside, dict(scope.args) if takes_all else {}, takes_all=takes_all)
        space = self.space(element, scope)
        inside = outside.included(path, space, given, at=f"{element.path}:{element.line}", takes_all=takes_all)
        inside.private = scope.private or {}
        self.clear(element, scope, inside.namespace, named=bool(space))
        if not is_file(path):
            self.lacks_file(element, "launch file", path, "there is no such file")
            return
        file = LaunchFile(path, inside.namespace, Place(element.path, element.line), dict(given))
        self._refuse_endless(element, file)
        root = self._root(path, None)
        self.at.includes.append(file)
        self._inside(file, root, inside)
        unused = [] if takes_all else list(inside.unused(given))
        if unused:
            hint = nearest(unused[0], inside.declared)
            raise element.error(
                f"unused args [{', '.join(unused)}] for include of [{path}]{f'; {hint}' if hint else ';'} that file "
                f"declares {', '.join(sorted(inside.declared)) or 'no args'}"
            )

    def _given(self, element: Element, outside: Scope, given: dict[str, str], *, takes_all: bool) -> dict[str, str]:
        """Return the arguments that an include passes on."""
        seen: set[str] = set()
        for child in element.children:
            if child.tag not in ("arg", "env"):
                self.warn(child, f"unrecognized '{child.tag}' tag in <include> tag")
            elif not self.applies(child, outside):
                continue
            elif child.tag == "env":
                read_env(self, child, outside)
            else:
                name, value, default, _ = self._arg(child, outside, given)
                if name in seen and not takes_all:
                    raise child.error(f"arg '{name}' has already been declared")
                seen.add(name)
                if value is None and default is None:
                    raise child.error(f"include args must have declared values: give arg '{name}' a value=\"...\"")
                if value is not None or name not in given:
                    given[name] = value if value is not None else str(default)
        return given

    def _refuse_endless(self, element: Element, file: LaunchFile) -> None:
        real = os.path.realpath(file.path)
        for one in self._open:
            if os.path.realpath(one.path) == real and one.args == file.args:
                names = " -> ".join(os.path.basename(each.path) for each in [*self._open, file])  # noqa: PTH119
                raise element.error(f"files include one another without end: {names}")
        if len(self._open) >= MAX_DEPTH:
            raise element.error(f"files include one another more than {MAX_DEPTH} deep: {file.path}")

    def node(self, element: Element, scope: Scope) -> None:
        """Add a node or a test."""
        made = read_node(self, element, scope)
        if isinstance(made, TestPlan):
            self.plan.tests.append(made)
            return
        self._refuse_second(element, made)
        self.plan.nodes.append(made)
        self.at.nodes.append(made)
        if len(self.plan.nodes) > MAX_NODES:
            raise element.error(f"more than {MAX_NODES} nodes")

    def _refuse_second(self, element: Element, made: NodePlan) -> None:
        first = self._names.setdefault(made.full_name, made.place)
        if first is not made.place:
            raise element.error(
                f"roslaunch file contains multiple nodes named [{made.full_name}], the first one at {first}. Names "
                'must be unique: choose another, put one of them into a group with ns="...", or use $(anon name)'
            )

    def machine(self, element: Element, scope: Scope) -> None:
        """Declare a machine."""
        made = read_machine(self, element, scope)
        before = self.plan.machines.setdefault(made.name, made)
        if not before.same_as(made):
            raise element.error(
                f"Machine [{made.name}] already added and does not match duplicate entry ({before.place})"
            )
        if made.is_default:
            self.default_machine = made.name

    def master(self, element: Element, scope: Scope) -> None:  # noqa: ARG002 - alike
        """Ignore an element of old files."""
        self.warn(element, "ignoring defunct <master /> tag")


TAGS: Mapping[str, Callable[[Reader, Element, Scope], None]] = {
    "arg": Reader.arg,
    "env": read_env,
    "group": Reader.group,
    "include": Reader.include,
    "machine": Reader.machine,
    "master": Reader.master,
    "node": Reader.node,
    "param": read_param,
    "remap": read_remap,
    "rosparam": read_rosparam,
    "test": Reader.node,
}


def find_file(words: Sequence[str], packages: PackageIndex | None = None) -> list[str]:
    """Return the launch files that a command line names: ``PACKAGE FILE`` or paths; ``-`` is kept.

    Raises ``LaunchError``, with a hint if the second word is an executable to be run by rosrun.
    """
    index = packages if packages is not None else PackageIndex()
    if not words:
        raise LaunchError("no launch file was given")
    if len(words) >= 2 and words[0] in index:
        found = files_named(index, words[0], words[1])
        if len(found) > 1:
            listed = "".join(f"\n- {path}" for path in found)
            raise LaunchError(
                f"multiple files named [{words[1]}] in package [{words[0]}]:{listed}\nPlease specify full path instead"
            )
        if found and not _is_executable(index, words[0], words[1]):
            return [found[0], *_all_there(words[2:])]
    if words[0] == "-" or is_file(words[0]):
        return [words[0], *_all_there(words[1:])]
    raise LaunchError(_no_file(words, index))


def files_named(index: PackageIndex, package: str, name: str) -> list[str]:
    """Return the files of this name anywhere in a package; for a path, the file at that path."""
    folder = os.fspath(index.path(package))
    if os.path.basename(name) != name:  # noqa: PTH119 - a text
        path = os.path.normpath(os.path.join(folder, name))  # noqa: PTH118
        return [path] if path.startswith(folder + os.sep) and is_file(path) else []
    found = []
    for parent, folders, names in os.walk(folder):
        folders[:] = sorted(each for each in folders if not each.startswith("."))
        if name in names:
            found.append(os.path.join(parent, name))  # noqa: PTH118
    return found


def launch_files(index: PackageIndex, package: str) -> list[str]:
    """Return the names of all launch files in a package."""
    return sorted(
        {name for _, _, names in os.walk(index.path(package)) for name in names if name.endswith((".launch", ".test"))}
    )


def _all_there(words: Sequence[str]) -> list[str]:
    gone = [word for word in words if word != "-" and not is_file(word)]
    if gone:
        raise LaunchError(f"The following input files do not exist: {', '.join(gone)}")
    return list(words)


def _is_executable(index: PackageIndex, package: str, name: str) -> bool:
    """Return True if a package has this executable, and it is not a launch file."""
    return not name.endswith((".launch", ".xml", ".test")) and name in index.executables(package)


def _no_file(words: Sequence[str], index: PackageIndex) -> str:
    if len(words) == 1:
        also = f"; a package needs a launch file after it: {words[0]} FILE" if words[0] in index else ""
        return f"[{words[0]}] is not a launch file name{also}"
    package, name = words[0], words[1]
    said = f"[{name}] is neither a launch file in package [{package}] nor is [{package}] a launch file name"
    if package not in index:
        if package in ("ping", "info", "kill"):
            return f"{said}. A running node is asked by: rosnode {package} {name}"
        hint = nearest(package, index.names()) or _as_executable(package, name)
        return f"{said}: there is no package {package!r}{f'; {hint}' if hint else ''}"
    if _is_executable(index, package, name):
        return f"{said}. It is an executable: rosrun {package} {name}"
    there = launch_files(index, package)
    hint = nearest(name, there) or (
        f"the package has {', '.join(there)}" if there else "the package has no launch files"
    )
    return "; ".join(filter(None, (said, hint, _as_executable(package, name))))


def _as_executable(package: str, name: str) -> str:
    """Return a hint if the name is not that of a launch file and may be an executable."""
    is_launch_file = name.endswith((".launch", ".xml", ".test"))
    return "" if is_launch_file else f"an executable is started by: rosrun {package} {name}"


def plan_of(*words: str | os.PathLike[str], lenient: bool = False, **args: Any) -> Plan:
    """Return the plan of launch files without running anything.

    Args:
        words: a package and a launch file in it, or paths; and ``name:=value`` for arguments.
        lenient: continue if something is missing, see `read`.
        args: further arguments as keyword arguments.

    Raises:
        LaunchError: a file is missing or invalid, with file and line; or something else is missing.

    """
    texts = [os.fspath(word) for word in words]
    given = dict(word.split(":=", 1) for word in texts if is_remapping(word))
    given |= {name: str(value).lower() if isinstance(value, bool) else str(value) for name, value in args.items()}
    index = PackageIndex()
    files = find_file([word for word in texts if not is_remapping(word)], index)
    return read(*files, args=given, packages=index, lenient=lenient)
