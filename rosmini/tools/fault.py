"""`rosmini fault`: injects faults into a graph, to see what happens. ROS has no such command.

``TOOL.run("/scan", "--lose", "0.3", graph=graph)`` is the same as ``graph.faults.disturb("/scan", lose=0.3)``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.core.verbs import Call, Lines, Parser, Tool, global_name

if TYPE_CHECKING:
    from optparse import Values

    from rosmini.core.graph.observers.faults import Faults

TOOL = Tool(
    "fault",
    "make something go wrong: lose, delay or double messages, kill a node, cut a service, jump a clock",
    only_verb="make",
)

DISTURBANCES = ("lose", "double", "delay", "jitter")


def _parser() -> Parser:
    parser = Parser(
        "rosmini fault",
        "%prog <topic> [--lose P] [--double P] [--delay S] [--jitter S] [--to NODE] [--seed N] | "
        "<node> --kill | <service> --cut | clock --jump S [--to NODE] | list | clear [name]",
        "Make something go wrong in the graph, the same on each run.",
        example="  rosmini fault /scan --lose 0.3 --seed 1 + rosmini_sim/simulator",
    )  # fmt: skip
    parser.add_option("--lose", type="float", metavar="P", help="lose messages with probability P")
    parser.add_option("--double", type="float", metavar="P", help="let them arrive twice with probability P")
    parser.add_option("--delay", type="float", metavar="S", help="let them arrive S seconds late")
    parser.add_option("--jitter", type="float", metavar="S", help="and up to S seconds later still: they may overtake")
    parser.add_option("--to", default="", metavar="NODE", help="for this subscriber only, or the clock of this node")
    parser.add_option("--seed", type="int", metavar="N", help="what chance starts from (the graph's seed)")
    parser.flag("--kill", dest="kill", help="kill the node as kill -9 does: the Master is told nothing")
    parser.flag("--cut", dest="cut", help="cut the service off: calls fail")
    parser.add_option("--jump", type="float", metavar="S", help="let the clock jump by S seconds, also back")
    return parser


@TOOL.verb("make, list and clear faults", parser=_parser, needs_graph=True, takes="topic")
def make(given: Values, call: Call) -> Lines:
    """Make, list or clear faults."""
    parser, faults = _parser(), call.graph.faults
    what, *rest = given.words or [""]
    asked = [name for name in DISTURBANCES if getattr(given, name) is not None]
    kinds = ["disturb"] * bool(asked) + ["kill"] * given.kill + ["cut"] * given.cut
    kinds += ["jump"] * (given.jump is not None)
    if what in ("list", "clear") and not kinds:
        return _list(faults) if what == "list" else _clear(faults, rest, parser)
    if not what or rest or len(kinds) != 1:
        parser.error("name one topic, node or service, or `clock`, `list` or `clear`, and one kind of fault for it")
    to = global_name(given.to) if given.to else ""
    if kinds == ["jump"]:
        if what != "clock":
            parser.error(f"it is `fault clock --jump {given.jump:g} --to {what}` for the clock of a node")
        faults.jump(given.jump, to)
        return _said(f"the clock of {to or 'every node'} jumps by {given.jump:+g} s")
    name = global_name(what)
    if kinds == ["disturb"]:
        strengths = {option: getattr(given, option) for option in asked}
        return _said(str(faults.disturb(name, to=to, seed=given.seed, **strengths)))
    if kinds == ["kill"]:
        faults.kill(name)
        return _said(f"{name} was killed; the Master does not know it")
    faults.cut(name)
    return _said(f"{name} is cut off")


def _said(line: str) -> Lines:
    return Lines(lines=(line,))


def _list(faults: Faults) -> Lines:
    return Lines(lines=tuple(faults.lines()) or ("no faults",))


def _clear(faults: Faults, names: list[str], parser: Parser) -> Lines:
    if len(names) > 1:
        parser.error("name one topic, node or service to clear, or none to clear all faults")
    count = faults.clear(global_name(names[0]) if names else "")
    return _said(f"{count} fault{'s' * (count != 1)} cleared")
