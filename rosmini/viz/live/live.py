"""A pad in a live notebook: the link between its node in the kernel and its page.

While the page is open, it receives frames at 30 Hz of the graph's time.

A page that drives a robot must send heartbeats. They concern the reader at the browser, so they are timed in wall
time, also if the graph runs in simulated time; keys pressed by a script need no page and work
without one.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.msgs import message_class
from rosmini.viz.live.key_maps import TeleopError

from .page import pad_data, scripts_of

try:
    from .page_link import LEFT_S, PageLink
except ImportError as error:
    raise TeleopError(
        "a pad in a live notebook needs anywidget, which is not installed here: `pip install anywidget`. "
        "pad.press() and pad.stop() work without it."
    ) from error

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from rosmini.core.graph import Node
    from rosmini.core.graph.clock import Timer
    from rosmini.core.graph.subscription import Subscriber

    from .pad import TeleopPad

FRAME_HZ = 30.0
DEAD_MAN_S = 1.0
"""The robot stops if the page has been silent for this long [s]."""
QUIET_S = 0.2
"""Interval between frames that repeat an unchanged state [s]; they show the page that the kernel responds."""
MIN_INTERVAL_S = 0.015
"""Minimum interval between frames [s]: a graph that runs ahead of the clock sends no more than a page can show."""


OTHERS_S = 1.0
"""Minimum interval between two searches for other drivers [s]."""


class Link(PageLink):
    """Receives the messages of a pad's page (see `rosmini-pad-kernel.js`) and sends it frames."""

    acts = frozenset({"key", "steer", "start", "reset", "choose", "keys"})
    signs = frozenset({"beat"})

    def __init__(self, pad: TeleopPad, clock: Callable[[], float] = time.monotonic) -> None:
        self.pad = pad
        self._driven_by_page = False
        self._timer: Timer | None = None
        self._messages: list[list[float]] = []
        self._last: tuple[Any, ...] = ()
        self._others: tuple[str, ...] = ()
        self._choices: tuple[str, ...] = ()
        """Names of everything that can be driven, as last sent to the page."""
        self._drawn: tuple[int, int | None] = (0, None)
        """The turtle strokes that the page has: their number, and how often the background had been cleared."""
        self._last_sent = 0.0
        self._looked = -OTHERS_S
        self._scan: NDArray[np.float32] | None = None
        """A scan not yet sent to the page: ranges (beams,), then the robot's pose at each beam (beams, 3)."""
        self._scans: Subscriber | None = None
        super().__init__((*scripts_of(pad), "rosmini-pad-kernel.js"), "rosminiPadKernel", self._data(), clock)
        pad.on_publish(self._published)

    def _data(self) -> dict[str, Any]:
        pad = self.pad
        self._choices = tuple(pad.choices)
        data = pad_data(pad) | {"choices": list(self._choices), "chosen": pad.chosen}
        if pad.shown_robot is not None and pad.gone is None:
            # This also loads the laser's code now, while the cell runs, instead of at the first key.
            data["ranges"] = np.array(pad.shown_robot.measure(), dtype=np.float32).tobytes()
        return data

    @property
    def node(self) -> Node:
        """The pad's node."""
        return self.pad.node

    @property
    def gone(self) -> str | None:
        """Reason why there is nothing left to drive, or None."""
        return self.pad.gone

    # -- in the graph --------------------------------------------------------------------------------------------

    def _take(self, kind: str | None, content: dict[str, Any]) -> None:
        try:
            self._begin()
            if kind == "key":
                self._driven_by_page = True
                self.pad.press(str(content.get("key")))
                self._check_other_drivers()
            elif kind == "steer":
                self._driven_by_page = True
                self.pad.steer(float(content.get("linear", 0)), float(content.get("angular", 0)))
            elif kind == "keys":
                self.pad.use(str(content.get("name")))
            elif kind == "choose":
                self._choose(str(content.get("name")))
            elif kind == "stop":
                self._stop()
            elif kind == "reset":
                self.pad.reset()
            elif kind == "hello":
                self._hello()
        except (TeleopError, TypeError, ValueError) as error:
            why = self.gone
            if why is None:
                self._refuse(content, str(error))
            else:
                self._tell_gone(why)

    def _check_other_drivers(self) -> None:
        """Look for other drivers, separately from the keys: the Master may be remote, and no key may wait for it."""
        now = self._clock()
        if now - self._looked >= OTHERS_S:
            self._looked = now
            self.node.spawn(f"{self.node.name} other drivers", self._note_others)

    def _note_others(self) -> None:
        if not self.node.is_shutdown():
            self._others = tuple(self.pad.others)

    def _choose(self, name: str) -> None:
        self.pad.choose(name)
        if self._scans is not None:
            self._scans.unregister()
            self._scans = None
        if self._timer is not None:
            self._timer.shutdown()
            self._timer = None
        self._scan, self._messages, self._last, self._others = None, [], (), ()
        self._begin()
        data = self._data()
        ranges = data.pop("ranges", None)
        self._send({"type": "pad", "data": data}, None if ranges is None else [ranges])

    def _begin(self) -> None:
        """Start to send frames, unless they are being sent already."""
        pad = self.pad
        if self._timer is not None:
            return
        if pad.gone is not None:
            raise TeleopError(pad.gone)
        self._timer = pad.node.timer(1 / FRAME_HZ, self._frame)
        if pad.shown_robot is not None and self._scans is None:
            self._scans = pad.node.subscriber(
                pad.shown_robot.scan_topic, message_class("sensor_msgs/LaserScan"), self._seen
            )

    def _seen(self, scan: Any) -> None:
        shown_robot = self.pad.shown_robot
        if shown_robot is not None and self.pad.gone is None:
            ranges = np.asarray(scan.ranges, dtype=np.float32)
            poses = np.broadcast_to(shown_robot.scan_poses, (len(ranges), 3)).astype(np.float32)
            self._scan = np.concatenate([ranges, poses.ravel()])

    def _hello(self) -> None:
        shown_robot = self.pad.shown_robot
        if shown_robot is not None and shown_robot.trail:
            self._send({"type": "trail"}, [np.array(shown_robot.trail, dtype=np.float32).tobytes()])
        self._drawn = (0, None)
        self._last, self._choices = (), ()

    def _stop(self) -> None:
        """Stop motion that the page caused; motion that a script caused continues."""
        driven, self._driven_by_page = self._driven_by_page, False
        if driven and self.pad.gone is None and not self.pad.teleop.at_rest:
            self.pad.stop()

    def _published(self, twist: Any) -> None:
        aside = [twist.linear.y, twist.linear.z]
        self._messages.append([twist.linear.x, twist.angular.z, *(aside if any(aside) else ())])
        del self._messages[:-8]

    def _frame(self, _event: object) -> None:
        now = self._clock()
        self._driven_by_page &= not self.pad.teleop.at_rest
        if self._driven_by_page and now - self._heard > DEAD_MAN_S:
            self._stop()
        if now - self._heard > LEFT_S and self._timer is not None:
            self._timer.shutdown()
            self._timer = None
            return
        if now - self._last_sent < MIN_INTERVAL_S:
            return
        why = self.pad.gone
        if why is None:
            self._show(now)
        else:
            self._tell_gone(why)

    def _tell_gone(self, why: str) -> None:
        if self._timer is not None:
            self._timer.shutdown()
            self._timer = None
        self._send({"type": "gone", "text": why})

    def _show(self, now: float) -> None:
        pad = self.pad
        pose, blocked, moved_shapes = (np.nan, np.nan, np.nan), False, None
        if pad.turtle is not None:
            pose, blocked = pad.turtle.sample_pose(), pad.turtle.blocked
        if pad.shown_robot is not None:
            pose, blocked, moved_shapes = (
                pad.shown_robot.sample_pose(),
                pad.shown_robot.blocked,
                pad.shown_robot.moved_shapes(),
            )
        scan, self._scan = self._scan, None
        teleop = pad.teleop
        window = None if pad.turtle is None else pad.turtle.state(*self._drawn)
        drawn = () if window is None else (window["next"], window["clears"], *(t["pose"] for t in window["turtles"]))
        shown = (*pose, *drawn, *teleop.target, *teleop.command, *teleop.speed, teleop.keys.name, blocked, pad.sent)
        # The Master, which may be remote, is asked for topics when the pad is opened.
        choices = self._choices if pad.turtle is None and pad.shown_robot is None else tuple(pad.choices)
        is_new, self._choices = choices != self._choices, choices
        if (
            shown == self._last
            and scan is None
            and moved_shapes is None
            and not is_new
            and now - self._last_sent < QUIET_S
        ):
            return
        self._last, self._last_sent = shown, now
        content = {
            "type": "frame",
            "messages": self._messages,
            "sent": pad.sent,
            "at_rest": pad.teleop.at_rest,
            "blocked": blocked,
            "scan": scan is not None,
            "keys": teleop.keys.name,
            "speed": list(teleop.speed),
            "others": list(self._others),
        }
        if window is not None:
            content["window"] = window
            self._drawn = window["next"], window["clears"]
        if moved_shapes is not None:
            content["pushed"] = moved_shapes
        if is_new:
            content["choices"] = list(choices)
        numbers = np.array([*pad.teleop.target, *pad.teleop.command, *pose], dtype=np.float64)
        buffers = [numbers.tobytes()] if scan is None else [numbers.tobytes(), scan.tobytes()]
        self._send(content, buffers)
        self._messages = []
