"""``catkin_make``: checks the packages of a workspace and generates the files in ``devel`` needed to use them."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Any

from rosmini import __version__
from rosmini.core import files
from rosmini.core.errors import nearest
from rosmini.core.packages import Package, PackageIndex, search_paths

from . import checks, reconfigure
from .findings import CatkinError, Finding
from .project import Project, python_packages
from .scripts import wrapper
from .setup_files import setup_files
from .workspace import MARKER, TOOL, Workspace, package_folders, python_folder

STATE = "rosmini.json"
"""The file in the build space that records which outputs were made from which inputs."""

RULE = "~" * 49

RELAY = """
from pathlib import Path

__path__.insert(0, {folder!r})
_code = Path({folder!r}, "__init__.py")
if _code.is_file():
    exec(compile(_code.read_text(encoding="utf-8"), str(_code), "exec"))
"""
"""Text of a Python package in ``devel``: it imports the one in the source space and adds the generated messages."""


@dataclass
class Report:
    """Findings and results of ``make``."""

    order: tuple[str, ...] = ()
    built: list[str] = field(default_factory=list)
    """Packages for which files were generated."""
    fresh: list[str] = field(default_factory=list)
    """Packages that were up to date."""
    failed: list[str] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)

    @property
    def status(self) -> int:
        """Exit status: 1 if a package could not be built."""
        return 1 if self.failed or any(each.is_error for each in self.findings) else 0


@dataclass(frozen=True)
class Source:
    """A readable package of the workspace."""

    package: Package
    project: Project | None

    @property
    def name(self) -> str:
        """Name of the package."""
        return self.package.name


def make(
    workspace: Workspace,
    only: Iterable[str] = (),
    *,
    with_dependencies: bool = False,
    environ: Mapping[str, str] | None = None,
    say: Callable[[str], object] = print,
) -> Report:
    """Build a workspace, or ``only`` some of its packages, optionally with the workspace packages that they need.

    A package with errors is skipped and the others are built. Outputs that are up to date are left as they
    are. Raises `CatkinError` if the workspace as a whole cannot be built, and `OSError` if nothing can be written.
    """
    environ = os.environ if environ is None else environ
    report = Report()
    sources = _read(workspace, report)
    state = _load(workspace.build / STATE)
    underlays = workspace.underlays(environ) or [Path(each) for each in state["underlays"] if Path(each).is_dir()]
    order = _ordered(sources, _wanted(sources, only, with_dependencies=with_dependencies))
    report.order = tuple(each.name for each in order)
    if order:
        noted = [f"-- {RULE}", f"-- ~~  traversing {len(order)} packages in topological order:"]
        noted += [f"-- ~~  - {each.name}" for each in order]
        say("\n".join([*noted, f"-- {RULE}"]))
    _lay_out(workspace, underlays)
    below = [folder for prefix in underlays for folder in package_folders(prefix)]
    builder = _Builder(workspace, PackageIndex([workspace.source, *below, *search_paths(environ)]), state, report, say)
    for source in order:
        builder.build(source)
    for name in set(state["packages"]) - {each.name for each in sources}:  # removed from the workspace
        _remove(workspace.devel, state["packages"].pop(name).get("outputs", []))
    state["underlays"] = [str(each) for each in underlays]
    _write(workspace.build / STATE, json.dumps(state, indent=1, sort_keys=True))
    return report


def _read(workspace: Workspace, report: Report) -> list[Source]:
    """Return the packages of the workspace. Raises `CatkinError` if two have the same name."""
    found: dict[str, Source] = {}
    for folder in workspace.packages():
        package, project, findings = checks.read(folder)
        report.findings += [*findings, *checks.nested(folder)]
        if package is None or any(each.is_error for each in findings):
            report.failed.append(package.name if package else folder.name)
            continue
        if package.name in found:
            first = found[package.name].package.path
            raise CatkinError(
                f"Multiple packages found with the same name {package.name!r}: {first} and {folder}; rename one, "
                "or put a file CATKIN_IGNORE into its folder"
            )
        found[package.name] = Source(package, project)
    return list(found.values())


def _wanted(sources: Sequence[Source], only: Iterable[str], *, with_dependencies: bool) -> set[str]:
    """Return the names of the packages to build. Raises `CatkinError` for an unknown one."""
    by_name = {each.name: each.package for each in sources}
    waiting = list(only)
    if not waiting:
        return {*by_name}
    found: set[str] = set()
    for name in waiting:
        if name not in by_name:
            hint = nearest(name, by_name) or f"there are: {', '.join(sorted(by_name)) or 'none'}"
            raise CatkinError(f"Packages {name!r} not found in the workspace; {hint}")
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += [each for each in by_name[name].depends if with_dependencies and each in by_name]
    return found


def _ordered(sources: Sequence[Source], wanted: set[str]) -> list[Source]:
    """Return the packages to build, each after those that it needs. Raises `CatkinError` if there is a cycle."""
    by_name = {each.name: each for each in sources if each.name in wanted}
    sorter = TopologicalSorter({name: sorted({*each.package.depends} & {*by_name}) for name, each in by_name.items()})
    try:
        sorter.prepare()
    except CycleError as error:
        circle = " -> ".join(reversed(error.args[1]))
        raise CatkinError(f"packages depend on each other in a circle: {circle}; take one <depend> out") from error
    order: list[Source] = []
    while sorter.is_active():
        ready = sorted(sorter.get_ready())
        order += [by_name[name] for name in ready]
        sorter.done(*ready)
    return order


def _lay_out(workspace: Workspace, underlays: Sequence[Path]) -> None:
    """Create the folders and the setup files for shells."""
    for folder in (workspace.build, workspace.devel):
        folder.mkdir(parents=True, exist_ok=True)
        _write(folder / ".built_by", TOOL)
    _write(workspace.devel / MARKER, str(workspace.source))
    python_folder(workspace.devel).mkdir(parents=True, exist_ok=True)
    for path, text in setup_files(workspace, underlays).items():
        _write(path, text, may_run=path.name == "env.sh")


@dataclass
class _Builder:
    """Builds packages one after another."""

    workspace: Workspace
    index: PackageIndex
    state: dict[str, Any]
    report: Report
    say: Callable[[str], object]
    _registry: Any = None

    def build(self, source: Source) -> None:
        """Check a package and generate missing files."""
        name, project = source.name, source.project
        kind = "metapackage" if source.package.is_metapackage else "package"
        self.say(f"-- +++ processing catkin {kind}: '{name}'")
        if project is None or source.package.is_metapackage:
            return
        findings = checks.check(source.package, project, self.index)
        packages, more = python_packages(project.folder) if project.python_setup is not None else ({}, [])
        findings += more
        known = self.state["packages"].get(name, {})
        digest = self._digest(source, packages)
        outputs = [self.workspace.devel / each for each in known.get("outputs", [])]
        is_fresh = known.get("digest") == digest and all(path.is_file() for path in outputs)
        if not is_fresh and not any(each.is_error for each in findings):
            findings += self._check_definitions(source)
        self.report.findings += findings
        if any(each.is_error for each in findings):
            self.report.failed.append(name)
            return
        counted = [sum(each.kind == kind for each in project.definitions) for kind in ("msg", "srv", "action")]
        if any(counted):
            actions = f", {counted[2]} actions" if counted[2] else ""
            self.say(f"-- {name}: {counted[0]} messages, {counted[1]} services{actions}")
        if is_fresh:
            self.report.fresh.append(name)
            return
        self._make(source, packages, known, digest)
        self.report.built.append(name)

    def _make(self, source: Source, packages: Mapping[str, Path], known: Mapping[str, Any], digest: str) -> None:
        """Write the generated files of a package, and remove those that are no longer generated."""
        name, project = source.name, source.project
        assert project is not None  # noqa: S101 (checked by the caller)
        made: dict[Path, str] = {}
        python = python_folder(self.workspace.devel)
        if project.definitions:
            from .generation import modules

            for definition in project.definitions:
                self.say(f"Generating Python from {definition.kind.upper()} {name}/{definition.name}")
            found = modules(name, project, self._messages())
            made |= {python / name / path: text for path, text in found.items()}
            made[python / name / "__init__.py"] = ""
        for word in project.reconfigurable:
            module, text = reconfigure.module(project.folder / word.text)
            self.say(f"Generating dynamic reconfigure files from {word.text}: {python / name / 'cfg' / module}.py")
            made |= dict.fromkeys((python / name / "__init__.py", python / name / "cfg/__init__.py"), "")
            made[python / name / "cfg" / f"{module}.py"] = text
        for package, folder in packages.items():
            made[python.joinpath(*package.split("."), "__init__.py")] = RELAY.format(folder=str(folder))
        programs: dict[Path, str] = {}
        for word, where in project.scripts:
            script = project.folder / word.text
            self.say(f"-- Installing devel-space wrapper {script} to {self.workspace.devel / where}")
            programs[self.workspace.devel / where / script.name] = wrapper(script)
        for path, text in (made | programs).items():
            if not path.resolve().is_relative_to(self.workspace.devel.resolve()):
                raise CatkinError(f"{project.path} would write outside the devel space: {path}")
            _write(path, text, may_run=path in programs)
        outputs = sorted(path.relative_to(self.workspace.devel).as_posix() for path in (*made, *programs))
        _remove(self.workspace.devel, {*known.get("outputs", [])} - {*outputs})
        self.state["packages"][name] = {"digest": digest, "outputs": outputs}
        self.say(f"Built target {name}")

    def _messages(self) -> Any:
        """Return the message registry of the workspace and of all packages below it."""
        if self._registry is None:
            from rosmini.msgs.registry import Registry
            from rosmini.msgs.sources import PackageSource

            self._registry = Registry(PackageSource(self.index))
        return self._registry

    def _check_definitions(self, source: Source) -> list[Finding]:
        if source.project is None or not source.project.definitions:
            return []
        from .generation import check_definitions

        return check_definitions(source.name, source.project, self._messages(), self.index)

    def _digest(self, source: Source, packages: Mapping[str, Path]) -> str:
        """Return a digest of all inputs of a package."""
        project = source.project
        assert project is not None  # noqa: S101 (checked by the caller)
        parts = hashlib.sha256(f"{__version__} {self.workspace.devel} {project.folder}".encode())
        inputs = [project.path, source.package.manifest]
        inputs += [project.folder / each.path for each in project.definitions]
        inputs += [project.folder / word.text for word in project.reconfigurable]
        for word in project.message_packages:
            if word.text in self.index:
                folder = self.index.path(word.text)
                inputs += [folder / kind / each for kind in ("msg", "srv") for each in files.names_in(folder / kind)]
        for path in inputs:
            parts.update(b"\0" + str(path).encode(errors="surrogateescape") + b"\0")
            parts.update(files.read(path) if files.is_file(path) else b"")
        parts.update(repr(sorted((name, str(path)) for name, path in packages.items())).encode())
        return parts.hexdigest()


# ---- files ----


def _load(path: Path) -> dict[str, Any]:
    """Return the recorded state; empty if the file is missing or not ours."""
    empty: dict[str, Any] = {"packages": {}, "underlays": []}
    try:
        found = json.loads(files.read(path))
        packages = {
            str(name): {"digest": str(each["digest"]), "outputs": [str(output) for output in each["outputs"]]}
            for name, each in found["packages"].items()
        }
        return {"packages": packages, "underlays": [str(each) for each in found["underlays"]]}
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return empty


def _write(path: Path, text: str, *, may_run: bool = False) -> None:
    """Write a file unless it already has this text."""
    data = text.encode(errors="surrogateescape")
    if path.is_file() and not path.is_symlink() and path.stat().st_size == len(data) and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    path.write_bytes(data)
    if may_run:
        path.chmod(0o755)


def _remove(devel: Path, outputs: Iterable[str]) -> None:
    """Remove generated files from the devel space, and the folders that become empty."""
    top = devel.resolve()
    for each in outputs:
        path = devel / each
        if not path.resolve().is_relative_to(top) or path.resolve() == top:
            continue
        path.unlink(missing_ok=True)
        for folder in path.parents:
            if folder == devel or files.names_in(folder) != []:
                break
            folder.rmdir()
