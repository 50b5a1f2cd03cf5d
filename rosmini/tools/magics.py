"""ROS's commands as line magics: ``%rostopic echo -n 3 /scan`` in a cell is ``rosmini rostopic echo -n 3 /scan``.

``%load_ext rosmini`` registers those of :data:`rosmini.tools.main.COMMANDS` that are magics. They act on the default
graph, print the output of the command, and return its result: ``found = %rosnode list``, then ``found.names``. In a
line only ``$name`` is replaced, by the value of that variable; braces belong to YAML. No shell is involved.
"""

from __future__ import annotations

import os
import re
import shlex
from contextlib import nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import UsageError, nearest
from rosmini.core.graph.notebook import mark_as_shown

from .completion import candidates
from .main import COMMANDS, Plugged, chosen

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from contextlib import AbstractContextManager

    from rosmini.core.verbs import Result, Tool

OPERATORS = "|<>;&"
"""Characters that are shell operators."""

SLIPS = ("roscpp", "rosmmsg", "rostop")
"""Frequent misspellings of commands; the error names the correct one."""

_VARIABLE = re.compile(r"\$(?:(\$)|([A-Za-z_]\w*))")


def register(
    shell: Any,
    *,
    say: Callable[[str], object] = print,
    warn: Callable[[str], object] = print,
    around: Callable[[], AbstractContextManager[object]] = nullcontext,
) -> None:
    """Register the commands as line magics of an IPython shell, with completion of their words.

    ``say`` prints output, ``warn`` prints problems, and each command runs in the context that ``around`` creates.
    """
    from IPython.core.magic import no_var_expand

    for name, entry in COMMANDS.items():
        if isinstance(entry, Plugged) or entry.is_magic:
            # The tools of other rooms import half of the library, so each is imported when it is first used.
            summary = f"a tool of {entry.entry_point.module}" if isinstance(entry, Plugged) else entry.summary
            magic = partial(run, shell, name, say=say, warn=warn)
            shell.register_magic_function(no_var_expand(_documented(magic, name, summary, around)), "line", name)
            shell.set_hook("complete_command", _complete, str_key=f"%{name}")
    for name in SLIPS:
        shell.register_magic_function(no_var_expand(_slip(name)), "line", name)


def _slip(name: str) -> Callable[[str], None]:
    def act(line: str) -> None:
        chosen([name, *line.split()])

    act.__name__, act.__doc__ = name, "This is no command; its error names the one that is meant."
    return act


def _documented(
    magic: Callable[[str], Result], name: str, summary: str, around: Callable[[], AbstractContextManager[object]]
) -> Callable[[str], Result]:
    """Return the magic as a function with a name and a help text."""

    def act(line: str) -> Result:
        with around():
            return magic(line)

    act.__name__, act.__doc__ = name, f"{summary}. `%{name} -h` lists the verbs."
    return act


def _complete(_shell: Any, event: Any) -> list[str]:
    """Return the completions of the word before the cursor."""
    from rosmini.core.graph import running_graph

    before = event.text_until_cursor.lstrip().removeprefix("%").split()
    if event.text_until_cursor[-1:].isspace():
        before.append("")
    return candidates(before, running_graph())


def tool(name: str) -> Tool:
    """Return the tool that a magic runs. Raises ``UsageError`` if the command is only for terminals."""
    found = COMMANDS[name].tool()
    if found is None or not found.is_magic:
        raise UsageError(f"{name} is not a magic: run `rosmini {name}` in a terminal")
    return found


def run(
    shell: Any,
    name: str,
    line: str,
    *,
    say: Callable[[str], object] = print,
    warn: Callable[[str], object] = print,
    console: Mapping[str, Any] | None = None,
) -> Result:
    """Run a line, print the output, and return the result; ``console`` is for nodes that it starts.

    Problems are printed like all other output: a notebook shows standard error after standard output. Raises as
    :meth:`rosmini.tools.verbs.Tool.run` does.
    """
    split = words(line, name, shell.user_ns)
    result = tool(name).run(*split, say=say, warn=warn, tells_time=True, console=console)
    view = getattr(result, "view", None)
    if view is not None:
        from IPython.core.display_functions import display

        display(view)  # type: ignore[no-untyped-call]
    for text in filter(None, ("" if view else str(result), *result.complaints)):
        say(text)
    mark_as_shown(result, shell)
    return result


def words(line: str, name: str, variables: Mapping[str, Any]) -> list[str]:
    """Return the words of a line, split as in a shell, with ``$name`` replaced; ``$$`` is a dollar sign.

    Raises ``UsageError`` for shell features, an unterminated quotation, and an unknown variable.
    """
    lexer = shlex.shlex(line, posix=True, punctuation_chars=OPERATORS)
    lexer.whitespace_split, lexer.commenters = True, ""
    if os.name == "nt":
        lexer.escape = ""  # there it separates folders
    try:
        split = list(lexer)
    except ValueError as error:
        raise UsageError(f"%{name}: {error}: a quotation mark in the line has no partner") from error
    for word in split:
        if word and not word.strip(OPERATORS):
            raise UsageError(
                f"%{name} runs no shell, and `{word}` is a shell's. Quote it if it belongs to an argument; "
                f"the result itself is what `result = %{name} ...` returns"
            )
    return [_VARIABLE.sub(partial(_value, variables, name), word) for word in split]


def _value(variables: Mapping[str, Any], name: str, match: re.Match[str]) -> str:
    if match[1]:
        return "$"
    if match[2] not in variables:
        own = [known for known in variables if not known.startswith("_")]
        hint = nearest(match[2], own) or "write $$ for a dollar sign"
        raise UsageError(f"%{name}: there is no variable {match[2]}; {hint}")
    return str(variables[match[2]])
