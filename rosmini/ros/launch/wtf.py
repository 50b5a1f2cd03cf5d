"""Rules of ``roswtf`` for launch files: what prevents a launch, and what does not run as the files say."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rosmini.core.packages import PackageIndex
from rosmini.ros.introspection.wtf.findings import Finding

from .errors import LaunchError
from .executables import missing_programs
from .reader import find_file, read
from .running import on_machine


def launch_findings(words: Sequence[str], packages: PackageIndex, environ: Mapping[str, str]) -> Iterator[Finding]:
    """Find what is wrong with the launch files of a command line, with ``name:=value``.

    These are unreadable files, missing things, warnings, and nodes that belong on other machines.
    """
    args = dict(word.split(":=", 1) for word in words if ":=" in word)
    try:
        files = find_file([word for word in words if ":=" not in word], packages)
        plan = read(*files, args=args, packages=packages, lenient=True)
    except LaunchError as error:
        first, *rest = str(error).splitlines()
        yield Finding(
            "launch_file", "ERROR", "The launch file cannot be read:", (first, *(f" {each.strip()}" for each in rest)),
            "Reading stopped at this place: correct it, and run roswtf again.",
        )  # fmt: skip
        return
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
