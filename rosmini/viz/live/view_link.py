"""The link between a simulation view's page in a live notebook and the kernel.

Frames are sent at up to 30 Hz while the page is open. They do not keep an otherwise idle graph running.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.viz.view import ViewError

from .teleop import TeleopError

try:
    from .live import FRAME_HZ, MIN_INTERVAL_S, QUIET_S
    from .page_link import LEFT_S, PageLink
except TeleopError as error:
    raise ViewError(
        "a view in a live notebook needs anywidget, which is not installed here: `pip install anywidget`. "
        "view.drag() and view.turn() work without it."
    ) from error

from .page import module
from .watch import STEP_S

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.geometry.poses import Pose
    from rosmini.core.graph import Node

    from .simulation_view import SimulationView
    from .watch import Body

SCRIPTS = ("rosmini-canvas.js", "rosmini-view-style.js", "rosmini-view.js", "rosmini-view-kernel.js")
LASER_S = 0.1
"""Minimum interval between two laser measurements [s]."""


class _Same:
    """Compares equal only to an object that holds the identical items."""

    def __init__(self, thing: object) -> None:
        self.thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.thing is self.thing

    __hash__ = None  # type: ignore[assignment]  # it is only compared


class ViewLink(PageLink):
    """Receives the messages of a view's page (see `rosmini-view-kernel.js`) and sends it frames."""

    acts = frozenset({"drag", "pause", "unpause", "step", "reset", "start"})

    def __init__(self, view: SimulationView, clock: Callable[[], float] = time.monotonic) -> None:
        self.view = view
        self.watch = view.watch
        self._cancel: Callable[[], None] | None = None
        self._key: tuple[Any, ...] = ()
        self._bodies: list[Body] = []
        self._last: tuple[Any, ...] = ()
        self._last_sent = self._last_looked = 0.0
        self._seen: list[Pose] = []
        data = self.node.scheduler.run_in_scheduler(self._data)
        super().__init__(module(SCRIPTS, "rosminiViewKernel"), data, clock)

    @property
    def node(self) -> Node:
        """The simulation's node."""
        return self.watch.node

    @property
    def gone(self) -> str | None:
        """Reason why there is nothing left to show, or None."""
        return self.watch.gone

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
        """Send the current state, and schedule the next frame."""
        if self._cancel is not None:
            self._cancel()
            self._cancel = None
        why = self.gone
        if why is not None:
            self._send({"type": "gone", "text": why})
            return
        now = self._clock()
        if now - self._heard > LEFT_S:
            return
        if now - self._last_sent >= MIN_INTERVAL_S or not self._last:
            self._show(now)
        node = self.watch.node
        # While time is paused and the graph is not live, a timer alone would keep a run going.
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
            buffers.append(self._measure().tobytes())
        self._last, self._last_sent = shown, now
        self._send({"type": "frame", "time": watch.host.now, "paused": watch.host.paused, "scans": looked}, buffers)

    def _present(self) -> tuple[Any, ...]:
        """Return the objects that must stay identical for the page's copy of the world to remain valid."""
        engine, host = self.watch.engine, self.watch.host
        return (_Same(engine.world), tuple(engine.robots), len(host.devices))

    def _measure(self) -> NDArray[np.float32]:
        lasers = self.watch.lasers(self._bodies)
        looks = [self.watch.measure(name, lidar) for name, lidar in lasers.items()]
        return np.concatenate(looks) if looks else np.zeros(0, dtype=np.float32)

    def _data(self) -> dict[str, Any]:
        """Return all data that a page needs, as JSON."""
        watch = self.watch
        self._key, self._bodies = self._present(), watch.bodies()
        self._seen = []
        lasers = watch.lasers(self._bodies)
        return {
            "title": self.view.heading,
            "scene": watch.scene(),
            "bodies": [body.data(lasers.get(body.name)) for body in self._bodies],
            "poses": [list(watch.pose(body)) for body in self._bodies],
            "scans": self._measure().tobytes(),
            "time": watch.host.now,
            "paused": watch.host.paused,
            "step": STEP_S,
        }
