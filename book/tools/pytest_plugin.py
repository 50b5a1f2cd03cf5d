"""For pytest: the environment in which notebooks and tests run, and a measurement of the notebooks (`--costs`).

Notebooks run with the display form of the book, as their stored outputs do. Nothing sees the variables of
a ROS that its user has set up (``source /opt/ros/noetic/setup.bash``, ``export TURTLEBOT3_MODEL=waffle``), so that
tests do not contact that user's Master. ``PYTHONDONTWRITEBYTECODE`` only keeps compiled modules out of the checkout.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from book.tools import costs
from rosmini.viz.embed import BOOK, VARIABLE

OF_ROS = ("ROS_", "ROSLISP_", "TURTLEBOT3_")
"""How the names of variables begin that belong to a ROS on this machine."""


def starting_twice(start: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that starts a kernel, a second time if it dies at once.

    jupyter_client finds free ports and releases them before the kernel takes them: another process can be faster.
    """

    def started(*arguments: Any, **options: Any) -> Any:
        try:
            return start(*arguments, **options)
        except RuntimeError:
            return start(*arguments, **options)

    return started


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option `--costs`. CI sets the variable instead, because it runs the README's command unchanged."""
    file = os.environ.pop("ROSMINI_COSTS", None)  # not for the pytests that tests start
    parser.addoption(
        "--costs", metavar="FILE", default=file, help="write time, memory and size of each notebook to FILE"
    )


def pytest_configure(config: pytest.Config) -> None:
    """Set up the environment that the tests' processes inherit."""
    with suppress(ImportError):
        kernel = importlib.import_module("nbval.kernel")
        vars(kernel)["start_new_kernel"] = starting_twice(kernel.start_new_kernel)
    if config.getoption("costs") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(CostWriter(config))
    for name in [name for name in os.environ if name.startswith(OF_ROS)]:
        del os.environ[name]
    # Hundreds of processes start here, and a kernel that has to compile all modules takes three times as long.
    if "PYTHONDONTWRITEBYTECODE" in os.environ and config.pluginmanager.has_plugin("cacheprovider"):
        del os.environ["PYTHONDONTWRITEBYTECODE"]
        os.environ["PYTHONPYCACHEPREFIX"] = str(config.cache.mkdir("bytecode"))
        sys.dont_write_bytecode, sys.pycache_prefix = False, os.environ["PYTHONPYCACHEPREFIX"]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Set `ROSMINI_DISPLAY=book` around a cell of a notebook: nbval starts the kernel when it sets up the first."""
    if item.path.suffix != ".ipynb":
        return (yield)
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = BOOK
    try:
        return (yield)
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Measure a notebook's kernel after the last cell, before nbval stops it."""
    manager = getattr(getattr(item.parent, "kernel", None), "km", None)
    if manager and (nextitem is None or nextitem.parent is not item.parent):
        item.user_properties.append(("cost", costs.of_process(manager.provisioner.pid)))


class CostWriter:
    """Collects the measured costs of notebooks, in the process that receives all reports, and writes them."""

    def __init__(self, config: pytest.Config) -> None:
        self._file, self._root = Path(config.getoption("costs")), config.rootpath
        self._chapters: dict[str, dict[str, float]] = {}

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the cost that comes with the report of a notebook's end."""
        properties: dict[str, Any] = dict(report.user_properties)
        if report.when == "teardown" and (cost := properties.get("cost")):
            name = report.nodeid.partition(".ipynb::")[0]
            self._chapters[name] = costs.of_files(self._root, name) | cost

    def pytest_sessionfinish(self, exitstatus: int) -> None:
        """Write the file if all tests have passed."""
        if exitstatus == pytest.ExitCode.OK:
            costs.write(self._file, self._chapters)
