"""What a graph has recorded, for the tools."""

from __future__ import annotations

import pytest

from rosmini import Graph
from rosmini.core.verbs import Call, VerbError
from rosmini.msgs.std_msgs.msg import String
from rosmini.tools.recorded import recorded


def test_it_is_everything_from_the_first_event_on() -> None:
    with Graph() as graph:
        with pytest.raises(VerbError):
            recorded(Call(graph), None)
        graph.record()
        graph.node("talker").publisher("chatter", String)
        before = graph.now()
        assert recorded(Call(graph), None).calls("/chatter") == [
            ("/talker", "Master", "registerPublisher(/chatter, std_msgs/String)", "[]")
        ]
        assert graph.now() == before


def test_recording_first_lets_time_pass_and_ends() -> None:
    with Graph() as graph:
        talker = graph.node("talker")
        talker.timer(0.1, lambda _: talker.set_param("/x", 1))
        assert len(recorded(Call(graph), 0.55).calls("/x")) == 5
        assert graph.recorded is None
