"""`rosmini rviz`: a graph as RViz shows it (http://wiki.ros.org/rviz).

In a terminal it serves a page on this machine that follows the graph until Ctrl-C. In a notebook `%rviz -d FILE`
shows a view that can be turned, with `--still` a picture, and with `--live` the running window; the first
two are a page in a terminal, too. ``TOOL.run("-d", "my.rviz", graph=graph).view`` is the view in Python.
"""

from __future__ import annotations

from optparse import Values

from rosmini.core.verbs import Call, Parser, Result, Shown, Span, Tool, shown

TOOL = Tool(
    "rviz", "show a robot, its sensors and its plans in the browser, and send it goals",
    purpose="looking at what a robot sees and plans", only_verb="show", example="rosmini_sim/simulator",
)  # fmt: skip

DURATION = 2.0
"""Default time for which it listens [s]."""


def _parser() -> Parser:
    parser = Parser(
        "rviz", "rosmini rviz [options] [DISPLAY ...]",
        "What RViz shows: displays of a .rviz file, or one for each topic that can be shown, and the status of each. "
        "Words select some of them by name, class or topic.",
        example="  rosmini rviz -f map --still RobotModel /map /scan",
    )  # fmt: skip
    parser.add_option("-d", "--display-config", metavar="FILE", help="a .rviz file")
    parser.add_option("-f", "--fixed-frame", metavar="FRAME", help="the frame in which everything is drawn")
    parser.add_option(
        "--duration", type="float", metavar="S",
        help=f"show the scene after S seconds of graph time (default: {DURATION:g})",
    )  # fmt: skip
    parser.flag("--live", help="the running window; the default in a terminal without other options")
    parser.flag("--no-browser", help="in a terminal: print the address of the window, and open nothing")
    parser.flag("--still", help="a picture that cannot be turned")
    parser.flag("--fit", help="from above and around everything, whatever the view of the file is")
    parser.add_option(
        "--view", metavar="KIND", help="from a view of this kind around everything: Orbit (from the side), TopDownOrtho"
    )
    parser.add_option("--title", metavar="TEXT", help="a caption under the picture")
    parser.add_option("-o", "--output", metavar="FILE", help="write the page (or .svg, .txt) there, and open nothing")
    return parser


@TOOL.verb("show what there is", parser=_parser)
def show(given: Values, call: Call) -> Result:
    """Open the window, or listen for some time and show the scene."""
    from rosmini.viz.rviz import Config, Scene, look_from, still, turnable
    from rosmini.viz.rviz.suggestions import selected, suggested

    graph = call.graph
    is_still = given.still or given.view or given.output or given.title or given.duration is not None
    if given.live and given.words:
        _parser().error(f"the window has boxes to select displays: leave out {' '.join(given.words)}, or --live")
    if given.live or (call.in_terminal and not is_still):
        return _live(given, call)
    file = given.display_config
    chosen = suggested(graph, given.fixed_frame) if file is None else Config.read(file)
    if given.words:
        chosen = selected(chosen, given.words)
    with Scene(graph, chosen, fixed_frame=given.fixed_frame) as scene:
        _listen(given, call)
        if scene.warning:
            call.warn(f"[WARN] {scene.config.source}: {scene.warning}")
        if given.view:
            look_from(scene, given.view)
        make = still if given.still else turnable
        return shown(make(scene, title=given.title, fit=given.fit), "rviz", given, call)


def _listen(given: Values, call: Call) -> None:
    """Let time pass, so that the displays receive messages."""
    duration = DURATION if given.duration is None else max(given.duration, 0.0)
    for _ in Span.of(call.graph, round(duration * 1e9)).every(100_000_000):
        pass


def _live(given: Values, call: Call) -> Result:
    """Open the window: a widget in a notebook, and a page that is served until Ctrl-C in a terminal."""
    from rosmini.viz.rviz.window import RVizWindow

    window = RVizWindow(call.graph, given.display_config, fixed_frame=given.fixed_frame)
    if window.scene.warning:
        call.warn(f"[WARN] {window.scene.config.source}: {window.scene.warning}")
    if not call.in_terminal:
        _listen(given, call)
        return Shown(view=window)
    import webbrowser

    from rosmini.viz.live.loopback import PageServer, has_screen

    with PageServer(window.link.widget, title="RViz") as server:
        call.say(f"RViz: {server.url}\nThis page follows the graph until Ctrl-C.")
        if has_screen() and not given.no_browser:
            webbrowser.open(server.url)
        for _ in Span.of(call.graph, None).every(100_000_000):
            pass
    window.close()
    return Result()
