"""A view of a simulation in a live notebook: what goes between the kernel and the page that shows it.

As with the pad (`rosmini.widgets.live`), what a page sends goes through the scheduler's inbox, from whatever thread
it comes, and everything else happens in the graph. Frames are sent at up to 30 Hz while somebody looks. They never
keep a graph going that would have nothing else to do.
"""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
from rosmini.viz.view import ViewError

from .teleop import TeleopError

try:
    from .live import FRAME_HZ, LEFT_S, QUIET_S, SHORTEST_S, PageWidget, answer_in_subshells
except TeleopError as error:
    raise ViewError(
        "a view in a live notebook needs anywidget, which is not installed here: `pip install anywidget`. "
        "view.drag() and view.turn() work without it."
    ) from error

from .page import module
from .watch import STEP_S

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.geometry.poses import Pose

    from .watch import Body, Watch

SCRIPTS = (
    "rosmini-canvas.js",
    "rosmini-view-style.js",
    "rosmini-view.js",
    "rosmini-view-kernel.js",
)
LASER_S = 0.1
"""No two looks of the lasers follow one another faster [s]."""
ACTIONS = ("drag", "pause", "unpause", "step", "reset", "start")


class LinkedView(Protocol):
    """A view, as its page sees it: :class:`~rosmini.widgets.simulation_view.SimulationView`."""

    watch: Watch
    message: str

    @property
    def heading(self) -> str:
        """What is viewed, in a few words."""

    def drag(self, name: str, to: Sequence[float]) -> None:
        """Take a robot or a box, and put it down."""

    def pause(self) -> None:
        """Stop the world's time."""

    def unpause(self) -> None:
        """Let the world's time go on."""

    def step(self, seconds: float) -> None:
        """Let so much of the world's time pass."""

    def reset(self) -> None:
        """Put everything back."""


class _Same:
    """Equal to nothing but what holds the very same thing."""

    def __init__(self, thing: object) -> None:
        self.thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.thing is self.thing

    __hash__ = None  # type: ignore[assignment]  # it is only compared


class ViewLink:
    """Takes what the page of a view sends, and sends it what it shows. `clock` is the wall's, in seconds."""

    def __init__(self, view: LinkedView, clock: Callable[[], float] = time.monotonic) -> None:
        self.view = view
        self.watch = view.watch
        self._clock = clock
        self._heard = clock()
        self._cancel: Callable[[], None] | None = None
        self._key: tuple[Any, ...] = ()
        self._bodies: list[Body] = []
        self._last: tuple[Any, ...] = ()
        self._last_sent = self._last_looked = 0.0
        self._seen: list[Pose] = []
        self.widget = PageWidget(
            _esm=module(SCRIPTS, "rosminiViewKernel"), data=self.watch.node.scheduler.on_hub(self._data)
        )
        answer_in_subshells(self.widget.comm)
        self.widget.on_msg(self.receive)

    # -- from the page, in any thread ----------------------------------------------------------------------------

    def receive(self, _widget: object, content: dict[str, Any], _buffers: object) -> None:
        """Take a message of the page: see `rosmini-view-kernel.js`."""
        self._heard = self._clock()
        node, kind = self.watch.node, content.get("type")
        graph = node.graph
        why = self.watch.gone
        if why is not None:
            self._send({"type": "gone", "text": why})
            return
        try:
            if kind in ACTIONS and not graph.is_live:
                graph.live()
        except RosminiError as error:
            self._refuse(content, str(error))
            return
        if not graph.is_live and not graph.scheduler.driven:
            self._send({"type": "still"})
            return
        graph.scheduler.call_soon_threadsafe(
            lambda: node.spawn(f"{node.name} view", partial(self._take, kind, content))
        )

    # -- in the graph --------------------------------------------------------------------------------------------

    def _take(self, kind: str | None, content: dict[str, Any]) -> None:
        view = self.view
        try:
            if kind == "drag":
                to = [float(part) for part in content.get("to", ())]
                view.drag(str(content.get("name")), to)
                self._send({"type": "put", "name": content.get("name"), "text": view.message})
            elif kind in ("pause", "unpause", "reset"):
                getattr(view, kind)()
                self._send({"type": "said", "text": view.message})
            elif kind == "step":
                view.step(STEP_S)
                self._send({"type": "said", "text": view.message})
        except RosminiError as error:
            self._refuse(content, str(error))
        except (TypeError, ValueError):
            self._refuse(content, f"{content.get('to')!r} is no place")
        if kind == "hello":
            self._key = ()
        self._last = ()
        self._frame()

    def _refuse(self, content: dict[str, Any], text: str) -> None:
        self._send({"type": "refused", "name": content.get("name"), "text": text})

    def _frame(self) -> None:
        """Show how things are, and come again."""
        if self._cancel is not None:
            self._cancel()
            self._cancel = None
        why = self.watch.gone
        if why is not None:
            self._send({"type": "gone", "text": why})
            return
        now = self._clock()
        if now - self._heard > LEFT_S:
            return
        if now - self._last_sent >= SHORTEST_S or not self._last:
            self._show(now)
        node = self.watch.node
        # Where time stands and nobody makes the graph live, a timer would be all that keeps a run going.
        if node.graph.is_live or not self.watch.host.paused:
            scheduler = node.scheduler
            when = scheduler.now_ns() + round(1e9 / FRAME_HZ)
            self._cancel = scheduler.call_at(when, self._due).cancel

    def _due(self) -> None:
        self.watch.node.guarded(self._frame, what="view")

    def _show(self, now: float) -> None:
        watch = self.watch
        key = self._present()
        if key != self._key:
            data = self._data()
            self._send({"type": "scene", "data": data}, [data.pop("scans")])
        poses = [watch.pose(body) for body in self._bodies]
        shown = (watch.host.paused, watch.host.now, *poses)
        if shown == self._last and now - self._last_sent < QUIET_S:
            return
        buffers = [np.array(poses, dtype=np.float64).tobytes()]
        looked = bool(poses != self._seen or not self._last) and now - self._last_looked >= LASER_S
        if looked:
            self._seen, self._last_looked = poses, now
            buffers.append(self._survey().tobytes())
        self._last, self._last_sent = shown, now
        self._send(
            {"type": "frame", "time": watch.host.now, "paused": watch.host.paused, "scans": looked}, buffers
        )

    def _present(self) -> tuple[Any, ...]:
        """What has to be the same for what the page knows of the world still to hold."""
        engine, host = self.watch.engine, self.watch.host
        return (_Same(engine.world), tuple(engine.robots), len(host.devices))

    def _survey(self) -> NDArray[np.float32]:
        lasers = self.watch.lasers(self._bodies)
        looks = [self.watch.survey(name, lidar) for name, lidar in lasers.items()]
        return np.concatenate(looks) if looks else np.zeros(0, dtype=np.float32)

    def _data(self) -> dict[str, Any]:
        """All that a page has to know, as JSON."""
        watch = self.watch
        self._key, self._bodies = self._present(), watch.bodies()
        self._seen = []
        lasers = watch.lasers(self._bodies)
        return {
            "title": self.view.heading,
            "scene": watch.scene(),
            "bodies": [body.data(lasers.get(body.name)) for body in self._bodies],
            "poses": [list(watch.pose(body)) for body in self._bodies],
            "scans": self._survey().tobytes(),
            "time": watch.host.now,
            "paused": watch.host.paused,
            "step": STEP_S,
        }

    def _send(self, content: dict[str, Any], buffers: list[bytes] | None = None) -> None:
        self.widget.send(content, buffers)
