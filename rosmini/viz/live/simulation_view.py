"""A live view of a simulation: drag robots and boxes with mouse, finger or keys, as in Gazebo's window.

>>> from rosmini import Graph
>>> from rosmini.sim.simulator import Simulator
>>> graph = Graph()
>>> simulator = Simulator(graph.node("simulator"), world="room", model="burger")
>>> view = SimulationView(simulator)
>>> view.drag("burger", (1.0, -1.0))
>>> view.turn("burger", 1.570796)
>>> print(view.message)
burger is at (1.00, -1.00, 90.0 deg)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.sim.simulation import Simulation
from rosmini.viz.rounding import fixed
from rosmini.viz.view import SVG_MIME, Picture, ViewError
from rosmini.viz.world_pictures import pose_text

from .live_view import LiveView
from .watch import STEP_S, Watch

T = TypeVar("T")


class SimulationView(LiveView):
    """A running world from above, in a notebook; a browser's pointer and keys also call `drag` and `turn`.

    In a live notebook it follows the simulation, no matter what drives the graph. In the book, and without a kernel,
    it is a still picture.

    Args:
        simulation: a simulator, stageros or gzserver.
        title: caption under the view, and first line of its text form.

    Raises:
        ViewError: `simulation` is not one of them.

    """

    def __init__(self, simulation: Simulation, *, title: str | None = None) -> None:
        if not isinstance(simulation, Simulation):
            raise ViewError(
                f"the view needs a running simulation, not a {type(simulation).__name__}. Give it "
                "rosrun('rosmini_sim', 'simulator').instance(), or that of stageros or gzserver."
            )
        self.watch = Watch(simulation)
        self.title = title
        self.message = ""
        """Result of the last drag, turn or button, or the reason why it was refused."""

    # -- actions -------------------------------------------------------------------------------------------------

    @property
    def names(self) -> tuple[str, ...]:
        """Names of everything that can be dragged."""
        return self._run_in_scheduler(lambda: tuple(body.name for body in self.watch.bodies() if body.is_draggable))

    def pose(self, name: str) -> Pose:
        """Return the pose of a robot or an object: x [m], y [m], heading [rad]. Raises `ViewError` for another name."""
        return self._run_in_scheduler(lambda: self.watch.pose(self.watch.body(name)))

    def drag(self, name: str, to: Sequence[float]) -> None:
        """Move a robot or a box to x, y [m], with its present heading or with a third number [rad].

        It is then at rest. If the place is occupied, it stays where it was and `WorldError` names the obstacle. Raises
        `ViewError` for an unknown name, for an invalid position, and after the simulation has ended.
        """
        if len(to) not in (2, 3) or not all(math.isfinite(part) for part in to):
            raise ViewError(f"{name!r} cannot be dragged to {tuple(to)!r}: give x and y [m], both finite")

        def put() -> None:
            self._require()
            body = self.watch.body(name)
            heading = to[2] if len(to) == 3 else self.watch.pose(body)[2]
            self._try(lambda: self.watch.simulation.drag(body.name, (float(to[0]), float(to[1]), float(heading))))
            self.message = f"{body.name} is at {pose_text(self.watch.pose(body))}"

        self._run_in_scheduler(put)

    def turn(self, name: str, heading: float) -> None:
        """Turn a robot or a box to a heading [rad, counter-clockwise from x]. Raises the same errors as `drag`."""
        if not math.isfinite(heading):
            raise ViewError(f"{name!r} cannot be turned to {heading!r}: give a finite heading [rad]")
        x, y, _ = self.pose(name)
        self.drag(name, (x, y, heading))

    def pause(self) -> None:
        """Pause the world's time. Calling it again has no effect."""
        self._do(self.watch.simulation.pause, "time stands")

    def unpause(self) -> None:
        """Resume the world's time. Calling it again has no effect."""
        self._do(self.watch.simulation.unpause, "time goes on")

    def step(self, seconds: float = STEP_S) -> None:
        """Advance the world's time by this many seconds, then pause. Raises `RosminiError` unless positive."""
        self._do(lambda: self.watch.simulation.step(seconds), f"{seconds:g} s have passed")

    def reset(self) -> None:
        """Reset everything to its initial pose, like the simulation's `reset`."""
        self._do(self.watch.simulation.reset, "all is back where it began")

    @property
    def paused(self) -> bool:
        """True if time is paused."""
        return self.watch.host.paused

    def _do(self, action: Callable[[], object], said: str) -> None:
        def act() -> None:
            self._require()
            self._try(action)
            self.message = said

        self._run_in_scheduler(act)

    def _try(self, action: Callable[[], object]) -> None:
        """Run the action, and store its error as the message."""
        try:
            action()
        except RosminiError as error:
            self.message = str(error)
            raise

    def _require(self) -> None:
        why = self.watch.gone
        if why is not None:
            raise ViewError(why)

    def _run_in_scheduler(self, function: Callable[[], T]) -> T:
        return self.watch.node.scheduler.run_in_scheduler(function)

    # -- showing -------------------------------------------------------------------------------------------------

    @property
    def heading(self) -> str:
        """Short description of the viewed world."""
        world = self.watch.engine.world
        return self.title or f"Simulation of the world {world.name}"

    @property
    def text(self) -> str:
        """The time, and the poses of everything that can be dragged, robots first."""
        return self._run_in_scheduler(self._describe)

    def _describe(self) -> str:
        watch = self.watch
        time = f"{fixed(watch.host.now, 2)} s{', paused' if watch.host.paused else ''}"
        lines = [f"{self.heading}: {time}"]
        lines += [
            f"{body.name} ({body.what}): {pose_text(watch.pose(body))}" for body in watch.bodies() if body.is_draggable
        ]
        why = watch.gone
        if why is not None:
            lines.append(why)
        elif self.message:
            lines.append(f"last: {self.message}")
        return "\n".join(lines)

    def still(self) -> Picture:
        """Return a picture of the current state."""
        return self._run_in_scheduler(lambda: self.watch.picture(self.title))

    @property
    def alt(self) -> str:
        """Alternative text: the view in a few sentences."""
        return f"{self.still().alt} Robots and boxes can be dragged in a live notebook."

    def _images(self) -> dict[str, bytes]:
        picture = self.still()
        return {SVG_MIME: (picture.svg or "").encode()}

    @property
    def html(self) -> str | None:
        """The still picture: motion needs the simulation, which runs in Python."""
        return self.still().html

    def _new_link(self) -> Any:
        from .view_link import ViewLink

        return ViewLink(self)
