"""`rosmini rospack`, `rosstack` and `rosversion` beside the real tools, on one workspace."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ..core.packages.workspaces import a_workspace
from ..processes import run
from .conftest import Tools, need_ros

need_ros("rospack", "rosstack", "rosversion")

ROSDEP = "could not find python module 'rosdep2.rospack', continuing without it\n"
"""What the real tools say where rosdep is missing."""


@pytest.fixture(scope="module")
def tools(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tools]:
    folder = tmp_path_factory.mktemp("ws")
    a_workspace(folder)
    env = {
        "PATH": f"/usr/bin:/bin:{os.environ['PATH']}",
        "HOME": str(folder),
        "ROS_HOME": str(folder / ".ros"),
        "ROS_PACKAGE_PATH": str(folder),
        "ROS_DISTRO": "noetic",
    }
    with Tools(env, tmp_path_factory.mktemp("tools")) as found:
        yield found


def both(tools: Tools, line: str, cwd: Path | None = None) -> tuple[Any, Any]:
    real = run(line.split(), env=tools.env, cwd=cwd)
    real.stderr = real.stderr.replace(ROSDEP, "")
    return real, tools.ours(line, cwd=cwd)


SAME = [
    "rospack find alpha", "rospack find renamed", "rospack depends alpha", "rospack depends1 alpha",
    "rospack deps alpha", "rospack deps1 alpha",
    "rospack depends1 mixed", "rospack depends mixed", "rospack depends1 gamma",
    "rospack plugins --attrib=plugin beta",
    "rospack", "rospack -q find nowhere", "rospack -q depends nowhere",
    "rosstack find gathering", "rosstack find alpha",
    "rosstack depends gathering", "rosstack depends1 gathering", "rosstack",
    "rosversion alpha", "rosversion -s alpha", "rosversion -d",
]  # fmt: skip


@pytest.mark.parametrize("line", SAME)
def test_the_same_line_prints_the_same(tools: Tools, line: str) -> None:
    real, ours = both(tools, line)
    assert (ours.returncode, ours.stdout, ours.stderr) == (real.returncode, real.stdout, real.stderr)


ANY_ORDER = [
    "rospack depends-on gamma", "rospack depends-on1 gamma", "rospack depends-on1 beta", "rosstack depends-on alpha",
]  # fmt: skip


@pytest.mark.parametrize("line", ANY_ORDER)
def test_what_the_real_one_prints_in_any_order_is_sorted(tools: Tools, line: str) -> None:
    real, ours = both(tools, line)
    assert ours.returncode == real.returncode == 0
    assert ours.stdout.splitlines() == sorted(real.stdout.splitlines())


@pytest.mark.parametrize("line", ["rospack list", "rospack list-names", "rosstack list", "rosstack list-names"])
def test_the_lists_have_the_same_packages_of_the_workspace(tools: Tools, line: str) -> None:
    def of_workspace(text: str) -> list[str]:
        names = {path.name for path in Path(tools.env["HOME"]).rglob("*") if path.is_dir()} | {"renamed"}
        return [row for row in text.splitlines() if row.split()[0] in names]

    real, ours = both(tools, line)
    assert ours.returncode == real.returncode == 0
    assert of_workspace(ours.stdout) == of_workspace(real.stdout) != []


@pytest.mark.parametrize(
    "line",
    [
        "rospack find nowhere", "rospack depends nowhere", "rospack depends1 nowhere", "rospack depends-on nowhere",
        "rospack plugins beta",
        "rospack find gathering", "rospack depends gathering", "rospack bogus", "rospack find",
        "rosstack find nowhere", "rosstack find", "rosstack bogus", "rosversion nowhere",
        "rospack find one two", "rosversion", "rosversion one two",
    ],
)  # fmt: skip
def test_an_error_begins_as_the_real_one(tools: Tools, line: str, tmp_path: Path) -> None:
    real, ours = both(tools, line, cwd=tmp_path)
    assert (ours.returncode, ours.stdout) == (real.returncode, real.stdout)
    if "two" not in line and line != "rosversion":  # argparse and boost have words of their own
        end = " and rosdep claims"  # there is no rosdep here
        assert ours.stderr.startswith(real.stderr.partition(end)[0].rstrip())


def test_the_package_of_the_working_folder_is_the_default(tools: Tools) -> None:
    for folder in (Path(tools.env["HOME"], "alpha"), Path(tools.env["HOME"], "alpha", "sub")):
        for line in ("rospack find", "rospack depends1"):
            real, ours = both(tools, line, folder)
            assert (ours.returncode, ours.stdout) == (real.returncode, real.stdout)
