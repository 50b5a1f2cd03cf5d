"""Bags written and read: the format, damage, full disks, and rosbags as the second opinion."""

from __future__ import annotations

import io
import re
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import (
    Bag,
    FilterError,
    ROSBagEncryptNotSupportedException,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
    changed_types,
    filter_bag,
    recompress,
    reindex,
)
from rosmini.ros.bag.index import connection
from rosmini.ros.bag.info import info_text, info_yaml
from rosmini.ros.bag.records import MAGIC, OP_BAG_HEADER, pack_record, u32, u64

from ...processes import run

String = message_class("std_msgs/String")
LaserScan = message_class("sensor_msgs/LaserScan")
Odometry = message_class("nav_msgs/Odometry")
HEADER = {
    "callerid": "/talker",
    "latching": "1",
    "md5sum": String._md5sum,
    "message_definition": String._full_text,
    "topic": "/chatter",
    "type": "std_msgs/String",
    "extra": "kept",
}


def fill(bag: Bag, count: int = 100) -> None:
    """Texts at 10 Hz and a scan each second, from 100 s on."""
    for i in range(count):
        time = Time(100 + i // 10, i % 10 * 100_000_000)
        bag.write("/chatter", String(f"hello {i}"), time)
        if i % 10 == 0:
            bag.write("/scan", LaserScan(ranges=[float(i)] * 4, range_max=3.5), time)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "test.bag"


@pytest.mark.parametrize("compression", ["none", "lz4"])
def test_large_messages(tmp_path: Path, compression: str) -> None:
    """They are neither copied into a chunk nor out of one.

    Several in a chunk, between small ones, and in turn with others.
    """
    path = tmp_path / "large.bag"
    image = message_class("sensor_msgs/Image")
    written = []
    with Bag(path, "w", compression=compression, chunk_threshold=700_000) as bag:
        for number in range(20):
            topic = f"/camera{number % 3}"
            bag.write("/chatter", String(f"{number}"), Time(number, 0))
            bag.write(topic, image(data=bytes([number]) * (number % 4 * 100_000)), Time(number, 5))
            written += [("/chatter", b"%d" % number), (topic, bytes([number]) * (number % 4 * 100_000))]
    read: list[tuple[str, bytes]] = []
    with Bag(path, numpy=False) as bag:
        for topic, message, _ in bag:
            read.append((topic, message.data.encode() if topic == "/chatter" else message.data))
    assert read == written
    script = (
        "import sys, rosbags.rosbag1 as r\nprint(sum(len(m[2]) for m in r.Reader(sys.argv[1]).__enter__().messages()))"
    )
    done = run([sys.executable, "-c", script, str(path)])
    with Bag(path) as bag:
        assert int(done.stdout) == sum(len(raw.data) for raw in bag.read_raw())


def test_damage_within_a_chunk_of_large_messages(tmp_path: Path) -> None:
    path = tmp_path / "large.bag"
    with Bag(path, "w") as bag:
        for number in range(2):
            bag.write("/camera", message_class("sensor_msgs/Image")(data=b"x" * 300_000), Time(number, 5))
    content = path.read_bytes()
    second = content.index(b"op=\x02", content.index(b"op=\x02") + 1)
    path.write_bytes(content.replace(content[second : second + 4], b"op=\x07"))
    with Bag(path) as bag, pytest.raises(ROSBagException, match=r"large\.bag.*damaged"):
        list(bag)


def texts(bag: Bag) -> list[str]:
    return [message.data for _, message, _ in bag.read_messages("/chatter")]


times = st.integers(0, 2**32 * 10**9 - 1)
recorded = st.lists(
    st.tuples(st.sampled_from(["/a", "/b", "/c"]), times, st.text(max_size=40)), min_size=1, max_size=40
)


@given(recorded, st.sampled_from(["none", "bz2", "lz4"]), st.integers(0, 400))
def test_what_is_written_is_read_in_the_order_of_time(messages, compression, threshold):
    file = io.BytesIO()
    with Bag(file, "w", compression, threshold) as bag:
        for topic, time, text in messages:
            bag.write(topic, String(text), Time.from_nsec(time))
    found = [(topic, t.to_nsec(), m.data) for topic, m, t in Bag(file)]
    assert found == sorted(messages, key=lambda message: message[1])
    assert Bag(file).get_message_count() == len(messages)


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_rosbags_reads_ours(path, compression):
    from rosbags.rosbag1 import Reader

    with Bag(path, "w", compression, 500) as bag:
        fill(bag)
    with Reader(path) as reader:
        theirs = [(conn.topic, time, bytes(data)) for conn, time, data in reader.messages()]
    ours = [(message.connection.topic, message.time, message.data) for message in Bag(path).read_raw()]
    assert sorted(theirs) == sorted(ours)
    assert len(ours) == 110


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_we_read_those_of_rosbags(path, compression):
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    writer = Writer(path)
    if compression != "none":
        writer.set_compression(getattr(Writer.CompressionFormat, compression.upper()))
    with writer:
        conn = writer.add_connection("/chatter", "std_msgs/msg/String", typestore=store, callerid="/x", latching=1)
        for i in range(10):
            writer.write(conn, 10**9 * i, String._encode(String(str(i))))
    with Bag(path) as bag:
        assert texts(bag) == [str(i) for i in range(10)]
        assert bag.message_class("/chatter") is String
        (found,) = bag.connections()
        assert (found.caller, found.latching) == ("/x", True)


def test_connection_headers_are_kept_to_the_byte(path, tmp_path):
    with Bag(path, "w") as bag:
        bag.write("/chatter", String("a"), Time(1), connection_header=HEADER)
        bag.write("/chatter", String("b"), Time(2), connection_header={**HEADER, "callerid": "/other"})
        bag.write("/chatter", String("c"), Time(3), connection_header=HEADER)
    copies = [path]
    for name, tool in (("lz4", recompress), ("bz2", recompress)):
        tool(copies[-1], tmp_path / name, name)
        copies.append(tmp_path / name)
    filter_bag(copies[-1], tmp_path / "f", "True")
    raws = [[conn.raw for conn in Bag(copy).connections()] for copy in (*copies, tmp_path / "f")]
    assert all(raw == raws[0] for raw in raws)
    assert b"extra=kept" in raws[0][0]
    headers = [header["callerid"] for *_, header in Bag(path).read_messages(return_connection_header=True)]
    assert headers == [b"/talker", b"/other", b"/talker"]


def test_topics_times_and_filters(path):
    with Bag(path, "w", chunk_threshold=300) as bag:
        fill(bag)
    with Bag(path) as bag:
        assert {topic for topic, _, _ in bag.read_messages(topics=["/scan"])} == {"/scan"}
        some = list(bag.read_messages("/chatter", start_time=Time(103), end_time=Time(104)))
        assert [m.data for _, m, _ in some] == [f"hello {i}" for i in range(30, 41)]
        chosen = bag.read_messages(connection_filter=lambda topic, kind, md5, text, header: kind == LaserScan._type)
        assert sum(1 for _ in chosen) == 10
        assert bag.get_message_count(["/scan", "/chatter"]) == 110
        assert (bag.get_start_time(), bag.get_end_time()) == (100.0, 109.9)
        types, topics = bag.get_type_and_topic_info()
        assert types["std_msgs/String"] == String._md5sum
        assert topics["/chatter"][:3] == ("std_msgs/String", 100, 1)
        assert topics["/chatter"].frequency == pytest.approx(10.0)
        with pytest.raises(ROSBagException, match="did you mean /chatter"):
            bag.message_class("/chater")
    with pytest.raises(ValueError, match="closed"):
        list(bag)


def test_a_bag_can_be_read_while_it_is_written_and_appended_to(path):
    with Bag(path, "w") as bag:
        fill(bag, 10)
        assert len(texts(bag)) == 10
        bag.write("/chatter", String("late"), Time(200))
        assert texts(bag)[-1] == "late"
    with Bag(path, "a") as bag:
        assert len(texts(bag)) == 11
        bag.write("/chatter", String("appended"), Time(300))
        bag.write("/new", String("x"), Time(301))
    with Bag(path) as bag:
        assert texts(bag)[-2:] == ["late", "appended"]
        assert [conn.topic for conn in bag.connections()] == ["/chatter", "/scan", "/new"]
    with Bag(path.with_name("other.bag"), "a") as bag:
        fill(bag, 1)
    assert Bag(path.with_name("other.bag")).get_message_count() == 2


def test_numbers_are_arrays_or_tuples(path):
    with Bag(path, "w") as bag:
        fill(bag, 1)
    _, scan, _ = next(Bag(path).read_messages("/scan"))
    assert isinstance(scan.ranges, np.ndarray)
    _, scan, _ = next(Bag(path, numpy=False).read_messages("/scan"))
    assert scan.ranges == (0.0,) * 4
    _, (kind, data, md5, position, cls), _ = next(Bag(path).read_messages("/scan", raw=True))
    assert (kind, md5, cls) == (LaserScan._type, LaserScan._md5sum, LaserScan)
    assert len(position) == 2
    with Bag(path.with_name("copy.bag"), "w") as copy:
        copy.write("/scan", (kind, data, md5, position, cls), Time(1), raw=True)
    assert next(iter(Bag(path.with_name("copy.bag"), numpy=False))).message == scan


# -- damage ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_a_truncated_bag_gives_all_that_is_whole(path, compression):
    """Cut at many places: every chunk before the cut is saved, and of an uncompressed one every message before it."""
    with Bag(path, "w", compression, 600) as bag:
        fill(bag)
    whole = path.read_bytes()
    order = [(m.connection.topic, m.time, m.data) for m in Bag(path).read_raw()]
    ends = [chunk.data_position + chunk.compressed for chunk in Bag(path).index.chunks]
    counts = np.cumsum([chunk.messages for chunk in Bag(path).index.chunks])
    for cut in range(len(MAGIC) + 4104, len(whole), 173):
        path.write_bytes(whole[:cut])
        with pytest.raises(ROSBagUnindexedException, match="reindex"):
            Bag(path)
        with Bag(path, allow_unindexed=True) as bag:
            read = [(m.connection.topic, m.time, m.data) for m in bag.read_raw()]
        assert path.read_bytes() == whole[:cut], "reading changed the file"
        result = reindex(path)
        found = [(m.connection.topic, m.time, m.data) for m in Bag(path).read_raw()]
        assert found == read == order[: len(found)]
        assert result.messages == len(found)
        least = max((count for count, end in zip(counts, ends, strict=True) if end <= cut), default=0)
        assert len(found) >= least
        for message in found[-1:]:
            if compression == "none":
                assert whole[:cut].rfind(message[2]) >= 0
    assert len(found) == 110


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
@pytest.mark.parametrize("where", ["chunk", "index data"])
def test_what_follows_damage_is_saved(path, compression, where):
    """Bytes in the middle are gone, as on a bad disk: what stands behind them is found again."""
    with Bag(path, "w", compression, 600) as bag:
        fill(bag)
    whole, chunks = path.read_bytes(), Bag(path).index.chunks
    order = [(m.connection.topic, m.time, m.data) for m in Bag(path).read_raw()]
    assert len(chunks) > 8
    for number in (2, 5):
        chunk = chunks[number]
        at = chunk.position if where == "chunk" else chunk.data_position + chunk.compressed
        index_position = whole.index(b"index_pos=") + 10
        path.write_bytes(
            whole[:index_position] + bytes(8) + whole[index_position + 8 : at] + b"\xff" * 12 + whole[at + 12 :]
        )
        result = reindex(path)
        found = [(m.connection.topic, m.time, m.data) for m in Bag(path).read_raw()]
        before = sum(each.messages for each in chunks[:number])
        lost = chunk.messages if where == "chunk" else 0
        assert found == order[:before] + order[before + lost :]
        assert result.messages == len(found)
        with Bag(path) as bag:
            assert bag.get_message_count() == len(found)


def test_a_recording_that_was_killed_is_saved(path):
    """What real ROS leaves: a chunk whose lengths were never filled in, without an index."""
    with Bag(path, "w") as bag:
        fill(bag, 10)
    (chunk,) = Bag(path).index.chunks
    data = bytearray(path.read_bytes()[: chunk.data_position + chunk.compressed])
    at = len(MAGIC) + 8
    data[at : at + 4096] = data[at : at + 4096].replace(
        b"index_pos=" + bytes(data[data.index(b"index_pos=") + 10 :][:8]), b"index_pos=" + bytes(8)
    )
    size = data.index(b"size=", chunk.position) + 5
    data[size : size + 4] = bytes(4)
    data[chunk.data_position - 4 : chunk.data_position] = bytes(4)
    path.write_bytes(data)
    assert reindex(path).messages == 11
    assert texts(Bag(path)) == [f"hello {i}" for i in range(10)]


def test_damage_is_told(path):
    with Bag(path, "w", "bz2") as bag:
        fill(bag, 10)
    data = bytearray(path.read_bytes())
    (chunk,) = Bag(path).index.chunks
    data[chunk.data_position + 20] ^= 0xFF
    path.write_bytes(data)
    with pytest.raises(ROSBagFormatException, match=r"bz2 chunk at byte 4117 does not decompress"):
        list(Bag(path))


@pytest.mark.parametrize(
    ("content", "kind", "said"),
    [
        (b"", ROSBagFormatException, "empty file"),
        (b"hello, world, this is a text", ROSBagFormatException, "does not appear to be a bag"),
        (b"#ROSBAG V1.2\n1234", ROSBagFormatException, "version 1.2"),
        (b"#ROSBAG", ROSBagFormatException, "nothing was recorded"),
        (b"SQLite format 3\0", ROSBagFormatException, "ROS 2"),
        (MAGIC, ROSBagUnindexedException, "ends after its first line"),
        (MAGIC + b"\xff" * 40, ROSBagFormatException, "damaged"),
        (
            MAGIC
            + pack_record(
                {
                    "op": bytes([OP_BAG_HEADER]),
                    "index_pos": u64.pack(1),
                    "conn_count": u32.pack(1),
                    "chunk_count": u32.pack(1),
                    "encryptor": b"rosbag/AesCbcEncryptor",
                    "gpg_user": b"me",
                }
            ),
            ROSBagEncryptNotSupportedException,
            "encrypted .*GPG user me.*rosbag decrypt",
        ),
    ],
)  # fmt: skip
def test_what_is_no_bag_says_what_it_is(path, content, kind, said):
    path.write_bytes(content)
    with pytest.raises(kind, match=said):
        Bag(path)
    with pytest.raises(OSError, match="No such file"):
        Bag(path.with_name("nope.bag"))


FULL = """
import resource, signal, sys
from rosmini.ros.bag import Bag, BagFull
from rosmini.msgs import message_class
from rosmini.core.time import Time
String = message_class("std_msgs/String")
limit, compression, threshold = int(sys.argv[2]), sys.argv[3], int(sys.argv[4])
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
bag = Bag(sys.argv[1], "w", compression, threshold)
try:
    for i in range(2000):
        bag.write("/chatter", String(f"{i:05d} " + "%x" % (i * 7919 ** 8)), Time(i))
    bag.close()
except BagFull as error:
    bag.close()
    print(error)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="limits of file sizes are POSIX's")
@pytest.mark.parametrize(("limit", "compression", "threshold"),
    [(60_000, "none", 8000), (60_000, "none", 10**6), (40_000, "lz4", 8000)])  # fmt: skip
def test_what_a_full_disk_has_is_saved_by_reindex(path, limit, compression, threshold):
    script = path.with_suffix(".py")
    script.write_text(textwrap.dedent(FULL), encoding="utf-8")
    done = run([sys.executable, str(script), str(path), str(limit), compression, str(threshold)])  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "cannot grow any more" in done.stdout
    with pytest.raises(ROSBagUnindexedException):
        Bag(path)
    reindex(path)
    found = [m.data[:5] for _, m, _ in Bag(path)]
    assert found == [f"{i:05d}" for i in range(len(found))]
    assert len(found) > 100


# -- types that are not known here, or changed
# ---------------------------------------------------------------------------


def test_unknown_and_changed_types_are_read_with_the_bags_definition(path):
    text = "string data\nint32 since\nmy_msgs/Part part\n" + "=" * 80 + "\nMSG: my_msgs/Part\nfloat32 x\n"
    raw = u32.pack(2) + b"hi" + u32.pack(7) + np.float32(0.5).tobytes()
    headers = {
        "/chatter": {"type": "std_msgs/String", "md5sum": "1" * 32, "message_definition": text},
        "/mine": {"type": "my_msgs/Whole", "md5sum": "2" * 32, "message_definition": text},
    }
    with Bag(path, "w") as bag:
        for topic, header in headers.items():
            bag.write_raw(bag.connect(connection(0, topic, header)), 10**9, raw)
    with Bag(path) as bag:
        for _, message, _ in bag:
            assert (message.data, message.since, message.part.x) == ("hi", 7, 0.5)
        changed, unknown = sorted(changed_types(bag), key=lambda change: change.local is None)
        assert (changed.type, changed.local, changed.topics) == ("std_msgs/String", String._md5sum, ("/chatter",))
        assert (unknown.type, unknown.local) == ("my_msgs/Whole", None)
        assert re.match(r"std_msgs/String \[1+\] on /chatter: here it is", str(changed))


# -- tools
# ------------------------------------------------------------------------------------------------------------------


def test_filter(path, tmp_path):
    with Bag(path, "w") as bag:
        fill(bag)
    out = tmp_path / "out.bag"
    assert filter_bag(path, out, "topic == '/chatter' and t.to_sec() >= 105") == (50, 110)
    assert texts(Bag(out)) == [f"hello {i}" for i in range(50, 100)]
    assert (
        filter_bag(path, out, "topic == '/scan' and max(m.ranges) > 25 and any(r > 0 for r in m.ranges)").written == 7
    )
    assert filter_bag(path, out, "len(m.data) == 7 if topic != '/scan' else False").written == 10
    before = out.read_bytes()
    with pytest.raises(FilterError, match=r"failed on a sensor_msgs/LaserScan of /scan.*Test the topic first"):
        filter_bag(path, out, "m.data == 'x'")
    assert out.read_bytes() == before
    assert list(tmp_path.glob("*.part")) == []
    with pytest.raises(ROSBagException, match="same file"):
        filter_bag(path, path, "True")


@pytest.mark.parametrize(
    "expression",
    [
        "__import__('os').system('true')",
        "m.__class__",
        "topic.format(m)",
        "2 ** 10 ** 10",
        "m.serialize(1)",
        "topic ==",
    ],
)
def test_an_expression_may_not_do_anything_else(path, tmp_path, expression):
    with Bag(path, "w") as bag:
        fill(bag, 1)
    with pytest.raises(FilterError):
        filter_bag(path, tmp_path / "out.bag", expression)


# -- what `rosbag info` prints: as in shared/ros_transcripts, with our own bag
# ------------------------------------------------

INFO = """\
path:         {path}
version:      2.0
duration:     9.9s
start:        Jan 01 1970 00:01:40.00 (100.00)
end:          Jan 01 1970 00:01:49.90 (109.90)
size:         {size} KB
messages:     110
compression:  lz4 [1/1 chunks; {share}%]
uncompressed: {plain} KB @ {plain_rate} KB/s
compressed:   {packed} KB @ {packed_rate} KB/s ({share}%)
types:        sensor_msgs/LaserScan [90c7ef2dc6895d81024acba2ac42f369]
              std_msgs/String       [992ce8a1687cec8c8bd883ec73ca41d1]
topics:       /chatter   100 msgs @ 10.0 Hz : std_msgs/String      
              /scan       10 msgs @  1.0 Hz : sensor_msgs/LaserScan"""  # noqa: W291


def test_info(path, monkeypatch):
    monkeypatch.setenv("TZ", "UTC")
    time.tzset()
    with Bag(path, "w", "lz4") as bag:
        fill(bag)
    with Bag(path) as bag:
        _, plain, packed = bag.get_compression_info()
        sizes = [f"{plain / 1024:.1f}", f"{packed / 1024:.1f}"]
        rates = [f"{plain / 9.9 / 1024:.1f}", f"{packed / 9.9 / 1024:.1f}"]
        expected = INFO.format(
            path=path,
            size=f"{path.stat().st_size / 1024:.1f}",
            share=f"{100 * packed / plain:.2f}",
            plain=sizes[0],
            packed=sizes[1].rjust(len(sizes[0])),
            plain_rate=rates[0],
            packed_rate=rates[1].rjust(len(rates[0])),
        )
        assert info_text(bag) == expected
        assert " @ " not in info_text(bag, freq=False).rpartition("types:")[2]
        assert "duration: 9.900000\n" in info_yaml(bag)
