"""Runs the ``<test>`` tags of launch files (http://wiki.ros.org/rostest): nodes that end, alongside all others."""

from __future__ import annotations

import os
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

from rosmini.core.files import is_file
from rosmini.core.graph import Graph
from rosmini.core.markup import MarkupError, parse_file

from .running import Launch, Running, in_graph

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.core.markup import Element
    from rosmini.core.packages import PackageIndex

    from .plan import Plan, TestPlan

MASTER_URI = "ROS_MASTER_URI"
KINDS = ("failure", "error", "skipped")


@dataclass(frozen=True)
class Case:
    """A test; ``kind`` is empty if it passed, else "failure", "error" or "skipped", and ``text`` gives the reason."""

    classname: str
    name: str
    kind: str = ""
    text: str = ""

    def __str__(self) -> str:
        how = {"": "passed", "failure": "FAILURE", "error": "ERROR"}.get(self.kind, self.kind)
        reason = f": {self.text.strip()}" if self.kind else ""
        return f"[{self.classname}/{self.name}][{how}]{reason}"


@dataclass(frozen=True)
class Results:
    """Results of the tests of launch files; printed like rostest's."""

    cases: tuple[Case, ...] = field(default=())

    def count(self, kind: str) -> int:
        """Return the number of tests with that result."""
        return sum(case.kind == kind for case in self.cases)

    @property
    def passed(self) -> bool:
        """True if there was a test and none failed."""
        return bool(self.cases) and not self.count("failure") + self.count("error")

    def __str__(self) -> str:
        lines = [f"[ROSTEST]{'-' * 71}", "", *map(str, self.cases), "", "SUMMARY"]
        lines += [f" * RESULT: {'SUCCESS' if self.passed else 'FAIL'}", f" * TESTS: {len(self.cases)}"]
        lines += [f" * ERRORS: {self.count('error')}", f" * FAILURES: {self.count('failure')}"]
        return "\n".join(lines)

    def write(self, file: str | Path) -> None:
        """Write the results as JUnit XML. Raises ``OSError``."""
        counts = {"failures": "failure", "errors": "error", "skipped": "skipped"}
        numbers = {name: str(self.count(kind)) for name, kind in counts.items()}
        root = ET.Element("testsuite", {"name": "rostest", "tests": str(len(self.cases)), **numbers})
        for case in self.cases:
            written = ET.SubElement(root, "testcase", classname=case.classname, name=case.name)
            if case.kind:
                ET.SubElement(written, case.kind, message=case.text.strip().rpartition("\n")[2]).text = case.text
        Path(file).parent.mkdir(parents=True, exist_ok=True)
        ET.ElementTree(root).write(file, encoding="utf-8", xml_declaration=True)


def run_tests(
    plan: Plan,
    folder: Path,
    *,
    simulated: bool = True,
    packages: PackageIndex | None = None,
    say: Callable[[str], object] = lambda _: None,
) -> Results:
    """Run the tests of a plan one after another, each with all nodes of the plan in a new graph.

    Args:
        plan: the plan; without tests there are no results.
        folder: where each test writes its results file.
        simulated: use simulated time, which then applies to time limits; otherwise wall-clock time.
        packages: the packages.
        say: prints progress.

    """
    cases: list[Case] = []
    for number, test in enumerate(plan.tests, start=1):
        file = folder / f"rosunit-{number}-{test.test_name}.xml"
        for _ in range(test.retry + 1):
            found = _run_test(plan, test, file, simulated=simulated, packages=packages, say=say)
            if not any(case.kind in KINDS[:2] for case in found):
                break
        cases += found
    return Results(tuple(cases))


def _run_test(
    plan: Plan,
    test: TestPlan,
    file: Path,
    *,
    simulated: bool,
    packages: PackageIndex | None,
    say: Callable[[str], object],
) -> list[Case]:
    """Run a test once and read its results."""
    file.unlink(missing_ok=True)
    classname = f"{test.package}.rosunit-{test.test_name}"
    node = replace(test, args=f"{test.args} '--gtest_output=xml:{file}'", output="screen")
    with Graph(simulated=simulated, strict=False) as graph, _own_master(graph):
        launch = Launch(plan, graph, in_graph(graph, packages), say=say, warn=say)
        launch.start()
        made = launch.start_node(node)
        if made is None:
            return [Case(classname, test.test_name, "error", f"{test.executable} could not be started")]
        made.asked_to_end = True  # its end is no news
        graph.run(test.time_limit, until=lambda: made.handle.poll() is not None)
        code = made.handle.poll()
        launch.stop()
    if code is None:
        said = f"the test did not end within its time limit of {test.time_limit:g} s"
        return [Case(classname, test.test_name, "failure", said)]
    return _results_of(made, code, file, classname, test)


@contextmanager
def _own_master(graph: Graph) -> Iterator[None]:
    """Serve the graph's Master at a free port and set ``ROS_MASTER_URI``, as rostest does."""
    before = os.environ.get(MASTER_URI)
    graph.online("http://localhost:0", live=False)
    os.environ[MASTER_URI] = graph.master_uri
    try:
        yield
    finally:
        graph.offline()
        if before is None:
            del os.environ[MASTER_URI]
        else:
            os.environ[MASTER_URI] = before


def _results_of(made: Running, code: int, file: Path, classname: str, test: TestPlan) -> list[Case]:
    """Return the results that a test has written; without any, the result of its exit status."""
    if not is_file(file):
        text = "" if code == 0 else f"{made.name} ended with exit status {code}, and wrote no results"
        return [Case(classname, test.test_name, "failure" if code else "", text)]
    try:
        root = parse_file(file)
    except MarkupError as error:
        return [Case(classname, test.test_name, "error", f"its results cannot be read: {error}")]
    return [_case(element, classname) for element in root.walk() if element.tag == "testcase"]


def _case(element: Element, classname: str) -> Case:
    for kind in KINDS:
        found = element.find(kind)
        if found is not None:
            return Case(classname, element.get("name"), kind, found.text or found.get("message"))
    return Case(classname, element.get("name"))
