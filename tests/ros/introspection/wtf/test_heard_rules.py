"""The rules on transforms and on the log."""

from __future__ import annotations

import pytest

from rosmini.ros.introspection.wtf.heard_rules import RULES, Heard, Transform

NOW = 1_000_000_000_000


def sent(*links: str, by: str = "/driver", stamp: int = NOW, static: bool = False) -> list[Transform]:
    """Transforms of `parent>child`."""
    pairs = (link.split(">") for link in links)
    return [Transform(parent, child, by, stamp, NOW, static) for parent, child in pairs]


def found(heard: Heard) -> dict[str, tuple[str, ...]]:
    return {each.rule: each.where for rule in RULES for each in rule(heard)}


def test_a_tree_is_well() -> None:
    assert found(Heard(sent("map>odom", "odom>base_footprint", "base_footprint>base_link") * 3)) == {}
    assert found(Heard()) == {}


def test_one_frame_and_two_senders() -> None:
    both = sent("odom>base", by="/one") + sent("odom>base", by="/two")
    assert found(Heard(both)) == {"repeated_senders": ("base: /one, /two",)}


def test_one_frame_and_two_parents() -> None:
    assert found(Heard(sent("map>odom", "map>base", "odom>base"))) == {"several_parents": ("base: map, odom",)}


def test_two_trees() -> None:
    assert found(Heard(sent("map>odom", "base>laser"))) == {"several_trees": ("base: base, laser", "map: map, odom")}


def test_a_circle() -> None:
    assert found(Heard(sent("a>b", "b>c", "c>a"))) == {"tf_loop": ("a, b, c",)}
    assert found(Heard(sent("a>a"))) == {"tf_loop": ("a",)}
    below = found(Heard(sent("a>b", "b>a", "b>x", "x>y")))
    assert below == {"tf_loop": ("a, b",)}


@pytest.mark.parametrize(("seconds", "text"), [(11, "11.0 s old"), (-3600, "3600.0 s ahead"), (9, None), (0.02, None)])
def test_stamps_far_from_the_time(seconds: float, text: str | None) -> None:
    heard = Heard(sent("odom>base", stamp=NOW - round(seconds * 1e9)))
    assert found(heard) == ({"old_transforms": (f"base, sent by /driver: {text}",)} if text else {})


def test_static_transforms_may_be_old_and_without_a_time_nothing_is() -> None:
    assert found(Heard(sent("a>b", stamp=0, static=True))) == {}
    assert found(Heard([Transform("a", "b", "/driver", 5, None, False)])) == {}


def test_errors_in_the_log_are_counted() -> None:
    heard = Heard(errors=[("/b", "two\nlines"), ("/a", "once"), ("/b", "two\nlines")])
    assert found(heard) == {"logged_errors": ("/a: once", "/b: two lines (2 times)")}
