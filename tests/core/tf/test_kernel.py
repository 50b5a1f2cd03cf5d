"""The kernel: it finds as bisection does, and gives the same numbers as plain Python and as machine code."""

import random
from bisect import bisect_left

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.tf import FrameTree, TransformException
from rosmini.core.tf.kernel import compiled_walk, find, walk
from rosmini.core.tf.rigid import rigid

from ...conftest import nightly

stamps = st.lists(st.integers(0, 2**62), min_size=1, unique=True).map(sorted)


@given(stamps, st.integers(0, 2**62), st.data())
def test_it_finds_as_bisection_does(stamps, other, data):
    asked = data.draw(st.sampled_from([*stamps, other, stamps[0] + 1, stamps[-1] - 1]))
    assert find(stamps, 0, len(stamps), asked) == bisect_left(stamps, asked)


def random_tree(seed):
    """Twenty frames at uneven times, some late, some under changing parents, one static."""
    rng, tree = random.Random(seed), FrameTree(warn=lambda _text: None)
    for step in range(150):
        for number in range(1, 20):
            if rng.random() < 0.7:
                parent = (number - 1) // 2 if number < 19 else step // 50
                stamp = 10**9 + step * 10**7 + rng.randrange(-(10**8), 10**6)
                transform = rigid([rng.gauss(0, 3) for _ in range(3)], [rng.gauss(0, 1) for _ in range(4)])
                tree.set(f"f{parent}", f"f{number}", transform, stamp, "/test", static=number == 7)
    return tree


def answers(tree, seed):
    rng = random.Random(seed)
    for _ in range(3000):
        target, source = (f"f{rng.randrange(20)}" for _ in range(2))
        try:
            yield tree.lookup(target, source, rng.choice([0, 10**9 + rng.randrange(150 * 10**7)]))
        except TransformException as error:
            yield str(error)


@pytest.mark.parametrize("seed", [0, *nightly(1, 2)])
def test_machine_code_gives_the_same_numbers_and_errors(seed, monkeypatch):
    pytest.importorskip("numba")
    plain, compiled = random_tree(seed), random_tree(seed)
    monkeypatch.setattr("rosmini.core.tf.tree.LOOKUPS_LOADED", 1)
    compiled.lookup("f0", "f1")
    monkeypatch.setattr("rosmini.core.tf.tree.LOOKUPS_LOADED", 10**9)
    found = list(answers(compiled, seed))
    assert compiled._walk is compiled_walk()
    assert list(answers(plain, seed)) == found
    assert plain._walk is walk
    assert len({type(one) for one in found}) == 2
    # And what comes later is seen, also where the arrays had to grow.
    for tree in (plain, compiled):
        for step in range(500):
            tree.set("f0", "f1", rigid((step, 0, 0)), 3 * 10**9 + step * 10**6, "/test")
            tree.set("f0", f"new{step}", rigid((0, step, 0)), 3 * 10**9 + 499 * 10**6, "/test")
    assert plain.lookup("f1", "new400") == compiled.lookup("f1", "new400")
    assert plain.lookup("f1", "new400").transform[:3] == (-499, 400, 0)


def test_without_numba_lookups_stay_in_python(monkeypatch):
    def machine_code():
        raise ImportError("no numba here")

    monkeypatch.setattr("rosmini.core.tf.tree.compiled_walk", machine_code)
    monkeypatch.setattr("rosmini.core.tf.tree.LOOKUPS_TO_LOAD", 3)
    tree = FrameTree()
    tree.set("a", "b", rigid((1, 2, 3)), 10**9)
    assert {tree.lookup("a", "b").transform for _ in range(6)} == {(1, 2, 3, 0, 0, 0, 1)}
