"""`rosservice` prints what the real one does, and returns data."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.verbs import VerbError
from rosmini.msgs.nav_msgs.srv import GetPlan
from rosmini.msgs.std_srvs.srv import Empty, SetBool, Trigger
from rosmini.tools.rosservice import TOOL

from .transcripts import assert_golden, masked, printed, read, talkers

REAL = read("rosservice")


def deliberate(_request: Any) -> Any:
    raise ValueError("deliberate failure")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        talkers(made)
        node = made.nodes["/srv_server"]
        node.service("/set_bool", SetBool, lambda request: (request.data, f"got {request.data}"))
        node.service("/trigger", Trigger, lambda _: (True, "triggered"))
        node.service("/srv_server/empty", Empty, lambda _: ())
        node.service("/fails", Trigger, deliberate)
        node.service("/returns_none", Trigger, lambda _: None)
        yield made


def real(line: str) -> tuple[str, int]:
    """What the real one printed, without what differs from run to run, and without Python's sign for bytes."""
    text, status = REAL[line]
    return plain(re.sub(r"b'(.*)'$", r"\1", text, flags=re.MULTILINE)), status


def plain(text: str) -> str:
    return masked(re.sub(r"rosrpc://\S+", "RPC", text))


def run(graph: Graph, *words: object) -> Any:
    return TOOL.run(*words, graph=graph, say=lambda _: None)


@pytest.mark.parametrize("line", ["rosservice type /nope", "rosservice info /nope", "rosservice call /nope"])
def test_what_there_is_to_do_comes_after_what_the_real_one_prints(graph: Graph, line: str) -> None:
    text, status = printed(TOOL, graph, line)
    assert text.startswith(real(line)[0]) and "`rosservice list`" in text and status == real(line)[1]
    assert printed(TOOL, graph, line.replace("nope", "set_bol"))[0].endswith("did you mean /set_bool?\n")


@pytest.mark.parametrize("line", ["rosservice", "rosservice -h"])
def test_the_overview(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(line.split()) == REAL[line][1]
    assert capsys.readouterr().out == REAL[line][0]


# -- data ------------------------------------------------------------------------------------------------------------


def test_the_results_are_data(graph: Graph) -> None:
    assert run(graph, "call", "/set_bool", "true").response == SetBool._response_class(True, "got True")
    assert run(graph, "call", "/set_bool", True).request.data is True
    assert set(run(graph, "find", "std_srvs/Trigger").names) == {"/fails", "/returns_none", "/trigger"}
    assert run(graph, "list", "/talker").names == ("/talker/get_loggers", "/talker/set_logger_level")
    about = run(graph, "info", "/trigger")
    assert (about.node, about.type, about.args) == ("/srv_server", "std_srvs/Trigger", "")
    assert run(graph, "find", "std_srvs/Triger").complaints == ("did you mean std_srvs/Trigger?",)
    verbose = run(graph, "call", "-v", "set_bool", "true")
    assert str(verbose) == 'data: True\n---\nsuccess: True\nmessage: "got True"'


def test_questions_take_no_time_of_the_graph_and_leave_nothing(graph: Graph) -> None:
    nodes, now = set(graph.nodes), graph.scheduler.now_ns()
    for line in ("list -n", "type /trigger", "info /trigger", "find std_srvs/Empty", "args /set_bool"):
        run(graph, *line.split())
    assert (set(graph.nodes), graph.scheduler.now_ns()) == (nodes, now)
    run(graph, "call", "/trigger")
    assert set(graph.nodes) == nodes


def test_a_header_is_stamped_where_that_is_asked_for(graph: Graph) -> None:
    heard: list[Any] = []
    graph.node("planner").service("/plan", GetPlan, lambda request: heard.append(request) or GetPlan._response_class())
    graph.run(1.0)
    run(graph, "call", "/plan", "start: {header: auto, pose: {position: {x: 1.5}}}")
    assert heard[0].start.pose.position.x == 1.5
    assert heard[0].start.header.stamp.to_nsec() == graph.scheduler.now_ns()


def test_a_type_that_is_not_known_here(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(SetBool, "_type", "far_away/SetBool")
    with pytest.raises(VerbError, match=r"Unable to load type \[far_away/SetBool\].*\n.*\n.*ROS_PACKAGE_PATH"):
        run(graph, "call", "/set_bool", "true")


def test_a_server_that_does_not_answer(graph: Graph) -> None:
    graph.ask_as("/gone").ask("registerService", "/lost", "rosrpc://127.0.0.1:9", "http://127.0.0.1:9/")
    with pytest.raises(
        VerbError, match=r"Unable to communicate with service \[/lost\].*(\n.*)*rosnode cleanup"
    ) as caught:
        run(graph, "type", "/lost")
    assert caught.value.status == 2
    assert run(graph, "find", "std_srvs/Empty").names == ("/srv_server/empty",)


def test_waiting_for_a_service_that_comes_later(graph: Graph) -> None:
    node = graph.node("late")
    node.timer(2.0, lambda _: node.service("later", Trigger, lambda _: (True, "here")), oneshot=True)
    assert run(graph, "call", "--wait", "/later").response.message == "here"


def test_what_is_refused(graph: Graph) -> None:
    assert_golden("rosservice", lambda line: printed(TOOL, graph, line))
