"""`rqt_reconfigure`: change the parameters of running nodes (http://wiki.ros.org/rqt_reconfigure)."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator, Sequence
from typing import Any

from rosmini.core.dynamic_reconfigure import Client, Config, ParameterGroup, ReconfigurableParameter
from rosmini.core.errors import ROSException, nearest
from rosmini.core.graph import Graph
from rosmini.ros.introspection.services import services
from rosmini.viz.view import ViewError

from .panel import Panel, bar, each_of
from .parts import Box, Cell, Control, Part, Row, Rows, number_text

SUFFIX = "/set_parameters"
PATIENCE_S = 5.0
"""Timeout for a server's description of its parameters [s]."""


class DynamicReconfigure(Panel):
    """The parameters of a dynamic_reconfigure server, with sliders, boxes and choices to change them.

    Args:
        graph: the graph.
        server: server shown at first.
        name: name of the panel's node.

    Raises:
        ViewError: there is no such server, or it does not describe its parameters.

    """

    tool, heading, plugin = "rqt_reconfigure", "Dynamic Reconfigure", "rqt_reconfigure/Param"
    group, summary = "Configuration", "parameters of running nodes, from a form"
    usage, takes = "[NODE]", "node"
    instead = "rosservice call /NODE/set_parameters VALUES"

    def __init__(self, graph: Graph, server: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.server = ""
        self._client: Client | None = None
        if server:
            self.choose(server)

    def names(self) -> list[str]:
        """Return the names of all servers, sorted."""
        known = (each.name for each in services(self.graph))
        return sorted(name.removesuffix(SUFFIX) for name in known if name.endswith(SUFFIX))

    def choose(self, server: str) -> None:
        """Choose another server, and wait for the description of its parameters. Raises ``ViewError``."""
        self._require()
        if server not in self.names():
            hint = nearest(server, self.names()) or f"there are {', '.join(self.names()) or 'none'}"
            raise ViewError(f"nothing can be reconfigured at {server!r:.80}; {hint}")
        try:
            client = Client(self.node, server, PATIENCE_S)
            described = client.get_configuration(PATIENCE_S) is not None
        except ROSException as error:
            raise ViewError(f"{server} does not answer: {error}") from error
        if not described:
            client.close()
            raise ViewError(f"{server} has not described its parameters within {PATIENCE_S:g} s")
        if self._client is not None:
            self._client.close()
        self.server, self._client = server, client

    @property
    def values(self) -> dict[str, Any]:
        """The parameters of the server and their last known values."""
        config = self._chosen.config or Config()
        return {name: config[name] for name in self._described() if name in config}

    def change(self, parameter: str, value: object) -> None:
        """Change a parameter; the server may clamp it to its range.

        Raises ``DynamicReconfigureException`` for an unknown parameter, a value of another type,
        and an update that the server refuses, and ``ViewError`` if no server is chosen.
        """
        self._require()
        self._chosen.config = self._chosen.update_configuration({parameter: value})

    def switch(self, group: str, on: bool) -> None:
        """Change the state of a group. Raises as `change` does."""
        self._require()
        self._chosen.config = self._chosen.update_configuration({"groups": {group: on}})

    @property
    def _chosen(self) -> Client:
        if self._client is None:
            raise ViewError("no server is chosen: choose() one of those in names()")
        return self._client

    def _described(self) -> list[str]:
        description = self._chosen.description
        return [] if description is None else [each.name for each in description.parameters]

    # -- showing --------------------------------------------------------------------------------------------------

    def parts(self) -> Sequence[Part]:
        """The server, and its parameters group by group."""
        choices = tuple(dict.fromkeys((self.server, *self.names())))
        found: list[Part] = [bar(Control("server", "Node", "choice", self.server, choices))]
        if self._client is not None and self._client.description is not None:
            found += self._group(self._client.description.root, self._client.config or {})
        return found

    def _group(self, group: ParameterGroup, config: dict[str, Any]) -> Iterator[Part]:
        if group.parameters:
            rows = tuple(_row(each, config.get(each.name, each.default)) for each in group.parameters)
            yield Rows(("Parameter", "Value", "", "Range", "Meaning"), rows, f"Parameters of {group.name}")
        states = _states(config.get("groups", {}))
        for inner in group.groups:
            on = states.get(inner.name, inner.state)
            parts: list[Part] = []
            if inner.type:
                parts.append(bar(Control(f"group/{inner.name}", f"{inner.name} ({inner.type})", "check", on)))
            if on or inner.type not in ("collapse", "hide"):
                parts += self._group(inner, config)
            yield Box(inner.name, tuple(parts))

    def settings(self) -> dict[str, Any]:
        """Return the server."""
        return {"selected_nodes": [self.server] if self.server else []}

    def restore(self, settings: dict[str, Any]) -> None:
        """Choose the server of a perspective, the last of several."""
        each_of(self.choose, settings.get("selected_nodes", []))

    def _operate(self, key: Sequence[str], value: Any) -> None:
        name = "/".join(key[1:])
        if key[0] == "server":
            self.choose(value)
        elif key[0] == "group":
            self.switch(name, value)
        else:
            self.change(name, value)


def _states(tree: dict[str, Any]) -> dict[str, bool]:
    found: dict[str, bool] = {}
    if "name" in tree:
        found[tree["name"]] = bool(tree["state"])
        for inner in tree["groups"].values():
            found |= _states(inner)
    return found


def _row(parameter: ReconfigurableParameter, value: Any) -> Row:
    name = parameter.name
    control, slider, range_text = Control(f"value/{name}", name, "text", str(value)), "", ""
    second: Cell = slider
    if parameter.edit_method:
        control = _choice(parameter, value)
    elif parameter.type == "bool":
        control = Control(f"value/{name}", name, "check", bool(value))
    elif parameter.type in ("int", "double"):
        low, high = (_bound(end) for end in (parameter.min, parameter.max))
        whole = parameter.type == "int"
        control = Control(f"value/{name}", name, "number", float(value), (), low, high, whole)
        if (low, high) != (None, None):
            range_text = " … ".join("" if end is None else number_text(end) for end in (low, high))
        if low is not None and high is not None and high > low:
            second = Control(f"slider/{name}", f"{name} (slider)", "slider", float(value), (), low, high, whole)
    return Row((name, control, second, range_text, parameter.description))


def _bound(end: Any) -> float | None:
    """Return the end of a range; None if it is unlimited: infinity or the largest whole number."""
    return float(end) if math.isfinite(end) and abs(end) < 2**31 - 1 else None


def _choice(parameter: ReconfigurableParameter, value: Any) -> Control:
    constants = ast.literal_eval(parameter.edit_method).get("enum", [])
    names = [str(each["name"]) for each in constants]
    now = next((str(each["name"]) for each in constants if each["value"] == value), str(value))
    return Control(f"value/{parameter.name}", parameter.name, "choice", now, tuple(dict.fromkeys((*names, now))))
