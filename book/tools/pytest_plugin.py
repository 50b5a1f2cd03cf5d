"""For pytest: the environment in which notebooks and tests run.

Notebooks run with the display form of the book, which is what their stored outputs hold. Nothing sees the variables of
a ROS that its user has set up (``source /opt/ros/noetic/setup.bash``, ``export TURTLEBOT3_MODEL=waffle``), so that
tests do not contact that user's Master.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from rosmini.viz.embed import BOOK, VARIABLE

OF_ROS = ("ROS_", "ROSLISP_", "TURTLEBOT3_")
"""How the names of variables begin that belong to a ROS on this machine."""


def pytest_configure() -> None:
    """Take the variables of the user's own ROS out of the environment; what tests start inherits it."""
    for name in [name for name in os.environ if name.startswith(OF_ROS)]:
        del os.environ[name]


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
