"""`rosmini rqt`: the tools of rqt as pictures: `rosmini rqt_graph` is `rosmini rqt graph` (http://wiki.ros.org/rqt).

Each class derived from `rosmini.viz.rqt.plugin.Plugin` is a verb. A terminal writes a page and opens it in the
browser; a notebook shows the view: ``TOOL.run("plot", "/odom/twist/twist/linear/x", graph=graph).view``.
"""

from __future__ import annotations

from optparse import Values

from rosmini.core.verbs import Call, Parser, Shown, Tool, VerbError, shown
from rosmini.viz.rqt.plugin import Plugin, plugins
from rosmini.viz.rqt.plugins import rqt_plugins

TOOL = Tool("rqt", "the tools of rqt as pictures", purpose="looking at a graph", example="graph")


def _add(plugin: type[Plugin]) -> None:
    """Add the verb of a tool."""
    is_form = plugin.instead is not None

    @TOOL.verb(
        plugin.summary, name=plugin.tool.removeprefix("rqt_"), parser=plugin.parser, takes=plugin.takes,
        only_asks=not is_form and plugin.listen_s is None, in_terminal=plugin.in_terminal if is_form else None,
    )  # fmt: skip
    def show(given: Values, call: Call) -> Shown:
        plugin.check_words(given.words)
        if is_form or given.live:
            if call.in_terminal:
                raise VerbError("--live is for notebooks: a terminal writes a page, in which nothing runs")
            return Shown(view=plugin.opened(given, call))
        if plugin.listen_s is not None:  # a node would wait for the Master
            call.graph.ask_as(f"/{plugin.tool}").ask("getPid")
        return shown(plugin.still(given, call), plugin.tool, given, call)


for _plugin in plugins():
    _add(_plugin)


def _plugins_parser() -> Parser:
    parser = Parser(
        "rqt", "rosmini rqt plugins", "The plugins of the real rqt in their nine groups, and what serves here."
    )
    parser.add_option("-o", "--output", metavar="FILE", help="write the page (or .txt) there, and open nothing")
    return parser


@TOOL.verb("rqt's plugins, and what serves here", name="plugins", parser=_plugins_parser, only_asks=True)
def _show_plugins(given: Values, call: Call) -> Shown:
    """Show the table of plugins."""
    return shown(rqt_plugins(), "rqt_plugins", given, call)
