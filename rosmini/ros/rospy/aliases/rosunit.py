"""``import rosunit``: unit tests whose results are written as JUnit XML (http://wiki.ros.org/rosunit)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def unitrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
    coverage_packages: Any = None,  # noqa: ARG001 - rosunit's signature
) -> None:
    """Run the tests of a class, a dotted name or a list of these, and print the results.

    Results are written to the file of ``--gtest_output=xml:FILE``. Raises ``SystemExit`` with 1 if a test failed.
    """
    from rosmini.ros.rospy.unit_tests import run  # unittest is loaded only for tests

    run(package, test_name, test, sysargs)
