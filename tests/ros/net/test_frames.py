"""Frames cut out of a stream: whatever pieces it comes in, and whatever lengths it promises."""

from __future__ import annotations

import struct
import tracemalloc

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import DeserializationError
from rosmini.core.graph.headers import HEADER_LIMIT
from rosmini.ros.net.frames import FrameReader


def frame(body: bytes) -> bytes:
    return struct.pack("<I", len(body)) + body


@given(st.lists(st.binary(max_size=40), max_size=8), st.lists(st.integers(1, 30), min_size=1))
def test_frames_come_out_whole_in_whatever_pieces_they_arrive(bodies: list[bytes], sizes: list[int]) -> None:
    stream, reader, seen = b"".join(map(frame, bodies)), FrameReader(), []
    turn = 0
    while stream:
        size = sizes[turn % len(sizes)]
        turn += 1
        seen += reader.feed(stream[:size])
        stream = stream[size:]
    assert seen == bodies


def test_answers_of_services_begin_with_their_ok_byte() -> None:
    reader = FrameReader(ok_byte=True)
    stream = frame(b"header") + b"\x01" + frame(b"response") + b"\x00" + frame(b"")
    assert [one for byte in stream for one in reader.feed(bytes([byte]))] == [b"header", b"\x01response", b"\x00"]


@pytest.mark.parametrize("length", [HEADER_LIMIT + 1, 10 * 2**20, 2**32 - 1])
def test_a_header_over_the_limit_is_refused_when_its_length_is_read(length: int) -> None:
    with pytest.raises(DeserializationError, match=f"connection header of {length} bytes was announced"):
        FrameReader().feed(struct.pack("<I", length))


@pytest.mark.parametrize("length", [900_000_000, 2**32 - 1])
def test_a_length_allocates_nothing(length: int) -> None:
    reader = FrameReader()
    reader.feed(frame(b"header"))
    tracemalloc.start()
    try:
        if length > 1_000_000_000:
            with pytest.raises(DeserializationError, match="at most 1000000000 are read"):
                reader.feed(struct.pack("<I", length))
        else:
            assert reader.feed(struct.pack("<I", length) + b"abc") == []
        assert tracemalloc.get_traced_memory()[1] < 100_000
    finally:
        tracemalloc.stop()
