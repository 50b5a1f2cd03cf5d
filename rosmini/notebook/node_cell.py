"""``%%node talker.py [args]``: the cell is a script, and runs as a node."""

from __future__ import annotations

import re
import shlex
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ScriptError, UsageError
from rosmini.ros.scripts import Console, ScriptHandle, ScriptSpec, find
from rosmini.ros.scripts.node_handle import NodeHandle, NodeSpec
from rosmini.ros.scripts.source import compile_script
from rosmini.ros.scripts.streams import Quiet
from rosmini.tools.magics import run
from rosmini.tools.magics import words as words_of

from .runs import RunKey

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rosmini.core.verbs import Result
    from rosmini.ros.launch import Launch
    from rosmini.ros.scripts.streams import OutputSink

    from .session import Session

SHEBANG = "#!/usr/bin/env python3"
"""First line of a script: it replaces the line of the magic, so that line numbers agree."""

STDIN, QUIET = "--stdin", "--quiet"
STARTUP_NS = 3_000_000_000
"""Time in which the warnings of a quiet program are hidden [ns of graph time]."""

_PRINTS = re.compile(r"\bprint\b|\blog(?:debug|info|warn|err|fatal)|\blogging\b|\bstd(?:out|err)\b|\binput\b")
"""Text that occurs in scripts that print."""


@dataclass(frozen=True)
class Words:
    """The words of a line: what to start, its arguments, the text of its standard input, and whether it is quiet."""

    what: tuple[str, ...]
    args: tuple[str, ...]
    stdin: str | None
    is_quiet: bool

    @classmethod
    def of(cls, line: str, name: str, count: int, usage: str, variables: Mapping[str, Any]) -> Words:
        """Read a line whose first ``count`` words say what to start. Raises ``UsageError`` with the ``usage``."""
        words = words_of(line, name, variables)
        stdin: str | None = None
        is_quiet = _take(words, QUIET)
        if STDIN in words:
            at = words.index(STDIN)
            if at + 1 == len(words):
                raise UsageError(f"{STDIN} takes the text to type, such as {STDIN} '3\\n4'. Usage: {usage}")
            stdin = words[at + 1].replace("\\n", "\n").removesuffix("\n") + "\n"
            del words[at : at + 2]
        what = words[:count]
        wrong = next((word for word in what if word.startswith("-")), None)
        if wrong is not None:
            raise UsageError(f"unknown option {wrong!r}. Usage: {usage}")
        if len(what) < count:
            raise UsageError(f"usage: {usage}")
        return cls(tuple(what), tuple(words[count:]), stdin, is_quiet)


def node(session: Session, line: str, cell: str) -> None:
    """Write the cell as a script into the notebook's package, and start it until it blocks.

    Raises ``UsageError`` for an invalid line, and ``ScriptError`` for a cell that is not valid Python: then nothing
    is written or ended.
    """
    given = Words.of(line, "%node", 1, f"%%node NAME.py [ARGS] [{STDIN} TEXT] [{QUIET}]", session.shell.user_ns)
    name = given.what[0]
    if not name.endswith(".py"):
        raise UsageError(f"%%node writes a Python script: call it {name.partition('.')[0]}.py, not {name}")
    text = f"{SHEBANG}\n{cell}"
    path = session.package.file("scripts", name)
    _check(session, name, text)
    _start_script(session, path, name, given, text)


def rosrun(session: Session, line: str) -> None:
    """Start an executable of a package until it blocks, like `rosrun PACKAGE EXECUTABLE [ARGS] &`.

    Raises ``UsageError`` for an invalid line, and the errors of :func:`rosmini.rosrun`.
    """
    usage = f"%rosrun PACKAGE EXECUTABLE [ARGS] [{STDIN} TEXT] [{QUIET}]"
    given = Words.of(line, "rosrun", 2, usage, session.shell.user_ns)
    package, name = given.what
    found = find(f"{package}/{name}")
    if found.path is not None:
        _start_script(session, found.path, name, given)
        return
    graph = session.graph
    session.attach()
    console = partial(Console, graph.scheduler, stdin="", sink=_output(session, given.is_quiet))
    session.runs.start(
        RunKey.of(f"{package}/{name}", given.args),
        name,
        lambda: NodeHandle(graph, NodeSpec(found, given.args), console),
        may_print=False,
    )


def roslaunch(session: Session, line: str) -> Result:
    """Start the nodes of launch files, or print information about the files, like the command.

    ``--quiet`` hides what they log while they start, but for errors, and later also what is no warning or error.
    Raises the errors of the command.
    """
    session.attach()
    words = words_of(line, "roslaunch", session.shell.user_ns)
    is_quiet = _take(words, QUIET)
    say = (lambda text: None if text.startswith("process[") else session.say(text)) if is_quiet else session.say
    console = {"stdin": "", "sink": _output(session, is_quiet)}
    results: list[Result] = []

    def start() -> Launch | None:
        results.append(run(session.shell, "roslaunch", shlex.join(words), say=say, console=console))
        return getattr(results[0], "launch", None)

    session.runs.launch(words, start)
    return results[0]


def _output(session: Session, is_quiet: bool) -> OutputSink:
    """Return the output for programs that start now."""
    if not is_quiet:
        return session.sink
    now_ns = session.graph.scheduler.now_ns
    end_ns = now_ns() + STARTUP_NS
    return Quiet(session.sink, lambda: now_ns() < end_ns)


def _take(words: list[str], word: str) -> bool:
    """Remove a word, and return whether it was there."""
    has = word in words
    words[:] = [each for each in words if each != word]
    return has


def _start_script(session: Session, path: Path, title: str, given: Words, text: str | None = None) -> None:
    """Start the script at ``path``; write it first if its text is given.

    Its standard input comes from ``--stdin``, or from the reader.
    """
    graph = session.graph
    advice = f"add {STDIN} TEXT to the line that starts {title}"
    stdin = session.typed(advice) if given.stdin is None else given.stdin
    source = path.read_text(encoding="utf-8", errors="replace") if text is None else text
    session.attach()
    console = partial(Console, graph.scheduler, stdin=stdin, sink=_output(session, given.is_quiet))

    def make() -> ScriptHandle:
        if text is not None:
            session.package.write("scripts", path.name, text, may_run=True)
        return ScriptHandle(graph, ScriptSpec(str(path), given.args), console, seed=_seed(given.args))

    session.runs.start(
        RunKey.of(str(path), given.args),
        title,
        make,
        may_print=_PRINTS.search(source) is not None,
        is_readers=path.is_relative_to(session.package.workspace) and not given.is_quiet,
    )


def _seed(args: Sequence[str]) -> str:
    """Return the seed of a run: runs of one file with different arguments differ."""
    return f"0/{' '.join(args)}"


def _check(session: Session, name: str, text: str) -> None:
    """Raise ``ScriptError`` for invalid Python, displayed like a syntax error in a cell."""
    try:
        compile_script(text.encode(), name)
    except ScriptError as error:
        cause = error.__cause__
        if isinstance(cause, SyntaxError):
            vars(error)["_render_traceback_"] = partial(_shown, session.shell, cause, str(error))
        raise


def _shown(shell: Any, cause: SyntaxError, text: str) -> list[str]:
    """Return IPython's display of a syntax error, and our advice."""
    lines: list[str] = shell.SyntaxTB.structured_traceback(type(cause), cause, [])
    known = text.partition("\n")[0]
    return lines if "this is not Python" in known else [*lines, known]
