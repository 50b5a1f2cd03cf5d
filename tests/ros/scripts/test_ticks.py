"""Ticks in loops: where they go, and that nothing else changes."""

import ast
import traceback

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.ros.scripts.ticks import TICK, with_ticks


def run(source, **names):
    ticks = []
    namespace = {TICK: lambda: ticks.append(1), **names}
    exec(compile(with_ticks(ast.parse(source)), "<s>", "exec"), namespace)
    return len(ticks), namespace


@pytest.mark.parametrize(
    ("source", "count"),
    [
        ("i = 0\nwhile i < 3: i += 1", 3),
        ("i = 3\nwhile (i := i - 1): pass", 2),
        ("for i in range(4):\n    for j in range(2): pass", 12),
        ("def f():\n    while True:\n        return 1\nx = f()", 1),
        ("for i in range(2): continue\nelse: x = 1", 2),
        ("x = [i for i in range(5)]", 0),
        ("class A:\n    for i in range(2): pass", 2),
        ("async def f():\n    while True: pass", 0),
    ],
)
def test_one_tick_for_each_turn(source, count):
    assert run(source)[0] == count


@pytest.mark.parametrize(
    ("loop", "is_idle"),
    [
        ("while n(): pass", True), ("while n(): continue", True), ("while n():\n    'waits'", True),
        ("while n():\n    if done: break", True), ("while n(): x = 1", False), ("while n(): n()", False),
        ("while (m := n()): pass", False), ("for i in range(1): pass", False),
    ],
)  # fmt: skip
def test_a_while_loop_whose_body_does_nothing_only_waits(loop, is_idle):
    turns = []
    names = {TICK: lambda **kinds: turns.append(kinds), "n": iter([1, 0, 0]).__next__, "done": False}
    exec(compile(with_ticks(ast.parse(loop)), "<s>", "exec"), names)
    assert turns == [{"is_idle": True} if is_idle else {}]


def test_docstring_and_future_import_stay_first():
    _, names = run(
        '"""Doc."""\nfrom __future__ import annotations\ndef f(a: Unknown):\n    """F."""\n    for i in ():\n        '
        '"""not a docstring"""\n'
    )
    assert names["__doc__"] == "Doc."
    assert names["f"].__doc__ == "F."
    assert names["f"].__annotations__ == {"a": "Unknown"}


def test_tracebacks_keep_their_lines():
    source = "x = 1\nwhile True:\n    x += 1\n\n    if x > 3:\n        1 / 0\n"
    with pytest.raises(ZeroDivisionError) as caught:
        run(source)
    assert traceback.extract_tb(caught.tb)[-1].lineno == 6


def test_an_error_in_the_tick_is_at_the_loop():
    def stop():
        raise InterruptedError

    with pytest.raises(InterruptedError) as caught:
        exec(compile(with_ticks(ast.parse("x = 1\nwhile x:\n    x += 1\n")), "<s>", "exec"), {TICK: stop})
    assert traceback.extract_tb(caught.tb)[-2].lineno == 2


@given(st.lists(st.integers(0, 5), max_size=4))
def test_the_program_computes_the_same(counts):
    source = "total = 0\n" + "\n".join(f"for i in range({n}):\n    total += i" for n in counts)
    plain: dict = {}
    exec(source, plain)
    ticks, names = run(source)
    assert names["total"] == plain["total"]
    assert ticks == sum(counts)
