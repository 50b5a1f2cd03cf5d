"""`rosparam` prints what the real one does, and returns data."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.verbs import Call, VerbError
from rosmini.tools.rosparam import TOOL

from ..processes import free_port
from .transcripts import assert_golden, in_order, printed, read

REAL = read("rosparam")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        yield made


def run(graph: Graph, *words: object) -> Any:
    return TOOL.run(*words, graph=graph, say=lambda _: None)


def test_the_lines_of_the_transcript_one_after_another(graph: Graph, tmp_path: Path) -> None:
    """What was set before them is set as it was; of the errors the first line is the real one's."""
    (tmp_path / "p.yaml").write_text("a: 1\nb: [1, 2.5, three]\nc: {d: true, e: str}\n", encoding="utf-8")
    master = graph.ask_as("/roslaunch")
    given = {
        "/rosdistro": "noetic\n", "/rosversion": "1.15.15\n", "/run_id": "7155df36-e53b-11f1-b1a9-02fc00000001",
        "/roslaunch/uris/host_127_0_0_1__34265": "http://127.0.0.1:34265/",
    }  # fmt: skip
    for name in master.ask("getParamNames"):
        master.ask("deleteParam", name)
    for name, value in given.items():
        master.ask("setParam", name, value)
    compared = 0
    for line, (said, status) in in_order("rosparam"):
        here = line.replace("/ws/", f"{tmp_path.as_posix()}/")
        if line.startswith("cat "):
            text = Path(here.split()[1]).read_text(encoding="utf-8")
            assert (text, 0) == (said, status)
        elif line == "rosparam get /":  # the real one does not sort
            assert sorted(printed(TOOL, graph, line)[0].splitlines()) == sorted(said.splitlines())
        elif line.startswith("rosparam dump -"):
            continue  # it writes a file of this name
        elif status == 1:
            text, exit_status = printed(TOOL, graph, here)
            assert (text.splitlines(keepends=True)[0], exit_status) == (said, status), line
            assert len(text.splitlines()) == 2
        elif len(line.split()) > 2:
            assert printed(TOOL, graph, here) == (said, status), line
        compared += 1
    assert compared > 30


@pytest.mark.parametrize("line", ["rosparam", "rosparam -h"])
def test_the_overview(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(line.split()) == REAL[line][1]
    assert capsys.readouterr().out == REAL[line][0]


def test_each_verb_has_help_with_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    for verb in TOOL.verbs:
        assert cli.main(["rosparam", verb, "-h"]) == 0
        said = capsys.readouterr().out
        assert said.startswith(f"Usage: rosparam {verb}")
        assert f"Example:\n  rosmini rosparam {verb}" in said


def test_without_a_master(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{free_port()}")
    text, status = read("errors_no_master")["rosparam list"]
    for line in ("rosparam list", "rosparam get /x", "rosparam set /x 1", "rosparam delete /x"):
        assert cli.main(line.split()) == status
        assert capsys.readouterr().err.startswith(text)


# -- data ------------------------------------------------------------------------------------------------------------


def test_the_results_are_data(graph: Graph) -> None:
    assert run(graph, "set", "/gains", "{p: 1.0, i: {max: 2}}").names == ("/gains/p", "/gains/i/max")
    assert run(graph, "get", "/gains").value == {"p": 1.0, "i": {"max": 2}}
    assert run(graph, "list", "/gains").names == ("/gains/i/max", "/gains/p")
    assert str(run(graph, "list", "-v", "/gains")) == "/gains/i/max=2\n/gains/p=1.0"
    assert run(graph, "delete", "/gains/i").names == ("/gains/i",)
    assert str(run(graph, "dump")).startswith("gains:\n  p: 1.0\n")


NEGATIVE = [
    ("-5", -5), ("-0.5", -0.5), ("-1e-3", "-1e-3"), ("'-x'", "-x"), ("", ""), ("deg(180)", 3.141592653589793),
]  # fmt: skip


@pytest.mark.parametrize(("text", "value"), NEGATIVE)
def test_values_that_look_like_options_and_empty_ones(graph: Graph, text: str, value: object) -> None:
    run(graph, "set", "/x", text)
    assert run(graph, "get", "/x").value == value


def test_what_is_done_is_said(graph: Graph, tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("a: 1\nb: {c: [1, 2]}\n---\n_ns: sub\nz: -1\n", encoding="utf-8")
    assert printed(TOOL, graph, "rosparam set -v /g '{p: 1, q: {r: 2.5}}'")[0] == (
        "set parameter [/g/p] to [1]\nset parameter [/g/q/r] to [2.5]\n"
    )
    assert printed(TOOL, graph, "rosparam get -v /g/p")[0] == "getting parameter [/g/p]\n1\n"
    name = path.as_posix()
    assert printed(TOOL, graph, f"rosparam load -v {name} /ns")[0] == (
        f"reading parameters from [{name}]\nreading parameters into namespace [/ns/sub]\n"
        "/ns/a=1\n/ns/b/c=[1, 2]\n/ns/sub/z=-1\n"
    )
    assert printed(TOOL, graph, f"rosparam dump -v {name} /ns/b")[0] == (
        f"dumping namespace [/ns/b] to file [{name}]\n/ns/b/c=[1, 2]\n"
    )
    assert path.read_text(encoding="utf-8") == "c:\n- 1\n- 2\n"
    assert printed(TOOL, graph, "rosparam delete -v /ns")[0] == "deleted parameter [/ns]\n"
    assert printed(TOOL, graph, "rosparam delete -v /")[0] == "deleted ENTIRE parameter server\n"
    assert run(graph, "list").names == ()


def test_the_terminal_reads_standard_input(graph: Graph) -> None:
    verb = TOOL.verbs["load"]
    stdin = io.StringIO("k: 1\nm: {n: 2}\n")
    verb.act(verb.parser().parse(["-", "/std"]), Call(graph, read_line=stdin.readline))
    assert run(graph, "get", "/std").value == {"k": 1, "m": {"n": 2}}


def test_names_are_in_the_namespace_of_the_shell(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_NAMESPACE", "/robot1")
    run(graph, "set", "speed", "2")
    assert run(graph, "get", "/robot1/speed").value == 2


def test_what_is_refused(graph: Graph) -> None:
    assert_golden("rosparam", lambda line: printed(TOOL, graph, line))


def test_a_file_that_cannot_be_written(graph: Graph) -> None:
    with pytest.raises(VerbError, match="cannot be written"):
        run(graph, "dump", "/nope/x.yaml")
