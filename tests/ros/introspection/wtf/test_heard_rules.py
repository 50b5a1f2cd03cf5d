"""The rules on transforms and on the log."""

from __future__ import annotations

from rosmini.ros.introspection.wtf.heard_rules import RULES, Heard, Transform


def sent(*frames: str, by: str = "/driver") -> list[Transform]:
    return [Transform(frame, by) for frame in frames]


def found(heard: Heard) -> dict[str, tuple[str, ...]]:
    return {each.rule: each.where for rule in RULES for each in rule(heard)}


def test_one_frame_has_one_sender() -> None:
    assert found(Heard(sent("odom", "base_footprint", "base_link") * 3)) == {}
    assert found(Heard()) == {}
    both = sent("base", by="/one") + sent("base", by="/two")
    assert found(Heard(both)) == {"repeated_senders": ("base: /one, /two",)}


def test_errors_in_the_log_are_counted() -> None:
    heard = Heard(errors=[("/b", "two\nlines"), ("/a", "once"), ("/b", "two\nlines")])
    assert found(heard) == {"logged_errors": ("/a: once", "/b: two lines (2 times)")}
