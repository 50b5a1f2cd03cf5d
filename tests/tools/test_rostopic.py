"""`rostopic` prints what the real one does, and returns data."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.verbs import VerbError
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools.rostopic import TOOL

from ..processes import free_port
from ..processes import run as process
from .transcripts import assert_golden, printed, read, talkers

REAL = read("rostopic")


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        talkers(made)
        yield made


def run(graph: Graph, *words: object) -> Any:
    return TOOL.run(*words, graph=graph, say=lambda _: None)


@pytest.mark.parametrize("line", ["rostopic info /nope", "rostopic type /nope"])
def test_what_there_is_to_do_comes_after_what_the_real_one_prints(graph: Graph, line: str) -> None:
    text, status = printed(TOOL, graph, line)
    assert status == REAL[line][1]
    assert text.startswith(REAL[line][0]) and "`rostopic list`" in text
    assert printed(TOOL, graph, line.replace("nope", "chater"))[0].endswith("did you mean /chatter?\n")


@pytest.mark.parametrize("line", ["rostopic", "rostopic bogus", "rostopic -h"])
def test_the_overview(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    status = cli.main(line.split())
    assert (capsys.readouterr().out, status) == REAL[line]


ABSENT = {"-b", "--bag", "-a", "--all", "--host", "-f", "--file", "--tcpnodelay"}
"""Options of the real tool that this one has not: those on bags, hosts, files and sockets."""


def test_each_verb_has_the_options_of_the_real_one_and_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    for verb in TOOL.verbs:
        assert cli.main(["rostopic", verb, "-h"]) == 0
        said = capsys.readouterr().out
        assert f"Example:\n  rosmini rostopic {verb}" in said
        real = REAL.get(f"rostopic {verb} -h", ("", 0))[0]
        assert said.startswith(real.partition("\n")[0])
        options = [words.split("=")[0] for words in real.replace(",", " ").split() if words.startswith("-")]
        assert {option for option in options if option not in said} <= {"-h", "--help", *ABSENT}


# -- data ------------------------------------------------------------------------------------------------------------


def test_the_results_are_data(graph: Graph) -> None:
    graph.node("other", namespace="/robot1").publisher("chatter", String)
    assert run(graph, "list", "/robot1").names == ("/robot1/chatter",)
    info = run(graph, "info", "chatter")
    assert (info.type, list(info.publishers), list(info.subscribers)) == (
        "std_msgs/String", ["/talker"], ["/listener"],
    )  # fmt: skip
    assert run(graph, "info", "/pose").subscribers == {}
    assert "Subscribers: None" in str(run(graph, "info", "/pose"))
    assert run(graph, "type", "/odom/pose/pose/position/x").field_type == "float64"
    assert run(graph, "type", "/odom/header/stamp/secs").field_type == "int32"
    assert run(graph, "find", "std_msgs/String").names == ("/chatter", "/robot1/chatter")
    assert run(graph, "find", "std_msgs/Strin").complaints == ("did you mean std_msgs/String?",)


def test_a_field_that_messages_do_not_have(graph: Graph) -> None:
    with pytest.raises(VerbError, match="messages on /scan are sensor_msgs/LaserScan and have no rangs; did you mean"):
        run(graph, "type", "/scan/rangs")


def test_a_tool_that_only_asks_starts_without_a_graph() -> None:
    code = (
        "import sys, rosmini.tools.main as m\n"
        "m.main(['rostopic', 'list'])\n"
        "print([name for name in ('numpy', 'rosmini.core.graph', 'rosmini.msgs', 'asyncio') if name in sys.modules])\n"
    )
    env = os.environ | {"ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"}
    assert process([sys.executable, "-c", code], env=env).stdout == "[]\n"


def test_info_counts_the_messages_that_queues_have_dropped(graph: Graph) -> None:
    node = graph.node("slow")
    node.subscriber("burst", String, lambda _: node.sleep(1.0), queue_size=1)
    publisher = graph.node("quick").publisher("burst", String)
    publisher.wait_for_subscribers()
    for number in range(10):
        publisher.publish(str(number))
    graph.run(5.0)
    found = run(graph, "info", "-v", "/burst")
    assert [(flow.subscriber, flow.side, flow.dropped) for flow in found.about.flows] == [
        ("/slow", "publisher", 0),
        ("/slow", "subscriber", 8),
    ]
    assert "/quick -> /slow (/burst): 8 dropped" in str(found)
    assert "ropped" not in str(run(graph, "info", "/burst"))


def test_what_is_refused(graph: Graph) -> None:
    assert_golden("rostopic", lambda line: printed(TOOL, graph, line))
