"""Debian's rosbag and ours: each opens what the other wrote, with the same messages, times and connection headers.

Skipped where there is no rosbag, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import json
import runpy
import signal
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xmlrpc.client import ServerProxy

import pytest

from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, Player, Recorder, filter_bag, recompress, reindex
from rosmini.ros.rospy.aliases import rosbag

from ..processes import PATIENCE, run, start, wait_until
from .conftest import SYSTEM_PYTHON, need_ros, rosmaster

if TYPE_CHECKING:
    from collections.abc import Iterator

PEER = Path(__file__).with_name("rosbag_peer.py")
ENV = {"PATH": "/usr/bin:/bin", "TZ": "UTC", "HOME": "/tmp", "COLUMNS": "80"}
COMPRESSIONS = ["none", "bz2", "lz4"]


need_ros("rosbag", modules="rosbag, roslz4, sensor_msgs.msg")


def real(*words: str, status: int = 0) -> str:
    done = run(words, env=ENV)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout


def peer(*words: object) -> Any:
    out = real(SYSTEM_PYTHON, str(PEER), *map(str, words))
    return json.loads(out) if words[0] == "read" else None


def ours(path: Path) -> dict[str, Any]:
    """What `rosbag_peer.content` says, by our module."""
    import hashlib

    found = []
    with rosbag.Bag(path) as bag:
        for topic, raw, t, head in bag.read_messages(raw=True, return_connection_header=True):
            fields = {key: value.decode() for key, value in head.items()}
            found.append([topic, t.to_nsec(), hashlib.md5(raw[1]).hexdigest(), fields])
        strings = [m.data for _, m, _ in bag.read_messages(["/chatter"])]
        info = bag.get_type_and_topic_info()
        summary = [
            bag.get_message_count(), bag.get_message_count(["/scan"]), bag.get_start_time(), bag.get_end_time(),
            bag.version,
            list(bag.get_compression_info()), info.msg_types, {name: list(one) for name, one in info.topics.items()},
            str(bag), bag.size,
        ]  # fmt: skip
    return {"messages": found, "strings": strings, "summary": summary}


@pytest.fixture(scope="module")
def theirs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Bags that real rosbag wrote."""
    folder = tmp_path_factory.mktemp("theirs")
    for compression in COMPRESSIONS:
        peer("write", folder / f"{compression}.bag", compression)
    return {compression: folder / f"{compression}.bag" for compression in COMPRESSIONS}


@pytest.fixture(autouse=True)
def _utc(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("TZ", "UTC")
    time.tzset()
    yield
    monkeypatch.undo()
    time.tzset()


def test_we_read_theirs_as_they_do(theirs):
    paths = list(theirs.values())
    for path, expected in zip(paths, peer("read", *paths), strict=True):
        found = ours(path)
        assert sorted(found.pop("messages"), key=str) == sorted(expected.pop("messages"), key=str)
        assert found == expected


def test_they_read_ours_as_we_do(theirs, tmp_path):
    paths = []
    for compression in COMPRESSIONS:
        path = tmp_path / f"{compression}.bag"
        recompress(theirs["none"], path, compression)
        paths.append(path)
    filter_bag(paths[2], tmp_path / "filtered.bag", "topic != '/scan' or m.header.seq % 3 == 0")
    with Bag(tmp_path / "filtered.bag", "a") as bag:
        bag.compression = "lz4"
        for _, m, t in Bag(paths[1]).read_messages("/chatter"):
            bag.write("/more", m, t)
    paths += [tmp_path / "filtered.bag"]
    for path, expected in zip(paths, peer("read", *paths), strict=True):
        found = ours(path)
        assert sorted(found.pop("messages"), key=str) == sorted(expected.pop("messages"), key=str)
        assert found == expected
    assert [len(Bag(path).connections()) for path in paths] == [4, 4, 4, 5]


def test_info_prints_the_same(theirs, capsys):
    from rosmini.tools.main import main

    ways = [[], ["--freq"], ["-y"], ["-y", "--freq"]]
    for path, options in [*((theirs["lz4"], way) for way in ways), (theirs["none"], []), (theirs["bz2"], [])]:
        main(["rosbag", "info", *options, str(path)])
        assert capsys.readouterr().out == real("/usr/bin/rosbag", "info", *options, str(path))


def test_what_we_reindex_they_read(theirs, tmp_path):
    for compression, path in theirs.items():
        cut = tmp_path / path.name
        cut.write_bytes(path.read_bytes()[: int(path.stat().st_size * 0.7)])
        assert "unindexed" in run(["/usr/bin/rosbag", "info", cut], env=ENV).stderr  # fmt: skip
        count = reindex(cut).messages
        (read,) = peer("read", cut)
        assert len(read["messages"]) == count
        whole = [message for message in ours(path)["messages"] if message[0] == "/scan"]
        found = [message for message in read["messages"] if message[0] == "/scan"]
        assert found == whole[: len(found)]
        assert len(found) > 20, compression


def test_their_tools_work_on_ours(theirs, tmp_path):
    path = tmp_path / "ours.bag"
    recompress(theirs["bz2"], path, "lz4")
    assert real("/usr/bin/rosbag", "check", str(path)) == "Bag file does not need any migrations.\n"
    real("/usr/bin/rosbag", "filter", str(path), str(tmp_path / "f.bag"), "topic == '/chatter'")
    assert len(ours(tmp_path / "f.bag")["strings"]) == 200
    real("/usr/bin/rosbag", "decompress", "-q", str(path))
    assert ours(path)["strings"] == ours(theirs["none"])["strings"]


def test_real_record_and_play(theirs, tmp_path):
    """Their roscpp player and recorder work on our bag, and we play what they recorded."""
    source, target = tmp_path / "source.bag", tmp_path / "recorded.bag"
    filter_bag(theirs["lz4"], source, "topic in ('/chatter', '/map') and t.secs < 1050")
    with rosmaster(tmp_path) as env, ServerProxy(env["ROS_MASTER_URI"]) as proxy:

        def subscribed() -> set[str]:
            return {topic for topic, _ in proxy.getSystemState("/test")[2][1]} & {"/chatter", "/map"}

        # At its limit the recorder leaves a topic, so its Master tells when it has all 50.
        record = ["/usr/lib/rosbag/record", "--limit", 50, "-O", target, "/chatter", "/map"]
        play = [
            "/usr/lib/rosbag/play", "--rate", 100, "--delay", 1.5, "--wait-for-subscribers", "--quiet", source,
        ]  # fmt: skip
        with start(record, env=env) as recording:
            wait_until(lambda: len(subscribed()) == 2, "the recorder", recording)
            run(play, env=env, check=True)
            wait_until(lambda: subscribed() == {"/map"}, "the last message", recording)
            recording.send_signal(signal.SIGINT)
            assert recording.wait(PATIENCE) == 0
    recorded = ours(target)
    assert recorded["strings"] == [f"hello {i}" for i in range(50)]
    with Bag(target) as bag:
        latching = {conn.topic: conn.latching for conn in bag.connections()}
    assert latching == {"/chatter": False, "/map": True}
    with Graph() as graph:
        recorder = Recorder(graph.node("record"), all=True, output_name=str(tmp_path / "again"), quiet=True)
        Player(graph.node("play"), target, quiet=True)
        graph.run()
        recorder.stop()
    assert ours(recorder.path)["strings"] == recorded["strings"]


UNLIKE = {
    # they need what only the file says: how often messages came
    "types after close": ["ValueError"],
    "types after writing and close": ["ValueError"],
    # after the first reading while it writes, rosbag gives messages twice, or forgets them
    "read while writing": ["x"],
    "read one while writing": [],
    "iterate while writing": 1,
    "count of while writing": 1,
    "compression info while writing": ["none", 218, 218],
    # rosbag reads on until some bytes are no text
    "a stream of text": ["ROSBagException"],
}


def test_what_they_raise_we_raise(tmp_path):
    """An ``except`` for real rosbag catches ours: wrong modes, wrong and missing files, uses after close."""
    for folder in ("theirs", "ours"):
        (tmp_path / folder).mkdir()
    script = Path(__file__).with_name("rosbag_errors_peer.py")
    outcomes = runpy.run_path(str(script))["outcomes"]
    expected = json.loads(real(SYSTEM_PYTHON, str(script), str(tmp_path / "theirs")))
    found = outcomes(rosbag, message_class("std_msgs/String"), Time, tmp_path / "ours")
    assert list(found) == list(expected)
    for name, answer in expected.items():
        wanted = UNLIKE.get(name, answer)
        raised = isinstance(wanted, list) and any(str(word).endswith(("Error", "Exception")) for word in wanted)
        same = set(wanted) <= set(found[name]) if raised and isinstance(found[name], list) else found[name] == wanted
        assert same, f"{name}: they {answer}, we {found[name]}"
