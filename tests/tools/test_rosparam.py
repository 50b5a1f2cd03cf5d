"""`rosparam` prints what the real one does, and returns data."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.verbs import Call, VerbError
from rosmini.tools.rosparam import TOOL

from .transcripts import assert_golden, printed, read

REAL = read("rosparam")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        yield made


def run(graph: Graph, *words: object) -> Any:
    return TOOL.run(*words, graph=graph, say=lambda _: None)


@pytest.mark.parametrize("line", ["rosparam", "rosparam -h"])
def test_the_overview(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(line.split()) == REAL[line][1]
    assert capsys.readouterr().out == REAL[line][0]


# -- data ------------------------------------------------------------------------------------------------------------


def test_the_results_are_data(graph: Graph) -> None:
    assert run(graph, "set", "/gains", "{p: 1.0, i: {max: 2}}").names == ("/gains/p", "/gains/i/max")
    assert run(graph, "get", "/gains").value == {"p": 1.0, "i": {"max": 2}}
    assert run(graph, "list", "/gains").names == ("/gains/i/max", "/gains/p")
    assert str(run(graph, "list", "-v", "/gains")) == "/gains/i/max=2\n/gains/p=1.0"
    assert run(graph, "delete", "/gains/i").names == ("/gains/i",)
    assert str(run(graph, "dump")).startswith("gains:\n  p: 1.0\n")


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
