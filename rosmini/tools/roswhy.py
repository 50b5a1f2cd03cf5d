"""`rosmini roswhy`: explains why the last message on a topic or call of a service came. ROS has no such command.

``TOOL.run("/cmd_vel", graph=graph).found`` is the chain of causes in Python.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.verbs import Call, Parser, Result, Tool, global_name
from rosmini.ros.introspection.why import DEPTH, explain

from .recorded import add_duration, recorded

if TYPE_CHECKING:
    from optparse import Values
    from pathlib import Path

    from rosmini.ros.introspection.why import Why

TOOL = Tool("roswhy", "why the last message on a topic came: the chain of its causes", only_verb="explain")


@dataclass(frozen=True, kw_only=True)
class Explained(Result):
    """Chains of causes of the last messages, the latest at the end; a notebook draws that one."""

    found: tuple[Why, ...]
    title: str | None = None
    path: Path | None = None

    def __str__(self) -> str:
        texts = [str(why) for why in self.found]
        return "\n\n".join(texts if self.path is None else [*texts, str(self.path)])

    @property
    def view(self) -> Any:
        """Picture of the last chain."""
        return self.found[-1].show(title=self.title)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        data, metadata = self.view._repr_mimebundle_(include, exclude)
        return {**data, "text/plain": str(self)}, metadata


def _parser() -> Parser:
    parser = Parser(
        "rosmini roswhy", "%prog [options] <topic or service or node>",
        "Say why the last message on a topic came, why a service was called, or what made a node do what it did last.",
        example="  rosmini roswhy /scan --duration 5 + rosmini_sim/simulator",
    )  # fmt: skip
    parser.add_option(
        "-n", dest="count", type="int", default=1, metavar="N", help="of the last N; the last one is drawn"
    )
    parser.add_option("--depth", type="int", default=DEPTH, metavar="N", help=f"at most N causes ({DEPTH})")
    parser.add_option("--title", help="a caption under the picture")
    parser.add_option("-o", "--output", metavar="FILE", help="write the picture (.svg, .html, .txt) there")
    add_duration(parser)
    return parser


@TOOL.verb("tell the chain of causes", name="explain", parser=_parser, needs_graph=True, takes="topic")
def explain_(given: Values, call: Call) -> Explained:
    """Explain the chain of causes."""
    if len(given.words) != 1:
        _parser().error("name one topic, service or node")
    if given.count < 1 or given.depth < 0:
        _parser().error("-n takes a number from 1 on, --depth one from 0 on")
    history = recorded(call, given.duration).history
    found = explain(history, global_name(given.words[0]), given.count, given.depth)
    made = Explained(found=tuple(found), title=given.title)
    if not given.output:
        return made
    return Explained(found=made.found, title=given.title, path=made.view.save(given.output))
