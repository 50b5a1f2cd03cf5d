"""ROS's own command line tools without the half second that each takes to import them: run by the system's Python.

Each line of standard input is a JSON list: the words of a command, and the files for standard output and standard
error. Each command runs in a process of its own, forked from this one, by the function that the tool's script calls;
the answer is its exit status.
"""

from __future__ import annotations

import importlib
import json
import os
import sys

MAINS = {
    "rosnode": "rosnodemain",
    "rostopic": "rostopicmain",
    "rosservice": "rosservicemain",
    "rosparam": "yamlmain",
}


def run(words: list[str], out: str, err: str) -> None:
    """Become that tool. In the forked process."""
    for number, path in enumerate((os.devnull, out, err)):
        file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o600)
        os.dup2(file, number)
    sys.argv = words
    getattr(sys.modules[words[0]], MAINS[words[0]])(words)


def main() -> None:
    """Import the tools, and run what is asked for."""
    for name in MAINS:
        importlib.import_module(name)
    while line := os.read(0, 65536):
        words, out, err = json.loads(line)
        child = os.fork()
        if not child:
            run(words, out, err)
            return
        _, status = os.waitpid(child, 0)
        os.write(1, f"{os.WEXITSTATUS(status) if os.WIFEXITED(status) else -1}\n".encode())


if __name__ == "__main__":
    main()
