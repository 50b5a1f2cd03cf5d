"""`rosmini rviz`: what RViz shows of a graph, at this moment (http://wiki.ros.org/rviz).

In a notebook `%rviz -d FILE` shows a view that can be turned, with `--still` a picture; in a terminal both are a page.
``TOOL.run("-d", "my.rviz", graph=graph).view`` is the view in Python.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.introspection.options import Parser

from .listening import Span
from .rqt import Shown, shown
from .verbs import Call, Tool

if TYPE_CHECKING:
    from optparse import Values

TOOL = Tool(
    "rviz", "robots, sensors and maps as displays in a scene, from a .rviz file or for what is published",
    purpose="looking at what a robot sees and plans", only_verb="show", example="rosmini_sim/simulator",
)  # fmt: skip
add_parser, main = TOOL.add_parser, TOOL.main

DURATION = 2.0
"""How long it listens if nobody says how long [s]."""


def _parser() -> Parser:
    parser = Parser(
        "rviz", "rosmini rviz [options]",
        "What RViz shows: displays of a .rviz file, or one for each topic that can be shown, and the status of each.",
        example="  rosmini rviz -f map --still",
    )  # fmt: skip
    parser.add_option("-d", "--display-config", metavar="FILE", help="a .rviz file")
    parser.add_option("-f", "--fixed-frame", metavar="FRAME", help="the frame in which everything is drawn")
    parser.add_option(
        "--duration", type="float", default=DURATION, metavar="S",
        help=f"listen for S seconds of graph time ({DURATION:g} if not given)",
    )  # fmt: skip
    parser.flag("--still", help="a picture that is not to be turned")
    parser.flag("--fit", help="from above and around everything, whatever the view of the file is")
    parser.add_option("--title", metavar="TEXT", help="a caption under the picture")
    parser.add_option(
        "-o", "--output", metavar="FILE", help="write the page (or .svg, .txt) there, and open nothing"
    )
    return parser


@TOOL.verb("show what there is", parser=_parser)
def show(given: Values, call: Call) -> Shown:
    """Listen for some time, and show what there is then."""
    from rosmini.viz.rviz import Scene, still, turnable
    from rosmini.viz.rviz.suggestions import suggested

    if given.words:
        _parser().error(
            f"rviz takes no words but options, not {given.words[0]!r}; a file is given by -d FILE"
        )
    config, graph = given.display_config, call.graph
    chosen = suggested(graph, given.fixed_frame) if config is None else config
    with Scene(graph, chosen, fixed_frame=given.fixed_frame) as scene:
        for _ in Span.of(graph, round(max(given.duration, 0.0) * 1e9)).every(100_000_000):
            pass
        if scene.warning:
            call.warn(f"[WARN] {scene.config.source}: {scene.warning}")
        make = still if given.still else turnable
        return shown(make(scene, title=given.title, fit=given.fit), "rviz", given, call)
