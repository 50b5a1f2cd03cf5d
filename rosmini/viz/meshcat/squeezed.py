"""Commands of a scene in fewer bytes: they repeat one another, and those of a second run in the same world do wholly.

What repeats is replaced by where it was before (J. Ziv, A. Lempel, "A universal algorithm for sequential data
compression", 1977). A library would do it better, and another release of it would write other bytes: pages are compared
to the byte.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

LEAST = 4
"""Bytes that are worth being looked for."""
TRIES = 24
"""Places where they were before, the last ones, of which the longest match counts."""
LEAP = 64


def squeezed(commands: Iterable[bytes]) -> bytes:
    """Commands, each with its length before it, as `commandsOf` of `rosmini-meshcat.js` reads them.

    Numbers are in bytes of seven bits, the lowest first. Again and again there is a count of bytes, these bytes, and
    how far back is what follows them, with its length, which may reach into what it makes; 0 back at the end.
    """
    data = b"".join(bytes(_number(len(command))) + command for command in commands)
    found = bytearray()
    start = 0
    for at, back, length in _repeats(data):
        found += bytes(_number(at - start)) + data[start:at] + bytes(_number(back)) + bytes(_number(length))
        start = at + length
    return bytes(found + bytes(_number(len(data) - start)) + data[start:] + bytes(_number(0)))


def _number(value: int) -> Iterator[int]:
    while value > 127:
        yield value & 127 | 128
        value >>= 7
    yield value


def _repeats(data: bytes) -> Iterator[tuple[int, int, int]]:
    """What was there before: where it is again, how far back, and its length, in order and without overlaps."""
    known: dict[bytes, list[int]] = {}
    at = 0
    while at + LEAST <= len(data):
        places = known.setdefault(data[at : at + LEAST], [])
        length, place = max(((_length(data, place, at), place) for place in places[-TRIES:]), default=(0, 0))
        places.append(at)
        if length:
            yield at, at - place, length
            for each in range(at + 1, min(at + length, len(data) - LEAST)):
                known.setdefault(data[each : each + LEAST], []).append(each)
        at += length or 1


def _length(data: bytes, place: int, at: int) -> int:
    """The number of bytes from `at` on that are those from `place` on; the first are known to be."""
    length = LEAST
    while at + length + LEAP <= len(data):
        if data[place + length : place + length + LEAP] != data[at + length : at + length + LEAP]:
            break
        length += LEAP
    while at + length < len(data) and data[place + length] == data[at + length]:
        length += 1
    return length
