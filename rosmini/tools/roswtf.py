"""`rosmini roswtf`: finds probable faults of the environment, a launch file and the graph, and suggests fixes.

``TOOL.run(graph=graph).findings`` does the same in Python (http://wiki.ros.org/roswtf).
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, ROSInitException
from rosmini.core.packages import PackageIndex, package_around
from rosmini.core.verbs import Call, Parser, Result, Span, Tool, tool_node
from rosmini.ros.introspection.wtf import graph_rules, heard_rules, static_rules
from rosmini.ros.introspection.wtf.findings import Finding, summary
from rosmini.ros.introspection.wtf.heard_rules import Heard, Transform
from rosmini.ros.introspection.wtf.survey import survey

if TYPE_CHECKING:
    from collections.abc import Callable
    from optparse import Values

TOOL = Tool(
    "roswtf", "what is probably wrong with the graph, and what to do about it",
    purpose="finding what is wrong", only_verb="look", takes_arguments=True,
)  # fmt: skip

LISTEN_S = 1.0
"""Default time to receive transforms and errors [s]."""
RULE = "=" * 80
ROSOUT_WARN, ROSOUT_ERROR = 4, 8
"""Levels WARN and ERROR of rosgraph_msgs/Log; FATAL is above them."""


@dataclass(frozen=True, kw_only=True)
class Diagnosis(Result):
    """All findings: before anything runs (``static``), and in the graph (``online``; None without a Master)."""

    context: str
    static: tuple[Finding, ...]
    online: tuple[Finding, ...] | None
    offline_because: str = ""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """All findings."""
        return (*self.static, *(self.online or ()))

    def __str__(self) -> str:
        lines = [self.context, RULE, summary("Static", self.static), "", RULE]
        if self.online is None:
            lines.append(self.offline_because)
        else:
            lines.append(summary("Online", self.online))
        return "\n".join(lines)


def _parser() -> Parser:
    parser = Parser(
        "rosmini roswtf", "%prog [options] [launch file | package file] [arg:=value...]",
        "Say what is probably wrong, and what to do about it; with a launch file, also with that.",
        example="  rosmini roswtf\n  rosmini roswtf turtlebot3_gazebo turtlebot3_world.launch model:=burger",
    )  # fmt: skip
    parser.flag("--offline", dest="offline", help="only check the environment and the packages")
    parser.add_option(
        "--duration", type="float", default=LISTEN_S, metavar="S",
        help=f"listen for transforms and errors for S seconds of graph time (not in ROS; {LISTEN_S:g} if not given)",
    )  # fmt: skip
    return parser


@TOOL.verb("look for what is wrong", parser=_parser, only_asks=lambda given: given.offline)
def look(given: Values, call: Call) -> Diagnosis:
    """Run all checks."""
    packages = PackageIndex()
    context, static = _static(packages)
    if given.words:
        from rosmini.ros.launch.wtf import launch_findings

        static += launch_findings(given.words, packages, os.environ)
    if given.offline:
        return Diagnosis(
            context=context, static=tuple(static), online=None, offline_because="The graph was not looked at."
        )
    try:
        heard = _listen(call, given.duration)
        graph = survey(call.peers)
    except MasterUnreachable as error:
        return Diagnosis(context=context, static=tuple(static), online=None, offline_because=str(error), status=1)
    online = [found for rule in graph_rules.RULES for found in rule(graph)]
    online += [found for tf_rule in heard_rules.RULES for found in tf_rule(heard)]
    return Diagnosis(context=context, static=tuple(static), online=tuple(online))


def _static(packages: PackageIndex) -> tuple[str, list[Finding]]:
    """Return the package that this folder belongs to, and faults of the environment."""
    from rosmini.ros.net.addresses import addresses

    here = package_around(Path.cwd() / "package.xml")
    context = f"Package: {here.name}" if here else "No package or stack in the current directory"
    found = [each for rule in static_rules.RULES for each in rule(os.environ, packages)]
    try:
        warning = addresses().warning
    except ROSInitException as error:
        found.append(Finding("addresses", "ERROR", str(error)))
    else:
        if warning:
            found.append(Finding("addresses", "WARNING", warning))
    return context, found


def _listen(call: Call, seconds: float) -> Heard:
    """Receive transforms and log errors for some time of the graph."""
    from rosmini.msgs import message_class

    heard, graph = Heard(), call.graph
    call.say(f"listening to /tf and /rosout for {seconds:g} s")
    with tool_node(graph, "roswtf") as node:

        def transforms(is_static: bool) -> Callable[[Any], None]:
            def hear(message: Any) -> None:
                sender = str((getattr(message, "_connection_header", None) or {}).get("callerid", "unknown"))
                now = graph.now().to_nsec() or None  # simulated time that has not begun
                for each in message.transforms:
                    stamp = each.header.stamp.to_nsec()
                    parent, child = (frame.lstrip("/") for frame in (each.header.frame_id, each.child_frame_id))
                    heard.transforms.append(Transform(parent, child, sender, stamp, now, is_static))

            return hear

        def log(message: Any) -> None:
            if message.level >= ROSOUT_ERROR:
                heard.errors.append((message.name, message.msg))
            elif message.level >= ROSOUT_WARN:
                heard.warnings.append((message.name, message.msg))

        tf = message_class("tf2_msgs/TFMessage")
        node.subscriber("/tf", tf, transforms(False))
        node.subscriber("/tf_static", tf, transforms(True))
        node.subscriber("/rosout_agg", message_class("rosgraph_msgs/Log"), log)
        span = Span.of(graph, round(max(seconds, 0.0) * 1e9))
        for _ in span.every(100_000_000):
            pass
    return heard
