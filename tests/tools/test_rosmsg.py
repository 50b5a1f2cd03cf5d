"""`rosmsg` and `rossrv` print what the real ones do, and return data."""

from __future__ import annotations

import io
import shlex
from pathlib import Path
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini.tools import rosmsg, rossrv

from .transcripts import assert_golden, printed, read

REAL = read("rosmsg_show") | read("rosmsg_md5") | read("rosmsg_misc") | read("rossrv")
TOOLS = {"rosmsg": rosmsg.TOOL, "rossrv": rossrv.TOOL}
EXACT = [
    line for line, (said, status) in REAL.items()
    if line.split()[1:2] in (["show"], ["md5"], ["package"]) and status == 0 and "Cannot locate" not in said
]  # fmt: skip


def run(line: str) -> Any:
    tool, *words = shlex.split(line)
    return TOOLS[tool].run(*words)


@pytest.mark.parametrize("line", EXACT)
def test_it_prints_what_the_real_one_does(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    status = cli.main(line.split())
    printed = capsys.readouterr().out
    assert status == 0
    if line == "rosmsg show Pose":  # turtlesim was not installed there
        printed = printed.partition("[turtlesim/Pose]")[0]
    assert printed == REAL[line][0]


@pytest.mark.parametrize("line", ["rosmsg", "rosmsg -h", "rosmsg bogus", "rossrv"])
def test_the_overview(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    status = cli.main(line.split())
    overview = REAL["rosmsg"][0].replace("rosmsg", line.split(maxsplit=1)[0])
    if line.startswith("rossrv"):
        overview = overview.replace("message", "service").replace("Message", "Service")
    assert capsys.readouterr().out == overview
    assert status == (0 if len(line.split()) == 1 else 64)


@pytest.mark.parametrize("line", ["rosmsg list", "rossrv list", "rosmsg packages"])
def test_what_the_real_ones_list_is_listed(line: str) -> None:
    """But for the types that only actionlib's own tests use, and those of packages that rosmini does not bring."""
    missing = set(REAL[line][0].splitlines()) - set(str(run(line)).splitlines())
    assert {name for name in missing if not name.startswith(("actionlib/", "topic_tools/"))} == set()


def test_the_results_are_data(tmp_path: Path) -> None:
    assert list(run("rosmsg show Pose").definitions) == ["geometry_msgs/Pose", "turtlesim/Pose"]
    assert run("rosmsg show std_msgs/String.msg").definitions == {"std_msgs/String": "string data\n"}
    assert run("rossrv md5 SetBool").sums == {"std_srvs/SetBool": "09fb03525b03e7ea1fd3992bafd87e16"}
    assert str(run("rossrv md5 SetBool")) == "[std_srvs/SetBool]: 09fb03525b03e7ea1fd3992bafd87e16"
    assert "std_srvs/Empty" in run("rossrv package std_srvs").names
    assert "std_srvs" in run("rossrv packages").names
    assert "\n" not in str(run("rosmsg packages -s"))
    assert run("rosmsg show -r std_msgs/Empty").definitions["std_msgs/Empty"].startswith("#")
    assert run("rossrv show -r std_srvs/SetBool").definitions["std_srvs/SetBool"].count("---\n") == 1


def test_an_md5_sum_of_nothing() -> None:
    assert run("rosmsg md5 nope/Nope").complaints[0] == "Cannot locate [nope/Nope]"
    complaint, meant = run("rosmsg md5 Twits").complaints
    assert "[Twits]" in complaint and "Twist" in meant


def test_the_name_may_come_on_standard_input(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("\nstd_msgs/String\n"))
    assert cli.main(["rosmsg", "show"]) == 0
    assert capsys.readouterr().out == "string data\n\n"
    assert cli.main(["rosmsg", "md5"]) == 2  # the real one waits for ever
    assert "please specify" in capsys.readouterr().err


def test_what_is_refused() -> None:
    assert_golden("rosmsg", lambda line: printed(TOOLS[line.split()[0]], None, line))
