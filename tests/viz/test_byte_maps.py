"""Maps of bytes."""

import struct
import xml.etree.ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz import ViewError, byte_map

SVG = "{http://www.w3.org/2000/svg}"


def texts(picture, kind=None):
    root = ET.fromstring(picture.svg)
    return [element.text or "" for element in root.iter(f"{SVG}text") if element.get("class") == kind]


def test_a_number_is_shown_in_digits_and_a_text_as_text():
    data = struct.pack("<I", 5) + b"hello"
    picture = byte_map(data, [(4, "length: 5"), (5, "data")], title="Figure 1: it")
    assert texts(picture) == ["05", "00", "00", "00", "h", "e", "l", "l", "o"]
    assert texts(picture, "rm-at") == ["0", "4"]
    assert texts(picture, "rm-what") == ["length: 5", "data"]
    assert picture.text.splitlines() == [
        "Figure 1: it: 9 bytes in 2 parts",
        f"      0  {'05 00 00 00':48} length: 5",
        f"      4  {'h  e  l  l  o':48} data",
    ]
    assert "9 bytes in 2 parts: 4 bytes, length: 5; 5 bytes, data" in picture.alt


def test_a_long_part_is_cut_and_counted():
    picture = byte_map(bytes(100), [(100, "zeros")], title="it")
    assert len(texts(picture)) == 64
    assert texts(picture, "rm-at") == ["0", "16", "32", "48", "64"]
    assert picture.text.splitlines()[-1].split() == ["64", "...", "36", "more", "bytes"]


def test_an_empty_part_has_its_line():
    picture = byte_map(bytes(4), [(4, "length: 0"), (0, "nothing")], title="it")
    assert texts(picture, "rm-what") == ["length: 0", "nothing"]


@pytest.mark.parametrize("sizes", [[3], [5], [2, 1], [-1, 5]])
def test_parts_that_are_not_the_data_are_refused(sizes):
    with pytest.raises(ViewError, match="but the data have 4"):
        byte_map(bytes(4), [(size, "part") for size in sizes], title="it")


@given(st.lists(st.tuples(st.binary(max_size=70), st.text(max_size=10)), min_size=1, max_size=5))
def test_whatever_the_bytes_the_picture_is_well_formed(parts):
    data = b"".join(part for part, _ in parts)
    picture = byte_map(data, [(len(part), meaning) for part, meaning in parts], title="it")
    assert len(texts(picture)) == sum(min(len(part), 64) for part, _ in parts)
