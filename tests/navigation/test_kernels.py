"""When the loops of navigation are compiled."""

import asyncio
import threading
from concurrent.futures import ThreadPoolExecutor

from rosmini import Graph
from rosmini.navigation import kernels


def test_simulated_time_compiles_nothing_ahead(monkeypatch):
    done = []
    monkeypatch.setattr(kernels, "compile_imported", lambda: done.append(True))
    with Graph() as graph:
        kernels.prepare(graph.node("planner"))
        graph.run(1)
    assert done == []


def test_in_real_time_a_node_waits_for_its_kernels_and_other_nodes_continue(monkeypatch):
    ticks, done = threading.Event(), []
    monkeypatch.setattr(kernels, "compile_imported", lambda: done.append(ticks.wait(60)))
    with Graph(simulated=False) as graph:
        graph.node("robot").timer(0.001, lambda event: ticks.set())
        planner = graph.node("planner")
        planner.spawn("set-up", lambda: kernels.prepare(planner))
        graph.run(until=lambda: done)
    assert done == [True]


def test_a_graph_that_becomes_live_compiles_before_time_passes(monkeypatch):
    times, ticked = [], asyncio.Event()

    def become_live():
        with Graph() as graph:
            planner = graph.node("planner")
            monkeypatch.setattr(kernels, "compile_imported", lambda: times.append(graph.now()))
            kernels.prepare(planner)
            graph.run(1)
            start = graph.now()
            planner.timer(0.001, lambda event: ticked.set())

            async def live():
                drive = graph.live()
                await ticked.wait()
                drive.stop()

            asyncio.run(live())
            return start

    with ThreadPoolExecutor(1) as pool:  # the browser's tests leave a running event loop in this thread
        start = pool.submit(become_live).result()
    assert times == [start]
