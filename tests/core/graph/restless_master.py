"""A Master as over a bad network: each call takes its time, and some do not arrive, or their answers do not."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable
from rosmini.core.graph.master_port import MasterPort

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Graph

LONGEST_NS = 100_000_000
REPEATED = ("register", "unregister", "subscribe", "unsubscribe")
"""How the calls begin that a node repeats until they arrive."""


class RestlessMaster(MasterPort):
    """Stands between a graph and its Master; everything random follows from ``seed``.

    ``share`` of the calls fail: half of these arrive all the same. With ``any_call`` that holds for those, too, that
    nobody repeats, such as ``getParam``. The attributes are those of the true Master, for tests that look into it.
    """

    def __init__(self, graph: Graph, seed: int, *, share: float = 0.15, any_call: bool = False) -> None:
        self.uri = graph.master.uri
        self.behind = graph.master
        self.calls = 0
        self.lost = 0
        self._scheduler = graph.scheduler
        self._random = random.Random(seed)
        self._share = share
        self._any_call = any_call
        graph.master = self

    def __getattr__(self, name: str) -> Callable[..., Any]:
        return getattr(self.behind, name)

    def call(self, method: str, caller_id: str, *arguments: Any) -> list[Any]:
        """Park the caller on the way there and on the way back."""
        self.calls += 1
        may_fail = self._any_call or method.startswith(REPEATED)
        lost, answered = (self._random.random() < self._share / 2 for _ in range(2)) if may_fail else (0, 0)
        self._travel()
        if lost:
            raise self._no_answer()
        answer = self.behind.call(method, caller_id, *arguments)
        self._travel()
        if answered:
            raise self._no_answer()
        return answer

    def _travel(self) -> None:
        """Be under way for half of at most a tenth of a second."""
        span = self._random.randrange(LONGEST_NS // 2)
        self._scheduler.sleep_until(self._scheduler.now_ns() + span, "the Master's answer")

    def _no_answer(self) -> MasterUnreachable:
        self.lost += 1
        return MasterUnreachable(f"the Master at {self.uri} does not answer")
