"""Cells that block: where output and errors of callbacks appear, and what an interrupt and a restart leave behind."""

import os
import signal

import pytest


def test_a_cell_blocks_and_callbacks_run_meanwhile(kernel):
    assert kernel.ok("pub.publish('a'); report = graph.run(0.05); print(report.reason)").stdout == "heard a\ntime\n"
    assert kernel.ok("pub.publish('b'); talker.sleep(0.05)").stdout == "heard b\n"
    assert kernel.ok("print(add(1, 2).sum)").stdout == "3\n"
    kernel.ok("timer = talker.timer(0.02, lambda event: pub.publish('tick'), oneshot=True)")
    assert kernel.ok("print(listener.wait_for_message('chatter', String).data)").stdout.splitlines()[-1] == "tick"


def test_output_of_a_callback_that_was_parked_in_an_earlier_cell_goes_to_the_cell_that_drives(kernel):
    kernel.ok(
        """
import numpy
from IPython.display import display
def slow(message):
    with numpy.errstate(divide="ignore"):  # lives in the callback's own context variables
        for part in "ab":
            print("out", part)
            print("err", part, file=sys.stderr)
            display(part)
            listener.sleep(0.1)
slow_pub = talker.publisher("slow", String)
listener.subscriber("slow", String, slow)
slow_pub.wait_for_subscribers()
slow_pub.publish("x")
"""
    )
    for part in "ab":
        cell = kernel.ok("graph.run(0.1);")
        assert (cell.stdout, cell.stderr, cell.shown) == (f"out {part}\n", f"err {part}\n", [f"'{part}'"])
    assert kernel.ok("graph.run(0.1);").stdout == ""


def test_what_a_callback_raises_is_raised_in_the_driving_cell_with_the_users_lines_only(kernel):
    kernel.ok("def broken(message):\n    raise ValueError('oops')\nlistener.subscriber('chatter', String, broken);")
    cell = kernel.run("pub.publish('x')\ngraph.run(0.05)")
    assert cell.errors == ["CallbackError"]
    (shown,) = cell.tracebacks
    assert "----> 2     raise ValueError('oops')" in shown
    assert "----> 2 graph.run(0.05)" in shown
    assert "broken of /listener, called for /chatter, raised ValueError: oops" in shown
    assert 'data: "x"' in shown
    assert "rosmini" not in shown
    assert "interactiveshell" not in shown
    assert kernel.ok("graph.run(0.05);").errors == []


def test_what_a_nodes_own_task_raises_is_shown_without_the_schedulers_frames(kernel):
    cell = kernel.run("def task():\n    talker.sleep(0.01)\n    {}['key']\ntalker.run(task)\ngraph.run(0.1)")
    assert cell.errors == ["KeyError"]
    assert "----> 3     {}['key']" in cell.tracebacks[0]
    assert "rosmini" not in cell.tracebacks[0]


def test_an_error_inside_the_library_that_is_not_rosminis_keeps_its_place(shared_kernel):
    cell = shared_kernel.run(
        "from rosmini.core.errors import nearest, short_traceback\n"
        "try:\n    nearest(1, ['a'])\n"
        "except TypeError as error:\n    print(*short_traceback(error))"
    )
    assert "errors.py" in cell.stdout


def test_a_wait_that_times_out_names_the_line_of_the_cell(kernel):
    cell = kernel.run("talker.wait_for_message('nothing', String, timeout=0.05)")
    assert cell.errors == ["ROSException"]
    assert "nobody publishes it" in cell.tracebacks[0]
    assert cell.tracebacks[0].count("File ") == 0


BUSY = {
    "run": "graph.run(1000)",
    "sleep": "talker.sleep(1000)",
    "wait_for_message": "talker.wait_for_message('nothing', String)",
    "service": "listener.service('slow', AddTwoInts, lambda request: listener.sleep(1000))\n"
    "talker.service_client('slow', AddTwoInts)(1, 2)",
}

IN_THE_GRAPH = "talker.timer(0.01, lambda event: print('now', flush=True), oneshot=True)\n"
"""Says when the cell is driving the graph: an interrupt before that is an interrupt of ordinary Python code."""


@pytest.mark.parametrize("what", BUSY)
@pytest.mark.parametrize("kernel", [False], indirect=True, ids=["wall"])
def test_an_interrupt_ends_the_cell_and_leaves_the_graph_in_order(kernel, what):
    cell = kernel.send(IN_THE_GRAPH + BUSY[what])
    kernel.until(lambda: "now" in cell.stdout, "the start")
    kernel.interrupt()
    kernel.until(lambda: cell.idle, "the end")
    assert cell.errors == ["KeyboardInterrupt"]
    assert "rosmini" not in cell.tracebacks[0]
    assert kernel.ok("pub.publish('after'); graph.run(0.05); print(add(1, 2).sum)").stdout == "heard after\n3\n"


def test_an_interrupt_ends_a_run_that_is_busy_in_simulated_time(shared_kernel):
    shared_kernel.ok(
        "busy = Graph(); node = busy.node('busy')\nnode.timer(0.001, lambda event: print('.', end='', flush=True));"
    )
    cell = shared_kernel.send("busy.run()")
    shared_kernel.until(lambda: "." in cell.stdout, "the start")
    shared_kernel.interrupt()
    shared_kernel.until(lambda: cell.idle, "the end")
    assert cell.errors == ["KeyboardInterrupt"]
    assert shared_kernel.ok("busy.run(0.01).reason").shown == ["'time'"]
    shared_kernel.ok("busy.shutdown()")


def test_a_second_interrupt_ends_a_callback_that_does_not_come_back(kernel):
    kernel.ok(
        """
def hang(message):
    print("hung", flush=True)
    while message.data == "hang":
        if graph.scheduler._interrupts.noted and "noted" not in heard:
            heard.append("noted")
            print("noted", flush=True)
listener.subscriber("chatter", String, hang);
"""
    )
    cell = kernel.send("pub.publish('hang')\ngraph.run(0.1)")
    kernel.until(lambda: "hung" in cell.stdout, "the start")
    kernel.interrupt()
    kernel.until(lambda: "noted" in cell.stdout, "the first signal")
    assert not cell.idle
    kernel.interrupt()
    kernel.until(lambda: cell.idle, "the end")
    assert cell.errors == ["KeyboardInterrupt"]
    assert kernel.ok("pub.publish('after'); graph.run(0.05);").stdout == "heard after\nhung\n"


CELLS = [
    "graph = Graph()",
    "talker, listener = graph.node('talker'), graph.node('listener')\npub = talker.publisher('chatter', String)",
    "listener.subscriber('chatter', String, lambda message: print(message.data, listener.now()));",
    "talker.timer(0.1, lambda event: pub.publish(f'at {event.current_real.to_sec():.3f}'));",
    "graph.run(0.35)",
    "talker.wait_for_message('chatter', String)",
    "graph.node('x', anonymous=True).name",
]


def test_restart_and_run_all_gives_the_same_again_and_leaves_nothing(new_kernel):
    def run_all():
        cells = [new_kernel.ok(code) for code in CELLS]
        return [(cell.stdout, cell.stderr, cell.shown) for cell in cells]

    first = run_all()
    assert "at 1000.100" in first[4][0]
    new_kernel.ok("live = graph.live()")  # is on when the kernel ends
    new_kernel.ok("wall = Graph(simulated=False); wall.node('n').timer(0.01, lambda event: None);")
    process = new_kernel.manager.provisioner.process
    new_kernel.restart()
    assert process.poll() is not None
    new_kernel.ok("import time, sys\nfrom rosmini import Graph\nfrom rosmini.msgs.std_msgs.msg import String")
    assert run_all() == first
    # Two kernels count their cells alike, and a cell that is run again in one kernel sees a new graph.
    assert run_all() == first


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_a_kernel_that_is_asked_to_end_while_a_cell_drives_does_so(new_kernel):
    cell = new_kernel.send("graph = Graph(simulated=False)\nprint('now', flush=True)\ngraph.run(1000)")
    new_kernel.until(lambda: cell.stdout, "the start")
    pid = new_kernel.manager.provisioner.pid
    os.kill(pid, signal.SIGTERM)
    new_kernel.until(lambda: not new_kernel.manager.is_alive(), "the end")
