"""A bag as an MCAP file, read back with the library of that format."""

from __future__ import annotations

import struct
import sys
import tracemalloc

import pytest

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, ROSBagException
from rosmini.ros.bag.mcap import from_mcap, to_mcap

reader = pytest.importorskip("mcap.reader")
zstandard = pytest.importorskip("zstandard")
lz4_frame = pytest.importorskip("lz4.frame")


@pytest.fixture
def bag(tmp_path):
    """Two topics, on one of them two publishers, a latched one among them."""
    text, pose = message_class("std_msgs/String"), message_class("geometry_msgs/PoseStamped")
    header = {"type": "std_msgs/String", "md5sum": text._md5sum, "message_definition": text._full_text}
    with Bag(tmp_path / "drive.bag", "w") as bag:
        for i in range(30):
            bag.write("/chatter", text(data=f"hello {i}"), Time(100, i))
            bag.write("/pose", pose(), Time(100, 1000 * i))
        bag.write(
            "/chatter",
            text(data="latched"),
            Time(101),
            connection_header={**header, "latching": "1", "callerid": "/map"},
        )
    return tmp_path / "drive.bag"


def test_everything_is_in_the_file(bag, tmp_path):
    target = tmp_path / "drive.mcap"
    assert to_mcap(bag, target) == (61, 61)
    with target.open("rb") as file, Bag(bag) as source:
        found = reader.make_reader(file, validate_crcs=True)
        assert found.get_header().profile == "ros1"
        messages = list(found.iter_messages())
        summary = found.get_summary()
        wanted = list(source.read_raw())
    assert [m.log_time for _, _, m in messages] == [time for _, time, *_ in wanted]
    assert [m.data for _, _, m in messages] == [data for _, _, data, *_ in wanted]
    assert {(s.name, s.encoding) for s, _, _ in messages} == {
        ("std_msgs/String", "ros1msg"), ("geometry_msgs/PoseStamped", "ros1msg")
    }  # fmt: skip
    assert len(summary.schemas) == 2
    assert len(summary.channels) == 3
    assert {c.message_encoding for c in summary.channels.values()} == {"ros1"}
    latched = next(c for c in summary.channels.values() if c.metadata.get("latching"))
    assert (latched.topic, latched.metadata["callerid"]) == ("/chatter", "/map")
    definition = next(s.data.decode() for s in summary.schemas.values() if s.name.endswith("PoseStamped"))
    assert definition == message_class("geometry_msgs/PoseStamped")._full_text
    assert summary.statistics.message_count == 61


def test_an_empty_bag_becomes_an_empty_file(tmp_path):
    Bag(tmp_path / "empty.bag", "w").close()
    assert to_mcap(tmp_path / "empty.bag", tmp_path / "empty.mcap") == (0, 0)
    with (tmp_path / "empty.mcap").open("rb") as file:
        assert list(reader.make_reader(file).iter_messages()) == []


def test_what_is_no_bag_leaves_no_file(tmp_path):
    (tmp_path / "wrong.bag").write_bytes(b"#ROSBAG V9.9\n")
    with pytest.raises(ROSBagException):
        to_mcap(tmp_path / "wrong.bag", tmp_path / "wrong.mcap")
    assert not list(tmp_path.glob("*.mcap*"))
    with pytest.raises(ROSBagException, match="same file"):
        to_mcap(tmp_path / "wrong.bag", tmp_path / "wrong.bag")


def test_without_the_library_it_says_what_to_install(bag, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    with pytest.raises(ROSBagException, match=r"pip install mcap"):
        to_mcap(bag, tmp_path / "drive.mcap")


def test_a_bag_comes_back_out_of_a_file_to_the_byte(bag, tmp_path):
    to_mcap(bag, tmp_path / "drive.mcap")
    assert from_mcap(tmp_path / "drive.mcap", tmp_path / "back.bag") == (61, 61)
    with Bag(bag) as source, Bag(tmp_path / "back.bag") as back:
        wanted = [(c.topic, c.type, c.md5sum, c.definition, t, d) for c, t, d, *_ in source.read_raw()]
        assert [(c.topic, c.type, c.md5sum, c.definition, t, d) for c, t, d, *_ in back.read_raw()] == wanted
        latched = [c for c in back.connections() if c.header.get("latching")]
        assert [(c.topic, c.text("callerid")) for c in latched] == [("/chatter", "/map")]


@pytest.mark.parametrize("text", [b"", b"#ROSBAG V2.0\n", b"\x89MCAP0\r\n" + 40 * b"\x05"])
def test_what_is_no_mcap_file_is_refused_and_leaves_nothing(tmp_path, text):
    (tmp_path / "a.mcap").write_bytes(text)
    with pytest.raises(ROSBagException, match="not an MCAP file, or is damaged"):
        from_mcap(tmp_path / "a.mcap", tmp_path / "a.bag")
    assert [path.name for path in tmp_path.iterdir()] == ["a.mcap"]


def with_chunk(compression: bytes, data: bytes, size: int) -> bytes:
    """A file with one chunk, which claims to hold `size` bytes."""
    chunk = struct.pack("<QQQII", 0, 0, size, 0, len(compression)) + compression
    chunk += struct.pack("<Q", len(data)) + data
    head = struct.pack("<I", 4) + b"ros1" + struct.pack("<I", 0)
    parts = [
        b"\x89MCAP0\r\n", b"\x01", struct.pack("<Q", len(head)), head, b"\x06", struct.pack("<Q", len(chunk)),
    ]  # fmt: skip
    return b"".join([*parts, chunk, b"\x02", struct.pack("<Q", 20), bytes(20), b"\x89MCAP0\r\n"])


ZEROS = bytes(50_000_000)


@pytest.mark.parametrize(
    "data",
    [
        with_chunk(b"zstd", b"abcd", 2**40),
        with_chunk(b"lz4", b"abcd", 2**40),
        with_chunk(b"lz4", b"abcd", 4),
        with_chunk(b"zstd", zstandard.compress(ZEROS), 4),
        with_chunk(b"zstd", zstandard.compress(b"abcd"), 5),
        with_chunk(b"lz4", lz4_frame.compress(ZEROS), 4),
        b"\x89MCAP0\r\n\x05" + struct.pack("<Q", 2**31) + b"abc",
        b"\x89MCAP0\r\n",
    ],
    ids=["no zstd", "no lz4", "short lz4", "zstd bomb", "too little", "lz4 bomb", "long record", "magic alone"],
)  # fmt: skip
def test_a_chunk_is_unpacked_as_far_as_it_claims_to_go_and_no_further(tmp_path, data):
    (tmp_path / "a.mcap").write_bytes(data)
    tracemalloc.start()
    try:
        with pytest.raises(ROSBagException, match=r"a\.mcap is not an MCAP file, or is damaged"):
            from_mcap(tmp_path / "a.mcap", tmp_path / "a.bag")
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 20_000_000


def test_chunks_of_zstd_are_read_and_a_message_without_its_channel_is_not(bag, tmp_path):
    from mcap.writer import CompressionType, Writer

    for number, channels in enumerate((1, 0)):
        with (tmp_path / f"{number}.mcap").open("wb") as file:
            writer = Writer(file, compression=CompressionType.ZSTD)
            writer.start(profile="ros1", library="t")
            schema = writer.register_schema("std_msgs/String", "ros1msg", b"string data")
            for _ in range(channels):
                writer.register_channel("/chatter", "ros1", schema)
            for time in (2, 1):
                writer.add_message(1, time, b"\x01\0\0\0x", time)
            writer.finish()
    assert from_mcap(tmp_path / "0.mcap", tmp_path / "0.bag") == (2, 2)
    with Bag(tmp_path / "0.bag") as made:
        assert [(topic, m.data, t.to_nsec()) for topic, m, t in made.read_messages()] == [
            ("/chatter", "x", 1), ("/chatter", "x", 2)
        ]  # fmt: skip
    with pytest.raises(ROSBagException, match="a message of the channel 1, which comes nowhere before it"):
        from_mcap(tmp_path / "1.mcap", tmp_path / "1.bag")


def test_messages_of_ros_2_are_named_as_such(tmp_path):
    from mcap.writer import Writer

    with (tmp_path / "a.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="t")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        channel = writer.register_channel("/chatter", "cdr", schema)
        writer.add_message(channel, 1, b"\0\1\0\0\1\0\0\0\0", 1)
        writer.finish()
    with pytest.raises(ROSBagException, match=r"/chatter in .* is encoded as 'cdr'"):
        from_mcap(tmp_path / "a.mcap", tmp_path / "a.bag")
