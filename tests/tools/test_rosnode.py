"""`rosnode` prints what the real one does, and returns data."""

from __future__ import annotations

import io
import sys
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.verbs import Call, Result, VerbError
from rosmini.msgs import message_class
from rosmini.tools.rosnode import TOOL

from .transcripts import assert_golden, printed, read, talkers

REAL = read("rosnode") | read("rosnode_kill")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        talkers(made)
        yield made


WITH_A_HINT = ["rosnode info /nope", "rosnode ping /nope -c 1", "rosnode kill /nope"]


@pytest.mark.parametrize("line", WITH_A_HINT)
def test_what_there_is_to_do_comes_after_what_the_real_one_prints(graph: Graph, line: str) -> None:
    text, status = printed(TOOL, graph, line)
    assert status == REAL[line][1]
    assert text.startswith(REAL[line][0]) and "`rosnode list`" in text


def test_killing_all_nodes(graph: Graph) -> None:
    graph.nodes["/poser"].shutdown()  # killed before, in the transcript
    assert printed(TOOL, graph, "rosnode kill -a") == REAL["rosnode kill -a"]
    assert graph.nodes == {}


@pytest.mark.parametrize("line", ["rosnode", "rosnode bogus", "rosnode -h"])
def test_the_overview(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    status = cli.main(line.split())
    assert (capsys.readouterr().out, status) == REAL[line]


def test_a_line_that_makes_no_sense(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["rosnode", "info"]) == 2
    assert capsys.readouterr().err == REAL["rosnode info"][0]
    assert cli.main(["rosnode", "lsit"]) == 64
    assert "did you mean list?" in capsys.readouterr().err


def test_in_a_terminal_it_acts_on_what_stands_after_a_plus(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["rosnode", "list", "+", "rosmini_sim/simulator"]) == 0
    assert capsys.readouterr().out == "/rosout\n/simulator\n"


# -- data ------------------------------------------------------------------------------------------------------------


def run(graph: Graph, *words: str) -> Any:
    return TOOL.run(*words, graph=graph, say=lambda _: None)


def test_the_results_are_data(graph: Graph) -> None:
    names = ("/listener", "/poser", "/rosout", "/srv_server", "/talker")
    assert run(graph, "list").names == names
    graph.node("talker", namespace="/robot1")
    assert run(graph, "list", "/robot1").names == ("/robot1/talker",)
    (about,) = run(graph, "info", "talker").nodes
    assert about.description.publications == (("/chatter", "std_msgs/String"), ("/rosout", "rosgraph_msgs/Log"))
    assert [(link.topic, link.to, link.direction) for link in about.contact.links] == [
        ("/rosout", "/rosout", "outbound"), ("/chatter", "/listener", "outbound"),
    ]  # fmt: skip
    assert run(graph, "info", "-q", "talker").nodes[0].contact is None
    assert run(graph, "ping", "talker").times == {"/talker": (0.0, 0.0, 0.0)}  # in simulated time
    assert run(graph, "machine").lines == ("rosmini",)
    assert run(graph, "machine", "rosmini").lines == tuple(sorted((*names, "/robot1/talker")))


def test_names_are_in_the_namespace_of_the_environment(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    graph.node("talker", namespace="/robot1")
    monkeypatch.setenv("ROS_NAMESPACE", "robot1")
    assert run(graph, "kill", "talker").names == ("/robot1/talker",)
    assert "/talker" in graph.nodes
    assert "/robot1/talker" not in graph.nodes


def test_a_machine_that_nobody_knows(graph: Graph) -> None:
    with pytest.raises(VerbError, match=r"cannot resolve machine name \[no host\] to address\nnodes run on rosmini"):
        run(graph, "machine", "no host")


# -- nodes that are gone ---------------------------------------------------------------------------------------------


def crash(graph: Graph, name: str) -> None:
    """The node is gone, and the Master has not heard of it."""
    node = graph.nodes[name]
    graph.transport.detach(node.uri)
    graph.remove_node(node)


def typed(*lines: str) -> Callable[[], str]:
    """What somebody types, line by line."""
    return io.StringIO("".join(f"{line}\n" for line in lines)).readline


def act(graph: Graph, verb: str, words: list[str], said: list[str], read_line: Callable[[], str]) -> Result:
    found = TOOL.find(verb)
    return found.act(found.parser().parse(words), Call(graph, said.append, said.append, read_line))


def test_cleanup_asks_in_a_terminal(graph: Graph) -> None:
    crash(graph, "/talker")
    said: list[str] = []
    assert vars(act(graph, "cleanup", [], said, typed("maybe", "n")))["names"] == ()
    assert said[-2:] == ["Please type y or n to continue:", "aborting"]
    assert "/talker" in run(graph, "list").names
    assert vars(act(graph, "cleanup", [], said, typed("y")))["names"] == ("/talker",)
    assert said[-2:] == ["Unregistering /talker", "done"]
    assert "/talker" not in run(graph, "list").names
    assert vars(act(graph, "cleanup", [], said, typed()))["names"] == ()


def test_cleanup_spares_a_node_that_is_there_again_when_the_answer_comes(graph: Graph) -> None:
    """Somebody has started it again before typing `y`: what the Master knows is the new one's."""
    crash(graph, "/talker")
    crash(graph, "/srv_server")
    said: list[str] = []

    def start_again_and_agree() -> str:
        graph.node("talker").publisher("chatter", message_class("std_msgs/String"))
        return "y\n"

    assert vars(act(graph, "cleanup", [], said, start_again_and_agree))["names"] == ("/srv_server",)
    assert "/talker answers now, and stays" in said
    assert "/talker" in run(graph, "list").names


def test_cleanup_spares_a_node_that_starts_again_while_its_old_address_is_asked(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A host that has gone takes ten seconds not to answer."""
    crash(graph, "/talker")
    gone = graph.ask_as("/test").ask("lookupNode", "/talker")
    ask, asked = graph.transport.call, []

    def slow(uri: str, method: str, *arguments: object) -> object:
        if uri == gone and method == "getPid":
            asked.append(uri)
            if len(asked) == 2:
                graph.node("talker")
        return ask(uri, method, *arguments)

    monkeypatch.setattr(graph.transport, "call", slow)
    assert run(graph, "cleanup").names == ()
    assert len(asked) == 2
    assert graph.ask_as("/test").ask("lookupNode", "/talker") == graph.nodes["/talker"].uri


def test_a_node_to_kill_is_chosen_by_its_number(graph: Graph) -> None:
    said: list[str] = []
    assert vars(act(graph, "kill", [], said, typed("0", "x", "2")))["names"] == ("/poser",)
    assert said[0].startswith("1. /listener\n2. /poser\n")
    assert len(said) == 3
    with pytest.raises(VerbError, match="no number"):
        act(graph, "kill", [], said, typed())


def test_ctrl_c_ends_pinging(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(_when: int) -> None:
        raise KeyboardInterrupt

    clock = SimpleNamespace(now_ns=graph.scheduler.now_ns, sleep_until=interrupt)
    peers: Any = SimpleNamespace(ask_as=graph.ask_as, transport=graph.transport, scheduler=clock)
    found = TOOL.find("ping")
    done = found.act(found.parser().parse(["/talker"]), Call(peers, lambda _: None, read_line=sys.stdin.readline))
    assert vars(done)["times"] == {"/talker": (0.0,)}


def test_what_is_refused(graph: Graph) -> None:
    assert_golden("rosnode", lambda line: printed(TOOL, graph, line))
