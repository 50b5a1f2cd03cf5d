"""`rossequence` and its options."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rosmini import Graph
from rosmini.core.errors import UsageError
from rosmini.core.verbs import VerbError
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools.rossequence import TOOL


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        made.record()
        made.node("listener").subscriber("chatter", String, lambda _: None)
        talker = made.node("talker")
        publisher = talker.publisher("chatter", String)
        talker.timer(1, lambda _: publisher.publish("tick"))
        made.run(3.5)
        yield made


def arrows(graph: Graph, *words: str) -> list[str]:
    return TOOL.run(*words, graph=graph).view.text.splitlines()


def test_it_draws_what_happened(graph: Graph, tmp_path: Path) -> None:
    lines = arrows(graph, "chatter", "--title", "Figure 1")
    assert lines[0].startswith("Figure 1: 8 calls")
    assert lines[-1] == "  /talker -> /listener: /chatter: 'tick'"
    assert arrows(graph, "-n", "2", "/chatter")[0].startswith(
        "What happened about /chatter (and 6 more calls after these): 2 calls"
    )
    result = TOOL.run("/chatter", "-o", str(tmp_path / "it.svg"), graph=graph)
    assert result.path == tmp_path / "it.svg"


def test_a_span_of_time(graph: Graph) -> None:
    assert arrows(graph, "--last", "1", "/chatter")[1:] == ["  /talker -> /listener: /chatter: 'tick'"]
    assert len(arrows(graph, "--since", "1001.5", "/chatter")) == 3
    assert len(arrows(graph, "--all")) > len(arrows(graph, "-n", "40"))


def test_wrong_words(graph: Graph) -> None:
    with pytest.raises(UsageError):
        TOOL.run("-n", "0", graph=graph)
    with Graph() as other, pytest.raises(VerbError, match=r"graph\.record"):
        TOOL.run("/chatter", graph=other)
