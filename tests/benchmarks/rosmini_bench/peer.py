"""Real ROS as a peer: its own roscore on a free loopback port, and two processes that talk."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Sequence

SYSTEM_PYTHON = "/usr/bin/python3"
"""Debian's and Ubuntu's packages of ROS are for the system's own Python."""

NODE = Path(__file__).with_name("rospy_node.py")
TIMEOUT_S = 120
START_S = 40
ATTEMPTS = 3


def find_rospy() -> Rospy | None:
    """Return the real rospy with a running roscore, or None where it is not installed."""
    if shutil.which("roscore") is None or not Path(SYSTEM_PYTHON).exists():
        return None
    if subprocess.run([SYSTEM_PYTHON, "-c", "import rospy"], capture_output=True, check=False).returncode != 0:
        return None
    return Rospy(SYSTEM_PYTHON)


class Core:
    """A roscore on a free loopback port, and the environment of what runs beside it."""

    def __init__(self, roscore: Sequence[str]) -> None:
        self.home = Path(tempfile.mkdtemp(prefix="rosmini-bench-"))
        self.env = {
            **{
                key: value
                for key, value in os.environ.items()
                if key not in ("PYTHONPATH", "VIRTUAL_ENV", "PYTHONHOME", "PYTHONDONTWRITEBYTECODE")
            },
            # A virtual environment may hold programs of the same name (rospkg brings a rosversion).
            "PATH": os.pathsep.join(["/usr/bin", "/bin", os.environ.get("PATH", "")]),
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": str(self.home),
        }
        for _ in range(ATTEMPTS):
            port = _free_port()
            self.env["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
            self._core = subprocess.Popen(
                [*roscore, "-p", str(port)], env=self.env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
            )
            if self._answers(port):
                return
            self._stop()
        shutil.rmtree(self.home, ignore_errors=True)
        msg = (
            f"roscore did not answer in {ATTEMPTS} attempts of {START_S} s; try it by hand: "
            f"{' '.join(roscore)} -p 11399"
        )
        raise RosminiError(msg)

    def _answers(self, port: int) -> bool:
        """Wait until the Master answers.

        False if roscore ends first (somebody else took the port) or takes too long.
        """
        deadline = time.monotonic() + START_S
        while time.monotonic() < deadline and self._core.poll() is None:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    return True
            time.sleep(0.05)
        return False

    def close(self) -> None:
        """Stop roscore and remove its files."""
        self._stop()
        shutil.rmtree(self.home, ignore_errors=True)

    def _stop(self) -> None:
        self._core.terminate()
        try:
            self._core.wait(10)
        except subprocess.TimeoutExpired:
            self._core.kill()
            self._core.wait()


class Rospy(Core):
    """Real ROS: its roscore, and what is measured of two of its nodes."""

    def __init__(self, python: str) -> None:
        super().__init__(["roscore"])
        self.python = python

    def measure(self, function: str, *arguments: int, node: Path = NODE) -> float:
        """Run ``function`` of the script ``node`` in a listening and a talking process.

        Return the listener's figure.
        """
        words = [function, *(str(argument) for argument in arguments)]
        listener = self._start(node, "listener", words)
        talker = self._start(node, "talker", words)
        try:
            output, _ = listener.communicate(timeout=TIMEOUT_S)
            talker.communicate(timeout=TIMEOUT_S)
        except subprocess.TimeoutExpired as error:
            msg = f"the rospy peer of {function} took more than {TIMEOUT_S} s"
            raise RosminiError(msg) from error
        finally:
            for process in (listener, talker):
                process.kill()
                process.wait()
        if listener.returncode != 0:
            msg = f"the rospy peer of {function} failed:\n{output}"
            raise RosminiError(msg)
        return float(json.loads(output.splitlines()[-1]))

    def _start(self, node: Path, role: str, words: list[str]) -> subprocess.Popen[str]:
        command = [self.python, str(node), role, *words]
        return subprocess.Popen(
            command, env=self.env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8"
        )


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
