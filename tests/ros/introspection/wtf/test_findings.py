"""How findings are printed."""

from __future__ import annotations

from rosmini.ros.introspection.wtf.findings import Finding, summary

WARNING = Finding("w", "WARNING", "Look:", ("/a:", " /b"), "Do this.")
ERROR = Finding("e", "ERROR", "Bad")


def test_a_finding_has_its_places_and_its_way_out() -> None:
    assert str(WARNING) == "WARNING Look:\n * /a:\n   /b\n   -> Do this."
    assert str(ERROR) == "ERROR Bad"


def test_warnings_come_first_each_kind_with_its_count() -> None:
    assert summary("Online", [ERROR, WARNING, ERROR]).splitlines() == [
        "Online checks summary:", "",
        "Found 1 warning(s).", "Warnings are things that may be just fine, but are sometimes at fault", "",
        "WARNING Look:", " * /a:", "   /b", "   -> Do this.", "",
        "Found 2 error(s).", "", "ERROR Bad", "ERROR Bad",
    ]  # fmt: skip


def test_nothing_found_is_said() -> None:
    assert summary("Static", []) == "Static checks summary:\n\nNo errors or warnings"
