"""``%%logo [--title TEXT] [TURTLE ...]``: the cell is a Logo program for turtles and robots of the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import UsageError
from rosmini.sim.logo import Logo, LogoError
from rosmini.tools.magics import words as words_of

if TYPE_CHECKING:
    from .session import Session

USAGE = "%%logo [--title TEXT] [TURTLE ...]"

TITLE = "--title"


def logo(session: Session, line: str, cell: str) -> Any:
    """Run the cell as a Logo program; show the drawing.

    Without names it drives turtlesim's first turtle, or all robots, or a turtle on paper. Later cells share the
    procedures and the drawing of this one until %roscore, and until clearscreen.
    The error of a program is printed with its line in the cell; like a ``%%node`` cell, the cell itself does not fail.
    Raises ``UsageError`` for an invalid line, and ``LogoError`` for an unknown turtle.
    """
    words = words_of(line, "%logo", session.shell.user_ns)
    title: str | None = None
    if TITLE in words:
        at = words.index(TITLE)
        if at + 1 == len(words):
            raise UsageError(f"{TITLE} takes a caption. Usage: {USAGE}")
        title = words[at + 1]
        del words[at : at + 2]
    wrong = next((word for word in words if word.startswith("-")), None)
    if wrong is not None:
        raise UsageError(f"unknown option {wrong!r}. Usage: {USAGE}")
    session.attach()
    interpreter = session.logo(tuple(words), lambda: _begin(session, words))
    before = interpreter.drawing.lines
    try:
        interpreter.run(cell, first_line=2)
    except LogoError as error:
        session.say(str(error))
    drawing = interpreter.drawing
    has_changed = title is not None or drawing.lines != before
    return drawing.show(title=title) if has_changed and drawing.strokes else None


def _begin(session: Session, names: list[str]) -> Logo:
    graph = session.graph
    return Logo.on(graph.node("logo", anonymous=bool(session.logos)), *names, say=session.say)
