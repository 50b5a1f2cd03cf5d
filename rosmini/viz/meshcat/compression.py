"""Compress the commands of a scene: they repeat one another, and a second run in the same world repeats all of them.

A repetition is replaced by a reference to its earlier occurrence (J. Ziv, A. Lempel, "A universal algorithm for
sequential data compression", 1977). A library would compress better, but its next release might write other bytes,
and pages are compared byte by byte.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

MIN_MATCH = 4
"""Minimum match length [bytes]."""
MAX_TRIES = 24
"""Number of most recent earlier occurrences that are tried."""
BLOCK = 64


def compress(commands: Iterable[bytes]) -> bytes:
    """Return the commands compressed, each preceded by its length, as `commandsOf` of `rosmini-meshcat.js` reads them.

    Numbers are written in bytes of seven bits, the lowest first. The result is a sequence of: a number of literal
    bytes, these bytes, the distance back to a match, and its length (it may overlap its copy). Distance 0 is the end.
    """
    data = b"".join(bytes(_number(len(command))) + command for command in commands)
    found = bytearray()
    start = 0
    for at, back, length in _matches(data):
        found += bytes(_number(at - start)) + data[start:at] + bytes(_number(back)) + bytes(_number(length))
        start = at + length
    return bytes(found + bytes(_number(len(data) - start)) + data[start:] + bytes(_number(0)))


def _number(value: int) -> Iterator[int]:
    while value > 127:
        yield value & 127 | 128
        value >>= 7
    yield value


def _matches(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Find earlier occurrences: yield (position, distance, length) of each match, in order and without overlaps."""
    known: dict[bytes, list[int]] = {}
    at = 0
    while at + MIN_MATCH <= len(data):
        places = known.setdefault(data[at : at + MIN_MATCH], [])
        length = back = 0
        for place in places[: -MAX_TRIES - 1 : -1]:
            longer = data[at : at + length + 1]
            if len(longer) > length and data.startswith(longer, place):
                length, back = _match_length(data, place, at), at - place
        places.append(at)
        if length:
            yield at, back, length
            for each in range(at + 1, min(at + length, len(data) - MIN_MATCH)):
                known.setdefault(data[each : each + MIN_MATCH], []).append(each)
        at += length or 1


def _match_length(data: bytes, place: int, at: int) -> int:
    """Return the length of the match between `place` and `at`; the first bytes are known to be equal."""
    length = MIN_MATCH
    while at + length + BLOCK <= len(data):
        if data[place + length : place + length + BLOCK] != data[at + length : at + length + BLOCK]:
            break
        length += BLOCK
    while at + length < len(data) and data[place + length] == data[at + length]:
        length += 1
    return length
