"""Command line tools without the time that importing them takes: run by the Python that they are for.

The argument is `real` for ROS's tools, `ours` for rosmini's. Each line of standard input is a JSON list: the words of
a command, the working folder, more environment, and the files for its standard streams. Each command runs in a process
of its own, forked from this one, by the function that the tool's script calls; the answer is its exit status.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import signal
import sys

MAINS = {"rosnode": "rosnodemain", "rostopic": "rostopicmain", "rosservice": "rosservicemain", "rosparam": "yamlmain"}
OURS = ["rosmini.tools.main", "rosmini.__main__", "rosmini.ros.net.online"]


def load(kind: str) -> None:
    """Import the tools of one kind."""
    for name in MAINS if kind == "real" else OURS:
        importlib.import_module(name)
    if kind == "ours":
        commands = sys.modules["rosmini.tools.main"].COMMANDS
        for name in [*MAINS, "rospack", "rosstack"]:
            commands[name].load()


def become(kind: str, words: list[str], cwd: str, env: dict[str, str], files: list[str]) -> None:
    """Be that tool. In the forked process, which ends if the tool hangs."""
    signal.alarm(300)
    for number, path in enumerate(files):
        flags = os.O_RDWR | os.O_CREAT | os.O_TRUNC if number else os.O_RDONLY
        os.dup2(os.open(path, flags, 0o600), number)
    os.chdir(cwd)
    os.environ.update(env)
    sys.argv = words
    if kind == "real":
        getattr(sys.modules[words[0]], MAINS[words[0]])(words)
    else:
        sys.argv = ["rosmini", *words]
        sys.exit(sys.modules["rosmini.__main__"].main())


def main() -> None:
    """Import the tools, and run what is asked for."""
    kind = sys.argv[1]
    load(kind)
    gc.collect()
    gc.freeze()  # no forked process copies the memory of the modules when it ends
    for line in sys.stdin:
        child = os.fork()
        if not child:
            become(kind, *json.loads(line))
            return
        _, status = os.waitpid(child, 0)
        print(os.waitstatus_to_exitcode(status), flush=True)


if __name__ == "__main__":
    main()
