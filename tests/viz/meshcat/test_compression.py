"""Commands in fewer bytes, and back."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.meshcat.compression import compress


def commands_of(data: bytes) -> list[bytes]:
    """The reverse, written from the description."""
    at = 0

    def number(source: bytes) -> int:
        nonlocal at
        value = shift = 0
        while True:
            value |= (source[at] & 127) << shift
            shift, at = shift + 7, at + 1
            if source[at - 1] < 128:
                return value

    everything = bytearray()
    while at < len(data):
        count = number(data)
        everything += data[at : at + count]
        at += count
        if back := number(data):
            for _ in range(number(data)):
                everything.append(everything[-back])
    at, found = 0, []
    while at < len(everything):
        length = number(bytes(everything))
        found.append(bytes(everything[at : at + length]))
        at += length
    return found


pieces = st.sampled_from([b"", b"a", b"abcd", b"abcdefgh" * 20, b"\x00" * 300, bytes(range(256))])


@given(st.lists(st.builds(b"".join, st.lists(pieces | st.binary(max_size=9)))))
def test_what_was_squeezed_comes_back(commands):
    assert commands_of(compress(commands)) == commands


def test_what_repeats_takes_nearly_nothing():
    command = bytes(range(256)) * 4
    once = len(compress([command]))
    assert once < 300
    assert len(compress([command] * 10)) < once + 30
