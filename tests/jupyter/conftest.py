"""A real kernel, and what its cells write, show and raise."""

from __future__ import annotations

import queue
import time
from contextlib import contextmanager
from dataclasses import dataclass, field

import pytest
from jupyter_client import KernelManager

from ..conftest import nightly
from ..processes import PATIENCE


@dataclass
class Cell:
    """What came back with one cell as its parent, in order."""

    id: str
    stdout: str = ""
    stderr: str = ""
    shown: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    tracebacks: list[str] = field(default_factory=list)
    idle: bool = False
    reply: dict | None = None


class Kernel:
    """A kernel with rosmini imported, and the cells that were sent to it."""

    def __init__(self):
        self.manager = KernelManager(kernel_name="python3")
        # Colours would stand in the middle of what the tests look for.
        self.manager.start_kernel(extra_arguments=["--InteractiveShell.colors=nocolor"])

    def connect(self):
        self.cells = {}  # a new client numbers its messages from one again
        self.client = self.manager.client()
        self.client.start_channels()
        self.client.wait_for_ready(timeout=PATIENCE)

    def restart(self):
        self.client.stop_channels()
        self.manager.restart_kernel()
        self.connect()

    def close(self):
        try:
            self.client.stop_channels()
        finally:
            self.manager.shutdown_kernel(now=True)

    def send(self, code, subshell=None):
        """Send a cell and do not wait for it."""
        message = self.client.session.msg(
            "execute_request",
            {"code": code, "silent": False, "store_history": True, "allow_stdin": False, "stop_on_error": False},
        )
        message["header"]["subshell_id"] = subshell
        self.client.shell_channel.send(message)
        return self._cell(message["header"]["msg_id"])

    def run(self, code, subshell=None):
        """Run a cell to its end."""
        cell = self.send(code, subshell)
        self.until(lambda: cell.idle and cell.reply is not None, f"the end of {code!r}, which wrote {cell}")
        return cell

    def ok(self, code):
        """Run a cell that must not raise."""
        cell = self.run(code)
        assert cell.errors == [], "\n".join(cell.tracebacks)
        return cell

    def comm(self, target, data=None, comm_id="c", kind="comm_msg", subshell=None):
        """Send a widget's message."""
        content = {"comm_id": comm_id, "data": data or {}}
        if kind == "comm_open":
            content["target_name"] = target
        message = self.client.session.msg(kind, content)
        message["header"]["subshell_id"] = subshell
        self.client.shell_channel.send(message)
        return self._cell(message["header"]["msg_id"])

    def subshell(self):
        """Start a subshell, as JupyterLab does for widgets."""
        message = self.client.session.msg("create_subshell_request", {})
        self.client.control_channel.send(message)
        reply = self.client.get_control_msg(timeout=PATIENCE)
        assert reply["content"]["status"] == "ok", reply
        return reply["content"]["subshell_id"]

    def interrupt(self):
        self.manager.interrupt_kernel()

    def until(self, condition, what):
        """Take messages until `condition()` holds."""
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, f"waited in vain for {what}"
            self._take()

    def _cell(self, message_id):
        return self.cells.setdefault(message_id, Cell(message_id))

    def _take(self):
        try:
            reply = self.client.get_shell_msg(timeout=0)
            self._cell(reply["parent_header"]["msg_id"]).reply = reply["content"]
        except queue.Empty:
            pass
        try:
            message = self.client.get_iopub_msg(timeout=0.05)
        except queue.Empty:
            return
        cell = self._cell(message["parent_header"].get("msg_id", "none"))
        content = message["content"]
        match message["msg_type"]:
            case "stream" if content["name"] == "stdout":
                cell.stdout += content["text"]
            case "stream":
                cell.stderr += content["text"]
            case "display_data" | "execute_result":
                cell.shown.append(content["data"].get("text/plain", ""))
            case "error":
                cell.errors.append(content["ename"])
                cell.tracebacks.append("\n".join(content["traceback"]))
            case "status":
                cell.idle = content["execution_state"] == "idle"


IMPORTS = """
import time, sys, threading, asyncio
from rosmini import Graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
"""

GRAPH = """
if "graph" in globals():
    graph.shutdown()
graph = Graph(simulated=SIMULATED)
talker, listener = graph.node("talker"), graph.node("listener")
pub = talker.publisher("chatter", String)
heard = []
def hear(message):
    heard.append(message.data)
    print("heard", message.data, flush=True)
subscriber = listener.subscriber("chatter", String, hear)
listener.service("add", AddTwoInts, lambda request: request.a + request.b)
add = talker.service_client("add", AddTwoInts)
pub.wait_for_subscribers()
"""


@contextmanager
def running():
    kernel = Kernel()
    try:
        kernel.connect()
        kernel.ok(IMPORTS)
        yield kernel
    finally:
        kernel.close()


@pytest.fixture
def new_kernel():
    """A kernel of the test's own."""
    with running() as kernel:
        yield kernel


@pytest.fixture(scope="module")
def shared_kernel():
    with running() as kernel:
        yield kernel


@pytest.fixture(params=[True, *nightly(False)], ids=["simulated", "wall"])
def kernel(request, shared_kernel):
    """The module's kernel with a new graph: `talker`, `listener`, `pub`, `add`, and what was `heard`."""
    shared_kernel.ok(GRAPH.replace("SIMULATED", str(request.param)))
    return shared_kernel
