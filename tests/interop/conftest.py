"""Real ROS 1, where the machine has it."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from ..conftest import required
from ..processes import free_port, listens, run, start, wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator

SYSTEM_PYTHON = "/usr/bin/python3"
"""The Python that Debian's ROS is for."""

FIND = "import sys; from importlib.util import find_spec; sys.exit(not all(map(find_spec, sys.argv[1:])))"
"""Looks for modules without their import, which takes half a second: each process of the tests asks several times."""


def need_ros(*programs: str, modules: str = "") -> None:
    """Skip where a program or a module of real ROS is missing; fail instead if ROSMINI_REQUIRE_ROS=1."""
    missing = [program for program in (*programs, SYSTEM_PYTHON) if shutil.which(program) is None]
    if not missing and modules and run([SYSTEM_PYTHON, "-c", FIND, *modules.split(", ")]).returncode:
        missing = [modules]
    if missing:
        reason = f"there is no {', '.join(missing)} of real ROS 1"
        if required("ROS"):
            pytest.fail(f"{reason}, and ROSMINI_REQUIRE_ROS=1", pytrace=False)
        pytest.skip(reason, allow_module_level=True)


@contextmanager
def rosmaster(home: Path) -> Iterator[dict[str, str]]:
    """A real Master of its own; yields the environment in which real nodes find it and write into `home` only."""
    port = free_port()
    found = {
        "PATH": f"/usr/bin:/bin:{os.environ['PATH']}",
        "HOME": str(home),
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
    }
    with start(["rosmaster", "--core", "-p", port], env=found) as process:
        wait_until(lambda: listens(port), "rosmaster", process)
        yield found


@pytest.fixture(scope="module")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The environment of a real Master; skips without real rospy."""
    need_ros("rosmaster", modules="rospy, sensor_msgs.srv, geometry_msgs.msg")
    with rosmaster(tmp_path_factory.mktemp("ros")) as found:
        yield found
