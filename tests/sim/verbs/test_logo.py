"""`rosmini logo`: files, programs that come along, and what is typed."""

import io
from argparse import Namespace

import pytest

from rosmini import Graph
from rosmini.core.errors import RosminiError, UsageError
from rosmini.sim.logo import LogoError
from rosmini.sim.verbs.logo import TOOL, programs
from rosmini.tools.terminal import Terminal

MIDDLE = 499 / 90


def test_a_file_is_run_on_paper(tmp_path):
    file = tmp_path / "mine.logo"
    file.write_text("repeat 2 [print repcount]\nfd 10", encoding="utf-8")
    said = []
    TOOL.run("--paper", str(file), say=said.append)
    assert said == ["1", "2"]
    result = TOOL.run("--paper", "-o", str(tmp_path / "it.svg"), str(file), say=said.append)
    for part in ("1 line, 10 steps", "turtle1 at [0 10], heading 0", str(tmp_path / "it.svg")):
        assert part in str(result)
    assert (tmp_path / "it.svg").read_text(encoding="utf-8").startswith("<svg")


def test_a_program_that_comes_along_drives_turtlesim():
    from rosmini.sim.turtlesim.node import TurtleSim

    with Graph(strict=False) as graph:
        sim = TurtleSim(graph.node("turtlesim"))
        graph.run(0.1)
        TOOL.run("square", "turtle1", graph=graph)
        turtle = sim.frame.turtles["turtle1"]
        assert (turtle.x, turtle.y) == pytest.approx((MIDDLE, MIDDLE), abs=1e-4)
        assert len(list(sim.frame.paper.strokes())) >= 4
        assert [name for name in graph.nodes if "logo" in name] == []


def test_wrong_words(tmp_path):
    assert {"square", "tree", "koch", "dragon", "hilbert", "spiral", "star"} <= set(programs())
    with pytest.raises(RosminiError, match="did you mean square"):
        TOOL.run("--paper", "sqare")
    with pytest.raises(UsageError, match="--paper has one turtle"):
        TOOL.run("--paper", "square", "turtle2")
    with pytest.raises(RosminiError, match="no input is available here"):
        TOOL.run("--paper")
    bad = tmp_path / "bad.logo"
    bad.write_text("fd 10\nfrwd 10", encoding="utf-8")
    with pytest.raises(LogoError, match="line 2: I don't know how to frwd"):
        TOOL.run("--paper", str(bad))
    bad.write_bytes(b"\xff\xfe")
    with pytest.raises(RosminiError, match="no program"):
        TOOL.run("--paper", str(bad))


def test_lines_are_typed(monkeypatch, capsys):
    typed = (
        "fd 10\nprint pos\nfrwd\nto twice :n\noutput 2 * :n\nend\nprint twice 4\nrepeat 2 [\nprint 1\n]\nbye\nprint 9\n"
    )
    monkeypatch.setattr("sys.stdin", io.StringIO(typed))
    assert Terminal(TOOL).main(Namespace(words=["--paper"])) == 0
    written = capsys.readouterr().out
    assert written == ("? ? 0 10\n? line 1: I don't know how to frwd; did you mean forward?\n? > > ? 8\n? > > 1\n1\n? ")


def test_ctrl_c_ends_the_program_and_not_the_conversation(monkeypatch, capsys):
    def pressed(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("rosmini.sim.logo.turtles.Turtle.face", pressed)
    monkeypatch.setattr("sys.stdin", io.StringIO("fd 10\nforever [right 1]\nprint pos\n"))
    assert Terminal(TOOL).main(Namespace(words=["--paper"])) == 0
    assert capsys.readouterr().out == "? ? stopped by Ctrl-C\n? 0 10\n? "
