"""Trials of scripts: a fresh graph with a TurtleBot3, in which the answer to an exercise runs.

The reader's graph is not involved. Time is simulated and the trial ends, so a script that runs for
ever does no harm. The output of scripts is kept, and an error that ends one is part of the verdict.
"""

from __future__ import annotations

import re
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, cast

from rosmini.core.graph import Graph
from rosmini.ros.scripts import Console, ScriptHandle, ScriptSpec, rosrun

from .checks import SEED, Script, Wrong

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

    from rosmini.sim.simulation import Simulation
    from rosmini.sim.simulator import Simulator
    from rosmini.sim.stage.node import Stageros
    from rosmini.sim.turtlesim import TurtleSim


class Trial:
    """A separate graph with a simulated TurtleBot3 Burger, for use in a ``with`` block.

    Args:
        world: the name of the simulator's world.
        parameters: of the simulator, as for rosrun: ``"_x:=1.0"``.
        is_shown: whether a wrong answer is shown with a picture of the drive; False if no robot drives.

    A `Wrong` that leaves the block gets the picture of the drive so far, and the first error that a script logged, or
    the warning about a loop that never sleeps.

    """

    def __init__(self, world: str = "room", *parameters: str, is_shown: bool = True) -> None:
        from rosmini.sim.recorder import Recorder

        self._begin(is_shown=is_shown)
        started = rosrun(
            "rosmini_sim", "simulator", f"_world:={world}", *parameters, graph=self.graph, capture_output=True
        )
        self.simulation: Simulation
        """Its simulation, of whichever simulator."""
        self.simulation = self.robot = cast("Simulator", cast("Any", started).instance())
        self._recorder = Recorder(self.graph, self.robot)

    def _begin(self, *, is_shown: bool) -> None:
        self.graph = Graph(strict=False, seed=SEED.get())
        self._is_shown = is_shown
        self._console = Console(self.graph.scheduler, prefix=False, capture_output=True)
        self._scripts: list[ScriptHandle] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Shut the graph down, and add the picture, and a logged error or endless loop, to a `Wrong`."""
        try:
            if isinstance(error, Wrong):
                if self._is_shown:
                    error.view = self.view()
                if (said := self._first_error() or self._endless_loop()) and said not in str(error):
                    error.args = (f"{error} Your script logged: {said}",)
        finally:
            self.graph.shutdown()

    @property
    def output(self) -> str:
        """Output of the scripts so far."""
        return self._console.captured or ""

    def start(self, script: Script, *args: str) -> ScriptHandle:
        """Start a script with arguments as for rosrun, and return its handle."""
        spec = ScriptSpec(script.name, args, source=script.source)
        seed = str(len(self._scripts) or "")  # two copies of a script draw different random numbers
        handle = ScriptHandle(self.graph, spec, lambda: self._console, seed=seed, owns_console=False)
        self._scripts.append(handle)
        handle.start()
        return handle

    def run(self, seconds: float) -> None:
        """Let graph time pass. Raises `Wrong` if a script has failed by then."""
        self.graph.run(seconds)
        for handle in self._scripts:
            if handle.poll():
                last = self.output.strip().rpartition("\n")[2] or f"exit status {handle.poll()}"
                lines = re.findall(rf'File "<{re.escape(handle.spec.path)}>", line (\d+)', self.output)
                where = f" in line {lines[-1]}" if lines else ""
                raise Wrong(f"{handle.spec.path} ended with an error{where}: {last}", "fix this error")

    def expect_no_errors(self) -> None:
        """Raise `Wrong` if a script has logged an error, such as that of a callback that failed."""
        if said := self._first_error():
            raise Wrong(f"Your script logged an error: {said}", "fix this error")

    def view(self) -> Any:
        """Return the picture of the drive so far; None if nothing was recorded yet, or if it cannot be drawn.

        An answer is right or wrong without its picture, for which a page of the book has to load matplotlib.
        """
        from rosmini.sim.recording import RecordingError
        from rosmini.viz.view import ViewError

        try:
            return self._recorder.recording().show(title="What the robot did")
        except (RecordingError, ViewError):
            return None

    def _first_error(self) -> str:
        """Return the first error that was logged, without its time, and the line of the script that caused it."""
        error = re.search(r"^\[ERROR\].*?\]: (.*)(?:\n  \S+, (line \d+), in )?", self.output, re.MULTILINE)
        if error is None:
            return ""
        text, line = error.groups()
        return f"{text} ({line})" if line else text

    def _endless_loop(self) -> str:
        """Return the warning about a loop that never sleeps, without its time and advice."""
        found = re.search(r"^\[WARN\].*?\]: <(.*)>(, line \d+: this loop never sleeps\.)", self.output, re.MULTILINE)
        return "".join(found.groups()) if found else ""


class StageTrial(Trial):
    """A separate graph with Stage, for use in a ``with`` block like a `Trial`.

    Args:
        world: the text of the world file.
        arguments: of stageros, as for rosrun: ``"base_scan:=scan"``.

    Raises:
        Wrong: Stage cannot read the world.

    """

    def __init__(self, world: str, *arguments: str) -> None:
        from rosmini.sim.recorder import Recorder
        from rosmini.sim.stage.errors import StageError

        self._begin(is_shown=True)
        with TemporaryDirectory() as folder:
            path = Path(folder) / "answer.world"
            path.write_text(world, encoding="utf-8")
            try:
                started = rosrun("stage_ros", "stageros", path, *arguments, graph=self.graph, capture_output=True)
                self.simulation = self.stage = cast("Stageros", cast("Any", started).instance())
            except StageError as error:
                self.graph.shutdown()
                said = str(error).replace(folder, "").lstrip("/\\")
                raise Wrong(
                    f"Stage cannot read it: {said}", "the number after the file name is that of the line"
                ) from error
        self._recorder = Recorder(self.graph, self.stage)


class TurtleTrial(Trial):
    """A separate graph with turtlesim, for use in a ``with`` block like a `Trial`.

    Args:
        parameters: of turtlesim, as for rosrun: ``"__name:=pond"``; None for no turtlesim.

    """

    def __init__(self, parameters: tuple[str, ...] | None = ()) -> None:
        self._begin(is_shown=True)
        if parameters is not None:
            self.open(*parameters)

    def open(self, *parameters: str) -> None:
        """Start a turtlesim with these arguments, and wait until it is ready."""
        rosrun("turtlesim", "turtlesim_node", *parameters, graph=self.graph, capture_output=True)
        self.run(0.1)

    def spawn(self, name: str, x: float, y: float, theta: float = 0.0) -> None:
        """Add another turtle to the window."""
        self.sim.spawn(x, y, theta, name)

    @property
    def sim(self) -> TurtleSim:
        """The only turtlesim. Raises `TurtleError` if there is none, or more than one."""
        from rosmini.sim.turtlesim import window

        return window(graph=self.graph)

    def view(self) -> Any:
        """Return the picture of the window; None if there is no window."""
        from rosmini.sim.turtlesim import TurtleError

        try:
            return self.sim.show(title="What the turtle did")
        except TurtleError:
            return None
