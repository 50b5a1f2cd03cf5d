import sys

import pytest

from rosmini.navigation.move_base.plugin_calls import PluginFault, call
from rosmini.navigation.nav_core import NoPath

traced = pytest.mark.skipif(sys.gettrace() is not None, reason="whoever measures coverage has the trace function")


class Mine:
    """What a reader may write."""

    def __init__(self, node):
        self.node = node

    def plan(self, x):
        return x + 1

    def works_long(self):
        return sum(i % 7 for i in range(100_000))

    def fails(self):
        raise NoPath("a wall")

    def raises(self):
        return list("ab")[2]

    def spins(self):
        while True:
            pass

    def recurses(self, n=0):
        for _ in range(2):
            self.recurses(n + 1) if n < 40 else None

    def sleeps(self, seconds):
        self.node.sleep(seconds)
        return "awake"


def asked(node, method, *arguments, budget=2.0):
    answers = []

    def ask():
        try:
            answers.append(call(node, "the planner mine/Mine", method, *arguments, budget=budget))
        except Exception as error:
            answers.append(error)

    node.spawn("asker", ask)
    node.graph.run(10.0)
    (answer,) = answers
    return answer


def test_it_returns(node):
    assert asked(node, Mine(node).plan, 3) == 4
    assert asked(node, Mine(node).works_long) == 299_995
    assert sys.gettrace() is None or "coverage" in sys.modules


def test_its_own_failures_come_through(node):
    assert isinstance(asked(node, Mine(node).fails), NoPath)


def test_what_it_raises_is_said_with_its_place(node):
    error = asked(node, Mine(node).raises)
    assert isinstance(error, PluginFault)
    assert "the planner mine/Mine raised IndexError: list index out of range (test_plugin_calls.py, line" in str(error)


@traced
def test_a_loop_without_end_is_ended(node):
    error = asked(node, Mine(node).spins, budget=0.2)
    assert isinstance(error, PluginFault)
    assert "has not returned after 200,000 loop iterations" in str(error)
    assert sys.gettrace() is None


@traced
def test_so_is_a_loop_of_calls(node):
    assert "loop iterations" in str(asked(node, Mine(node).recurses, budget=0.2))


def test_it_may_block_within_its_budget(node):
    assert asked(node, Mine(node).sleeps, 1.5) == "awake"
    error = asked(node, Mine(node).sleeps, 5.0)
    assert "did not return within 2 s, waiting for time to pass" in str(error)


def test_time_that_passes_is_the_graphs(node):
    before = node.clock.now_ns()
    asked(node, Mine(node).works_long)
    assert node.clock.now_ns() - before == 10_000_000_000
