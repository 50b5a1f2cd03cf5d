"""Unit tests that write JUnit XML."""

from __future__ import annotations

import unittest
from pathlib import Path

import pytest

from rosmini.core.markup import parse_file
from rosmini.ros.rospy.unit_tests import run


class _Mixed(unittest.TestCase):
    __test__ = False  # not one of pytest's

    def test_passes(self) -> None:
        pass

    def test_raises(self) -> None:
        raise OSError("<broken> & lost")

    def test_fails(self) -> None:
        self.fail("no")

    @unittest.expectedFailure
    def test_surprises(self) -> None:
        pass


def test_every_outcome_is_written(tmp_path: Path) -> None:
    file = tmp_path / "deep" / "results.xml"
    with pytest.raises(SystemExit) as end:
        run("package", "name", _Mixed, ["x", f"--gtest_output=xml:{file}"])
    assert end.value.code == 1
    root = parse_file(file)
    assert (root.get("tests"), root.get("failures"), root.get("errors")) == ("4", "2", "1")
    given = {case.get("name"): [child.tag for child in case] for case in root.all("testcase")}
    assert given == {
        "test_passes": [],
        "test_raises": ["error"],
        "test_fails": ["failure"],
        "test_surprises": ["failure"],
    }
    assert any("<broken> & lost" in case.word("error") for case in root)
