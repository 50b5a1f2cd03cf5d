"""A panel of rqt in a live notebook: what goes between the kernel and the page that shows it.

The page is sent the panel's HTML when that has changed, a few times a second while the page is open. The page answers
each time, and is sent no more until then, so that messages do not queue up in a slow browser.
"""

from __future__ import annotations

import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.viz.view import ViewError

try:
    from rosmini.viz.live.page_link import LEFT_S, PageLink
except ImportError as error:
    raise ViewError(
        "a panel in a live notebook needs anywidget, which is not installed here: `pip install anywidget`. "
        "panel.set() and the panel's own functions work without it."
    ) from error

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node
    from rosmini.viz.rqt.panel import Panel

SCRIPTS = ("rosmini-rqt.js",)
REST = 2.0
"""After a look a graph is left alone for so many times as long as the look took."""
QUIET_S = 0.6
"""How often a page learns that the kernel answers, where nothing has changed [s]."""


class PanelLink(PageLink):
    """Takes what the page of a panel sends (see `rosmini-rqt.js`), and sends it what it shows."""

    acts = frozenset({"set", "start"})
    signs = frozenset({"hello", "beat", "seen"})

    def __init__(self, panel: Panel, clock: Callable[[], float] = time.monotonic) -> None:
        self.panel = panel
        self._last_sent = 0.0
        self._number = 0
        """That of the last operation of a control."""
        self._unseen = False
        """Whether the page has not yet answered what it was sent last."""
        self._last = panel.markup(live=True)
        self._cancel: Callable[[], None] | None = None
        super().__init__((*SCRIPTS, *panel.scripts), "rosminiRqt", {"html": self._last}, clock)

    @property
    def node(self) -> Node:
        """The panel's."""
        return self.panel.node

    @property
    def gone(self) -> str | None:
        """Why there is nothing to operate any more, or None."""
        return self.panel.gone

    # -- in the graph --------------------------------------------------------------------------------------------

    def _take(self, kind: str | None, content: dict[str, Any]) -> None:
        if kind == "set":
            self._number = content.get("number", 0)
            with suppress(RosminiError):  # the panel shows what is wrong
                self.panel.set(str(content.get("key")), content.get("value"))
        if kind == "hello":
            self._last = ""
        if kind in ("hello", "seen"):
            self._unseen = False
        self._look(at_once=kind not in ("beat", "seen"))

    def _look(self, *, at_once: bool = False) -> None:
        """Send what is new, and come again."""
        if self._cancel is not None:
            if not at_once:
                return
            self._cancel()
        self._cancel = None
        now = self._clock()
        why = self.gone
        if why is not None:
            self._send({"type": "gone", "text": why})
            return
        if now - self._heard > LEFT_S:
            return
        is_due = at_once or now - self._last_sent >= 0.9 * self.panel.update_interval_s  # timers may be early
        if is_due and (not self._unseen or now - self._last_sent > LEFT_S):
            self._show(now)
        wait = max(self.panel.update_interval_s, REST * (self._clock() - now))
        scheduler = self.panel.graph.scheduler
        self._cancel = scheduler.call_at(scheduler.now_ns() + round(wait * 1e9), self._due).cancel

    def _due(self) -> None:
        self._cancel = None
        node = self.panel.node
        if not node.is_shutdown():  # a lane, since Master and nodes may be asked, which can take time
            node.spawn(f"{node.name} page", self._look)

    def _show(self, now: float) -> None:
        html = self.panel.markup(live=True)
        news = self.panel.news(whole=not self._last)
        if html != self._last:
            self._send({"type": "sheet", "html": html, "number": self._number})
        elif news is None and now - self._last_sent >= QUIET_S:
            self._send({"type": "alive"})
        elif news is None:
            return
        if news is not None:
            self._send(*news)
        self._unseen = html != self._last or news is not None
        self._last, self._last_sent = html, now
