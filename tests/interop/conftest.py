"""Real ROS 1, where the machine has it."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from ..conftest import required
from ..processes import free_port, listens, run, start, wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

SYSTEM_PYTHON = "/usr/bin/python3"
"""The Python that Debian's ROS is for."""

FORKED = Path(__file__).with_name("forked_tools.py")

FIND = "import sys; from importlib.util import find_spec; sys.exit(not all(map(find_spec, sys.argv[1:])))"
"""Looks for modules without their import, which takes half a second: each process of the tests asks several times."""


def need_ros(*programs: str, modules: str = "") -> None:
    """Skip where a program or a module of real ROS is missing; fail instead if ROSMINI_REQUIRE_ROS=1.

    Debian has a Python without ROS: a test that runs it names what it imports.
    """
    assert programs or modules
    missing = [program for program in (*programs, SYSTEM_PYTHON) if shutil.which(program) is None]
    if not missing and modules and run([SYSTEM_PYTHON, "-c", FIND, *modules.split(", ")]).returncode:
        missing = [modules]
    if missing:
        reason = f"there is no {', '.join(missing)} of real ROS 1"
        if required("ROS"):
            pytest.fail(f"{reason}, and ROSMINI_REQUIRE_ROS=1", pytrace=False)
        pytest.skip(reason, allow_module_level=True)


Ended = subprocess.CompletedProcess[str]

PYTHONS = {"real": SYSTEM_PYTHON, "ours": sys.executable}


class Tools:
    """ROS's command line tools and ours in one environment, imported once for many commands (`forked_tools`)."""

    def __init__(self, env: Mapping[str, str], folder: Path) -> None:
        self.env = env
        self.folder = folder
        self._stack = ExitStack()
        self._servers: dict[str, Any] = {}

    def __enter__(self) -> Tools:
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def real(self, line: str, **options: Any) -> Ended:
        """Run a command line with ROS's tool."""
        return self.run("real", shlex.split(line), **options)

    def ours(self, line: str, **options: Any) -> Ended:
        """Run a command line with our tool."""
        return self.run("ours", shlex.split(line), **options)

    def both(self, line: str, **options: Any) -> tuple[Ended, Ended]:
        """Run a command line with ROS's tool, then with ours."""
        return self.real(line, **options), self.ours(line, **options)

    def run(
        self,
        kind: str,
        words: list[str],
        *,
        stdin: str = "",
        cwd: Path | None = None,
        env: Mapping[str, str] | None = None,
    ) -> Ended:
        """Run the words of a command with the tools of one kind."""
        if kind not in self._servers:
            command = [PYTHONS[kind], FORKED, kind]
            server = start(command, env=self.env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=None)
            self._servers[kind] = self._stack.enter_context(server)
        server = self._servers[kind]
        streams = [self.folder / f"{kind}.{name}" for name in ("in", "out", "err")]
        streams[0].write_text(stdin, encoding="utf-8")
        request = [words, str(cwd or self.folder), dict(env or {}), list(map(str, streams))]
        server.stdin.write(json.dumps(request) + "\n")
        server.stdin.flush()
        status = int(server.stdout.readline())
        return Ended(words, status, *(path.read_text(encoding="utf-8") for path in streams[1:]))


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


@pytest.fixture(scope="module")
def tools(master: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tools]:
    """The tools at that Master."""
    with Tools(master, tmp_path_factory.mktemp("tools")) as found:
        yield found
