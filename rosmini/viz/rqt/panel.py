"""A panel: a tool of rqt with controls, in a live notebook, in a script and in a page."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph import Node
from rosmini.core.names import resolve
from rosmini.core.verbs import Span
from rosmini.viz.live.live_view import LiveView
from rosmini.viz.svg import element
from rosmini.viz.view import View, ViewError

from .markup import page
from .parts import Bar, Control, Drawing, Part, Words, controls, text_of
from .plugin import Plugin

if TYPE_CHECKING:
    from collections.abc import Callable
    from optparse import Values
    from typing import Self, TypeVar

    from rosmini.core.graph import Graph
    from rosmini.core.verbs import Call

    from .parts import Value

    T = TypeVar("T")


REDRAW_S = 1.0
"""How often a picture is drawn again [s]."""


class PanelNode(Node):
    """The node of a panel. A new panel of its name takes its place without a complaint: a cell was run again."""


class Panel(Plugin, LiveView):
    """A tool of rqt on a graph. What a hand does in a page, :meth:`set` does in a script.

    Args:
        graph: the graph that is looked at.
        name: of the panel's node, without which another of the kind takes this one's place; the tool's by default.
        node: what acts on the graph, in place of a node of the panel's own.

    """

    look_s: ClassVar[float] = 0.2
    """How often a page that shows it looks at it [s]."""

    def __init__(self, graph: Graph, *, name: str | None = None, node: Node | None = None) -> None:
        self.graph = graph
        self.message = ""
        """What the last thing that was done did."""
        self.problem = ""
        """Why the last thing that :meth:`set` was to do was refused."""
        self._drawn: tuple[float, Drawing] | None = None
        self._node = node or _own_node(graph, name or self.tool)

    @property
    def node(self) -> Node:
        """What acts on the graph."""
        return self._node

    @classmethod
    @contextmanager
    def alone(cls, graph: Graph, *words: str, **options: Any) -> Iterator[Self]:
        """Open a panel under a name that no other node has, and close it in the end."""
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
        """What it shows now, from top to bottom."""

    @abstractmethod
    def _operate(self, key: Sequence[str], value: Any) -> None:
        """Do what a control stands for; ``key`` is the control's, split at ``/``."""

    def view(self, title: str | None = None) -> View:
        """Return what it shows now, without its controls. Forms have none."""
        raise NotImplementedError(f"{self.tool} is a form")

    @property
    def scripts(self) -> tuple[str, ...]:
        """What its page has beside `rosmini-rqt.js`."""
        return ()

    def news(self, *, whole: bool) -> tuple[dict[str, Any], list[bytes]] | None:
        """What its page is to be sent beside the sheet, or None; `whole` for one that has nothing yet."""
        del whole
        return None

    def settings(self) -> dict[str, Any]:
        """What a perspective keeps of it, by the names that the real plugin has for it."""
        return {}

    def restore(self, settings: dict[str, Any]) -> None:
        """Take what a perspective kept; of other keys nothing is taken. Raises ``RosminiError``, ``ValueError``."""

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
            RosminiError: what it stands for failed.

        """

        def find() -> Control:
            known = {control.key: control for control in controls(self.parts())}
            if key not in known:
                hint = nearest(key, known) or f"it has {', '.join(sorted(known))}"
                raise ViewError(f"{self.tool} has no control {key!r:.80}; {hint}")
            return known[key]

        self._try(lambda: self._set(self._on_hub(find), value))

    def _set(self, control: Control, given: object) -> None:
        value: Value = control.taken(given)
        self._require()
        self._operate(control.key.split("/"), value)

    def _try(self, action: Callable[[], T]) -> T:
        """Do it, and keep what is wrong with it."""
        self.message = self.problem = ""
        try:
            return action()
        except RosminiError as error:
            self.problem = str(error)
            raise

    @property
    def gone(self) -> str | None:
        """Why there is nothing to operate any more, or None."""
        return f"the node {self.node.name} was shut down" if self.node.is_shutdown() else None

    def _say(self, text: str) -> None:
        """Show what was done."""
        self.message, self.problem = text, ""

    def _require(self) -> None:
        if self.gone is not None:
            raise ViewError(f"{self.tool} has ended: {self.gone}. Open it again.")

    def close(self) -> None:
        """End it, as one closes a window. Harmless when repeated."""
        self.node.shutdown("the panel was closed")

    def _on_hub(self, function: Callable[[], T]) -> T:
        return self.graph.scheduler.on_hub(function)

    # -- showing --------------------------------------------------------------------------------------------------

    def shown(self) -> list[Part]:
        """Return its parts, and what is to be said of the last thing that was done."""
        found = list(self.parts())
        why = self.gone
        if why is not None:
            found.append(Words(why, is_bad=True))
        elif self.problem or self.message:
            found.append(Words(self.problem or self.message, is_bad=bool(self.problem)))
        return found

    @property
    def text(self) -> str:
        """The name of the tool, and what it shows."""
        return f"{self.tool}\n{self._on_hub(lambda: text_of(self.shown()))}".rstrip()

    @property
    def alt(self) -> str:
        """The panel in a sentence or two."""
        first = self.text.split("\n")[1:4]
        return f"The panel {self.heading} of rqt. {'; '.join(' '.join(line.split()) for line in first)}"

    def markup(self, *, live: bool) -> str:
        """What it shows, as HTML."""
        return self._on_hub(lambda: page(self.heading, self.shown(), live=live))

    def _images(self) -> dict[str, bytes]:
        return {}

    @property
    def html(self) -> str:
        """The panel as a page has it: as it stands, and nothing in it can be operated."""
        return element("figure", self.markup(live=False), class_="rosmini-figure", style="margin:0.5em 0")

    def _new_link(self) -> Any:
        from rosmini.viz.live.panel_link import PanelLink

        return PanelLink(self)


def _own_node(graph: Graph, name: str) -> PanelNode:
    """Start the node of a panel, in place of that of an earlier one of its name."""
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
    """Do it for each of the names that a perspective kept. Raises one ``ViewError`` for all that failed."""
    problems = []
    for name in names:
        try:
            act(str(name))
        except RosminiError as error:
            problems.append(str(error))
    if problems:
        raise ViewError("; ".join(problems))
