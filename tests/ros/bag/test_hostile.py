"""Damaged and hostile bags: nothing in them is run, memory stays bounded by the file, and errors say where."""

from __future__ import annotations

import bz2
import io
import os
import random
import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import lz4.frame
import pytest

from rosmini.core.errors import DeserializationError, RosminiError
from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import (
    Bag,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
    filter_bag,
    fix_bag,
    recompress,
    reindex,
)
from rosmini.ros.bag.index import connection
from rosmini.ros.bag.info import info_text, info_yaml
from rosmini.ros.bag.player import Player
from rosmini.ros.bag.records import MAGIC, OP_CHUNK, TRUSTED_CHUNK, pack_fields, pack_record, u32
from rosmini.ros.rospy.aliases.genpy.dynamic import generate_dynamic

from ...conftest import nightly
from ...gates.test_damaged_files import damaged

String = message_class("std_msgs/String")
LaserScan = message_class("sensor_msgs/LaserScan")
MEGABYTE = 1024 * 1024


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "test.bag"


def bag_of(path: Path, kind: str, definition: str, data: bytes = b"") -> Path:
    """A bag with one message of a type of its own."""
    with Bag(path, "w") as bag:
        header = {"type": kind, "md5sum": "0" * 32, "message_definition": definition}
        bag.write_raw(bag.connect(connection(0, "/topic", header)), 10**9, data)
    return path


def use(path: Path) -> None:
    """Do with a bag what can be done."""
    with Bag(path) as bag:
        info_text(bag)
        bag.message_class("/topic")
        for _, message, _ in bag:
            str(message)


TRAP = "X=0;open('trap','w');y"
TRAPS = {
    "type": (f"p/{TRAP}", "int32 a\n"),
    "type with lines": ("p/X=0\n    open('trap','w')\n    y", "int32 a\n"),
    "package": (f"{TRAP}/T", "int32 a\n"),
    "field": ("p/T", f"int32 {TRAP}\n"),
    "field name": ("p/T", "int32 a;open('trap','w')\n"),
    "field with a tab": ("p/T", "string[]\ta\n"),
    "type of a field": ("p/T", f"p/{TRAP} a\n{'=' * 80}\nMSG: p/{TRAP}\nint32 a\n"),
    "nested": ("p/T", f"p/N a\n{'=' * 80}\nMSG: p/N\nint32 a\n{'=' * 80}\nMSG: p/{TRAP}\nint32 b\nbad line here\n"),
    "constant": ("p/T", "bool A=open('trap','w')\nint32 a\n"),
    "number": ("p/T", "int32 A=__import__('os').abort()\n"),
    "array": ("p/T", "int32[open('trap','w')] a\n"),
    "itself": ("p/T", "p/T a\n"),
    "large": ("p/T", "float64[99999999999] a\n"),
}


@pytest.mark.parametrize("name", TRAPS)
def test_nothing_of_a_bag_is_run(path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(path.parent)
    bag_of(path, *TRAPS[name], bytes(4))
    if name == "nested":
        use(path)  # a definition that nothing asks for
    else:
        with pytest.raises(
            ROSBagFormatException, match=r"test\.bag: the definition of .* on '/topic' is broken"
        ) as caught:
            use(path)
        assert len(str(caught.value)) < 1000
    assert not path.with_name("trap").exists()


def chunk(compression: str, size: int, packed: bytes) -> bytes:
    fields = {"compression": compression.encode(), "op": bytes([OP_CHUNK]), "size": u32.pack(size)}
    return pack_record(fields, packed)


def bomb(path: Path, compression: str, claimed: int | None, real: int) -> Path:
    """A bag with an index whose one chunk claims to have some bytes (None: as many as it has), and has others."""
    with Bag(path, "w") as bag:
        bag.write("/topic", String("x"), Time(1))
    whole = path.read_bytes()
    begin = whole.index(b"compression=none") - 8
    size = struct.unpack_from("<I", whole, whole.index(b"size=", begin) + 5)[0]
    data_at = whole.index(b"size=", begin) + 9 + 4
    packed = pack(compression, bytes(real))
    record = chunk(compression, real if claimed is None else claimed, packed)
    moved = len(record) - (data_at + size - begin)
    rest = whole[data_at + size :]
    front = bytearray(whole[:begin])
    at = front.index(b"index_pos=") + 10
    struct.pack_into("<Q", front, at, struct.unpack_from("<Q", front, at)[0] + moved)
    path.write_bytes(bytes(front) + record + rest)
    return path


def pack(compression: str, data: bytes) -> bytes:
    if compression == "bz2":
        return bz2.compress(data)
    return lz4.frame.compress(data, block_size=lz4.frame.BLOCKSIZE_MAX4MB)


@pytest.mark.parametrize("compression", ["bz2", "lz4"])
@pytest.mark.parametrize(
    ("claimed", "real", "said"),
    [
        (1000, 50 * MEGABYTE, "should have 1,000 bytes and has more than 1,000"),
        (2**32 - 1, 100, f"has .* bytes and claims to hold 4,294,967,295; at most {TRUSTED_CHUNK:,} are unpacked"),
        (TRUSTED_CHUNK, 100, f"should have {TRUSTED_CHUNK:,} bytes and has 100"),
    ],
)
def test_a_chunk_is_unpacked_as_far_as_it_says(
    path: Path, compression: str, claimed: int, real: int, said: str
) -> None:
    bomb(path, compression, claimed, real)
    tracemalloc.start()
    try:
        with (
            Bag(path) as bag,
            pytest.raises(ROSBagFormatException, match=rf"test\.bag: the .*chunk at byte 4117 {said}"),
        ):
            list(bag.read_raw())
        whole = path.read_bytes()
        at = whole.index(b"index_pos=") + 10
        path.write_bytes(whole[:at] + bytes(8) + whole[at + 8 :])
        found = reindex(path)
        assert tracemalloc.get_traced_memory()[1] < 20 * MEGABYTE
    finally:
        tracemalloc.stop()
    assert (found.messages, len(found.problems)) == (0, 1)


def test_what_is_longer_than_the_file_takes_no_memory(path: Path) -> None:
    """Lengths of headers, of data and of chunks, and numbers of records, up to 4 GiB."""
    with Bag(path, "w") as bag:
        bag.write("/topic", String("x"), Time(1))
    whole = path.read_bytes()
    tracemalloc.start()
    try:
        for at in range(len(MAGIC), len(whole) - 4, 3):
            if 150 < at < 4117:
                continue  # the room of the first record
            path.write_bytes(whole[:at] + b"\xff\xff\xff\xff" + whole[at + 4 :])
            attempt(path)
        assert tracemalloc.get_traced_memory()[1] < 5 * MEGABYTE
    finally:
        tracemalloc.stop()


def attempt(path: Path) -> None:
    """Everything but real errors of ours, of which each names the file."""
    for allow in (False, True):
        try:
            with Bag(path, allow_unindexed=allow) as bag:
                for look in (info_text, info_yaml, list, Bag.get_type_and_topic_info, Bag.get_compression_info):
                    try:
                        look(bag)
                    except RosminiError as error:
                        assert str(path) in str(error)  # noqa: PT017 - most are fine
        except ROSBagException as error:
            assert str(path) in str(error)  # noqa: PT017


def samples(folder: Path) -> list[bytes]:
    """Bags of each kind of record, small and of each compression, one of them without an index."""
    found = []
    for compression in ("none", "bz2", "lz4"):
        path = folder / "sample.bag"
        with Bag(path, "w", compression, 600) as bag:
            for i in range(6):
                bag.write("/topic", String(f"hello {i}"), Time(100 + i))
                bag.write("/scan", LaserScan(ranges=[1.0, 2.0]), Time(100 + i, 5))
            bag.connect(connection(0, "/odd", {"type": "p/T", "md5sum": "0", "message_definition": "int32[] a\n"}))
        whole = path.read_bytes()
        found += [whole, whole[:-700]]
    return found


@pytest.mark.parametrize("seed", [0, *nightly(*range(1, 20))])
def test_any_damage_to_a_bag_is_an_error_that_names_the_file(tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    kept = samples(tmp_path)
    path, target = tmp_path / "fuzz.bag", tmp_path / "target.bag"
    tracemalloc.start()
    try:
        for round_ in range(60):
            path.write_bytes(damaged(rng.choice(kept), rng))
            attempt(path)
            tools: list[Any] = [
                lambda: recompress(path, target, "none"),
                lambda: filter_bag(path, target, "True"),
                lambda: reindex(path),
            ]
            for tool in tools[round_ % 3 :]:
                try:
                    tool()
                except (ROSBagException, DeserializationError) as error:
                    assert str(path) in str(error)  # noqa: PT017
        assert tracemalloc.get_traced_memory()[1] < 20 * MEGABYTE
    finally:
        tracemalloc.stop()


def test_a_bag_with_a_damaged_first_record_is_not_emptied_by_reindexing(path: Path) -> None:
    with Bag(path, "w") as bag:
        bag.write("/topic", String("x"), Time(1))
    whole = path.read_bytes()
    path.write_bytes(whole[:13] + b"\xff" * 4 + whole[17:])
    with pytest.raises(ROSBagUnindexedException, match="has no index that can be read"):
        Bag(path)
    with pytest.raises(ROSBagFormatException, match=r"test\.bag: the record at byte 13"):
        reindex(path)
    assert len(path.read_bytes()) == len(whole)


def test_a_bag_with_a_damaged_index_is_reindexed(path: Path) -> None:
    with Bag(path, "w") as bag:
        bag.write("/topic", String("x"), Time(1))
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b"chunk_pos=", b"chunk_pas="))
    with pytest.raises(ROSBagUnindexedException, match=r"'chunk_pos': the file is damaged.*rosbag reindex"):
        Bag(path)
    assert reindex(path).messages == 1


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names")
def test_a_pipe_is_not_waited_for(path: Path) -> None:
    os.mkfifo(path)
    with pytest.raises(OSError, match="it is a pipe"):
        Bag(path)


def test_a_stream_is_named(path: Path) -> None:
    with pytest.raises(ROSBagFormatException, match="the bag is an empty file"):
        Bag(io.BytesIO())
    fields = pack_fields({"op": b"\3"})
    with pytest.raises(
        ROSBagUnindexedException, match=r"the bag has no index that can be read: .* no valid field 'index_pos'"
    ):
        Bag(io.BytesIO(MAGIC + u32.pack(len(fields)) + fields + u32.pack(0)))


def test_bags_of_version_2_1_open_and_say_so(path: Path) -> None:
    with Bag(path, "w") as bag:
        bag.write("/topic", String("x"), Time(1))
    path.write_bytes(path.read_bytes().replace(b"V2.0", b"V2.1", 1))
    with Bag(path) as bag:
        assert bag.version == 201
        assert [m.data for _, m, _ in bag] == ["x"]
        assert "version:     2.1\n" in info_text(bag)
        assert "version: 2.1\n" in (info_yaml(bag) or "")
    with pytest.raises(ROSBagException, match="bag version 201 is unsupported for appending"):
        Bag(path, "a")


def play(path: Path) -> None:
    with Bag(path) as bag, Graph() as graph:
        Player(graph.node("play"), bag, quiet=True)
        graph.run(1.0)


@pytest.mark.parametrize(
    "use",
    [
        lambda path: list(Bag(path)),
        lambda path: filter_bag(path, path.with_name("target.bag"), "True"),
        lambda path: fix_bag(path, path.with_name("target.bag"), force=True),
        play,
    ],
    ids=["read", "filter", "fix", "play"],
)
def test_a_damaged_message_names_the_file_and_its_place(path: Path, use: Callable[[Path], object]) -> None:
    changed = generate_dynamic("std_msgs/String", "string text")["std_msgs/String"]
    with Bag(path, "w") as bag:
        raw: Any = ("std_msgs/String", b"\xff\xff\xff\xff", changed._md5sum, changed)
        bag.write("/topic", raw, Time(1), raw=True)
    place = r"test\.bag: the message on /topic at byte \d+ of the chunk at byte 4117 cannot be read: std_msgs/String"
    with pytest.raises(DeserializationError, match=place):
        use(path)
