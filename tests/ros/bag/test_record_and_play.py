"""Recording and playing on a graph, in simulated time, and in wall time where that can differ."""

from __future__ import annotations

import errno
import hashlib
import itertools
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rosmini.core.errors import TypeMismatch
from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, BagFull, Player, Recorder, ROSBagException, reindex
from rosmini.ros.bag.index import connection
from rosmini.ros.bag.writer import Writer
from tests.core.graph.byte_transport import ByteTransport

from ...conftest import nightly
from ...core.graph.restless_master import RestlessMaster
from ...processes import PATIENCE, run, start

String = message_class("std_msgs/String")
LaserScan = message_class("sensor_msgs/LaserScan")
TFMessage = message_class("tf2_msgs/TFMessage")
TransformStamped = message_class("geometry_msgs/TransformStamped")


@pytest.fixture
def graph():
    with Graph() as graph:
        yield graph


def record(graph: Graph, path: Path, *topics: str, **fields) -> Recorder:
    fields = {"topics": topics, "output_name": str(path), "quiet": True, **fields}
    return Recorder(graph.node("record"), **fields)


def talker(graph: Graph, count: int, hz: float, name: str = "talker", topic: str = "chatter"):
    """Publishes numbers."""
    node = graph.node(name)
    publisher = node.publisher(topic, String, queue_size=None)

    def talk() -> None:
        publisher.wait_for_subscribers()
        rate = node.rate(hz)
        for i in range(count):
            publisher.publish(str(i))
            rate.sleep()

    return node.run(talk)


def texts(path: Path, topic: str = "/chatter") -> list[str]:
    return [message.data for _, message, _ in Bag(path).read_messages(topic)]


def test_nothing_is_lost_at_10_khz(graph, tmp_path):
    recorder = record(graph, tmp_path / "x", "/chatter")
    lane = talker(graph, 4_000, 10_000)
    graph.run(until=lambda: lane.idle)
    assert recorder.stop() == [tmp_path / "x.bag"]
    assert texts(tmp_path / "x.bag") == [str(i) for i in range(4_000)]
    stamps = [t.to_nsec() for _, _, t in Bag(tmp_path / "x.bag")]
    assert {after - before for before, after in itertools.pairwise(stamps)} == {100_000}
    assert recorder.dropped == 0
    assert "/record" not in graph.nodes


def test_the_connection_headers_are_those_of_the_graph(graph, tmp_path):
    recorder = record(graph, tmp_path / "x", all=True)
    lanes = [talker(graph, 3, 10, name) for name in ("one", "two")]
    graph.node("map_server").publisher("map", String, latch=True).publish("world")
    graph.run(until=lambda: all(lane.idle for lane in lanes))
    recorder.stop()
    headers = {(conn.topic, conn.caller): conn for conn in Bag(tmp_path / "x.bag").connections(["/chatter", "/map"])}
    assert set(headers) == {("/chatter", "/one"), ("/chatter", "/two"), ("/map", "/map_server")}
    assert headers["/map", "/map_server"].latching
    assert list(headers["/chatter", "/one"].header) == [
        "callerid", "latching", "md5sum", "message_definition", "topic", "type",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"all": True, "exclude": "/(rosout.*|b/.*)"}, {"/a/one", "/a/two"}),
        ({"topics": ("/a/.*",), "regex": True}, {"/a/one", "/a/two"}),
        ({"topics": ("/[ab]/.*",), "regex": True, "exclude": ".*two"}, {"/a/one", "/b/one"}),
        ({"topics": ("a/one", "/b/one")}, {"/a/one", "/b/one"}),
    ],
)
def test_which_topics(graph, tmp_path, fields, expected):
    """Those that are there, and those that come later."""
    first = graph.node("first").publisher("/a/one", String)
    recorder = record(graph, tmp_path / "x", **fields)
    graph.run(1.0)
    late = graph.node("late")
    publishers = [first, *(late.publisher(topic, String) for topic in ("/a/two", "/b/one"))]
    graph.run(1.0)
    for publisher in publishers:
        publisher.publish("x")
    graph.run(1.0)
    recorder.stop()
    assert {conn.topic for conn in Bag(recorder.path).connections()} == expected


def test_limit_size_and_duration(graph, tmp_path):
    lane = talker(graph, 1000, 100)
    limited = record(graph, tmp_path / "limited", "/chatter", limit=7)
    graph.run(0.5)
    assert limited.done
    assert texts(limited.path) == [str(i) for i in range(7)]
    timed = record(graph, tmp_path / "timed", "/chatter", duration=1.0)
    sized = Recorder(
        graph.node("sized"), topics=["/chatter"], output_name=str(tmp_path / "sized"), size=6000, quiet=True
    )
    graph.run(until=lambda: lane.idle)
    assert timed.done
    assert 99 <= len(texts(timed.path)) <= 101
    assert sized.done
    assert 6000 < Bag(sized.path).size < 15_000


@pytest.mark.parametrize("fields", [{"duration": 1.0}, {"size": 10_000}])
def test_splitting_loses_nothing_and_keeps_what_is_latched(graph, tmp_path, fields):
    graph.node("server").publisher("map", String, latch=True).publish("world")
    recorder = record(
        graph, tmp_path / "x", "/chatter", "/map", split=True, repeat_latched=True, chunksize=1000, compression="lz4",
        **fields
    )  # fmt: skip
    lane = talker(graph, 500, 100)
    graph.run(until=lambda: lane.idle)
    paths = recorder.stop()
    assert [path.name for path in paths] == [f"x_{i}.bag" for i in range(len(paths))]
    assert len(paths) > 2
    assert [text for path in paths for text in texts(path)] == [str(i) for i in range(500)]
    assert all(texts(path, "/map") == ["world"] for path in paths)
    assert list(tmp_path.glob("*.active")) == []


def test_a_buffer_that_is_too_small_says_so(graph, tmp_path, capsys):
    recorder = record(graph, tmp_path / "x", "/chatter", buffsize=20)
    publisher = graph.node("talker").publisher("chatter", String, queue_size=None)
    publisher.wait_for_subscribers()
    for i in range(10):
        publisher.publish(f"message {i}")
    graph.run(1.0)
    recorder.stop()
    assert recorder.dropped == 9
    assert texts(recorder.path) == ["message 9"]
    assert "buffer exceeded" in capsys.readouterr().err


def test_what_makes_no_sense_is_refused(graph, tmp_path):
    for fields in (
        {},
        {"all": True, "duration": -1},
        {"topics": ("(",), "regex": True},
        {"topics": ("a",), "split": True},
    ):
        with pytest.raises(ROSBagException):
            record(graph, tmp_path / "x", **fields)
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_cannot_be_opened_is_an_error_at_once(graph, tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere.*x\.bag"):
        record(graph, tmp_path / "nowhere" / "x", "/chatter")
    assert graph.nodes["/record"].subscriptions == {}


LIMITED = """
import resource, signal, sys
from rosmini.tools.main import main
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
raise SystemExit(main(["run", "rosbag/record", *sys.argv[2:], "/chatter", "+", sys.argv[1], "--duration", "20"]))
"""
TALKER = """
import sys
import rospy
from std_msgs.msg import String
rospy.init_node("talker")
publisher = rospy.Publisher("chatter", String, queue_size=10)
rate = rospy.Rate(100)
for number in range(50 + int({count})):
    publisher.publish(f"{{number:05d}} " + "x" * 1000)
    rate.sleep()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="limits of file sizes are POSIX's")
@pytest.mark.parametrize(("count", "words"), [(1000, []), *nightly((60, []), (1000, ["--split", "--size", "1"]))])
def test_a_recording_on_a_full_disk_fails_and_can_be_repaired(tmp_path, count, words):
    script = tmp_path / "talker.py"
    script.write_text(TALKER.format(count=count), encoding="utf-8")
    done = run([sys.executable, "-c", LIMITED, str(script), "-O", str(tmp_path / "trip"), *words])  # fmt: skip
    assert done.returncode == 1, done.stdout + done.stderr
    assert done.stderr.count("[ERROR]") == 1
    assert "cannot grow any more" in done.stderr
    (bag,) = tmp_path.glob("trip*")
    assert bag.suffix == ".bag"
    reindex(bag)
    found = [m.data[:5] for _, m, _ in Bag(bag)]
    assert len(found) > 20
    assert found == sorted(found)


def test_a_disk_that_fails_ends_the_recording(graph, tmp_path, monkeypatch):
    """Any error of the system, at any moment: here the fifth time that something is written."""
    recorder = record(graph, tmp_path / "x", "/chatter", chunksize=100)
    publisher = graph.node("talker").publisher("chatter", String, queue_size=None)
    graph.run(0.1)
    real, calls = Writer._put, []

    def put(self, *parts):
        calls.append(parts)
        if len(calls) == 5:
            raise OSError(errno.EIO, "Input/output error")
        real(self, *parts)

    monkeypatch.setattr(Writer, "_put", put)
    for number in range(10):
        publisher.publish("x" * 200 + str(number))
    with pytest.raises(OSError, match="Input/output error"):
        graph.run(0.5)
    assert (recorder.done, recorder.exit_status, recorder.error.errno) == (True, 1, errno.EIO)
    reindex(recorder.path)
    assert Bag(recorder.path).get_message_count() >= 4


def test_under_sim_time_messages_have_the_time_of_the_clock_topic(graph, tmp_path):
    graph.master.setParam("/test", "/use_sim_time", True)
    recorder = record(graph, tmp_path / "x", "/chatter")
    clock = graph.node("clock").publisher("/clock", graph.clock_class)
    publisher = graph.node("talker").publisher("chatter", String, queue_size=None)
    graph.run(1.0)
    clock.publish(clock=Time(5))
    graph.run(0.1)
    publisher.publish("five")
    graph.run(0.1)
    recorder.stop()
    assert [(m.data, t.to_sec()) for _, m, t in Bag(recorder.path)] == [("five", 5.0)]


# -- playing -----------------------------------------------------------------------------------------------------------


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Ten texts, one a second from 50 s on; a map that was latched at 50 s; two static transforms of two nodes."""
    path = tmp_path / "in.bag"
    with Bag(path, "w") as bag:

        def header(topic: str, cls, caller: str, latching: str) -> dict[str, str]:
            return {
                "callerid": caller, "latching": latching, "md5sum": cls._md5sum, "message_definition": cls._full_text,
                "topic": topic, "type": cls._type,
            }  # fmt: skip

        bag.write("/map", String("world"), Time(50), connection_header=header("/map", String, "/map_server", "1"))
        for caller, child in (("/one", "laser"), ("/two", "imu")):
            message = TFMessage([TransformStamped(child_frame_id=child)])
            bag.write("/tf_static", message, Time(50), connection_header=header("/tf_static", TFMessage, caller, "1"))
        for i in range(10):
            bag.write("/chatter", String(str(i)), Time(50 + i), connection_header=header("/chatter", String, "/t", "0"))
    return path


class Heard:
    """What a node hears on a topic, with the graph's time since it was made."""

    def __init__(self, graph: Graph, topic: str = "/chatter", cls=String, name: str = "listener") -> None:
        self.start = graph.now()
        self.texts: list[str] = []
        self.times: list[float] = []
        self.messages: list = []
        node = graph.node(name)

        def hear(message) -> None:
            self.messages.append(message)
            self.texts.append(getattr(message, "data", ""))
            self.times.append(round((graph.now() - self.start).to_sec(), 6))

        node.subscriber(topic, cls, hear)


def play(graph: Graph, bag, **fields) -> Player:
    return Player(graph.node("play"), bag, quiet=True, **fields)


@pytest.mark.parametrize(
    ("fields", "texts", "times"),
    [
        ({}, "0123456789", [0.2 + i for i in range(10)]),
        ({"rate": 4.0}, "0123456789", [0.2 + i / 4 for i in range(10)]),
        ({"start": 3.0, "duration": 2.5}, "345", [0.2, 1.2, 2.2]),
        ({"immediate": True, "delay": 0.0}, "0123456789", [0.0] * 10),
    ],
)
def test_when_messages_are_published(graph, bag, fields, texts, times):
    heard = Heard(graph)
    player = play(graph, bag, topics=("/chatter",), **fields)
    graph.run()
    assert "".join(heard.texts) == texts
    assert heard.times == pytest.approx(times)
    assert player.done
    assert player.played == len(texts)
    assert "/play" not in graph.nodes


def test_playing_in_wall_time(bag):
    with Graph(simulated=False) as graph:
        heard = Heard(graph)
        player = play(graph, bag, topics=("/chatter",), rate=100.0)
        graph.run(until=lambda: player.done and len(heard.texts) == 10)
        assert "".join(heard.texts) == "0123456789"
        # None comes early; how late it may come is the machine's affair.
        assert all(time > 0.2 + i / 100 - 1e-3 for i, time in enumerate(heard.times))


def test_pause_step_and_resume(graph, bag):
    heard = Heard(graph)
    player = play(graph, bag, topics=("/chatter",), pause=True)
    graph.run(5.0)
    assert heard.texts == []
    assert player.step()
    graph.run(1.0)
    assert heard.texts == ["0"]
    player.resume()
    graph.run(2.5)
    assert heard.texts == ["0", "1", "2"]
    player.pause()
    assert player.position.to_sec() == pytest.approx(52.5)
    graph.run(10.0)
    assert len(heard.texts) == 3
    player.resume()
    with pytest.raises(ROSBagException, match="pause"):
        player.step()
    graph.run()
    assert "".join(heard.texts) == "0123456789"
    assert not player.step() if player.paused else player.done


def test_loop_goes_on(graph, bag):
    heard = Heard(graph)
    player = play(graph, bag, topics=("/chatter",), loop=True, rate=10.0)
    graph.run(3.0)
    assert "".join(heard.texts).startswith("0123456789" * 2)
    assert not player.done
    player.stop()


def test_the_clock(graph, bag):
    graph.master.setParam("/test", "/use_sim_time", True)
    node = graph.node("follower")
    heard = Heard(graph, "/clock", graph.clock_class, "observer")
    play(graph, bag, topics=("/chatter",), clock=True, hz=10.0, rate=2.0)
    graph.run(2.201)
    assert node.now().to_sec() == pytest.approx(54.0, abs=0.21)
    shown = [message.clock.to_sec() for message in heard.messages]
    assert shown[:3] == pytest.approx([50.0, 50.2, 50.4])
    graph.run()
    assert node.now().to_sec() == pytest.approx(59.0)


def test_names(graph, bag):
    heard = Heard(graph, "/robot/news")
    node = graph.node("play", remappings={"/robot/chatter": "/robot/news"})
    Player(node, bag, prefix="/robot", quiet=True)
    topics = [topic for topic, _ in graph.master.getPublishedTopics("/test", "/robot")[2]]
    assert sorted(topics) == ["/robot/map", "/robot/news", "/robot/tf_static"]
    graph.run()
    assert "".join(heard.texts) == "0123456789"


def test_what_was_latched_is_latched_again(graph, bag):
    """A late subscriber gets the map, and the static transforms of both nodes."""
    player = play(graph, bag, keep_alive=True)
    graph.run()
    assert player.done
    late = Heard(graph, "/map", name="late")
    static = Heard(graph, "/tf_static", TFMessage, "late_too")
    chatter = Heard(graph, "/chatter", name="late_three")
    graph.run()
    assert late.texts == ["world"]
    assert sorted(message.transforms[0].child_frame_id for message in static.messages) == ["imu", "laser"]
    assert chatter.texts == []
    assert late.messages[0]._connection_header["latching"] == "1"
    player.stop()


def test_sequence_numbers_are_those_of_the_bag(graph, tmp_path):
    path = tmp_path / "scan.bag"
    with Bag(path, "w") as bag:
        for number in (41, 17):
            scan = LaserScan()
            scan.header.seq = number
            bag.write("/scan", scan, Time(number))
    heard = Heard(graph, "/scan", LaserScan)
    play(graph, path, rate=100.0)
    graph.run()
    assert [message.header.seq for message in heard.messages] == [17, 41]


def test_bags_are_played_as_one(graph, bag, tmp_path):
    other = tmp_path / "other.bag"
    with Bag(other, "w") as written:
        for i in range(9):
            written.write("/chatter", String("abcdefghi"[i]), Time(50 + i, 500_000_000))
    heard = Heard(graph)
    play(graph, [bag, other], topics=("/chatter",))
    graph.run()
    assert "".join(heard.texts) == "0a1b2c3d4e5f6g7h8i9"


def test_what_is_recorded_while_playing_is_what_was_played(graph, bag, tmp_path):
    recorder = record(graph, tmp_path / "again", "/chatter", "/map", "/tf_static")
    play(graph, bag)
    graph.run()
    recorder.stop()
    before = [(m.connection.topic, m.data) for m in Bag(bag).read_raw()]
    after = [(m.connection.topic, m.data) for m in Bag(recorder.path).read_raw()]
    assert sorted(after) == sorted(before)


def test_what_cannot_be_played(graph, bag, tmp_path):
    with pytest.raises(ROSBagException, match="did you mean /chatter"):
        play(graph, bag, topics=("/chater",))
    with pytest.raises(ROSBagException, match=r"start 20 s into bags of 9\.0 s"):
        play(graph, bag, start=20.0)
    with Bag(tmp_path / "empty.bag", "w"):
        pass
    with pytest.raises(ROSBagException, match="no message"):
        play(graph, tmp_path / "empty.bag")
    with pytest.raises(ROSBagException, match="rate"):
        play(graph, bag, rate=0)
    assert issubclass(BagFull, ROSBagException)


# -- types, transports, and the end by a signal ------------------------------------------------------------------------


@pytest.fixture
def changed(tmp_path: Path) -> Path:
    """A bag from a time when std_msgs/String had one more field, with a type that nobody here knows."""
    path = tmp_path / "old.bag"
    text = "string data\nint32 since\n"
    md5 = hashlib.md5(text.strip().encode()).hexdigest()
    with Bag(path, "w") as bag:
        for topic, kind in (("/mine", "my_msgs/Whole"), ("/old", "std_msgs/String")):
            header = {"type": kind, "md5sum": md5, "message_definition": text}
            bag.write_raw(bag.connect(connection(0, topic, header)), 10**9, b"\2\0\0\0hi\7\0\0\0")
    return path


def test_types_that_are_not_known_here_are_played_and_recorded(graph, changed, tmp_path):
    recorder = record(graph, tmp_path / "again", all=True, exclude="/rosout.*")
    play(graph, changed)
    graph.run()
    recorder.stop()
    fields = ("type", "md5sum", "message_definition")
    before = {conn.topic: [conn.text(name) for name in fields] for conn in Bag(changed).connections()}
    after = {conn.topic: [conn.text(name) for name in fields] for conn in Bag(recorder.path).connections()}
    assert before == after
    assert [message.since for _, message, _ in Bag(recorder.path)] == [7, 7]


def test_a_subscriber_of_a_type_that_has_changed_is_told(graph, changed):
    graph.node("listener").subscriber("old", String)
    play(graph, changed)
    with pytest.raises(TypeMismatch, match=r"/play publishes /old as std_msgs/String[\s\S]*- int32 since"):
        graph.run()


def test_over_a_transport_of_bytes_and_threads(tmp_path):
    with Graph(transports=[ByteTransport], simulated=False) as graph:
        recorder = record(graph, tmp_path / "x", "/chatter", "/map")
        graph.node("server").publisher("map", String, latch=True).publish("world")
        publisher = graph.node("talker").publisher("chatter", String, queue_size=None)
        publisher.wait_for_subscribers()
        for i in range(500):
            publisher.publish(str(i))
        graph.run(2.0, until=lambda: sum(recorder.counts.values()) == 501)
        recorder.stop()
    assert texts(recorder.path) == [str(i) for i in range(500)]
    assert texts(recorder.path, "/map") == ["world"]


@pytest.mark.skipif(sys.platform == "win32", reason="sends a signal as POSIX has it")
def test_ctrl_c_ends_a_recording_in_good_order(tmp_path):
    script = tmp_path / "talker.py"
    script.write_text(
        "import rospy\nfrom std_msgs.msg import String\nrospy.init_node('talker')\n"
        "publisher = rospy.Publisher('chatter', String, queue_size=10)\nrate = rospy.Rate(200)\nnumber = 0\n"
        "while not rospy.is_shutdown():\n    publisher.publish(str(number))\n    number += 1\n"
        "    if number == 60:\n        print('go', flush=True)\n    rate.sleep()\n",
        encoding="utf-8",
    )
    command = [
        sys.executable, "-m", "rosmini", "rosbag", "record", "-q", "-O", "x", "/chatter", "+", "talker.py",
    ]  # fmt: skip
    with start(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert "go" in process.stdout.readline()
        process.send_signal(signal.SIGINT)
        _, problems = process.communicate(timeout=PATIENCE)
    assert "Traceback" not in problems
    numbers = [int(text) for text in texts(tmp_path / "x.bag")]
    assert len(numbers) >= 50
    assert numbers == list(range(numbers[0], numbers[-1] + 1))
    assert not (tmp_path / "x.bag.active").exists()


@pytest.mark.parametrize("seed", [0, *nightly(*range(1, 5))])
def test_what_arrives_before_all_topics_are_subscribed_to_is_recorded(graph, tmp_path, seed):
    """A Master elsewhere takes its time for each of the topics."""
    RestlessMaster(graph, seed)
    topics = [f"/t{number}" for number in range(5)]

    def work() -> None:
        talker = graph.node("talker")
        for topic in topics:
            talker.publisher(topic, String, latch=True).publish(topic)
        recorder = record(graph, tmp_path / "x", *topics)
        talker.sleep(5.0)
        recorder.stop()

    lane = graph.node("main").run(work)
    graph.run(until=lambda: lane.idle)
    assert sorted(topic for topic, _, _ in Bag(tmp_path / "x.bag")) == topics
