"""A graph that goes on by itself while cells, widgets and other threads talk to it."""

import re
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import pytest

from rosmini import Graph
from rosmini.core.graph import live as live_module
from rosmini.core.graph.live import LiveDrive


def live(kernel, code="drive = graph.live()"):
    return kernel.ok(code)


def test_a_live_graph_goes_on_between_cells_and_writes_into_the_cell_that_started_it(kernel):
    cell = live(kernel, "drive = graph.live()\ntimer = talker.timer(0.02, lambda event: pub.publish('tick'))")
    kernel.until(lambda: cell.stdout.count("heard tick") > 3, "ticks between cells")
    other = kernel.ok("pub.publish('mine'); listener.sleep(0.05)")  # a cell that blocks drives the graph itself
    assert "heard mine" in other.stdout
    kernel.ok("await asyncio.sleep(0.1)")
    before = cell.stdout.count("tick")
    kernel.until(lambda: cell.stdout.count("tick") > before + 3, "ticks after the other cells")
    stopped = kernel.ok("drive.stop()\nn = len(heard)\nawait asyncio.sleep(0.1)\nprint(len(heard) == n, graph.is_live)")
    assert stopped.stdout == "True False\n"


def test_a_widgets_message_reaches_a_live_graph(kernel):
    cell = live(
        kernel,
        """
def opened(comm, message):
    comm.on_msg(lambda message: pub.publish(message["content"]["data"]["word"]))
get_ipython().kernel.comm_manager.register_target("pad", opened)
drive = graph.live()
""",
    )
    kernel.comm("pad", kind="comm_open", comm_id="pad1")
    kernel.comm("pad", {"word": "from a widget"}, comm_id="pad1")
    kernel.until(lambda: "heard from a widget" in cell.stdout, "the message")
    kernel.comm("pad", {"word": "on a subshell"}, comm_id="pad1", subshell=kernel.subshell())
    kernel.until(lambda: "heard on a subshell" in cell.stdout, "the message")
    kernel.comm("pad", kind="comm_close", comm_id="pad1")


def test_an_error_of_a_callback_is_shown_once_and_stops_a_live_graph(kernel):
    kernel.ok("def broken(message):\n    1 / 0\nlistener.subscriber('chatter', String, broken)\nlistener.sleep(0.01)")
    cell = live(kernel)
    kernel.ok("pub.publish('x')")
    kernel.until(lambda: cell.errors, "the error")
    assert cell.errors == ["CallbackError"]
    assert "----> 2     1 / 0" in cell.tracebacks[0]
    assert "The live graph was stopped. Call live() to go on" in cell.tracebacks[0]
    assert "rosmini" not in cell.tracebacks[0]
    assert re.fullmatch(r"False <.* 1 s .*stopped>\n", kernel.ok("print(graph.is_live, drive)").stdout)
    kernel.ok("graph.strict = False")
    again = live(kernel)
    kernel.ok("pub.publish('y'); pub.publish('z')")
    kernel.until(lambda: "heard z" in again.stdout and again.stdout.count("broken of /listener") == 2, "the log")
    assert kernel.ok("print(graph.is_live); drive.stop()").stdout == "True\n"


def test_an_interrupt_between_cells_stops_a_live_graph_and_one_of_a_cell_does_not(kernel):
    cell = live(kernel)
    # Not one long sleep: Python loses a signal that comes between its last look and the system's sleep.
    busy = kernel.send("print('now', flush=True)\nwhile True:\n    time.sleep(0.01)")
    kernel.until(lambda: busy.stdout, "the start")
    kernel.interrupt()
    kernel.until(lambda: busy.idle, "the end")
    assert busy.errors == ["KeyboardInterrupt"]
    kernel.ok("pub.publish('still live')")
    kernel.until(lambda: "heard still live" in cell.stdout, "the message")
    kernel.interrupt()
    kernel.until(lambda: cell.stderr, "the notice")
    assert "interrupt" in cell.stderr and "live()" in cell.stderr and cell.stderr.count("\n") == 1
    assert kernel.ok("pub.publish('after'); graph.run(0.01); print(graph.is_live)").stdout == "heard after\nFalse\n"


def test_a_callback_that_hangs_in_a_live_graph_is_ended_by_two_interrupts(kernel):
    kernel.ok(
        """
def hang(message):
    while message.data == "hang":
        if graph.scheduler._interrupts.noted and "noted" not in heard:
            heard.append("noted")
            print("noted", flush=True)
listener.subscriber("chatter", String, hang)
listener.sleep(0.01)
"""
    )
    cell = live(kernel)
    kernel.ok("pub.publish('hang')")
    kernel.until(lambda: "heard hang" in cell.stdout, "the start")
    kernel.interrupt()
    kernel.until(lambda: "noted" in cell.stdout, "the first signal")
    kernel.interrupt()
    kernel.until(lambda: "stopped by an interrupt" in cell.stderr, "the end")
    assert kernel.ok("print(graph.is_live); graph.run(0.01);").stdout == "False\n"


def test_live_needs_an_event_loop():
    from rosmini import Graph
    from rosmini.core.errors import RosminiError

    def program():
        with Graph() as graph, pytest.raises(RosminiError, match="needs an event loop"):
            graph.live()

    # in a thread of its own: a browser's tests before this one leave a loop running in theirs
    with ThreadPoolExecutor(1) as pool:
        pool.submit(program).result()


CALLS = (
    "pub.publish('from a subshell')\nprint(add(1, 2).sum)\nstart = talker.now()\ntalker.sleep(0.05)\n"
    "print((talker.now() - start).to_sec() >= 0.05)"
)


@pytest.mark.parametrize("state", ["idle", "live", "driving", "busy"])
def test_calls_from_a_subshell_get_through(kernel, state):
    kernel.ok("talker.timer(0.01, lambda event: None)\nlistener.sleep(0.02)")  # a parked lane, as real graphs have
    busy = None
    if state == "live":
        live(kernel)
    elif state == "driving":
        busy = kernel.send("print('now', flush=True)\ngraph.run(until=lambda: 'done' in heard)")
    elif state == "busy":
        busy = kernel.send("gate = threading.Event()\nprint('now', flush=True)\ngate.wait()")
    if busy is not None:
        kernel.until(lambda: "now" in busy.stdout, "the start")
    subshell = kernel.subshell()
    cell = kernel.send(CALLS, subshell)
    if state == "busy":
        # The cell keeps the main thread and does not drive: the call says so, waits, and goes on after it.
        kernel.until(lambda: "does not drive" in cell.stderr, "the notice")
        kernel.run("gate.set()", kernel.subshell())
    kernel.until(lambda: cell.idle and cell.reply, "the end")
    assert cell.errors == []
    # Where nobody else drives, the blocking call is what drives, and gets the output.
    heard = "heard from a subshell\n" if state in ("idle", "busy") else ""
    assert cell.stdout == f"{heard}3\nTrue\n"
    if state == "driving":
        kernel.run("pub.publish('done')", subshell)
    if busy is not None:
        kernel.until(lambda: busy.idle, "the end of the other cell")
        assert busy.errors == []
    assert "from a subshell" in kernel.ok("print(heard)").stdout


def test_errors_and_endless_waits_of_a_subshell_end_there(kernel):
    subshell = kernel.subshell()
    cell = kernel.run("talker.wait_for_message('nothing', String, timeout=0.05)", subshell)
    assert cell.errors == ["ROSException"]
    cell = kernel.run("talker.service_client('nothing', AddTwoInts)(1, 2)", subshell)
    assert cell.errors == ["ServiceException"]
    kernel.ok("def broken(message):\n    1 / 0\nlistener.subscriber('chatter', String, broken)\nlistener.sleep(0.01)")
    cell = kernel.run("pub.publish('x')\ntalker.sleep(0.05)", subshell)  # the call that drives
    assert cell.errors == ["CallbackError"]
    assert kernel.ok("print(add(1, 2).sum)").stdout == "3\n"


@pytest.mark.parametrize("kernel", [True], indirect=True, ids=["simulated"])
def test_a_subshell_hears_that_nothing_can_happen_any_more(kernel):
    cell = kernel.run("talker.wait_for_message('nothing', String)", kernel.subshell())
    assert cell.errors == ["GraphEnded"]


def test_a_graph_that_a_widgets_thread_made_is_refused_to_cells_while_it_has_parked_lanes(kernel):
    subshell = kernel.subshell()
    made = kernel.run(
        "theirs = Graph(); node = theirs.node('n'); node.timer(0.1, lambda event: None); theirs.run(0.15);", subshell
    )
    assert made.errors == []
    cell = kernel.run("node.sleep(0.1)")
    assert cell.errors == ["RosminiError"]
    assert "Make the graph in a cell" in cell.tracebacks[0]
    kernel.run("theirs.shutdown()", subshell)


def test_a_cell_that_sleeps_by_itself_says_why_the_live_graph_stands_still(kernel):
    live(kernel)
    told = kernel.ok("import time\ntime.sleep(0.01)").stderr
    assert "the live graph stands still meanwhile" in told
    assert "graph.run(seconds)" in told
    assert kernel.ok("graph.run(0.01).reason").stderr == ""
    kernel.ok("drive.stop()\nawait asyncio.sleep(0.05)")
    assert kernel.ok("time.sleep(0.01)").stderr == ""


class SlowLoop:
    """An event loop with a wall clock of its own, which only the callbacks of a graph make go on."""

    def __init__(self):
        self.wall = 100.0
        self._calls = []

    def call_soon_threadsafe(self, callback):
        self.call_later(0.0, callback)

    def call_later(self, delay, callback):
        self._calls.append((self.wall + delay, callback))

    def run(self, seconds):
        end = self.wall + seconds
        while self.wall < end:
            when, callback = self._calls.pop(0)
            self.wall = max(self.wall, when)
            callback()


@pytest.mark.parametrize(("period", "cost"), [(0.4, 0.3), (0.01, 0.008)], ids=["drawings", "many callbacks"])
def test_a_live_graph_keeps_up_with_wall_time_while_callbacks_leave_it_enough(monkeypatch, period, cost):
    loop, stamps = SlowLoop(), []
    monkeypatch.setattr(live_module, "time", SimpleNamespace(perf_counter=lambda: loop.wall))
    with Graph() as graph:

        def draw(_event):
            stamps.append(graph.now().to_sec())
            loop.wall += cost

        graph.node("window").timer(period, draw)
        start = graph.now().to_sec()
        drive = LiveDrive(graph, loop)
        loop.run(10.0)
        drive.stop()
        assert graph.now().to_sec() - start == pytest.approx(10.0, abs=0.5)
        assert len(stamps) == pytest.approx(10.0 / period, rel=0.06)
