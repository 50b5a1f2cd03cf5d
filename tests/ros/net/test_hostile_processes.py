"""Processes of ours that are stopped (SIGSTOP) for a while, or killed: the others go on, and meet them again."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest

from ...interop.wire.harness import Stage

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = [pytest.mark.nightly, pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGSTOP")]

STRING = "std_msgs/String"
TRIGGER = "std_srvs/Trigger"
ANSWER = {"success": True, "message": "here I am"}


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[Stage]:
    """An empty stage."""
    with Stage(tmp_path) as found:
        yield found


def test_a_stopped_master_and_a_stopped_server_hold_nobody_for_ever(stage: Stage) -> None:
    core = stage.roscore("ours")
    server, client = stage.peer("ours", "server").ready(), stage.peer("ours", "client").ready()
    client.ask("subscribe", "/news", STRING)
    server.ask("advertise", "/news", STRING)
    server.ask("connected", "/news")
    server.ask("serve", "/ask", TRIGGER, ANSWER)
    assert client.ask("call", "/ask", TRIGGER, {}, persistent=True) == ANSWER

    core.pause()  # connections need no Master
    server.ask("publish", "/news", ["without a master"])
    assert client.ask("hear", "/news") == [{"data": "without a master"}]
    client.tell("call_now", "/ask", TRIGGER)  # a new one does: it waits, or is told why not
    core.resume()
    answer = client.answer()
    assert answer == ANSWER or "does not answer" in answer["error"]
    client.ask("forget_proxy", "/ask")

    server.pause()
    client.tell("call_now", "/ask", TRIGGER)
    server.resume()
    answer = client.answer()
    assert answer == ANSWER or "does not answer" in answer["error"]

    server.kill()
    assert "No node listens there" in client.ask("call_now", "/ask", TRIGGER)["error"]
    again = stage.peer("ours", "server").ready()
    again.ask("serve", "/ask", TRIGGER, ANSWER)
    assert client.ask("call_now", "/ask", TRIGGER) == ANSWER
    assert "Traceback" not in client.output + core.output + again.output


def test_a_killed_master_returns_at_the_same_port(stage: Stage) -> None:
    stage.roscore("ours").kill()
    core = stage.roscore("ours")
    node = stage.peer("ours", "node").ready()
    node.ask("advertise", "/news", STRING, latch=True)
    node.ask("publish", "/news", ["latched"])
    core.kill()
    node.wait_for("does not answer any more")
    stage.roscore("ours")
    stage.wait_for("/news", "publishers", "/node")
    assert node.output.count("does not answer any more") == 1
    late = stage.peer("ours", "late").ready()
    late.ask("subscribe", "/news", STRING)
    assert late.ask("hear", "/news") == [{"data": "latched"}]
