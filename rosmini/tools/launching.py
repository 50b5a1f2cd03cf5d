"""Launching in a terminal: a process for each node, a Master if none runs, and their shutdown."""

from __future__ import annotations

import os
import shlex
import socket
import subprocess
import sys
import time
import uuid
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, RosminiError
from rosmini.ros.introspection.direct import DirectWire

from .collector import seldom
from .roscore import port_number
from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    from collections.abc import Callable
    from optparse import Values

    from rosmini.core.graph import Graph
    from rosmini.core.packages import PackageIndex
    from rosmini.ros.launch.plan import NodePlan, Plan
    from rosmini.ros.launch.processes import Guard, ProcessHandle
    from rosmini.ros.launch.running import Running
    from rosmini.ros.net.addresses import Addresses

PAUSE_S = 0.05
"""Pause before the Master is polled again [s]."""

MASTER_S = 60.0
"""Timeout for an answer of the Master started here [s]."""


class Log:
    """Log file of this launch; everything printed is also written to it."""

    def __init__(self, run_id: str) -> None:
        home = Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")
        self.folder = Path(os.environ.get("ROS_LOG_DIR") or home / "log") / run_id
        self.home = home
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise RosminiError(
                f"unable to create directory for log file [{self.folder}]: {error.strerror}. Please set ROS_LOG_DIR to "
                "a folder that can be written"
            ) from error
        self.path = self.folder / f"roslaunch-{socket.gethostname()}-{os.getpid()}.log"
        self._file = self.path.open("w", encoding="utf-8", errors="backslashreplace")

    def say(self, text: str) -> None:
        """Print a message and write it to the log."""
        print(text, flush=True)
        self._write(text)

    def complain(self, text: str) -> None:
        """Print an error and write it to the log."""
        print(text, file=sys.stderr, flush=True)
        self._write(text)

    def _write(self, text: str) -> None:
        self._file.write(text + "\n")
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def launch(plan: Plan, given: Values, packages: PackageIndex) -> int:
    """Run a plan until its nodes have ended, or Ctrl-C; the exit status is 0, as in roslaunch."""
    from rosmini.ros.launch.processes import Guard
    from rosmini.ros.net.addresses import addresses

    end_as_ctrl_c()
    if given.port is not None:
        port = port_number(given.port)
        os.environ["ROS_MASTER_URI"] = f"http://{addresses().master[0]}:{port}"
    where = addresses()
    if given.wait_for_master:
        wait_for_master(where)
    run_id = asked(where, "getParam", "/run_id")
    log = Log(str(run_id or uuid.uuid1()))
    guard = Guard()
    try:
        with seldom():
            return run(plan, given, packages, where, log, guard)
    finally:
        guard.close()
        log.close()


def asked(where: Addresses, method: str, *arguments: object) -> Any:
    """Return the Master's answer, or None if it does not answer or refuses."""
    try:
        with DirectWire(where.master_uri) as wire:
            code, _, value = wire.ask_as("/roslaunch").call(method, *arguments)
    except MasterUnreachable:
        return None
    return value if code == 1 else None


def wait_for_master(where: Addresses) -> None:
    """Wait until a Master answers."""
    if asked(where, "getPid") is None:
        print("roscore/master is not yet running, will wait for it to start", flush=True)
        while asked(where, "getPid") is None:
            time.sleep(PAUSE_S)
    print("master has started, initiating launch", flush=True)


def run(plan: Plan, given: Values, packages: PackageIndex, where: Addresses, log: Log, guard: Guard) -> int:
    """Start everything, wait, and shut it down."""
    log.say(f"... logging to {log.path}\nPress Ctrl-C to interrupt")
    for line in where.notes:
        log.complain(f"rosmini: {line}")
    log.say(f"\n{plan.summary({'/rosdistro': 'noetic', '/rosversion': '1.16.0'})}\n")
    master = None
    if asked(where, "getPid") is None:
        master = start_master(where, log, guard)
    else:
        log.say(f"ROS_MASTER_URI={where.master_uri}\n")
    try:
        run_nodes(plan, given, packages, log, guard, first=2 if master is not None else 1)
    finally:
        if master is not None:
            end_master(master, log, guard)
    log.say("shutting down processing monitor...\n... shutting down processing monitor complete\ndone")
    return 0


def start_master(where: Addresses, log: Log, guard: Guard) -> subprocess.Popen[bytes]:
    """Start a Master and wait until it answers. Raises ``MasterUnreachable`` if its address is not this machine's."""
    from rosmini.ros.net.addresses import is_loopback

    host, port = where.master
    if not is_loopback(host) and host != where.host and host != socket.gethostname():
        raise MasterUnreachable(
            f"unable to contact ROS master at [{where.master_uri}], and it belongs on {host}: start roscore there. If "
            f"{host} is this machine, set ROS_HOSTNAME={host} (or ROS_IP to its address)"
        )
    log.say("auto-starting new master")
    with (log.folder / "master.log").open("wb") as output:
        process = subprocess.Popen(
            [sys.executable, "-m", "rosmini", "roscore", "-p", str(port)],
            stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
    guard.started(process.pid)
    log.say(f"process[master]: started with pid [{process.pid}]")
    deadline = time.monotonic() + MASTER_S
    while asked(where, "getPid") is None:
        if process.poll() is not None or time.monotonic() > deadline:
            said = (log.folder / "master.log").read_text(encoding="utf-8", errors="replace").strip()
            raise MasterUnreachable(f"the Master did not start at [{where.master_uri}]: {said}")
        time.sleep(PAUSE_S)
    log.say(f"ROS_MASTER_URI={where.master_uri}\n\nsetting /run_id to {log.folder.name}")
    asked(where, "setParam", "/run_id", log.folder.name)
    log.say(f"process[rosout-1]: started with pid [{process.pid}]\nstarted core service [/rosout]")
    return process


def end_master(process: subprocess.Popen[bytes], log: Log, guard: Guard) -> None:
    """Shut down the Master that was started here."""
    log.say("[rosout-1] killing on exit\n[master] killing on exit")
    with suppress(ProcessLookupError):
        process.terminate()
    try:
        process.wait(15.0)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    guard.ended(process.pid)


def run_nodes(plan: Plan, given: Values, packages: PackageIndex, log: Log, guard: Guard, *, first: int) -> None:
    """Start the nodes, wait until all have ended or Ctrl-C, and shut down the rest."""
    from rosmini.ros.launch.running import Launch
    from rosmini.ros.net import connect

    with connect() as graph:
        running = Launch(
            plan, graph, maker(plan, graph, packages, log, guard),
            say=log.say, warn=log.complain, first=first,
            sigint_timeout=given.sigint_timeout, sigterm_timeout=given.sigterm_timeout,
        )  # fmt: skip
        try:
            running.start()
            if not running.running:
                log.say("No processes to monitor")
            running.wait()
            if running.running and not running.ending:
                log.say("all processes on machine have died, roslaunch will exit")
            running.stop()
        except KeyboardInterrupt:
            with suppress(KeyboardInterrupt):
                running.stop()
        finally:
            running.kill()


def maker(
    plan: Plan, graph: Graph, packages: PackageIndex, log: Log, guard: Guard
) -> Callable[[NodePlan, str], Running]:
    """Return a function that creates the handles of nodes as processes."""
    from rosmini.ros.launch.executables import program
    from rosmini.ros.launch.processes import ProcessHandle, ProcessSpec, environment
    from rosmini.ros.launch.running import Running, log_base, on_machine

    def make(node: NodePlan, name: str) -> Running:
        if node.machine and not plan.machines[node.machine].is_local:
            raise RosminiError(on_machine(plan, node))
        found = program(node, packages, os.environ)
        base = log_base(log.folder, name)
        words = (*shlex.split(node.launch_prefix), *found.words, *node.words(), f"__log:={base}.log")
        output = None if node.output == "screen" else Path(f"{base}-stdout.log")
        environ = environment(os.environ, node.environment, node.namespace)
        spec = ProcessSpec(name, words, environ, folder_of(node, found.folder, log), output)
        handle: ProcessHandle = ProcessHandle(graph, spec, guard)
        return Running(name, node, handle, base)

    return make


def folder_of(node: NodePlan, executable: str, log: Log) -> str:
    """Return the folder in which a process runs: ROS_HOME, or as ``cwd`` says."""
    asked_for = (node.cwd or "").lower()
    if asked_for == "node":
        return executable
    if asked_for == "cwd":
        return os.getcwd()  # noqa: PTH109
    log.home.mkdir(parents=True, exist_ok=True)
    return str(log.home)
