"""`rosmini logo`: runs Logo programs for turtles of turtlesim, for robots, and on paper. ROS has no such command."""

from __future__ import annotations

from optparse import Values
from pathlib import Path

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.packages import PackageIndex
from rosmini.core.verbs import Call, Lines, Parser, Result, Shown, Tool, tool_node
from rosmini.sim.logo import Logo, LogoError

TOOL = Tool(
    "logo",
    "run a Logo program that drives turtles and robots",
    purpose="running programs in Logo",
    example="turtlesim/turtlesim_node",
    only_verb="run",
    group="Run and look",
)

PROMPT, MORE = "? ", "> "
"""UCBLogo's prompts for a new line and for a continued one."""


def _parser() -> Parser:
    parser = Parser(
        "rosmini logo", "%prog [options] [FILE [TURTLE ...]]",
        "Run a program in Logo. FILE is a file, or one of the programs that rosmini brings: "
        f"{', '.join(programs())}. Without FILE lines are read as they are typed. TURTLE is a turtle of turtlesim, or "
        "the namespace of a robot with cmd_vel and odom; if none is named, the first turtle of turtlesim draws, or, "
        "where there is no turtlesim, all robots drive.",
        example="  rosmini logo tree + turtlesim/turtlesim_node\n  rosmini logo --paper -o tree.svg tree",
    )  # fmt: skip
    parser.flag("--paper", help="draw on paper: no graph is needed")
    parser.add_option("-o", "--output", metavar="FILE", help="write the drawing (.svg, .html, .txt) there")
    parser.add_option("--title", metavar="TEXT", help="a caption under the drawing")
    parser.add_option("--seed", type="int", default=0, metavar="N", help="of random (0)")
    return parser


@TOOL.verb("run a program", parser=_parser, only_asks=lambda given: bool(given.paper))
def run(given: Values, call: Call) -> Result:
    """Run a program, or typed lines."""
    file, *names = given.words or [""]
    program = source(file) if file else None
    if given.paper:
        if names:
            _parser().error(f"--paper has one turtle; {names[0]} is in a graph")
        return _draw(Logo(say=call.say, seed=given.seed), program, given, call)
    with tool_node(call.graph, "logo") as node:
        return _draw(Logo.on(node, *names, say=call.say, seed=given.seed), program, given, call)


def _draw(logo: Logo, program: str | None, given: Values, call: Call) -> Result:
    if program is None:
        _converse(logo, call)
    else:
        logo.run(program)
    if not logo.drawing.strokes or (program is None and not given.output):
        return Lines()
    view = logo.drawing.show(title=given.title)
    return Shown(view=view, path=view.save(given.output) if given.output else None)


def _converse(logo: Logo, call: Call) -> None:
    """Read lines and run them, until `bye` or the end of input; an error or Ctrl-C ends only the program."""
    if call.read_line is None:
        raise RosminiError("no input is available here: name a file, or use %%logo in a notebook")
    text = ""
    while True:
        print(MORE if text else PROMPT, end="", flush=True)
        line = call.read_line()
        if not line or (not text and line.strip().lower() == "bye"):
            return
        text += line
        try:
            logo.run(text)
        except LogoError as error:
            if line.strip() and ("never closed" in error.message or "has no end" in error.message):
                continue
            call.say(str(error))
        except KeyboardInterrupt:
            call.say("stopped by Ctrl-C")
        text = ""


def programs() -> list[str]:
    """Return the names of the programs included in rosmini."""
    return sorted(path.stem for path in _folder().glob("*.logo"))


def source(name: str) -> str:
    """Return the text of a file or of an included program. Raises ``RosminiError`` if there is neither."""
    path = Path(name)
    if not path.is_file() and name in programs():
        path = _folder() / f"{name}.logo"
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        known = nearest(name, programs()) or f"rosmini brings {', '.join(programs())}"
        raise RosminiError(f"there is no program {name!r} to be read; {known}") from error


def _folder() -> Path:
    return PackageIndex().path("rosmini_logo") / "programs"
