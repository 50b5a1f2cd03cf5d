"""Unit tests with results as JUnit XML, for ``rosunit`` and ``rostest``."""

from __future__ import annotations

import sys
import unittest
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

OPTION = "--gtest_output=xml:"
"""Option of a test for the path of its results file."""


class _Result(unittest.TextTestResult):
    """Records the tests in the order in which they ran."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.ran: list[unittest.TestCase] = []

    def startTest(self, test: unittest.TestCase) -> None:  # as unittest calls it
        self.ran.append(test)
        super().startTest(test)


def suite_of(test: Any) -> unittest.TestSuite:
    """Return the tests of a class, a dotted name (``"module.Class"``), or a list of them."""
    loader = unittest.defaultTestLoader
    if isinstance(test, list | tuple):
        return unittest.TestSuite(suite_of(each) for each in test)
    if isinstance(test, str):
        return loader.loadTestsFromName(test)
    if isinstance(test, unittest.TestSuite):
        return test
    return loader.loadTestsFromTestCase(test)


def run(package: str, test_name: str, test: Any, words: Sequence[str] | None) -> None:
    """Run tests like `rosunit.unitrun`. Raises ``SystemExit`` with 1 if a test failed."""
    runner = unittest.TextTestRunner(sys.stdout, verbosity=2, resultclass=_Result)
    result: Any = runner.run(suite_of(test))
    given = sys.argv if words is None else words
    file = next((word.removeprefix(OPTION) for word in given if word.startswith(OPTION)), None)
    if file:
        write_results(file, f"{package}.{test_name}", result)
    sys.stdout.flush()
    if not result.wasSuccessful():
        raise SystemExit(1)


def write_results(file: str, classname: str, result: Any) -> None:
    """Write the results of tests as JUnit XML."""
    found = list(_results(result))
    counts = {kind: sum(what == kind for _, what, _ in found) for kind in ("failure", "error", "skipped")}
    root = ET.Element(
        "testsuite",
        name=classname,
        tests=str(len(found)),
        failures=str(counts["failure"]),
        errors=str(counts["error"]),
        skipped=str(counts["skipped"]),
    )
    for name, what, text in found:
        case = ET.SubElement(root, "testcase", classname=classname, name=name)
        if what:
            ET.SubElement(case, what, message=text.strip().rpartition("\n")[2]).text = text
    Path(file).parent.mkdir(parents=True, exist_ok=True)
    ET.ElementTree(root).write(file, encoding="utf-8", xml_declaration=True)


def _results(result: Any) -> Iterator[tuple[str, str, str]]:
    """Yield each test with its result: empty, or a kind and a text; errors outside of tests come last."""
    given: dict[Any, tuple[str, str]] = {}
    for kind, found in (("error", result.errors), ("failure", result.failures), ("skipped", result.skipped)):
        given |= {test: (kind, text) for test, text in found}
    given |= dict.fromkeys(result.unexpectedSuccesses, ("failure", "it passed, and was expected to fail"))
    for test in result.ran:
        yield (test.id().rpartition(".")[2], *given.pop(test, ("", "")))
    for test, (kind, text) in given.items():
        yield str(test), kind, text
