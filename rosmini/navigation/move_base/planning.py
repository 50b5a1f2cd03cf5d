"""The lane that runs the global planner on request, and alternatives to a goal that cannot be reached."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Any

from rosmini.core.graph import Node, Waiter

from .state_machine import StateMachine

STEP_CELLS = 3.0
"""Distance [cells] between the alternative goals that `make_plan` tries."""


def offsets_within(tolerance: float, resolution: float) -> Iterator[tuple[float, float]]:
    """Yield offsets (dx, dy) [m] from a goal, on squares that grow to `tolerance` [m], as in `make_plan`."""
    step = resolution * STEP_CELLS
    if 0 < tolerance < step:
        step = tolerance
    for ring in range(1, int(tolerance / step + 1e-9) + 1):
        for down, right in product(range(ring + 1), repeat=2):
            if max(down, right) < ring:
                continue
            for up, along in product((-1, 1) if down else (1,), (-1, 1) if right else (1,)):
                yield along * right * step, up * down * step


class PlannerLane:
    """Plans for `goal` while the state machine wants a plan: once, or `planner_frequency` times a second.

    `plan(goal)` returns the poses, or an empty plan. `stop()` is called when the planner's patience has run out.
    """

    def __init__(
        self, node: Node, machine: StateMachine, plan: Callable[[Any], Sequence[Any]], stop: Callable[[], object]
    ) -> None:
        self.node, self.machine = node, machine
        self._plan, self._stop = plan, stop
        self.goal: Any = None
        self.latest: Sequence[Any] | None = None
        """A plan that has not been taken yet."""
        self._waiter: Waiter | None = None
        node.spawn(f"{node.name} planner", self._run)

    def wake(self) -> None:
        """Plan immediately if the state machine wants a plan."""
        waiter, self._waiter = self._waiter, None
        if waiter is not None:
            waiter.wake()

    def take(self) -> Sequence[Any] | None:
        """Return the latest plan and forget it; None if there is no new one."""
        plan, self.latest = self.latest, None
        return plan

    def _sleep(self, timeout_ns: int | None) -> None:
        self._waiter = self.node.waiter("a goal to plan for")
        self.node.wait(self._waiter, timeout_ns=timeout_ns)

    def _run(self) -> None:
        pause: int | None = None
        while not self.node.is_shutdown():
            self._sleep(pause)
            pause = None
            if self.machine.wants_plan:
                pause = self._plan_once()

    def _plan_once(self) -> int | None:
        """Plan once; return the time [ns] until planning again, or None to wait for `wake`."""
        clock = self.node.clock
        start, goal = clock.now_ns(), self.goal
        plan = self._plan(goal)
        if goal is not self.goal:
            return 0  # another goal has preempted the one that the plan is for
        now = clock.now_ns()
        if plan:
            self.latest = plan
            self.machine.plan_found(now * 1e-9)
        elif self.machine.plan_failed(now * 1e-9):
            self._stop()
        frequency = self.machine.config.planner_frequency
        return max(0, start + round(1e9 / frequency) - now) if frequency > 0 else None
