"""The tree of frames: what it refuses, and what it says. `tests/interop/test_tf_buffer.py` compares its answers."""

import math

import pytest

from rosmini.core.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
)
from rosmini.core.tf.rigid import from_yaw, rigid
from rosmini.core.tf.tree import FrameTree

S = 1_000_000_000


@pytest.fixture
def source_of():
    return []


@pytest.fixture
def tree(source_of):
    """map -> odom at 1 s and 2 s, odom -> base at 2 s and 3 s, base -> laser for ever, and x -> y apart."""
    tree = FrameTree(warn=source_of.append)
    tree.set("map", "odom", rigid((1, 0, 0)), 1 * S, "/amcl")
    tree.set("map", "odom", rigid((2, 0, 0)), 2 * S, "/amcl")
    tree.set("odom", "base", from_yaw(3, 0, 0), 2 * S, "/robot")
    tree.set("odom", "base", from_yaw(4, 0, math.pi / 2), 3 * S, "/robot")
    tree.set("base", "laser", rigid((0.5, 0, 0.25)), 0, "/static", static=True)
    tree.set("x", "y", rigid(), 1 * S, "/other")
    return tree


@pytest.mark.parametrize(
    ("time", "parts"),
    [
        (
            4 * S,
            (
                "extrapolation 1.000s into the future",
                "from frame [base] to frame [odom]",
                "Requested: 4.000 s",
                "odom -> base is known from 2.000 s to 3.000 s (2 transforms, 2.0 Hz, from /robot)",
                "has not arrived yet",
                "Time(0)",
            ),
        ),
        (1_999_999_000, ("0.000001s into the past", "this edge was not yet published", "Time(0)")),
        (30 * S, ("27.000s into the future", "27 times the usual", "has stopped")),
        (1_700_000_000 * S, ("different clocks", "/use_sim_time")),
    ],
)
def test_extrapolation_says_all(tree, time, parts):
    with pytest.raises(ExtrapolationException) as info:
        tree.lookup("odom", "base", time)
    for part in parts:
        assert part in str(info.value)


def test_extrapolation_names_the_edge_at_fault(tree):
    with pytest.raises(ExtrapolationException, match=r"the edge map -> odom is known from 1\.000 s to 2\.000 s"):
        tree.lookup("map", "laser", 5 * S // 2)
    with pytest.raises(ExtrapolationException, match="the edge odom -> base is known"):
        tree.lookup("map", "laser", 3 * S // 2)


def test_one_sample_alone_cannot_be_interpolated():
    tree = FrameTree()
    tree.set("a", "b", rigid(), 1 * S)
    with pytest.raises(ExtrapolationException, match=r"(?s)only at 1\.000 s \(1 transform\).*send it as a static one"):
        tree.lookup("a", "b", 2 * S)


def test_what_the_clock_and_the_cache_have_to_say():
    tree = FrameTree(now_ns=lambda: 20 * S)
    for tenth in range(205):
        tree.set("a", "b", rigid(), tenth * S // 10)
    with pytest.raises(ExtrapolationException, match=r"in the future: it is 20\.000 s now"):
        tree.lookup("a", "b", 21 * S)
    with pytest.raises(ExtrapolationException, match=r"the buffer keeps 10 s, and this is longer ago"):
        tree.lookup("a", "b", 3 * S)


def test_two_trees_are_drawn(tree):
    with pytest.raises(ConnectivityException) as info:
        tree.lookup("y", "laser", 9 * S)
    text = str(info.value)
    assert text.startswith(
        "Could not find a connection between 'y' and 'laser' because they are not part of the same tree"
    )
    assert "'y' is in that of 'x', 'laser' in that of 'map'" in text
    assert text.endswith("map\n`-- odom\n    `-- base\n        `-- laser\nx\n`-- y")


@pytest.mark.parametrize(
    ("target", "source", "text"),
    [
        ("map", "lazer", '"lazer" passed to lookupTransform argument source_frame does not exist. Did you mean laser?'),
        ("maps", "laser", '"maps" passed to lookupTransform argument target_frame does not exist. Did you mean map?'),
        ("map", "qq", "There are these frames: base, laser, map, odom, x, y."),
    ],
)  # fmt: skip
def test_an_unknown_frame(tree, target, source, text):
    with pytest.raises(LookupException) as info:
        tree.lookup(target, source)
    assert text in str(info.value)


def test_an_empty_tree_says_so():
    with pytest.raises(LookupException, match="No transform has been received yet"):
        FrameTree().lookup("a", "b")


def test_names_that_tf2_does_not_take(tree):
    with pytest.raises(InvalidArgumentException, match="cannot be empty"):
        tree.lookup("", "map")
    with pytest.raises(InvalidArgumentException, match=r"cannot start with a '/'\. Use \"map\"\."):
        tree.lookup("base", "/map")


def test_a_loop_is_told(tree):
    tree.set("laser", "map", rigid(), 2 * S, "/joker")
    with pytest.raises(
        LookupException, match=r"(?s)contains a loop.*Frame map exists with parent laser \(from /joker\)"
    ):
        tree.lookup("map", "y", 2 * S)
    assert isinstance(tree.why_not("base", "y", 2 * S), LookupException)


@pytest.mark.parametrize("target", ["map", "laser", "y", "nowhere", "", "/map"])
@pytest.mark.parametrize("stamp", [0, 1, 2 * S])
def test_what_is_known_is_what_a_lookup_answers(tree, target, stamp):
    for pair in ((target, "laser"), ("laser", target)):
        assert tree.knows(*pair, stamp) == (tree.why_not(*pair, stamp) is None)


# ---- what is refused ----


def test_repeated_data_are_said_once_and_name_both(tree, source_of):
    for _ in range(5):
        assert not tree.set("map", "odom", rigid((9, 0, 0)), 2 * S, "/fake")
        assert not tree.set("map", "odom", rigid((9, 0, 0)), 1 * S, "/fake")
    (text,) = source_of
    assert text.startswith('TF_REPEATED_DATA: the transform of frame "odom" at 2.000 s came more than once')
    assert "/amcl sent it first, /fake again: two broadcasters" in text
    assert tree.lookup("map", "odom", 2 * S).transform[0] == 2


@pytest.mark.parametrize(
    ("edge", "word"),
    [
        (("a", "a", rigid()), "TF_SELF_TRANSFORM"),
        (("a", "", rigid()), "TF_NO_CHILD_FRAME_ID"),
        (("", "a", rigid()), "TF_NO_FRAME_ID"),
        (("a", "b", (math.nan, 0, 0, 0, 0, 0, 1)), "TF_NAN_INPUT"),
        (("a", "b", (0, 0, 0, 0, 0, 0, 0)), "TF_DENORMALIZED_QUATERNION"),
        (("a", "b", (0, 0, 0, 0, 0, 0, 0.5)), "TF_DENORMALIZED_QUATERNION"),
    ],
)
def test_data_that_cannot_be_right(source_of, edge, word):
    tree = FrameTree(warn=source_of.append)
    assert not tree.set(*edge, 1, "/me")
    assert not tree.set(*edge, 2, "/me")
    (text,) = source_of
    assert text.startswith(word + ": /me ")
    assert list(tree) == []


def test_old_data_and_the_end_of_the_cache(source_of):
    tree = FrameTree(cache_ns=2 * S, warn=source_of.append)
    for second in range(1, 6):
        tree.set("a", "b", rigid((second, 0, 0)), second * S, "/me")
    kept = tree.edges["b"]
    assert (kept.oldest_ns, len(kept), kept.newest_ns) == (3 * S, 3, 5 * S)
    assert not tree.set("a", "b", rigid(), 2 * S, "/late")
    assert source_of[0].startswith('TF_OLD_DATA: the transform of frame "b" at 2.000 s from /late')
    assert tree.set("a", "b", rigid((3.5, 0, 0)), 3 * S + S // 2, "/me")  # late, but not too late
    assert tree.lookup("a", "b", 3 * S + S // 4).transform[0] == 3.25


# ---- frames that change their parent ----


def test_a_frame_that_changes_its_parent(tree, source_of):
    tree.set("base", "cup", rigid((1, 0, 0)), 2 * S, "/hand")
    tree.set("map", "cup", rigid((7, 0, 0)), 3 * S, "/hand")
    assert source_of == []  # a sender may move its own frame
    assert tree.lookup("base", "cup", 2 * S).transform[0] == 1
    assert tree.lookup("base", "cup", 2 * S + 1).transform[0] == 1  # the earlier parent holds until the next sample
    assert tree.chain("map", "cup", 3 * S) == ["cup", "map"]
    assert tree.lookup("map", "cup").transform[0] == 7
    for second in range(4, 20):
        tree.set("map", "cup", rigid((second, 0, 0)), second * S, "/hand")
    assert tree.edges["cup"].steady  # the old parent is out of the cache
    assert tree.lookup("map", "cup", 9 * S + S // 2).transform[0] == 9.5


def test_two_parents_by_two_senders(tree, source_of):
    for second in range(3, 9):
        tree.set("map", "base", rigid(), second * S + 1, "/fake")
        tree.set("odom", "base", rigid(), second * S + 2, "/robot")
    (text,) = source_of
    assert 'TF_TWO_PARENTS: frame "base" is under "odom" by /robot, and under "map" by /fake' in text


def test_clear(tree):
    tree.clear()
    assert list(tree) == ["base", "laser"]  # a static frame is sent once only
    tree.set("map", "base", rigid(), S)
    assert tree.lookup("map", "laser").stamp_ns == S
