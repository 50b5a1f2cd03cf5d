"""A panel: a tool of rqt with controls, in a live notebook, in a script and in a page."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph import Graph, Node
from rosmini.core.names import resolve
from rosmini.core.verbs import Call, Span
from rosmini.viz.live.live_view import LiveView
from rosmini.viz.svg import element
from rosmini.viz.view import View, ViewError

from .markup import page
from .parts import Bar, Control, Drawing, Part, Value, Words, controls, text_of
from .plugin import Plugin

if TYPE_CHECKING:
    from optparse import Values

    T = TypeVar("T")


REDRAW_S = 1.0
"""Interval after which a picture is drawn again [s]."""


class PanelNode(Node):
    """The node of a panel. A new panel of the same name replaces it without a warning, since cells are run again."""

    panel: Panel | None = None


class Panel(Plugin, LiveView):
    """A tool of rqt on a graph. A reader operates its controls in a page, a script by :meth:`set`.

    Args:
        graph: the graph.
        name: name of the panel's node, by default the tool's; a new panel of the same name replaces this one.
        node: node to use; by default the panel starts one.

    """

    update_interval_s: ClassVar[float] = 0.2
    """Interval between updates of its page [s]."""

    def __init__(self, graph: Graph, *, name: str | None = None, node: Node | None = None) -> None:
        self.graph = graph
        self.message = ""
        """Result of the last operation."""
        self.problem = ""
        """Error of the last call of :meth:`set`."""
        self._drawn: tuple[float, Drawing] | None = None
        if node is None:
            node = _own_node(graph, name or self.tool)
            node.panel = self
        self._node = node

    @property
    def node(self) -> Node:
        """The node that acts on the graph."""
        return self._node

    @classmethod
    @contextmanager
    def alone(cls, graph: Graph, *words: str, **options: Any) -> Iterator[Self]:
        """Open a panel whose node has a unique name, and close it in the end."""
        make: Any = cls
        panel = make(graph, *words, name=graph.anonymous_name(cls.tool), **options)
        try:
            yield panel
        finally:
            panel.close()

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Return the view of a panel that has listened for some time."""
        words, options = cls.arguments(given)
        with cls.alone(call.graph, *words, **options) as panel:
            for _ in Span.of(call.graph, round(max(given.duration, 0.0) * 1e9)).every(100_000_000):
                pass
            return panel.view(given.title)

    # -- for each kind of panel -----------------------------------------------------------------------------------

    @abstractmethod
    def parts(self) -> Sequence[Part]:
        """Return its current contents from top to bottom."""

    @abstractmethod
    def _operate(self, key: Sequence[str], value: Any) -> None:
        """Perform the action of a control; ``key`` is its key, split at ``/``."""

    def view(self, title: str | None = None) -> View:
        """Return its current contents as a picture or a table. Forms have none."""
        raise NotImplementedError(f"{self.tool} is a form")

    @property
    def scripts(self) -> tuple[str, ...]:
        """Scripts of its page in addition to `rosmini-rqt.js`."""
        return ()

    def news(self, *, whole: bool) -> tuple[dict[str, Any], list[bytes]] | None:
        """Return a message for its page in addition to the HTML, or None; `whole` for a page that is still empty."""
        del whole
        return None

    def settings(self) -> dict[str, Any]:
        """Return its settings for a perspective, under the keys of the real plugin."""
        return {}

    def restore(self, settings: dict[str, Any]) -> None:
        """Restore settings from a perspective; other keys are ignored. Raises ``RosminiError``, ``ValueError``."""

    def _redrawn(self, draw: Callable[[], Drawing]) -> Drawing:
        """Return a drawing that is at most a second old."""
        now = self.graph.now().to_sec()
        if self._drawn is None or abs(now - self._drawn[0]) >= REDRAW_S:
            self._drawn = (now, draw())
        return self._drawn[1]

    # -- operating it ---------------------------------------------------------------------------------------------

    def set(self, key: str, value: object = True) -> None:
        """Operate the control of a key: tick a box, write into a field, press a button.

        Raises:
            ViewError: there is no such control, or it cannot have this value.
            RosminiError: the operation failed.

        """

        def find() -> Control:
            known = {control.key: control for control in controls(self.parts())}
            if key not in known:
                hint = nearest(key, known) or f"it has {', '.join(sorted(known))}"
                raise ViewError(f"{self.tool} has no control {key!r:.80}; {hint}")
            return known[key]

        self._try(lambda: self._set(self._run_in_scheduler(find), value))

    def _set(self, control: Control, given: object) -> None:
        value: Value = control.taken(given)
        self._require()
        self._operate(control.key.split("/"), value)

    def _try(self, action: Callable[[], T]) -> T:
        """Call a function and store its error."""
        self.message = self.problem = ""
        try:
            return action()
        except RosminiError as error:
            self.problem = str(error)
            raise

    @property
    def gone(self) -> str | None:
        """Reason why the panel has ended, or None."""
        return f"the node {self.node.name} was shut down" if self.node.is_shutdown() else None

    def _say(self, text: str) -> None:
        """Show the result of an operation."""
        self.message, self.problem = text, ""

    def _require(self) -> None:
        if self.gone is not None:
            raise ViewError(f"{self.tool} has ended: {self.gone}. Open it again.")

    def close(self) -> None:
        """Close the panel. Calling it again has no effect."""
        self.node.shutdown("the panel was closed")

    def _run_in_scheduler(self, function: Callable[[], T]) -> T:
        return self.graph.scheduler.run_in_scheduler(function)

    # -- showing --------------------------------------------------------------------------------------------------

    def shown(self) -> list[Part]:
        """Return its parts, and the result or error of the last operation."""
        found = list(self.parts())
        why = self.gone
        if why is not None:
            found.append(Words(why, is_bad=True))
        elif self.problem or self.message:
            found.append(Words(self.problem or self.message, is_bad=bool(self.problem)))
        return found

    @property
    def text(self) -> str:
        """The name of the tool, and its contents."""
        return f"{self.tool}\n{self._run_in_scheduler(lambda: text_of(self.shown()))}".rstrip()

    @property
    def alt(self) -> str:
        """The panel in a sentence or two."""
        first = self.text.split("\n")[1:4]
        return f"The panel {self.heading} of rqt. {'; '.join(' '.join(line.split()) for line in first)}"

    def markup(self, *, live: bool) -> str:
        """Return its contents as HTML."""
        return self._run_in_scheduler(lambda: page(self.heading, self.shown(), live=live))

    def _images(self) -> dict[str, bytes]:
        return {}

    @property
    def html(self) -> str:
        """The panel in a static page, where its controls are disabled."""
        return element("figure", self.markup(live=False), class_="rosmini-figure", style="margin:0.5em 0")

    def _new_link(self) -> Any:
        from rosmini.viz.live.panel_link import PanelLink

        return PanelLink(self)


def _own_node(graph: Graph, name: str) -> PanelNode:
    """Start the node of a panel; it replaces the node of an earlier panel of that name."""
    before = graph.nodes.get(resolve(name, "/"))
    if isinstance(before, PanelNode):
        before.shutdown("a new panel took its place")
    return PanelNode(name, graph)


def pass_time(graph: Graph, seconds: float) -> None:
    """Let graph time pass. Raises ``ViewError`` unless it is positive."""
    if not 0 < seconds < float("inf"):
        raise ViewError(f"a duration is a positive number of seconds, not {seconds!r:.40}")
    graph.run(seconds)


def bar(*cells: str | Control) -> Bar:
    """Return a bar of these controls and words."""
    return Bar(cells)


def each_of(act: Callable[[str], object], names: Iterable[object]) -> None:
    """Call a function for each name in a perspective. Raises one ``ViewError`` for all failures."""
    problems = []
    for name in names:
        try:
            act(str(name))
        except RosminiError as error:
            problems.append(str(error))
    if problems:
        raise ViewError("; ".join(problems))
