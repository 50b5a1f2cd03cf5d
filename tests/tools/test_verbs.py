"""Verbs: one table and one parser each, two front ends. A new tool is one small file, such as the one written here."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.errors import UsageError
from rosmini.core.time import Time
from rosmini.core.verbs import Tool, VerbError
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.bag import Bag
from rosmini.sim.verbs.world import TOOL as WORLD
from rosmini.tools.rosbag import TOOL as ROSBAG

from ..processes import free_port

NEW_TOOL = '''
"""`rosmini rosgreet`: a tool of one verb."""
from dataclasses import dataclass
from rosmini.core.verbs import ArgumentParser, Result, Tool, VerbError

TOOL = Tool("rosgreet", "greet nodes", usage_status=64, example="rosmini_sim/simulator")

@dataclass(frozen=True, kw_only=True)
class Greetings(Result):
    names: tuple[str, ...]

    def __str__(self):
        return "\\n".join(f"{self.word}, {name}!" for name in self.names)
    word: str = "hello"

def parser():
    made = ArgumentParser("rosgreet all", "Greet all nodes.")
    made.add_argument("--word", default="hello", help="how to greet")
    made.add_argument("--but", help="a node that is not greeted")
    return made

@TOOL.verb("greet all nodes", name="all", parser=parser, needs_graph=True)
def all_(given, call):
    there = sorted(call.graph.nodes)
    if given.but and given.but not in there:
        raise VerbError(f"there is no node {given.but}", status=4)
    call.say("looking")
    left = tuple(f"{given.but} is not greeted" for _ in range(bool(given.but)))
    names = tuple(n for n in there if n != given.but)
    return Greetings(names=names, word=given.word, complaints=left, status=len(left))
'''


@pytest.fixture
def greet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Tool:
    (tmp_path / "rosgreet.py").write_text(NEW_TOOL, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "rosgreet", raising=False)
    monkeypatch.setitem(cli.COMMANDS, "rosgreet", cli.Entry("rosgreet", "greet nodes"))
    import rosgreet  # type: ignore[import-not-found]

    tool: Tool = rosgreet.TOOL
    return tool


def test_in_python_a_verb_returns_its_result(greet: Tool, capsys: pytest.CaptureFixture[str]) -> None:
    with Graph() as graph:
        graph.node("talker")
        found = greet.run("all", "--word", "good morning", graph=graph)
        assert vars(found)["names"] == ("/rosout", "/talker")
        assert str(found) == "good morning, /rosout!\ngood morning, /talker!"
        assert (found.status, found.complaints) == (0, ())
        assert capsys.readouterr().out == "looking\n"
        greet.on(graph)("all", "--but", "/rosout")
        assert capsys.readouterr().out == "looking\nhello, /talker!\n/rosout is not greeted\n"
        with pytest.raises(VerbError, match="there is no node /nobody"):
            greet.run("all", "--but", "/nobody", graph=graph)


def test_in_a_terminal_it_is_printed_and_has_an_exit_status(greet: Tool, capsys: pytest.CaptureFixture[str]) -> None:
    assert greet.name == "rosgreet"
    nodes = ["+", "rosmini_sim/simulator", "__name:=one", "+", "rosmini_sim/simulator", "__name:=two"]
    assert cli.main(["rosgreet", "all", "--but", "/rosout", *nodes]) == 1
    done = capsys.readouterr()
    assert done.out == "looking\nhello, /one!\nhello, /two!\n"
    assert done.err == "/rosout is not greeted\n"
    assert cli.main(["rosgreet", "all", "--but", "/x", *nodes]) == 4
    assert capsys.readouterr().err == "there is no node /x\n"


def test_a_verb_that_needs_a_graph_says_how_to_name_one(greet: Tool, capsys: pytest.CaptureFixture[str]) -> None:
    assert greet.verbs["all"].needs_graph
    assert cli.main(["rosgreet", "all"]) == 1
    assert "`rosmini rosgreet all + rosmini_sim/simulator`" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("al",), ("all", "--wrd", "x"), ("help", "al")])
def test_words_that_make_no_sense(greet: Tool, words: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(UsageError, match="all"):
        greet.run(*words)
    assert cli.main(["rosgreet", *words]) == 64
    assert "rosgreet" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("all", "-h"), ("help", "all")])
def test_help_is_the_same_in_both(greet: Tool, words: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    told = str(greet.run(*words))
    assert "how to greet" in told
    assert cli.main(["rosgreet", *words]) == 0
    assert capsys.readouterr().out == told + "\n"
    assert "greet all nodes" in str(greet.run())
    assert str(greet.run()) == str(greet.run("help")) == greet.help()


def test_the_results_of_rosbag_have_data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with Bag("t.bag", "w") as bag:
        for number in range(4):
            bag.write("/chatter", String(str(number)), Time(100 + number))
    said: list[str] = []
    copied = ROSBAG.run("filter", "-p", "m.data", "t.bag", tmp_path / "f.bag", "t.secs < 102", say=said.append)
    assert said == ["MATCH 0", "MATCH 1", "NO MATCH 2", "NO MATCH 3"]
    assert vars(copied)["bags"] == ((tmp_path / "f.bag", "2 of 4 messages"),)
    assert vars(ROSBAG.run("check", "t.bag"))["changes"] == ()
    partly = ROSBAG.run("info", "t.bag", "none.bag", "f.bag")
    assert (partly.status, len(vars(partly)["texts"]), len(partly.complaints)) == (1, 2, 1)
    done = ROSBAG.run("compress", "t.bag", "none.bag")
    assert (done.status, [path.name for path, _ in vars(done)["bags"]]) == (1, ["t.bag"])
    assert done.complaints == ("ERROR reading none.bag: [Errno 2] No such file or directory: 'none.bag'",)
    assert vars(WORLD.run("check", "arena", "none.world"))["sound"][0].file == "arena"


class Printer:
    def __init__(self) -> None:
        self.shown = ""

    def text(self, text: str) -> None:
        self.shown += text


def test_ipython_shows_a_result_as_a_terminal_does() -> None:
    printer = Printer()
    result = WORLD.run("check", "arena", "none.world")
    result._repr_pretty_(printer, False)
    assert printer.shown.startswith("arena: sound: made in Python")
    assert printer.shown.splitlines()[-1].startswith("error: none.world")


def test_a_tool_that_is_over_in_a_moment_does_not_say_where_it_listens(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A node does, once; whoever asks a question has set ROS_IP and knows."""
    monkeypatch.setenv("ROS_IP", "203.0.113.7")
    monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{free_port()}")
    assert cli.main(["rostopic", "echo", "-n", "1", "/x"]) == 1
    said = capsys.readouterr().err
    assert "listening on" not in said
    assert "203.0.113.7 is not an address of this machine" in said
