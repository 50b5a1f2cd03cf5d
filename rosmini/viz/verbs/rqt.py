"""`rosmini rqt`: the tools of rqt as pictures: `rosmini rqt_graph` is `rosmini rqt graph` (http://wiki.ros.org/rqt).

In a terminal a picture is a page, which is opened in the browser; in a notebook it is shown:
``TOOL.run("plot", "/odom/twist/twist/linear/x", graph=graph).view``.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from rosmini.core.verbs import (
    Call,
    Parser,
    Shown,
    Span,
    Tool,
    VerbError,
    global_name,
    shown,
    tool_node,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from optparse import Values

    from rosmini.viz.view import View

RQT = {
    "graph": "the computation graph",
    "plot": "numbers in messages over time",
    "topic": "topics with types, bandwidths, rates and values",
    "msg": "the fields of a message type",
    "srv": "the fields of a service type",
    "action": "the fields of an action type",
    "console": "what nodes log",
    "bag": "what is in a bag, over time",
    "tf_tree": "the tree of frames",
    "image_view": "the next image on a topic",
    "gui": "several plugins in one window",
    "robot_steering": "drive a robot, with keys",
    "publisher": "publish on topics, from a form",
    "service_caller": "call services, from a form",
    "logger_level": "how much each node logs, from a form",
    "reconfigure": "parameters of nodes that run, from a form",
}
"""The tools of rqt and what they show."""

TOOL = Tool(
    "rqt", "the tools of rqt as pictures",
    purpose="looking at a graph", example="graph",
)  # fmt: skip

MODES = {"nodes": "nodes_only", "active": "nodes_topics_active", "all": "nodes_topics_all"}


def _parser(verb: str, usage: str, description: str, example: str, seconds: float | None = None) -> Parser:
    line = f"  rosmini rqt_{verb} {example}".rstrip()
    parser = Parser("rqt", f"rosmini rqt_{verb} {usage}".rstrip(), description, example=line)
    parser.add_option(
        "-o", "--output", metavar="FILE", help="write the page (or .svg, .txt) there, and open nothing"
    )
    if seconds is not None:
        parser.add_option(
            "--duration", type="float", default=seconds, metavar="S",
            help=f"listen for S seconds of graph time ({seconds:g} if not given)",
        )  # fmt: skip
    return parser


def _add_title(parser: Parser) -> Parser:
    """Add the option that puts a caption under the picture."""
    parser.add_option("--title", metavar="TEXT", help="a caption under the picture")
    return parser


def _add_live(parser: Parser) -> Parser:
    """Add the option that asks for what goes on."""
    parser.add_option(
        "--live", action="store_true", default=False, help="in a notebook: a panel that goes on"
    )
    return parser


def _live(kind: str, call: Call, *words: str, **options: Any) -> Shown:
    """Open a panel of `rosmini.viz.rqt`. Raises ``VerbError`` in a terminal, where a page operates nothing."""
    if call.in_terminal:
        raise VerbError(
            "--live is for notebooks: what is written in a terminal is a page, and nothing in it goes on"
        )
    from rosmini.viz import rqt

    return Shown(view=vars(rqt)[kind](call.graph, *words, **options))


def _one_word(given: Values, parser: Parser, what: str) -> str:
    if len(given.words) != 1:
        parser.error(f"name one {what}")
    return str(given.words[0])


# -- what asks the Master or nobody ----------------------------------------------------------------------------------


def _graph_parser() -> Parser:
    parser = _parser("graph", "[options]", "Who publishes what to whom.", "--mode active --hide debug,tf")
    parser.add_option(
        "--mode",
        choices=sorted(MODES),
        default="nodes",
        help="topics as labels (nodes), or as boxes (active, all)",
    )
    parser.add_option(
        "--hide", metavar="LIST", help="debug, dead_sinks, leaf_topics, params, tf, unreachable, none"
    )
    parser.add_option(
        "--nodes", default="/", metavar="FILTER", help="names or regular expressions, - excludes"
    )
    parser.add_option("--topics", default="/", metavar="FILTER", help="likewise")
    parser.add_option("--group", metavar="LIST", help="what is one box: actions, images, tf, none")
    parser.add_option(
        "--namespaces", type="int", default=2, metavar="N", help="how deep boxes around them nest"
    )
    parser.add_option(
        "--highlight", default="", metavar="NAME", help="a node or topic, and what is beside it"
    )
    return _add_live(_add_title(parser))


@TOOL.verb(RQT["graph"], parser=_graph_parser, only_asks=True)
def graph(given: Values, call: Call) -> Shown:
    """Draw the computation graph."""
    from rosmini.ros.introspection.nodes import names, silent
    from rosmini.viz.rqt.graph import DEFAULT_GROUP, DEFAULT_HIDE, rqt_graph
    from rosmini.viz.rqt.graph_state import CALLER_ID, GraphState

    options: dict[str, Any] = {
        "mode": MODES[given.mode],
        "hide": _switches(given.hide, DEFAULT_HIDE),
        "group": _switches(given.group, DEFAULT_GROUP),
        "namespaces": given.namespaces,
        "namespace": given.nodes,
        "topics": given.topics,
        "highlight": given.highlight,
    }
    if given.live:
        return _live("NodeGraph", call, **options)
    master = call.peers.ask_as(CALLER_ID)
    state = GraphState.of(
        master.ask("getSystemState"),
        master.ask("getTopicTypes"),
        unreachable=silent(call.peers, names(call.peers)),
    )
    return shown(rqt_graph(state, title=given.title, **options), "rqt_graph", given, call)


def _switches(given: str | None, default: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a list of switches turns on."""
    return default if given is None else tuple(part for part in given.split(",") if part != "none")


def _definition(verb: str, example: str) -> None:
    """Add the verb that shows the fields of a type."""

    def parser() -> Parser:
        return _parser(verb, "TYPE", "The fields of a type as a tree.", example)

    @TOOL.verb(RQT[verb], name=verb, parser=parser, only_asks=True, takes="" if verb == "action" else verb)
    def show(given: Values, call: Call) -> Shown:
        from rosmini.viz.rqt import definitions

        draw: Callable[[str], View] = vars(definitions)[f"rqt_{verb}"]
        return shown(draw(_one_word(given, parser(), "type")), f"rqt_{verb}", given, call)


for _verb, _example in (
    ("msg", "geometry_msgs/Twist"),
    ("srv", "nav_msgs/GetPlan"),
    ("action", "move_base_msgs/MoveBase"),
):
    _definition(_verb, _example)


def _plugins_parser() -> Parser:
    return _parser(
        "plugins", "", "The plugins of the real rqt in their nine groups, and what serves here.", ""
    )


@TOOL.verb("rqt's plugins, and what serves here", parser=_plugins_parser, only_asks=True)
def plugins(given: Values, call: Call) -> Shown:
    """Show the table of plugins."""
    from rosmini.viz.rqt.plugins import rqt_plugins

    return shown(rqt_plugins(), "rqt_plugins", given, call)


def _bag_parser() -> Parser:
    return _add_title(_parser("bag", "FILE", "What is in a bag, over time.", "house.bag"))


@TOOL.verb(RQT["bag"], parser=_bag_parser, only_asks=True)
def bag(given: Values, call: Call) -> Shown:
    """Draw the messages of a bag over time."""
    from rosmini.ros.bag import Bag
    from rosmini.viz.rqt.bag import rqt_bag

    with Bag(_one_word(given, _bag_parser(), "bag")) as opened:
        return shown(rqt_bag(opened, title=given.title), "rqt_bag", given, call)


# -- what listens ------------------------------------------------------------------------------------------------------


def _plot_parser() -> Parser:
    text = "Numbers in messages over time; x:y stands for two fields beside one another."
    parser = _parser("plot", "[options] FIELD...", text, "/odom/pose/pose/position/x:y", 5.0)
    return _add_live(_add_title(parser))


@TOOL.verb(RQT["plot"], parser=_plot_parser, takes="topic")
def plot(given: Values, call: Call) -> Shown:
    """Plot fields over time."""
    from rosmini.viz.rqt.plot import rqt_plot

    fields = [
        global_name(word.partition("[")[0]) + word[len(word.partition("[")[0]) :] for word in given.words
    ]
    if given.live:
        return _live("Plot", call, *fields)
    view = rqt_plot(call.graph, *fields, duration=given.duration, title=given.title)
    return shown(view, "rqt_plot", given, call)


def _topic_parser() -> Parser:
    text = "All topics; of those named, the last values."
    return _add_live(_parser("topic", "[options] [TOPIC...]", text, "/odom", 2.0))


@TOOL.verb(RQT["topic"], parser=_topic_parser, takes="topic")
def topic(given: Values, call: Call) -> Shown:
    """Show all topics."""
    from rosmini.viz.rqt.topics import rqt_topic

    expand = [global_name(word) for word in given.words]
    if given.live:
        return _live("TopicMonitor", call, *expand)
    return shown(rqt_topic(call.graph, expand=expand, duration=given.duration), "rqt_topic", given, call)


def _console_parser() -> Parser:
    parser = _parser(
        "console", "[options]", "What nodes log in this time.", "--level WARN --duration 10", 5.0
    )
    parser.add_option("--level", default="DEBUG", metavar="LEVEL", help="the lowest level: DEBUG to FATAL")
    return _add_live(parser)


@TOOL.verb(RQT["console"], parser=_console_parser)
def console(given: Values, call: Call) -> Shown:
    """Show what nodes log."""
    from rosmini.viz.rqt import rqt_console

    if given.live:
        return _live("LogConsole", call, level=given.level)
    log = call.graph.console()
    try:
        _pass(call, given.duration)
        return shown(rqt_console(log, level=given.level), "rqt_console", given, call)
    finally:
        log.close()


def _tf_parser() -> Parser:
    return _add_live(_parser("tf_tree", "[options]", "The tree of frames.", "--duration 3", 2.0))


@TOOL.verb(RQT["tf_tree"], parser=_tf_parser)
def tf_tree(given: Values, call: Call) -> Shown:
    """Draw the tree of frames."""
    from rosmini.core.tf import TransformListener
    from rosmini.viz.tf_trees import tf_tree as draw

    if given.live:
        return _live("TfTree", call)
    with tool_node(call.graph, "rqt_tf_tree") as node:
        listener = TransformListener(node)
        _pass(call, given.duration)
        return shown(draw(listener), "rqt_tf_tree", given, call)


def _image_parser() -> Parser:
    text = "The next image on a topic."
    return _add_live(_parser("image_view", "[options] TOPIC", text, "/camera/rgb/image_raw", 5.0))


@TOOL.verb(RQT["image_view"], parser=_image_parser, takes="topic")
def image_view(given: Values, call: Call) -> Shown:
    """Show the next image on a topic."""
    from rosmini.msgs import message_class
    from rosmini.viz.image_pictures import image_picture

    name = global_name(_one_word(given, _image_parser(), "topic"))
    if given.live:
        return _live("ImageView", call, name)
    heard: list[Any] = []
    with tool_node(call.graph, "rqt_image_view") as node:

        def begin(wake: Callable[[], None]) -> None:
            def hear(image: Any) -> None:
                heard.append(image)
                wake()

            node.subscriber(name, message_class("sensor_msgs/Image"), hear)

        Span.of(call.graph, round(given.duration * 1e9)).wait(node, f"an image on {name}", begin)
    if not heard:
        raise VerbError(
            f"no image came on {name} in {given.duration:g} s; `rosmini rostopic info {name}` says who publishes it"
        )
    return shown(image_picture(heard[0], title=name), "rqt_image_view", given, call)


# -- what is operated --------------------------------------------------------------------------------------------------

PANELS = {
    "publisher": (
        "MessagePublisher",
        "",
        "rostopic pub -r 10 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.2}}'",
    ),
    "service_caller": ("ServiceCaller", "[SERVICE]", "rosservice call /SERVICE VALUES"),
    "reconfigure": ("DynamicReconfigure", "[NODE]", "rosservice call /NODE/set_parameters VALUES"),
    "logger_level": ("LoggerLevel", "[NODE]", "rosservice call /NODE/set_logger_level rosout DEBUG"),
}
"""The panels: the class, its words, and the command that does the same in a terminal, where a page operates nothing."""

TELEOP = "roslaunch turtlebot3_teleop turtlebot3_teleop_key.launch"


def _panel(verb: str) -> None:
    """Add the verb that opens a panel in a notebook."""
    kind, usage, instead = PANELS[verb]

    def parser() -> Parser:
        text = f"A form in a notebook: %rqt_{verb}. In a terminal do: rosmini {instead}"
        return Parser("rqt", f"rosmini rqt_{verb} {usage}".rstrip(), text, example=f"  %rqt_{verb}")

    def in_terminal(_words: Sequence[str]) -> int:
        print(
            f"rqt_{verb} is a form in a notebook (%rqt_{verb}). In a terminal do:\n  rosmini {instead}",
            file=sys.stderr,
        )
        return 2

    # Its one word, [NODE] or [SERVICE], is completed.
    @TOOL.verb(RQT[verb], name=verb, parser=parser, in_terminal=in_terminal, takes=usage.strip("[]").lower())
    def show(given: Values, call: Call) -> Shown:
        if len(given.words) > (1 if usage else 0):
            parser().error(f"rqt_{verb} takes {usage or 'no words'}")
        return _live(kind, call, *map(global_name, given.words))


for _verb in PANELS:
    _panel(_verb)


def _steering_parser() -> Parser:
    text = "A pad with keys that drives a robot or a turtle in a notebook. In a terminal do: rosmini "
    return _add_title(
        Parser("rqt", "rosmini rqt_robot_steering [ROBOT]", text + TELEOP, example="  %rqt_robot_steering")
    )


def _steering_in_terminal(_words: Sequence[str]) -> int:
    print(
        f"rqt_robot_steering is a pad in a notebook. In a terminal do:\n  rosmini {TELEOP}", file=sys.stderr
    )
    return 2


@TOOL.verb(RQT["robot_steering"], parser=_steering_parser, in_terminal=_steering_in_terminal)
def robot_steering(given: Values, call: Call) -> Shown:
    """Open a pad for a robot of the graph's simulator: the robot that is named, or else the first."""
    from rosmini.sim.simulation import Simulation
    from rosmini.sim.turtlesim import TurtleSim
    from rosmini.viz.live.pad import TeleopPad

    if len(given.words) > 1:
        _steering_parser().error("rqt_robot_steering takes one robot")
    programs = [node.program for _, node in sorted(call.graph.nodes.items())]
    driven = next((each for each in programs if isinstance(each, Simulation | TurtleSim)), call.graph)
    return Shown(view=TeleopPad(driven, robot="".join(given.words), title=given.title))


def _gui_parser() -> Parser:
    text = "Plugins beside one another in a notebook, with rqt's menus. In a terminal: the commands to use instead."
    parser = Parser(
        "rqt", "rosmini rqt_gui [options] [PLUGIN...]", text, example="  %rqt_gui rqt_graph rqt_console"
    )
    parser.add_option("--perspective-file", metavar="FILE", help="what runs, as rqt exported it")
    return parser


def _gui_in_terminal(words: Sequence[str]) -> int:
    from rosmini.viz.rqt import Perspective
    from rosmini.viz.rqt.plugins import PLUGINS

    given, serves = _gui_parser().parse(words), {row[2]: row[3] for row in PLUGINS}
    wanted = list(given.words)
    if given.perspective_file:
        wanted = [each.plugin for each in Perspective.read(given.perspective_file).running] + wanted
    print(
        "A window of several plugins is for notebooks (%rqt_gui). In a terminal each is a command of its own:"
    )
    for plugin in wanted or [f"rqt_{verb}" for verb in RQT if verb != "gui"]:
        package = plugin.partition("/")[0]
        found = serves.get(package, "no plugin of rqt")
        is_command = found.startswith(("ros", "rqt", "rviz"))
        print(f"  {plugin}: {'rosmini ' * is_command}{found}")
    return 2


@TOOL.verb(RQT["gui"], parser=_gui_parser, in_terminal=_gui_in_terminal)
def gui(given: Values, call: Call) -> Shown:
    """Open a window in a notebook."""
    return _live("Rqt", call, *given.words, perspective=given.perspective_file)


def _pass(call: Call, seconds: float) -> None:
    """Let graph time pass."""
    for _ in Span.of(call.graph, round(max(seconds, 0.0) * 1e9)).every(100_000_000):
        pass
