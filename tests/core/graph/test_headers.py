"""Connection headers, as TCPROS writes them."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import DeserializationError
from rosmini.core.graph.headers import decode_header, encode_header

KEYS = st.text(st.characters(codec="utf-8", exclude_characters="="), min_size=1)
VALUES = st.text(st.characters(codec="utf-8"))


@given(st.dictionaries(KEYS, VALUES, max_size=8))
def test_a_header_survives_the_wire(fields: dict[str, str]) -> None:
    decoded = decode_header(encode_header(fields))
    assert decoded == fields
    assert list(decoded) == sorted(fields)


def test_a_header_has_the_bytes_that_ros_sends() -> None:
    assert encode_header({"topic": "/chatter", "md5sum": "*"}) == (
        b"\x1e\x00\x00\x00" + b"\x08\x00\x00\x00md5sum=*" + b"\x0e\x00\x00\x00topic=/chatter"
    )


@given(st.binary(max_size=60))
def test_any_bytes_are_a_header_or_a_clear_error(data: bytes) -> None:
    for hostile in (data, struct.pack("<I", len(data)) + data):
        try:
            fields = decode_header(hostile)
        except DeserializationError:
            continue
        assert all("=" not in key for key in fields)


@given(st.dictionaries(KEYS, VALUES, min_size=1, max_size=4), st.data())
def test_a_header_that_was_cut_off_is_an_error(fields: dict[str, str], data: st.DataObject) -> None:
    whole = encode_header(fields)
    cut = data.draw(st.integers(0, len(whole) - 1))
    with pytest.raises(DeserializationError):
        decode_header(whole[:cut])


@pytest.mark.parametrize(
    ("body", "text"),
    [
        (b"\x04\x00\x00", "middle of a field's length, at byte 0"),
        (b"\xff\xff\xff\xff", "at byte 0 a field of .* claims 4294967295 bytes; 0 are left"),
        (b"\x02\x00\x00\x00ab", "has no '='"),
        (b"\x02\x00\x00\x00=\xff", "not UTF-8"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(body: bytes, text: str) -> None:
    with pytest.raises(DeserializationError, match=text):
        decode_header(struct.pack("<I", len(body)) + body)
