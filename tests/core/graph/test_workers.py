"""Where a scheduler's code runs: numpy may reuse the memory of large intermediate results there."""

from __future__ import annotations

import sys

from ...processes import run

LARGE = """
import numpy
from rosmini import Graph

square, row = numpy.ones((600, 600)), numpy.ones((1, 600))

def work(_):
    return (1.0 + 2.0 * row - 3.0 * square) / 0.05 + 1e-6

def nap():
    while not node.is_shutdown():
        graph.scheduler.sleep_until(graph.scheduler.now_ns() + 100_000_000)

with Graph() as graph:
    node = graph.node("node")
    node.timer(0.1, work)
    for number in range(5):
        node.spawn(f"nap {number}", nap)
    for _ in range(3):
        graph.run(1.0)
print("whole")
"""
"""Without `workers.DEEP` numpy reads below the bottom of a worker's stack, and the process ends by SIGSEGV."""


def test_large_intermediate_results_in_a_callback_do_no_harm():
    done = run([sys.executable, "-c", LARGE])
    assert (done.returncode, done.stdout) == (0, "whole\n"), done.stderr[-500:]
