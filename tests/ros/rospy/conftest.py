"""A graph in each clock, and programs: functions that use rospy as a script of their own would."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from rosmini import Graph, set_default_graph

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


WALL_RATE = 10.0
"""How much faster than the clock wall time goes here."""


class Program:
    """A script's context, as far as rospy looks at it."""

    def __init__(self, graph: Graph, main: Callable[[], object], argv: list[str]) -> None:
        self.argv = argv
        self.node: Any = None
        self.node_name = ""
        self.at_shutdown: list[Callable[[str], object]] = []
        self.error: BaseException | None = None
        self.result: Any = None
        self.done = False
        self.lane = graph.scheduler.spawn(main.__name__, lambda: self.run(main), context=self)
        self.lane.node = None

    def run(self, main: Callable[[], object]) -> None:
        try:
            self.result = main()
        except Exception as error:
            self.error = error
        self.done = True

    def remaining_argv(self) -> list[str]:
        return self.argv

    def set_node_name(self, name: str) -> None:
        self.node_name = name

    def enter(self) -> None:
        pass

    def leave(self) -> None:
        pass


class Programs:
    """Starts programs in one graph and drives it."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    def start(self, main: Callable[[], object], *arguments: str) -> Program:
        return Program(self.graph, main, ["prog", *arguments])

    def __call__(
        self, *mains: Callable[[], object], arguments: tuple[str, ...] = (), limit: float | None = None
    ) -> Any:
        """Run all; return what the last one returned, or raise what it raised. `limit` is of graph time."""
        if limit is None:
            limit = 5.0 if self.graph.scheduler.simulated else PATIENCE * WALL_RATE
        programs = [self.start(main, *arguments) for main in mains]
        self.graph.run(limit, until=lambda: programs[-1].done)
        last = programs[-1]
        if last.error is not None:
            raise last.error
        assert last.done, f"{mains[-1].__name__} did not end; it waits for {last.lane.waiting_for}"
        return last.result


@pytest.fixture(params=["simulated", "wall"])
def simulated(request: pytest.FixtureRequest) -> bool:
    return request.param == "simulated"


@pytest.fixture
def graph(simulated: bool) -> Iterator[Graph]:
    """The default graph, which logs what callbacks raise. Its wall time runs ten times too fast."""
    made = Graph(simulated=simulated, strict=False, rate=1.0 if simulated else WALL_RATE)
    made.notebook = False  # nbval has imported ipykernel into this process
    set_default_graph(made)
    yield made
    made.shutdown("the test is over")
    set_default_graph(None)


@pytest.fixture
def sim() -> Iterator[Graph]:
    """The default graph, in simulated time."""
    made = Graph(strict=False)
    made.notebook = False  # nbval has imported ipykernel into this process
    set_default_graph(made)
    yield made
    made.shutdown("the test is over")
    set_default_graph(None)


@pytest.fixture
def programs(graph: Graph) -> Programs:
    return Programs(graph)


@pytest.fixture
def sim_programs(sim: Graph) -> Programs:
    return Programs(sim)


@pytest.fixture
def log(capsys: pytest.CaptureFixture[str]) -> SimpleNamespace:
    """What was written: out() and err()."""
    return SimpleNamespace(read=capsys.readouterr)
