"""For makers: the graph's tests on the restless Master with one seed after another.

``python -m tests.core.graph.restless_seeds 1-1000 [FILE]`` collects the tests once and runs them in a child for each
seed. It prints a line for each seed, and appends it to FILE: the seed, how many tests failed, and which. Seeds that
FILE has already are left out. Its status is not 0 if a test failed.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest

from . import conftest

HERE = Path(__file__).parent


class Seeds:
    """A plugin of pytest that runs what was collected once for each seed, each time in a child."""

    def __init__(self, seeds: range, rows: Path | None) -> None:
        self._seeds = seeds
        self._rows = rows
        self._failed: list[str] = []
        self._is_child = False

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note a failure."""
        if report.failed:
            self._failed.append(f"{report.nodeid.rpartition('::')[2]} ({report.when})")

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool | None:
        """Fork for each seed; a child goes on with pytest's own loop."""
        done = set()
        if self._rows is not None and self._rows.exists():
            done = {int(row.split()[0]) for row in self._rows.read_text(encoding="utf-8").splitlines()}
        for seed in self._seeds:
            if seed in done:
                continue
            child = os.fork()
            if child == 0:
                conftest.SEED = seed
                self._is_child = True
                return None
            _, status = os.waitpid(child, 0)
            session.testsfailed += status != 0
        return True

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """End a child, having told what failed."""
        if self._is_child:
            row = f"{conftest.SEED} {len(self._failed)} of {len(session.items)} failed {' '.join(self._failed)}\n"
            for fd in [1] if self._rows is None else [1, os.open(self._rows, os.O_WRONLY | os.O_APPEND | os.O_CREAT)]:
                os.write(fd, row.encode())
            os._exit(bool(self._failed))


def main(span: str, rows: str | None = None, *options: Any) -> None:
    """Run the seeds of a span such as ``1-1000``."""
    first, _, last = span.partition("-")
    seeds = Seeds(range(int(first), int(last or first) + 1), None if rows is None else Path(rows))
    sys.exit(
        pytest.main(
            [
                "-n0", "-q", "-p", "no:cacheprovider", "-m", "nightly", "-k", conftest.RESTLESS, str(HERE),
                # Importing the conftest has imported it before pytest could rewrite its asserts.
                "-W", "ignore::pytest.PytestAssertRewriteWarning", *options,
            ],
            [seeds],
        )
    )  # fmt: skip


if __name__ == "__main__":
    main(*sys.argv[1:])
