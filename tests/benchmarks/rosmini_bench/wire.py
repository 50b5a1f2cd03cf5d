"""What is measured of the wire: topics and services between processes, the Master, the tools, and a node's memory.

Our nodes and rospy's run the same script (`wire_node.py`), each under the roscore of their own kind.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
import xmlrpc.client
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.msgs import message_class, service_class
from rosmini.ros.net import connect

from . import Measure
from .peer import SYSTEM_PYTHON, TIMEOUT_S, Core

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from .peer import Rospy

NODE = Path(__file__).with_name("wire_node.py")
PACKAGE = "rosmini_bench_wire"
MANIFEST = f"""<package format="2">
  <name>{PACKAGE}</name><version>1.0.0</version><description>The nodes of rosmini bench.</description>
  <maintainer email="nobody@example.com">nobody</maintainer><license>none</license>
</package>
"""
ROSMINI = [sys.executable, "-m", "rosmini"]
TOPICS = [
    *(f"/bench/{kind}{way}" for kind in ("string", "scan", "image") for way in ("", "/echo")),
    "/bench/string/queued",
]
FAN = "/bench/string/fan"
LISTENERS = 10
NODES = 100


class Process:
    """A process of `wire_node.py`."""

    def __init__(self, words: list[str], env: dict[str, str]) -> None:
        self._process = subprocess.Popen(
            words, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8"
        )

    def answer(self) -> float:
        """Wait for its next answer. Raises ``RosminiError`` when it failed."""
        out = self._process.stdout
        if out is None:
            raise RosminiError("this process has no output")
        for line in out:
            if line.startswith("@ "):
                answer = json.loads(line[2:])
                if isinstance(answer, str):
                    raise RosminiError(f"no figure of the wire: {answer}")
                return float(answer)
        raise RosminiError("a node of the wire's benchmark ended; run it by hand: rosmini rosrun, wire_node.py")

    def ask(self, **command: Any) -> float:
        """Tell it to do something and wait for the answer."""
        if self._process.stdin is not None:
            self._process.stdin.write(json.dumps(command) + "\n")
            self._process.stdin.flush()
        return self.answer()

    def leave(self) -> None:
        """Ask it to end: its input ends, and with it what it does."""
        if self._process.stdin is not None:
            self._process.stdin.close()
            self._process.stdin = None

    def close(self) -> None:
        """End it, and wait for its end."""
        self.leave()
        try:
            self._process.communicate(timeout=TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.communicate()


class Side:
    """A roscore and nodes of one kind, ours or rospy's; what is not needed is not started."""

    def __init__(self, core: Core, node: list[str], tool: list[str], env: dict[str, str]) -> None:
        self.core = core
        self._node = node
        self._tool = tool
        self._env = env
        self._processes: list[Process] = []
        self._talker: Process | None = None
        self._listeners = 0
        self.megabytes = 0.0

    def close(self) -> None:
        """End its nodes; the roscore is its maker's to end."""
        for process in self._processes:
            process.leave()
        for process in self._processes:
            process.close()

    def _start(self, *words: str) -> Process:
        process = Process([*self._node, *words], self._env)
        self._processes.append(process)
        return process

    @property
    def talker(self) -> Process:
        """The talker; it and its listener are started when they are first needed."""
        if self._talker is None:
            self._start("listener", *TOPICS).answer()
            self._talker = self._start("talker")
            self.megabytes = self._talker.ask(do="ready")
        return self._talker

    def memory(self) -> float:
        """Return how many megabytes a process with one node has held at most, when it has just started."""
        return self.megabytes if self.talker else 0.0

    def throughput(self, topic: str, count: int, queue_size: int | None = None) -> float:
        """Return messages a second."""
        return self.talker.ask(do="throughput", topic=topic, count=count, queue_size=queue_size)

    def fan_out(self, count: int) -> float:
        """Return messages a second at all listeners together."""
        starting = [self._start("listener", FAN) for _ in range(LISTENERS - self._listeners)]
        for listener in starting:
            listener.answer()
        self._listeners = LISTENERS
        return self.talker.ask(do="throughput", topic=FAN, count=count, listeners=LISTENERS)

    def latency(self, topic: str, count: int) -> float:
        """Return microseconds."""
        return self.talker.ask(do="latency", topic=f"{topic}/echo", count=count)

    def calls(self, count: int, *, persistent: bool) -> float:
        """Return calls of a service a second."""
        return self.talker.ask(do="calls", count=count, persistent=persistent)

    def registrations(self) -> float:
        """Return the seconds in which the Master registers and forgets 100 nodes: the client is always the same."""
        begin = time.perf_counter()
        uri = self._env["ROS_MASTER_URI"]
        for number in range(NODES):
            with xmlrpc.client.ServerProxy(uri) as master:
                node, at = f"/bench{number}", f"http://127.0.0.1:{number + 1}/"
                to: Any = master
                answers = [
                    to.registerService(node, f"{node}/service", f"rosrpc://127.0.0.1:{number + 1}", at),
                    to.registerPublisher(node, f"{node}/topic", "std_msgs/String", at),
                    to.registerSubscriber(node, f"{node}/inbox", "std_msgs/String", at),
                    to.unregisterService(node, f"{node}/service", f"rosrpc://127.0.0.1:{number + 1}"),
                    to.unregisterPublisher(node, f"{node}/topic", at),
                    to.unregisterSubscriber(node, f"{node}/inbox", at),
                ]
            if any(answer[0] != 1 for answer in answers):
                raise RosminiError(f"the Master refused a registration: {answers}")
        return time.perf_counter() - begin

    def tool(self) -> float:
        """Return the seconds that `rostopic list` takes; not the first time, which compiles it."""
        seconds = 0.0
        for _ in range(2):
            begin = time.perf_counter()
            subprocess.run([*self._tool, "list"], env=self._env, check=True, stdout=subprocess.DEVNULL)
            seconds = time.perf_counter() - begin
        return seconds


def nodes_join(core: Core) -> float:
    """Return the seconds in which 100 nodes of one process of ours join a Master, with a topic and a service each."""
    string = message_class("std_msgs/String")
    trigger = service_class("std_srvs/Trigger")
    with connect(core.env) as graph:
        begin = time.perf_counter()
        for number in range(NODES):
            node = graph.node(f"bench{number}")
            node.publisher("~topic", string)
            node.service("~service", trigger, lambda _: None)
        return time.perf_counter() - begin


def ours(stack: ExitStack) -> Side:
    """Return our side; what it starts is ended with the stack."""
    core = Core([*ROSMINI, "roscore"])
    stack.callback(core.close)
    packages = core.home / "packages"
    scripts = packages / PACKAGE / "scripts"
    scripts.mkdir(parents=True)
    (scripts.parent / "package.xml").write_text(MANIFEST, encoding="utf-8")
    shutil.copy(NODE, scripts / NODE.name)
    (scripts / NODE.name).chmod(0o755)
    side = Side(
        core,
        [*ROSMINI, "rosrun", PACKAGE, NODE.name],
        [*ROSMINI, "rostopic"],
        {**core.env, "ROS_PACKAGE_PATH": str(packages)},
    )
    stack.callback(side.close)
    return side


def theirs(rospy: Rospy, stack: ExitStack) -> Side:
    """Return rospy's side; its nodes are ended with the stack."""
    side = Side(rospy, [SYSTEM_PYTHON, str(NODE)], ["rostopic"], rospy.env)
    stack.callback(side.close)
    return side


def measures(rospy: Rospy | None, scale: float, stack: ExitStack) -> Iterator[Measure]:
    """Yield everything that is measured; what has to be stopped goes to the stack."""
    mine = ours(stack)
    peer = None if rospy is None else theirs(rospy, stack)

    def both(name: str, unit: str, run: Callable[[Side], float], *, more: bool = True) -> Measure:
        return Measure(
            f"wire: {name}", unit, lambda: run(mine), None if peer is None else lambda: run(peer), more_is_better=more
        )

    def times(count: int) -> int:
        return max(int(count * scale), 1)

    if sys.platform != "win32":
        yield both("memory of a node's process", "MB", Side.memory, more=False)
    yield both("String of 100 bytes", "messages/s", lambda side: side.throughput("/bench/string", times(100_000)))
    yield both(
        "String of 100 bytes, queue_size=5000",
        "messages/s",
        lambda side: side.throughput("/bench/string/queued", times(100_000), 5000),
    )
    yield both("LaserScan of 360 beams", "messages/s", lambda side: side.throughput("/bench/scan", times(20_000)))
    yield both("image of 1 MB", "MB/s", lambda side: side.throughput("/bench/image", times(1_000)))
    yield both(f"String of 100 bytes to {LISTENERS} processes", "messages/s", lambda side: side.fan_out(times(20_000)))
    for kind, what in (
        ("string", "String of 100 bytes"),
        ("scan", "LaserScan of 360 beams"),
        ("image", "image of 1 MB"),
    ):
        yield both(
            f"{what}, latency, median at 100 Hz",
            "us",
            lambda side, kind=kind: side.latency(f"/bench/{kind}", times(300)),  # type: ignore[misc]
            more=False,
        )
    yield both(
        "service calls of a persistent client", "calls/s", lambda side: side.calls(times(10_000), persistent=True)
    )
    yield both("service calls, a connection each", "calls/s", lambda side: side.calls(times(500), persistent=False))
    yield both(f"the Master registers and forgets {NODES} nodes", "s", Side.registrations, more=False)
    yield Measure(f"wire: {NODES} nodes of one process join", "s", lambda: nodes_join(mine.core), more_is_better=False)
    yield both("rostopic list", "s", Side.tool, more=False)
