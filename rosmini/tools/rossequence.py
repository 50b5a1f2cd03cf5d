"""`rosmini rossequence`: draws a sequence diagram of a graph's recording. ROS has no such command.

``TOOL.run("/chatter", graph=graph).view`` is the picture in Python.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.core.verbs import Call, Parser, Shown, Tool, global_name

from .recorded import add_duration, recorded

if TYPE_CHECKING:
    from optparse import Values

TOOL = Tool("rossequence", "who called whom, and sent what to whom, as it happened", only_verb="draw")

DEFAULT_CALLS = 40
"""Default number of calls drawn."""


def _parser() -> Parser:
    parser = Parser(
        "rosmini rossequence", "%prog [options] [node or topic or service ...]",
        "Draw who called whom and sent what to whom: all, or what is about the topics, services and parameters and "
        "between the nodes that are named.",
        example="  rosmini rossequence /chatter --duration 1 + rosmini_sim/simulator",
    )  # fmt: skip
    parser.add_option(
        "-n", dest="count", type="int", default=DEFAULT_CALLS, metavar="N", help=f"the first N calls ({DEFAULT_CALLS})"
    )
    parser.add_option("--since", type="float", metavar="T", help="only from T s of the graph's time on")
    parser.add_option("--last", type="float", metavar="S", help="only the last S seconds of the graph's time")
    parser.flag("--all", dest="everything", help="also what every node does for its log messages")
    parser.add_option("--title", help="a caption under the picture")
    parser.add_option("-o", "--output", metavar="FILE", help="write the picture (.svg, .html, .txt) there")
    add_duration(parser)
    return parser


@TOOL.verb("draw what happened", parser=_parser, needs_graph=True, takes="topic")
def draw(given: Values, call: Call) -> Shown:
    """Draw the diagram."""
    if given.count < 1:
        _parser().error(f"-n takes a number from 1 on, not {given.count}")
    recording = recorded(call, given.duration)
    since = given.since if given.last is None else call.graph.now().to_sec() - given.last
    view = recording.show(
        *map(global_name, given.words),
        everything=given.everything, since=since, limit=given.count, title=given.title,
    )  # fmt: skip
    return Shown(view=view, path=view.save(given.output) if given.output else None)
