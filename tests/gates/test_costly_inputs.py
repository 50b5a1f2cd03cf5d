"""Small inputs cost little: files made to be costly cost at most in proportion to their length, or are refused.

Each family makes a file of n parts. Calls are counted, of Python's own functions too: twice as many parts cost about
twice as many calls. Where the cost would be inside one call, n is so large that its square could not be waited for.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from rosmini import launch
from rosmini.errors import RosminiError
from rosmini.expressions import Expression
from rosmini.packages import PackageIndex

AT_LEAST = 20_000
"""Fewer calls are not compared."""

PRIME = 2**61 - 1
"""Multiples of it have the same hash."""

PACKAGES = PackageIndex()


class Family(NamedTuple):
    name: str
    make: Callable[[int], str | bytes]
    n: int
    refused: bool = False


def _launch(*parts: str) -> str:
    return f"<launch>{''.join(parts)}</launch>"


def _value(text: str) -> str:
    return _launch(f'<param name="a" value="{text}"/>')


def _each(pattern: str, n: int) -> str:
    return "".join(pattern.replace("#", str(i)) for i in range(n))


TALKER = '<node name="n#" pkg="rospy_tutorials" type="talker.py"/>'

FAMILIES = {
    # expressions
    "a format string with nested brackets": Family(
        "a.txt", lambda n: f"'%((a)x){n}d' % {{'(a)x': 1}}", 10**9, refused=True
    ),
    "a format string with escaped signs": Family("a.txt", lambda n: f"'%%(a%{n}d)' % 1", 10**9, refused=True),
    "a set of colliding numbers": Family(
        "a.txt", lambda n: f"{{i * {PRIME} for i in range({n})}}", 10_000, refused=True
    ),
    "a dictionary of colliding numbers": Family(
        "a.txt", lambda n: f"dict([(i * {PRIME}, 1) for i in range({n})])", 5_000, refused=True
    ),
    "names on many lines": Family("a.txt", lambda n: f"[{'1,' * n}{chr(10) * n}]", 3000),
    "large factorials": Family(
        "a.txt", lambda n: f"[factorial(500) for i in range({n})]", 40_000, refused=True
    ),
    "a search from the right": Family(
        "a.txt", lambda n: f"('a' * {n}).rfind('a' * {n // 4} + 'b' + 'a' * {n // 4})", 400_000, refused=True
    ),
    "large numbers as text": Family("a.txt", lambda n: f"str([1 << 4000] * {n})", 100_000, refused=True),
    # launch files
    "dollar signs": Family("a.launch", lambda n: _value("$" * n), 500_000),
    "brackets that stay open": Family("a.launch", lambda n: _value("$(" * n), 250_000),
    "unknown elements": Family("a.launch", lambda n: _launch("<a/>" * n), 2000),
    "unknown attributes": Family("a.launch", lambda n: _launch('<param name="a" value="1" b=""/>' * n), 500),
    "arguments and $(eval)": Family(
        "a.launch",
        lambda n: _launch(_each('<arg name="a#" default="1"/><param name="b" value="$(eval 1)"/>', n)),
        200,
    ),
    "arguments that are missing": Family(
        "a.launch", lambda n: _launch(_each('<param name="b" value="$(arg b#)"/>', n)), 2000, refused=True
    ),
    "remappings and nodes": Family(
        "a.launch",
        lambda n: _launch(_each('<remap from="a#" to="b"/>', n), _each(TALKER, n)),
        500,
        refused=True,
    ),
    "loops in $(eval)": Family(
        "a.launch",
        lambda n: _launch('<param name="a" value="$(eval sum([i for i in range(999)]))"/>' * n),
        500,
        refused=True,
    ),
}


def _read(path: Path) -> object:
    match path.suffix:
        case ".txt":
            return Expression(path.read_text("utf-8")).evaluate({})
        case ".launch":
            return launch.read(path, environ={}, packages=PACKAGES, lenient=True)
    raise AssertionError(path)


def _calls(path: Path, data: str | bytes) -> tuple[int, bool]:
    """How many calls reading a file takes, and whether it is refused."""
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    calls, refused = 0, False

    def count(_frame: object, event: str, _arg: object) -> None:
        nonlocal calls
        calls += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _read(path)
    except RosminiError:
        refused = True
    finally:
        sys.setprofile(before)
    return calls, refused


@pytest.mark.parametrize("family", FAMILIES)
def test_a_costly_file_costs_in_proportion_to_its_length_or_is_refused(family, tmp_path):
    name, make, n, refused = FAMILIES[family]
    _calls(tmp_path / name, make(2))  # what is loaded and cached once
    (half, _), (whole, was_refused) = (_calls(tmp_path / name, make(count)) for count in (n // 2, n))
    assert whole <= max(AT_LEAST, 2.5 * half)
    assert was_refused is refused
