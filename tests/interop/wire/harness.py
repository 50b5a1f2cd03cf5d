"""What the tests of the wire start: Masters, nodes and tools, real ones and ours, each as a process of its own.

Nothing outlives its `Stage`: every child is told where it may write by ROS_HOME, a folder of this stage alone, and
what carries that in its environment is killed in the end, whoever started it (roslaunch gives its nodes sessions of
their own). Waits are for a line, or for a state of the Master.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import sys
import xmlrpc.client
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...processes import free_port, run, start, wait_until
from ..conftest import SYSTEM_PYTHON, Tools

if TYPE_CHECKING:
    import subprocess
    from collections.abc import Mapping, Sequence
    from types import TracebackType

PEER = Path(__file__).with_name("peer.py")
FORKED_TOOLS = {"rosnode", "rostopic", "rosservice", "rosparam"}
"""Tools that are imported once for many commands."""
ROSMINI = [sys.executable, str(PEER.with_name("ours.py"))]
PACKAGE = "wire_peers"
ALL_REAL = os.environ.get("ROSMINI_WIRE_ALL_REAL") == "1"
"""Real ROS in the place of ours everywhere: so one sees that the tests ask for what ROS does."""

MANIFEST = """<package format="2">
  <name>wire_peers</name><version>1.0.0</version><description>The tests' peers.</description>
  <maintainer email="nobody@example.com">nobody</maintainer><license>none</license>
</package>
"""


class Child:
    """A process whose output goes to a file: one may look at any time, and nothing fills up and blocks."""

    def __init__(self, name: str, process: Any, log: Path) -> None:
        self.name = name
        self.process = process
        self._log = log
        self._position = 0

    @property
    def output(self) -> str:
        """What it has written, to standard output and standard error."""
        return self._log.read_text(encoding="utf-8", errors="replace")

    @property
    def tail(self) -> str:
        """The last of what it has written."""
        return "\n".join(line[:500] for line in self.output.splitlines()[-25:])

    def wait_for(self, pattern: str, *, fresh: bool = False) -> re.Match[str]:
        """Wait until its output has a pattern; with `fresh`, after what the last `wait_for` found."""
        found: list[re.Match[str]] = []

        def there() -> bool:
            text = self.output
            one = re.search(pattern, text[self._position :] if fresh else text, re.MULTILINE)
            if one:
                found.append(one)
            return one is not None

        self.wait(there, f"{pattern!r} of {self.name}")
        self._position += found[0].end() if fresh else 0
        return found[0]

    def wait(self, condition: Any, what: str) -> None:
        """Wait until a condition holds that this process brings about; what it wrote is in the error."""
        try:
            wait_until(lambda: condition() or (self.process.poll() is not None and not condition()), what)
            if not condition():
                raise AssertionError(f"no {what}: its process ended with {self.process.returncode}")
        except AssertionError as error:
            raise AssertionError(f"{error}\n--- {self.name} wrote:\n{self.tail}") from None

    def send(self, number: int) -> None:
        """Send a signal to this process alone."""
        self.process.send_signal(number)

    def pause(self) -> None:
        """Stop it (SIGSTOP), and wait until it stands."""
        self.send(signal.SIGSTOP)
        wait_until(lambda: self._state() == "T", f"{self.name} to stand")

    def resume(self) -> None:
        """Let it go on (SIGCONT)."""
        self.send(signal.SIGCONT)

    def _state(self) -> str:
        stat = Path(f"/proc/{self.process.pid}/stat").read_text(encoding="utf-8")
        return stat.rpartition(") ")[2][0]

    def threads(self) -> int:
        """Return how many threads it has."""
        return len(os.listdir(f"/proc/{self.process.pid}/task"))

    def descriptors(self) -> int:
        """Return how many files and sockets it has open."""
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def kill(self) -> None:
        """Kill it, as `kill -9` does, and wait until it is gone."""
        self.send(signal.SIGKILL)
        self.process.wait()

    def interrupt(self) -> int:
        """Press Ctrl-C, wait until it has ended, and return its exit status."""
        self.send(signal.SIGINT)
        return self.ended()

    def ended(self) -> int:
        """Wait until it has ended; return its exit status."""
        try:
            wait_until(lambda: self.process.poll() is not None, f"the end of {self.name}")
        except AssertionError as error:
            raise AssertionError(f"{error}\n--- {self.name} wrote:\n{self.tail}") from None
        return int(self.process.returncode)


class Peer(Child):
    """A process of peer.py."""

    answers = 0
    is_ours = False
    is_busy = False
    """Whether the tests of a module have it publish and serve by itself already."""

    def ready(self) -> Peer:
        """Wait until its node has started. Harmless when repeated."""
        if self.answers:
            return self
        self.wait(self.has_answered, f"the start of {self.name}")
        answer = self._answer()
        self.node, self.uri = answer[1], answer[2]
        return self

    def ask(self, do: str, *arguments: Any, **options: Any) -> Any:
        """Tell it to do something and return the answer."""
        self.tell(do, *arguments, **options)
        return self._answer()

    def interrupt(self) -> int:
        """Press Ctrl-C; a real one that waits for a command ends at the end of its input."""
        self.send(signal.SIGINT)
        self.process.stdin.close()
        return self.ended()

    def tell(self, do: str, *arguments: Any, **options: Any) -> None:
        """Tell it to do something; `answer` has the answer."""
        self.process.stdin.write(json.dumps({"do": do, "with": arguments, **options}) + "\n")
        self.process.stdin.flush()

    def answer(self) -> Any:
        """Wait for the answer to the oldest command that has not been answered."""
        return self._answer()

    def has_answered(self) -> bool:
        """Whether there is an answer that nobody has asked for."""
        return len(self._answers()) > self.answers

    def _answers(self) -> list[str]:
        lines = self.output.splitlines(keepends=True)
        return [line for line in lines if line.startswith("@ ") and line.endswith("\n")]

    def _answer(self) -> Any:
        try:
            self.wait(self.has_answered, f"answer {self.answers} of {self.name}")
        except AssertionError as error:
            error.add_note(self._stacks())
            self.kill()  # it would answer the next test with what this one asked
            raise
        answer = json.loads(self._answers()[self.answers][2:])
        self.answers += 1
        if isinstance(answer, dict) and "raised" in answer:
            raise AssertionError(f"{self.name}: {answer['raised']}\n--- it wrote:\n{self.tail}")
        return answer

    def _stacks(self) -> str:
        """What its threads do, and its lanes if it is one of ours."""
        before = len(self.output)
        for number in (signal.SIGUSR1, signal.SIGUSR2) if self.is_ours else (signal.SIGUSR1,):
            written = len(self.output)
            self.send(number)
            with suppress(AssertionError):
                wait_until(lambda written=written: len(self.output) > written, "its stacks", self.process, patience=5.0)
        return f"--- {self.name} is at:\n{self.output[before:]}"


class Stage:
    """A folder, an environment, and the processes that run in it; `with` ends them all."""

    def __init__(self, home: Path, port: int | None = None, host: str = "127.0.0.1") -> None:
        self.home = home
        self.host = host
        self.port = port or free_port()
        self.children: list[Child] = []
        self.pair: dict[str, Peer] = {}
        """The two peers that the tests of a module share."""
        self._stack = ExitStack()
        self._packages = home / "packages"
        self.marker = str(home / ".ros")
        (home / ".ros").mkdir()
        self._tools = self._stack.enter_context(Tools(self.environment(), home))
        self.add_package()

    @property
    def uri(self) -> str:
        """The address of the Master."""
        return f"http://{self.host}:{self.port}/"

    def environment(self, **more: str) -> dict[str, str]:
        """A clean environment: nothing of the machine's ROS, nothing written outside of the stage's folder."""
        found = {
            "PATH": "/usr/bin:/bin",
            "HOME": str(self.home),
            "TMPDIR": str(self.home),
            "LANG": "C.UTF-8",
            "ROS_MASTER_URI": self.uri,
            "ROS_IP": self.host,
            "ROS_HOME": self.marker,
            "ROS_LOG_DIR": str(self.home / "log"),
            "ROS_PACKAGE_PATH": str(self._packages),
            "PYTHONUNBUFFERED": "1",
            "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
        }
        for name in ("COVERAGE_PROCESS_START", "COVERAGE_PROCESS_CONFIG", "NUMBA_CACHE_DIR"):
            if name in os.environ:
                found[name] = os.environ[name]
        return found | more

    def add_package(self) -> None:
        """Make a package with peer.py in it, which real tools and ours find on ROS_PACKAGE_PATH."""
        scripts = self._packages / PACKAGE / "scripts"
        scripts.mkdir(parents=True)
        (scripts.parent / "package.xml").write_text(MANIFEST, encoding="utf-8")
        shutil.copy(PEER, scripts / "peer.py")
        (scripts / "peer.py").chmod(0o755)

    # ---- processes ----

    def start(
        self,
        name: str,
        words: list[Any],
        env: Mapping[str, str] | None = None,
        kind: type[Child] = Child,
        within: list[str] | None = None,
    ) -> Any:
        """Start a program; `within` are words before it that say where (a network namespace)."""
        log = self.home / f"{len(self.children):02}_{name}.out"
        with log.open("wb") as out:
            process: subprocess.Popen[str] = self._stack.enter_context(
                start(
                    [*(within or []), *words],
                    env=self.environment(**(env or {})),
                    stdin=-1,
                    stdout=out,
                    stderr=out,
                    cwd=self.home,
                )
            )
        child = kind(name, process, log)
        self.children.append(child)
        return child

    def peer(self, kind: str, name: str, *arguments: str, within: list[str] | None = None, **env: str) -> Peer:
        """Start peer.py with real rospy ("real") or with ours ("ours"), as the node `name`."""
        words: list[Any] = [*arguments, f"__name:={name}"]
        if kind == "real" or ALL_REAL:
            words = [SYSTEM_PYTHON, PEER, *words]
        else:
            words = [*ROSMINI, "rosrun", PACKAGE, "peer.py", *words]
        child: Peer = self.start(name, words, env, Peer, within)
        child.is_ours = words[0] == ROSMINI[0]
        return child

    def roscore(self, kind: str, *arguments: str, within: list[str] | None = None, **env: str) -> Child:
        """Start a real roscore or ours, and wait until its Master answers and /rosout is there.

        With --core there is only the Master, which real ROS has as a program of its own.
        """
        real = "/usr/bin/rosmaster" if "--core" in arguments else "/usr/bin/roscore"
        words = [real] if kind == "real" or ALL_REAL else [*ROSMINI, "roscore"]
        child: Child = self.start(f"roscore_{kind}", [*words, "-p", self.port, *arguments], env, within=within)
        if not within:
            child.wait(self.has_rosout if "--core" not in arguments else self.answers, "a Master")
        return child

    def second_roscore(self, kind: str) -> Child:
        """Start another one at the same port."""
        words = ["/usr/bin/roscore"] if kind == "real" or ALL_REAL else [*ROSMINI, "roscore"]
        child: Child = self.start(f"second_{kind}", [*words, "-p", self.port])
        return child

    def tool(self, *words: Any) -> str:
        """Run one of ROS's tools, or another program, to its end and return what it wrote; it has to succeed."""
        return self._succeed("real", [str(word) for word in words])

    def our_tool(self, *words: Any) -> str:
        """Run one of our tools."""
        return self._succeed("ours", [str(word) for word in words])

    def _succeed(self, kind: str, words: list[str]) -> str:
        if words[0] in FORKED_TOOLS:
            done = self._tools.run(kind, words)
        else:
            done = run(words if kind == "real" else [*ROSMINI, *words], env=self.environment(), cwd=self.home)
        assert done.returncode == 0, f"{words} ended with {done.returncode}:\n{done.stdout}\n{done.stderr}"
        return done.stdout

    def play(self, words: list[Any], topic: str, listeners: Sequence[Peer]) -> Child:
        """Play a bag that has /gate, too, by a program that waits for subscribers of all topics.

        /gate has none before that program sends the topic to all listeners.
        """
        child: Child = self.start("play", words)
        child.wait(lambda: self.who(topic, "publishers"), f"a player of {topic}")
        (player,) = self.who(topic, "publishers")
        for listener in listeners:
            self.wait_until_sent(topic, player, listener.node)
        listeners[0].ask("subscribe", "/gate", "std_msgs/Int32")
        return child

    # ---- the Master ----

    def master(self, method: str, *arguments: Any) -> Any:
        """Return the value of the Master's answer; None if the code is not 1."""
        with xmlrpc.client.ServerProxy(self.uri) as proxy:
            code, _, value = getattr(proxy, method)("/test", *arguments)  # type: ignore[misc, str-unpack]
        return value if code == 1 else None

    def answers(self) -> bool:
        """Whether the Master answers."""
        try:
            return self.master("getPid") is not None
        except (OSError, xmlrpc.client.Error):
            return False

    def has_rosout(self) -> bool:
        """Whether the Master answers and /rosout subscribes."""
        return self.answers() and "/rosout" in self.who("/rosout", "subscribers")

    def who(self, name: str, role: str) -> list[str]:
        """Return who publishes or subscribes to a topic, or serves a service."""
        table = self.master("getSystemState")[("publishers", "subscribers", "services").index(role)]
        return sorted(next((nodes for topic, nodes in table if topic == name), []))

    def nodes(self) -> set[str]:
        """Return the names of all nodes that the Master knows."""
        return {name for table in self.master("getSystemState") for _, names in table for name in names}

    def wait_for(self, name: str, role: str, *nodes: str) -> None:
        """Wait until these nodes, and no others, publish, subscribe to or serve something."""
        try:
            wait_until(lambda: self.who(name, role) == sorted(nodes), f"{nodes} as {role} of {name}")
        except AssertionError as error:
            raise AssertionError(f"{error}; there are {self.who(name, role)}") from None

    def wait_until_sent(self, topic: str, node: str, listener: str) -> None:
        """Wait until a node sends what it publishes on a topic to another one."""

        def is_sent() -> bool:
            with xmlrpc.client.ServerProxy(self.master("lookupNode", node)) as slave:
                rows: Any = slave.getBusInfo("/test")[2]  # type: ignore[index]
            return any((row[1], row[2], row[4]) == (listener, "o", topic) for row in rows)

        wait_until(is_sent, f"{node} to send {topic} to {listener}")

    def wait_until_heard(self, prefix: str, topics: list[str]) -> None:
        """Wait until the only node whose name begins so has got messages on all of these topics."""
        names: set[str] = set()

        def has_heard() -> bool:
            names.update(name for name in self.nodes() if name.startswith(prefix))
            if not names:
                return False
            (name,) = names
            with xmlrpc.client.ServerProxy(self.master("lookupNode", name)) as slave:
                answer: Any = slave.getBusStats("/test")
            _, subscribed, *_ = answer[2] if answer[0] == 1 else answer  # roscpp's has no code
            size = {topic: sum(link[1] for link in links) for topic, links in subscribed}
            return all(size.get(topic) for topic in topics)

        wait_until(has_heard, f"messages on {topics}")

    # ---- the end ----

    def __enter__(self) -> Stage:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.close()
        for pid in self.survivors():
            self.kill(pid)

    def kill(self, pid: int) -> None:
        """Kill one of `survivors`."""
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)

    def survivors(self) -> list[int]:
        """Return the processes that carry this stage's ROS_HOME in their environment."""
        found = []
        for path in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if f"ROS_HOME={self.marker}\0".encode() in (path / "environ").read_bytes():
                    found.append(int(path.name))
        return found
