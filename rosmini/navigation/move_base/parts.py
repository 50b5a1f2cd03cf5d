"""The parts of a running `move_base`: its loaded plugins, the topics they use, and the data that they exchange.

The parts are read from the running objects, so they include planners and layers from other packages.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from rosmini.core.graph import Publisher

from .plugins import GLOBAL, LOCAL
from .state_machine import State

if TYPE_CHECKING:
    from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS

    from .node import MoveBase

STATES, TRANSFORMS, RECOVERIES = "states", "transforms", "recovery behaviors"
"""Names of parts; the others are `global planner`, `local planner`, and the names of the costmaps."""
ACTION = "move_base/"
"""The namespace of the action's topics."""


@dataclass(frozen=True)
class Part:
    """A part of the node: its unique name, lines of description, and the topics that it subscribes to and publishes."""

    name: str
    lines: tuple[str, ...]
    subscribes: frozenset[str] = frozenset()
    publishes: frozenset[str] = frozenset()


class Link(NamedTuple):
    """Data that one part passes to another."""

    source: str
    target: str
    label: str


@dataclass(frozen=True)
class Structure:
    """All parts of a `move_base` and the links between them."""

    parts: tuple[Part, ...]
    links: tuple[Link, ...]


def structure_of(move_base: MoveBase) -> Structure:
    """Return the current parts of a `move_base`."""
    costmaps = (move_base.global_costmap, move_base.local_costmap)
    parts = [_states(move_base), Part(TRANSFORMS, (TRANSFORMS,), subscribes=frozenset(("/tf", "/tf_static")))]
    links = [Link(STATES, _planner(GLOBAL), "goal"), Link(_planner(GLOBAL), _planner(LOCAL), "plan")]
    for costmap in costmaps:
        parts.append(_costmap(costmap))
        links.append(Link(TRANSFORMS, costmap.name, "pose"))
    for which, planner in ((GLOBAL, move_base.planner), (LOCAL, move_base.controller)):
        parts.append(_of_planner(move_base, which))
        links += [
            Link(each.name, _planner(which), "costs") for each in costmaps if getattr(planner, "costmap", None) is each
        ]
    if move_base.recovery_behaviors:
        parts.append(_recoveries(move_base))
        links.append(Link(STATES, RECOVERIES, "stuck"))
        links += [Link(RECOVERIES, each.name, "clear") for each in costmaps if _is_cleared(move_base, each)]
    return Structure(tuple(parts), tuple(links))


def _planner(which: str) -> str:
    return f"{which} planner"


def _states(move_base: MoveBase) -> Part:
    """Return the part for the state machine, which receives goals from the action and from `move_base_simple/goal`."""
    resolve = move_base.node.resolve
    action, simple = resolve(ACTION + "goal"), resolve("move_base_simple/goal")
    lines = ("state machine", *(state.name for state in State))
    return Part(STATES, lines, subscribes=frozenset((action, simple)))


def _of_planner(move_base: MoveBase, which: str) -> Part:
    """Return the part for a planner; the local one publishes on `cmd_vel`."""
    planners = move_base.planners
    publishes = frozenset((move_base.node.resolve("cmd_vel"),)) if which == LOCAL else frozenset()
    return Part(
        _planner(which),
        (_planner(which), planners.names[which]),
        subscribes=planners.subscribed_topics(which),
        publishes=publishes,
    )


def _costmap(costmap: Costmap2DROS) -> Part:
    """Return the part for a costmap, with its layers, lowest first, and their topics."""
    grid = costmap.grid
    size = f"{grid.width} x {grid.height} cells, frame {costmap.global_frame}"
    rows = [layer.name for layer in costmap.layers]
    subscribes = frozenset(topic for layer in costmap.layers for topic in layer.topics)
    return Part(costmap.name, (costmap.name, size, *rows), subscribes=subscribes)


def _recoveries(move_base: MoveBase) -> Part:
    """Return one part for all recovery behaviours, in order."""
    rows = [f"{number}. {each.name}" for number, each in enumerate(move_base.recovery_behaviors, 1)]
    publishes = {
        value.topic
        for _, behavior in move_base.recovery_behaviors
        for value in vars(behavior).values()
        if isinstance(value, Publisher)
    }
    return Part(RECOVERIES, (RECOVERIES, *rows), publishes=frozenset(publishes))


def _is_cleared(move_base: MoveBase, costmap: Costmap2DROS) -> bool:
    """Return whether a recovery behaviour declares that it clears this costmap."""
    return any(costmap in behavior.costmaps() for _, behavior in move_base.recovery_behaviors)
