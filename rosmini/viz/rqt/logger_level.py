"""`rqt_logger_level`: how much each node logs (http://wiki.ros.org/rqt_logger_level)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.core.errors import ServiceException, nearest
from rosmini.core.graph import Graph
from rosmini.core.graph.rosout import LEVELS
from rosmini.msgs import service_class
from rosmini.ros.introspection.services import services
from rosmini.viz.view import ViewError

from .panel import Panel, bar
from .parts import Control, Part, Row, Rows

GET, SET = "/get_loggers", "/set_logger_level"
NAMES = tuple(name.capitalize() for name in LEVELS)


class LoggerLevel(Panel):
    """The loggers of a node and their levels, read and set through the node's services.

    >>> from rosmini import Graph
    >>> graph = Graph()
    >>> talker = graph.node("talker")
    >>> levels = LoggerLevel(graph, "/talker")
    >>> levels.loggers["rosout"]
    'Info'
    >>> levels.set_level("rosout", "Debug")
    >>> levels.loggers["rosout"]
    'Debug'

    Args:
        graph: the graph.
        node: node shown at first.
        name: name of the panel's node.

    Raises:
        ViewError: there is no such node.
        ServiceException: the node does not answer.

    """

    tool, heading, plugin = "rqt_logger_level", "Logger Level", "rqt_logger_level/LoggerLevel"
    group, summary = "Logging", "how much each node logs, from a form"
    usage, takes = "[NODE]", "node"
    instead = "rosservice call /NODE/set_logger_level rosout DEBUG"

    def __init__(self, graph: Graph, node: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.chosen = ""
        """The node whose loggers are shown."""
        self.loggers: dict[str, str] = {}
        """Its loggers and their levels at the last request."""
        if node:
            self.choose(node)

    def names(self) -> list[str]:
        """Return the nodes that offer both services, sorted."""
        known = {each.name for each in services(self.graph)}
        nodes = (name.removesuffix(GET) for name in known if name.endswith(GET))
        return sorted(node for node in nodes if f"{node}{SET}" in known and node != self.node.name)

    def choose(self, node: str) -> None:
        """Choose another node, and ask for its loggers. Raises ``ViewError``, ``ServiceException``."""
        if node not in self.names():
            hint = nearest(node, self.names()) or f"there are {', '.join(self.names()) or 'none'}"
            raise ViewError(f"no node {node!r:.80} offers {GET[1:]} and {SET[1:]}; {hint}")
        self.chosen, self.loggers = node, {}
        self.refresh()

    def refresh(self) -> None:
        """Ask the node for its loggers again. Raises ``ServiceException``."""
        answer = self._ask(GET, "roscpp/GetLoggers")
        self.loggers = {each.name: each.level.capitalize() for each in sorted(answer.loggers, key=lambda one: one.name)}

    def set_level(self, logger: str, level: str) -> None:
        """Set the level of a logger: Debug, Info, Warn, Error or Fatal. Raises ``ViewError``, ``ServiceException``."""
        if level.capitalize() not in NAMES:
            raise ViewError(f"no level {level!r:.40}; {nearest(level, NAMES) or 'there are ' + ', '.join(NAMES)}")
        if logger not in self.loggers:
            hint = nearest(logger, self.loggers) or f"it has {', '.join(self.loggers) or 'none'}"
            raise ViewError(f"{self.chosen or 'no node'} has no logger {logger!r:.80}; {hint}")
        self._ask(SET, "roscpp/SetLoggerLevel", logger=logger, level=level.upper())
        self.refresh()
        self._say(f"{self.chosen}: {logger} logs from {level.capitalize()} on")

    def _ask(self, service: str, kind: str, **fields: str) -> Any:
        self._require()
        if not self.chosen:
            raise ViewError("no node is chosen: choose() one of those in names()")
        try:
            return self.node.service_client(f"{self.chosen}{service}", service_class(kind)).call(**fields)
        except ServiceException as error:
            raise ServiceException(f"{self.chosen} does not say what it logs: {error}") from error

    def parts(self) -> Sequence[Part]:
        """The node, and its loggers."""
        choices = tuple(dict.fromkeys((self.chosen, *self.names())))
        rows = tuple(
            Row(
                (
                    name,
                    Control(
                        f"level/{name}", f"level of {name}", "choice", level, tuple(dict.fromkeys((*NAMES, level)))
                    ),
                )
            )
            for name, level in self.loggers.items()
        )
        return [
            bar(Control("node", "Node", "choice", self.chosen, choices), Control("refresh", "Refresh", "button")),
            Rows(("Logger", "Level"), rows, "Loggers", "choose a node"),
        ]

    def settings(self) -> dict[str, Any]:
        """Return the node."""
        return {"node": self.chosen}

    def restore(self, settings: dict[str, Any]) -> None:
        """Choose the node."""
        if settings.get("node"):
            self.choose(str(settings["node"]))

    def _operate(self, key: Sequence[str], value: Any) -> None:
        if key[0] == "node":
            self.choose(value)
        elif key[0] == "refresh":
            self.refresh()
        else:
            self.set_level("/".join(key[1:]), value)
