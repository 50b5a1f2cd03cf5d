"""Rules of ``roswtf`` for launch files: what prevents a launch, and what does not run as the files say."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import DefinitionError
from rosmini.core.packages import BUILT_IN, package_around, read_package
from rosmini.ros.introspection.wtf.findings import Finding

from .errors import LaunchError
from .executables import missing_programs
from .plan import shortened
from .reader import find_file, read
from .running import on_machine

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from rosmini.core.packages import PackageIndex
    from rosmini.ros.introspection.wtf.survey import Survey

    from .plan import LaunchFile, Plan


def load(words: Sequence[str], packages: PackageIndex) -> Plan | Finding:
    """Read the launch files of a command line, with ``name:=value``; an unreadable file becomes a finding."""
    args = dict(word.split(":=", 1) for word in words if ":=" in word)
    try:
        files = find_file([word for word in words if ":=" not in word], packages)
        return read(*files, args=args, packages=packages, lenient=True)
    except LaunchError as error:
        first, *rest = str(error).splitlines()
        return Finding(
            "launch_file", "ERROR", "The launch file cannot be read:", (first, *(f" {each.strip()}" for each in rest)),
            "Reading stopped at this place: correct it, and run roswtf again.",
        )  # fmt: skip


def static_findings(plan: Plan, packages: PackageIndex, environ: Mapping[str, str]) -> Iterator[Finding]:
    """Find missing things, warnings, and packages that are used but not declared."""
    missing = [*plan.missing, *missing_programs(plan, packages, environ)]
    if missing:
        where: list[str] = []
        for each in missing:
            where.append(f"{each.kind} {each.name} ({each.place})")
            where += [f" {line}" for line in str(each).splitlines() if "did you mean" in line or "chmod" in line]
        yield Finding(
            "launch_missing", "ERROR", "The launch file names what is not there:", tuple(where),
            "A package belongs below a folder of ROS_PACKAGE_PATH; a script into the folder scripts, with its run bit.",
        )  # fmt: skip
    odd = tuple(plan.warnings)
    if odd:
        yield Finding("launch_warnings", "WARNING", "The launch file says what has no effect, or another one:", odd)
    elsewhere = tuple(
        f"{node.place}: {on_machine(plan, node)}"
        for node in plan.all_nodes()
        if node.machine and not plan.machines[node.machine].is_local
    )
    if elsewhere:
        yield Finding("launch_elsewhere", "WARNING", "Not all of the launch file runs here:", elsewhere)
    undeclared = [line for root in plan.roots for file in root.walk() for line in _undeclared(file)]
    if undeclared:
        yield Finding(
            "launch_undeclared", "WARNING", "Launch files use packages that their own package does not name:",
            tuple(dict.fromkeys(undeclared)),
            "Add <exec_depend>NAME</exec_depend> to package.xml: another computer then installs it, too.",
        )  # fmt: skip


def online_findings(plan: Plan, graph: Survey) -> Iterator[Finding]:
    """Find nodes of a launch that have ended, and changed parameters; nothing if none of the nodes runs."""
    names = [node.full_name for node in plan.nodes]
    gone = tuple(name for name in names if name not in graph.nodes)
    if len(gone) == len(names):
        return
    if gone:
        yield Finding(
            "launch_ended", "WARNING", "Nodes of the launch file do not run, and others of it do:", gone,
            'They have ended, or never started: output="screen" shows what they said last, `roslaunch --log` where '
            "their log files are.",
        )  # fmt: skip
    changed = []
    for name, setting in plan.settings.items():
        value = graph.parameter(*name.strip("/").split("/"))
        if value != setting.value:
            now = "not set" if value is None else shortened(value)
            changed.append(f"{name}: {now} instead of {shortened(setting.value)} ({setting.place})")
    if changed:
        yield Finding(
            "launch_changed", "WARNING", "Parameters are not what the launch file sets:", tuple(changed),
            "Another launch file, dynamic_reconfigure or `rosparam set` came after it; the last one wins.",
        )  # fmt: skip


# -- helpers ---------------------------------------------------------------------------------------------------------


def _undeclared(file: LaunchFile) -> Iterator[str]:
    """Yield the packages whose nodes and files a launch file uses but its own manifest does not name."""
    home = package_around(file.path)
    if home is None:
        return
    try:
        own = read_package(home)
    except DefinitionError:
        return  # broken_manifests says so
    used = {node.package for node in file.nodes}
    for path in (*(each.path for each in file.includes), *(setting.source for setting in file.settings)):
        around = package_around(path) if path and Path(path).is_absolute() else None
        if around is not None:
            used.add(around.name if around != home else own.name)
    missing = sorted(used - {own.name, *own.depends, *BUILT_IN})
    if missing:
        yield f"{own.name}: {', '.join(missing)} ({file.path})"
