"""`rosmini aliases`: lines for a shell that give ROS's commands their bare names, with completion.

`eval "$(rosmini aliases)"` in ~/.bashrc or ~/.zshrc makes `rostopic list` work; in PowerShell it is
`rosmini aliases powershell | Out-String | Invoke-Expression`. A name that the shell knows already, as where ROS itself
is set up, is left alone.
"""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import sys
from pathlib import Path

from .main import COMMANDS

SHELLS = ("bash", "zsh", "powershell")

PATIENCE_S = 1.0
"""Timeout for an answer of the Master when a word is completed [s]."""

EMPTY = '""'
"""An empty word as passed by PowerShell, which up to 7.2 drops truly empty words."""

_ROS = ("ros", "rqt", "catkin_")
"""Prefixes of ROS's commands; rosmini's own, such as `rosmini test`, have no bare name."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `aliases`."""
    parser = subparsers.add_parser(
        "aliases",
        help="print lines for a shell: bare names (rostopic, rosnode ...) and completion",
        description=__doc__,
        epilog='for example: eval "$(rosmini aliases bash)"',
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("shell", nargs="?", choices=SHELLS, help="by default the one that runs, by $SHELL")
    parser.add_argument(
        "--complete", nargs=argparse.REMAINDER, metavar="WORD", help="print what the last word may become (for shells)"
    )
    return parser


def main(args: argparse.Namespace) -> int:
    """Print the lines, or the completions of a word."""
    if args.complete is not None:
        return _complete(args.complete)
    shell = args.shell or _shell()
    print(lines(shell, _program()), end="")
    kept = [name for name in names() if shutil.which(name)]
    if kept:
        print(
            f"rosmini: these commands are of the ROS that is installed here, and stay so: {', '.join(kept)}. "
            f"For rosmini's, write `rosmini {kept[0]}`.",
            file=sys.stderr,
        )
    return 0


def names() -> list[str]:
    """Return the commands that have bare names: ROS's."""
    return [name for name, entry in COMMANDS.items() if entry.folder is None and name.startswith(_ROS)]


def lines(shell: str, program: list[str]) -> str:
    """Return the lines for a shell; ``program`` is the command that starts rosmini."""
    if shell == "powershell":
        start = "& " + " ".join(f"'{word.replace(chr(39), chr(39) * 2)}'" for word in program)
        return "".join(_POWERSHELL.format(name=name, start=start, call=_cd(shell, name, start)) for name in names())
    start = shlex.join(program)
    head = (_BASH if shell == "bash" else _ZSH).format(start=start)
    completes = "complete -o default -F _rosmini_complete" if shell == "bash" else "compdef _rosmini_complete"
    return head + "".join(
        f"if ! type {name} >/dev/null 2>&1; then {name}() {{ {_cd(shell, name, start)}; }}; {completes} {name}; fi\n"
        for name in names()
    )


def _cd(shell: str, name: str, start: str) -> str:
    """Return the body of a name's function: start the command; `roscd` changes the folder."""
    if shell == "powershell":
        return (
            f"$there = {start} roscd @args; if ($there) {{ Set-Location $there }}"
            if name == "roscd"
            else (f"{start} {name} @args")
        )
    if name == "roscd":
        return f'local there; there=$({start} roscd "$@") && cd "$there"'
    return f'{start} {name} "$@"'


def _shell() -> str:
    """Return the shell that is probably running."""
    if os.name == "nt" and "SHELL" not in os.environ:
        return "powershell"
    name = Path(os.environ.get("SHELL", "bash")).name
    return name if name in SHELLS else "bash"


def _program() -> list[str]:
    """Return the command that starts rosmini from any folder."""
    found = shutil.which("rosmini")
    return [str(Path(found).absolute())] if found else [sys.executable, "-m", "rosmini"]


def _complete(words: list[str]) -> int:
    from rosmini.core.errors import RosminiError
    from rosmini.ros.introspection.direct import DirectWire
    from rosmini.ros.net.addresses import addresses

    from .completion import candidates

    try:
        with DirectWire(addresses().master_uri, master_s=PATIENCE_S, node_s=PATIENCE_S) as wire:
            found = candidates(["" if word == EMPTY else word for word in words], wire)
    except RosminiError:  # such as an invalid address of the Master: shells want words, not messages
        return 1
    print("".join(f"{word}\n" for word in found), end="")
    return 0


_BASH = """\
_rosmini_complete() {{
    local IFS=$'\\n'
    COMPREPLY=($({start} aliases --complete "${{COMP_WORDS[@]:0:COMP_CWORD+1}}" 2>/dev/null))
}}
complete -o default -F _rosmini_complete rosmini
"""

_ZSH = """\
if ! type compdef >/dev/null 2>&1; then autoload -Uz compinit && compinit -i; fi
_rosmini_complete() {{
    local -a found
    found=("${{(@f)$({start} aliases --complete "${{(@)words[1,CURRENT]}}" 2>/dev/null)}}")
    compadd -- $found || _files
}}
compdef _rosmini_complete rosmini
"""

_POWERSHELL = """\
if (-not (Get-Command {name} -ErrorAction SilentlyContinue)) {{
    function global:{name} {{ {call} }}
    Register-ArgumentCompleter -Native -CommandName {name} -ScriptBlock {{
        param($word, $line, $cursor)
        $words = @($line.CommandElements | ForEach-Object {{ $_.ToString() }})
        if (-not $word) {{ $words += '""' }}
        {start} aliases --complete @words | ForEach-Object {{
            [System.Management.Automation.CompletionResult]::new($_, $_, 'ParameterValue', $_)
        }}
    }}
}}
"""
