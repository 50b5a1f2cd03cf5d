"""Processes that die, stop and come back: Masters, publishers, subscribers, servers; ours and real ones, in turn."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

import pytest

from ...conftest import nightly
from ...processes import run, wait_until
from .hosts import LOOPBACK, lone_host

if TYPE_CHECKING:
    from .harness import Peer, Stage

pytestmark = pytest.mark.ros

Peers = tuple["Peer", "Peer"]
STRING = "std_msgs/String"
INFO = "sensor_msgs/SetCameraInfo"
ANSWER = {"success": True, "status_message": "set"}
OTHER = {"ours": "real", "real": "ours"}
KINDS = pytest.mark.parametrize("kind", ["real", *nightly("ours")])
"""Which of the two dies or stops; the other one is seen to go on."""


@pytest.fixture
def partners(pair: Peers) -> dict[str, Peer]:
    """The two nodes that are there all the time, by their kind."""
    return {"ours": pair[0], "real": pair[1]}


@pytest.mark.nightly
def test_two_nodes_of_one_name(core: Stage) -> None:
    """The Master has the older one shut down, with the reason."""
    older = core.peer("ours", "twin").ready()
    for kind in ("real", "ours", "ours"):
        newer = core.peer(kind, "twin").ready()
        older.wait_for("new node registered with same name")
        older.process.stdin.close()
        assert older.ended() == 0
        assert core.master("lookupNode", "/twin") == newer.uri
        newer.ask("subscribe", "/twin_topic", STRING)
        core.wait_for("/twin_topic", "subscribers", "/twin")
        older = newer
    older.interrupt()
    wait_until(lambda: "/twin" not in core.nodes(), "the end of /twin")


@KINDS
def test_a_publisher_is_killed_and_returns(core: Stage, partners: dict[str, Peer], kind: str) -> None:
    topic = f"/news_{kind}"
    reader = partners[OTHER[kind]]
    reader.ask("subscribe", topic, STRING)
    for text in ("first", "second"):
        writer = core.peer(kind, f"writer_{kind}").ready()
        writer.ask("advertise", topic, STRING, latch=True)
        writer.ask("publish", topic, [text])
        assert reader.ask("hear", topic) == [{"data": text}]
        writer.kill()
    core.wait_for(topic, "publishers", writer.node)  # it did not take leave
    writer = core.peer(OTHER[kind], f"writer_{kind}").ready()
    writer.ask("advertise", topic, STRING, latch=True)
    writer.ask("publish", topic, ["third"])
    assert reader.ask("hear", topic) == [{"data": "third"}]
    writer.interrupt()


@KINDS
def test_a_subscriber_is_killed_and_returns(core: Stage, partners: dict[str, Peer], kind: str) -> None:
    topic = f"/news_of_{kind}"
    writer = partners[OTHER[kind]]
    writer.ask("advertise", topic, STRING)
    for text in ("first", "second"):
        reader = core.peer(kind, f"sink_{kind}").ready()
        reader.ask("subscribe", topic, STRING)
        writer.ask("connected", topic, 1)
        writer.ask("publish", topic, [text])
        assert reader.ask("hear", topic) == [{"data": text}]
        reader.kill()
        writer.ask("publish_until_alone", topic)


@KINDS
def test_a_server_is_killed_and_returns(core: Stage, partners: dict[str, Peer], kind: str) -> None:
    service = f"/mend_{kind}"
    client = partners[OTHER[kind]]
    for _ in range(2):
        server = core.peer(kind, f"server_{kind}").ready()
        server.ask("serve", service, INFO, ANSWER)
        assert client.ask("call", service, INFO, {}) == ANSWER
        assert client.ask("call", service, INFO, {}, persistent=True) == ANSWER
        server.kill()
        gone = client.ask("call_now", service, INFO)
        assert "error" in gone, gone
        client.ask("forget_proxy", service)


@KINDS
def test_a_stopped_subscriber_does_not_block_the_publisher(core: Stage, partners: dict[str, Peer], kind: str) -> None:
    """What does not go through is dropped, the oldest first; who still listens gets all of it."""
    topic = f"/flood_{kind}"
    writer, awake = partners[OTHER[kind]], partners[kind]
    stopped = core.peer(kind, f"stopped_{kind}").ready()
    writer.ask("advertise", topic, STRING, queue_size=5)  # first: rospy has no queue for who connects meanwhile
    for reader in (stopped, awake):
        reader.ask("subscribe", topic, STRING, what="size")
    writer.ask("connected", topic, 2)
    stopped.pause()
    for _ in range(30):  # 12 MB: more than the system keeps for a connection
        writer.ask("flood", topic, 400_000, 1)
        assert awake.ask("hear", topic) == [[400_000, 1]]
    stopped.resume()
    heard = stopped.ask("hear", topic)
    assert heard[0] == [400_000, 1]
    writer.ask("flood", topic, 7, 1)
    while heard[-1] != [7, 1]:
        heard += stopped.ask("hear", topic)
    assert len(heard) <= 31
    stopped.interrupt()


@KINDS
def test_a_stopped_publisher_does_not_hang_its_subscribers(core: Stage, partners: dict[str, Peer], kind: str) -> None:
    """A node that stands answers nobody: the others go on, and connect to it when it wakes."""
    asleep = core.peer(kind, f"asleep_{kind}").ready()
    other = partners[OTHER[kind]]
    third = partners["ours"] if kind == "ours" else core.peer("ours", "third").ready()
    asleep.ask("advertise", f"/from_asleep_{kind}", STRING, latch=True)
    asleep.ask("publish", f"/from_asleep_{kind}", ["good morning"])
    asleep.pause()
    for peer in (other, third):
        peer.ask("subscribe", f"/from_asleep_{kind}", STRING)
    other.ask("advertise", f"/from_busy_{kind}", STRING, latch=True)
    other.ask("publish", f"/from_busy_{kind}", ["hello"])
    third.ask("subscribe", f"/from_busy_{kind}", STRING)
    assert third.ask("hear", f"/from_busy_{kind}") == [{"data": "hello"}]
    asleep.resume()
    for peer in (other, third):
        assert peer.ask("hear", f"/from_asleep_{kind}") == [{"data": "good morning"}]
    for peer in {asleep, third} - {partners["ours"]}:
        peer.interrupt()


def test_a_stopped_node_does_not_hang_the_master(core: Stage, partners: dict[str, Peer]) -> None:
    """Its notices wait for it; the other nodes' do not."""
    asleep, reader = core.peer("real", "real_hears").ready(), partners["ours"]
    for peer in (asleep, reader):
        peer.ask("subscribe", "/notices", STRING)
    asleep.pause()
    writer = core.peer("ours", "notice").ready()
    writer.ask("advertise", "/notices", STRING, latch=True)
    writer.ask("publish", "/notices", ["now"])
    assert reader.ask("hear", "/notices") == [{"data": "now"}]
    asleep.resume()
    assert asleep.ask("hear", "/notices") == [{"data": "now"}]
    for peer in (asleep, writer):
        peer.interrupt()


@KINDS
def test_a_master_dies_and_returns(stage: Stage, kind: str) -> None:
    """Connections go on without it; our nodes say so once and register again at the one that returns."""
    master = stage.roscore(kind, "--core")
    writer, reader = stage.peer("ours", "writer").ready(), stage.peer("ours", "reader").ready()
    reader.ask("subscribe", "/news", STRING)
    writer.ask("advertise", "/news", STRING)
    writer.ask("serve", "/mend", INFO, ANSWER)
    writer.ask("connected", "/news")
    master.kill()
    for child in stage.survivors():
        if child not in {writer.process.pid, reader.process.pid}:
            stage.kill(child)
    writer.ask("publish", "/news", ["without a master"])
    assert reader.ask("hear", "/news") == [{"data": "without a master"}]
    stage.roscore(OTHER[kind], "--core")
    stage.wait_for("/news", "publishers", "/writer")
    stage.wait_for("/news", "subscribers", "/reader")
    stage.wait_for("/mend", "services", "/writer")
    late = stage.peer("real", "late").ready()
    late.ask("subscribe", "/news", STRING)
    writer.ask("connected", "/news", 2)
    writer.ask("publish", "/news", ["again"])
    for peer in (reader, late):
        assert peer.ask("hear", "/news") == [{"data": "again"}]
    assert late.ask("call", "/mend", INFO, {}) == ANSWER


@pytest.mark.nightly
def test_the_network_goes_down_and_up(stage: Stage) -> None:
    """What was published meanwhile arrives, our nodes say what happened, and no thread or descriptor is left of it.

    Where the system refuses namespaces it is the Master that is out of reach: it stands.
    """
    with lone_host() as host:
        within = [] if host is None else host.within
        core = stage.roscore("ours", "--core", within=within)
        peers = [stage.peer("ours", name, within=within).ready() for name in ("reader", "writer")]
        reader, writer = peers
        reader.ask("subscribe", "/news", STRING)
        writer.ask("advertise", "/news", STRING)
        writer.ask("serve", "/mend", INFO, ANSWER)
        writer.ask("connected", "/news")
        assert reader.ask("call", "/mend", INFO, {}, persistent=True) == ANSWER
        assert reader.ask("call_now", "/mend", INFO) == ANSWER
        before = [(peer.threads(), peer.descriptors()) for peer in peers]
        if host is None:
            core.pause()
        else:
            run([*within, *LOOPBACK, "down"], check=True)
        for peer in peers:
            peer.wait_for(r"\[WARN\].* the Master at .* does not answer any more: ")
        writer.ask("publish", "/news", ["in the dark"])
        if host is None:
            core.resume()
        else:
            run([*within, *LOOPBACK, "up"], check=True)
        for peer in peers:
            peer.wait_for(rf"\[WARN\].* the Master at .* is back: {peer.node} registers again")
        assert reader.ask("hear", "/news") == [{"data": "in the dark"}]
        writer.ask("publish", "/news", ["and light"])
        assert reader.ask("hear", "/news") == [{"data": "and light"}]
        assert reader.ask("call", "/mend", INFO, {}, persistent=True) == ANSWER
        assert reader.ask("call_now", "/mend", INFO) == ANSWER
        wait_until(
            lambda: [(peer.threads(), peer.descriptors()) for peer in peers] == before,
            "as many threads and descriptors as before",
        )


def test_a_second_roscore_is_refused(core: Stage) -> None:
    for kind in ("ours", "real"):
        second = core.second_roscore(kind)
        assert second.ended() == 1
        assert core.uri.rstrip("/") in second.output
    assert core.answers()


def test_ctrl_c_ends_roscore_and_nodes_and_leaves_nothing(stage: Stage) -> None:
    core = stage.roscore("ours")
    peer = stage.peer("ours", "node").ready()
    peer.ask("advertise", "/news", STRING)
    assert peer.interrupt() in {0, 130, -signal.SIGINT}
    wait_until(lambda: "/node" not in stage.nodes(), "unregistering")
    assert core.interrupt() in {0, 130, -signal.SIGINT}
    wait_until(lambda: not stage.survivors(), "the end of all")
    assert "Traceback" not in core.output + peer.output, core.tail + peer.tail
