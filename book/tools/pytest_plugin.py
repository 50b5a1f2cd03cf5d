"""For pytest: the environment in which notebooks and tests run.

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
from typing import Any

import pytest

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


def pytest_configure(config: pytest.Config) -> None:
    """Set up the environment that the tests' processes inherit."""
    with suppress(ImportError):
        kernel = importlib.import_module("nbval.kernel")
        vars(kernel)["start_new_kernel"] = starting_twice(kernel.start_new_kernel)
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
