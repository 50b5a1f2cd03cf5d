"""`roswhy` and its options."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import rosmini.tools.main as cli
from rosmini import Graph
from rosmini.core.errors import UsageError
from rosmini.core.verbs import VerbError
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools.roswhy import TOOL


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        yield made


def test_it_tells_and_draws(graph: Graph, tmp_path: Path) -> None:
    graph.record()
    talker = graph.node("talker").publisher("chatter", String, latch=True)
    for word in ("one", "two"):
        talker.publish(word)
    result = TOOL.run("-n", "2", "chatter", "--title", "Figure 1", graph=graph)
    for why, number, word in zip(result.found, (1, 2), ("one", "two"), strict=True):
        told = why.steps[0].what
        assert f"/talker published message {number} on /chatter" in told and repr(word) in told
    data, _ = result._repr_mimebundle_()
    assert data["text/plain"] == str(result)
    assert "Figure 1" in data["text/html"]
    saved = TOOL.run("chatter", "-o", str(tmp_path / "why.svg"), graph=graph)
    assert saved.path.read_text(encoding="utf-8").startswith("<svg")


def test_a_graph_that_does_not_record_says_so_or_records_first(graph: Graph) -> None:
    talker = graph.node("talker")
    publisher = talker.publisher("chatter", String, latch=True)
    with pytest.raises(VerbError, match="--duration"):
        TOOL.run("/chatter", graph=graph)
    talker.timer(0.2, lambda _: publisher.publish("tick"))
    result = TOOL.run("/chatter", "--duration", "1.1", graph=graph)
    assert "message 5 on /chatter: 'tick'" in str(result)
    assert graph.recorded is None


@pytest.mark.parametrize("words", [("-n", "1"), ("/a", "/b"), ("/a", "-n", "0"), ("/a", "--depth", "-1")])
def test_words_that_make_no_sense(graph: Graph, words: tuple[str, ...]) -> None:
    graph.record()
    with pytest.raises(UsageError):
        TOOL.run(*words, graph=graph)


def test_in_a_terminal_it_acts_on_what_stands_after_the_plus(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["roswhy", "/nothing", "--duration", "0.5", "+", "rosmini_sim/simulator"]) != 0
    assert "nothing was published on /nothing" in capsys.readouterr().err
