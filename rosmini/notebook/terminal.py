"""``%%terminal``: a cell whose lines run as in a terminal, on every system, without a shell.

    %%terminal
    mkdir -p ~/example_ws/src
    cd ~/example_ws
    catkin_make
    source devel/setup.bash

Each line is shown after a ``$``, then its output. A terminal keeps its folder and its environment from cell to
cell. It starts in ``~``, an empty temporary folder, and writes nowhere else. It knows ROS's commands by their bare
names, which are the line magics, and a shell's first words, see :data:`rosmini.notebook.shell_words.WORDS`.

``%%terminal --at robot`` is a second terminal with its own environment, like a second window. ``%%terminal --new``
starts with an empty home folder. Exports of the first terminal also apply to line magics and ``%%node``.
"""

from __future__ import annotations

import io
import os
import re
import shlex
import socket
import sys
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO, cast

from rosmini.core import files
from rosmini.core.errors import RosminiError, UsageError, nearest
from rosmini.core.graph import default_graph
from rosmini.core.verbs import VerbError
from rosmini.ros.catkin.setup_files import folders_in
from rosmini.ros.net.addresses import MASTER_URI, host_and_port, is_loopback
from rosmini.tools.aliases import names as ros_names
from rosmini.tools.magics import tool
from rosmini.tools.main import COMMANDS, NO_COMMANDS, main
from rosmini.tools.roscd import located, workspace

from . import shell_lines, shell_words
from .package import TemporaryFolder
from .places import ROS, Places, ShownStream
from .prompt import Prompt, changed, put
from .shell_words import WORDS, Given, word

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

FIRST = "1"
"""Name of the default terminal."""

_SETUP = re.compile(rf"{ROS}/setup\.(bash|sh|zsh)")
_ASSIGNMENT = re.compile(r"([A-Za-z_]\w*)=(.*)", re.DOTALL)

_WRITE = "a cell has no editor: write a file with `cat > FILE << 'EOF'`, or a script with %%node"
_NETWORK = "nothing is fetched here: write the file with `cat > FILE << 'EOF'`, or a script with %%node"
_SYSTEM = "there is nothing to install here"
_PYTHON = "use rosrun to start a script of a package; a cell with %%node is such a script"
NOT_HERE = {
    **dict.fromkeys(("nano", "vi", "vim", "emacs", "gedit", "code"), _WRITE),
    **dict.fromkeys(("wget", "curl", "git", "ssh"), _NETWORK),
    **dict.fromkeys(("sudo", "apt", "apt-get", "pip", "rosdep"), _SYSTEM),
    **dict.fromkeys(("python", "python3"), _PYTHON),
}
"""Commands that are missing here, and what to do instead."""


class Terminal(Prompt):
    """One terminal: runs lines, and prints them with their output."""

    def __init__(self, places: Places, shell: Any, attach: Callable[[], object]) -> None:
        super().__init__(places)
        self._shell = shell
        self._attach = attach
        self.status = 0
        """Exit status of the last command."""
        profile = places.home / ".bashrc"
        if profile.is_file():
            self.run_file(profile)

    def run(self, text: str) -> None:
        """Run the lines of a cell. Raises ``UsageError`` for an unknown command before any line runs."""
        lines = shell_lines.parse(text)
        self._check(lines)
        out = cast("TextIO", ShownStream(sys.stdout, self.places))
        try:
            with redirect_stdout(out), redirect_stderr(out):
                for line in lines:
                    print(f"$ {line.text}")
                    self._line(line)
        finally:
            self._attach()

    def run_file(self, path: Path) -> None:
        """Run the lines of a file, without showing them."""
        lines = shell_lines.parse(files.read(path).decode("utf-8", "replace"))
        self._check(lines)
        for line in lines:
            self._line(line)

    def _check(self, lines: Sequence[shell_lines.Line]) -> None:
        """Raise ``UsageError`` for an unknown command."""
        for line in lines:
            for pipeline in line.pipelines:
                for command in pipeline.commands:
                    words = [each for each in command.words if not _ASSIGNMENT.match(each)]
                    if words and "$" not in words[0]:
                        self._find(shell_lines.unquoted(words[0]), line.number)

    def _find(self, name: str, number: int) -> None:
        if name in WORDS or name in ros_names():
            return
        known = [*ros_names(), *WORDS]
        hint = NOT_HERE.get(name) or NO_COMMANDS.get(name) or nearest(name, known)
        commands = f"it knows ROS's commands (rosrun, rostopic, catkin_make ...) and {', '.join(sorted(WORDS))}"
        raise UsageError(f"%%terminal, line {number}: there is no command {name!r} here; {hint or commands}")

    def _line(self, line: shell_lines.Line) -> None:
        for pipeline in line.pipelines:
            if (pipeline.after == "&&" and self.status) or (pipeline.after == "||" and not self.status):
                continue
            text: str | None = None
            for command in pipeline.commands:
                text = self._command(command, text, is_last=command is pipeline.commands[-1])

    def _command(self, command: shell_lines.Command, text: str | None, *, is_last: bool) -> str:
        """Run one command, which reads ``text``, and return its output for the next one."""
        if command.text is not None:
            text = command.text if command.text_is_raw else shell_lines.expand_variables(command.text, self._value)
        written = io.StringIO() if command.to is not None or not is_last else None
        name, words = "", list(command.words)
        try:
            settings = self._settings(words)
            name, *rest = words or [""]
            rest = [each for one in rest for each in self._expanded(one)]
            with changed({}) if written is None else redirect_stdout(cast("TextIO", written)):
                self.status = self._run(shell_lines.expand(name, self._value), rest, text, settings)
            if command.to is not None and written is not None:
                self._write(command.to, written.getvalue())
        except SystemExit as ended:  # a help, or invalid arguments
            self.status = ended.code if isinstance(ended.code, int) else 0
        except VerbError as error:
            self._failed(str(error), error.status)
        except (UsageError, RosminiError) as error:
            is_tools = isinstance(error, UsageError) and name not in WORDS
            self._failed(str(error) if is_tools else f"{name}: {error}", 1)
        except OSError as error:
            self._failed(f"{name}: {error.filename or ''}: {error.strerror}", 1)
        return "" if written is None or command.to is not None else written.getvalue()

    def _failed(self, text: str, status: int) -> None:
        print(text)
        self.status = status

    def _settings(self, words: list[str]) -> dict[str, str]:
        """Remove the ``NAME=VALUE`` before a command from its words, and return them."""
        found = {}
        while words and (match := _ASSIGNMENT.match(words[0])):
            found[match[1]] = shell_lines.expand(match[2], self._value)
            del words[0]
        return found

    def _expanded(self, raw: str) -> list[str]:
        meant = shell_lines.expand(raw, self._value)
        return [meant] if shell_lines.is_quoted(raw) else self.words(meant)

    def _value(self, name: str) -> str:
        return str(self.status) if name == "?" else self.environment.get(name, "")

    def _write(self, to: shell_lines.Redirection, text: str) -> None:
        name = shell_lines.expand(to.file, self._value)
        if name == "/dev/null":
            return
        path = self.path(name, writes=True)
        with path.open("a" if to.appends else "w", encoding="utf-8", newline="\n") as file:
            file.write(text)

    def _run(self, name: str, words: list[str], text: str | None, settings: dict[str, str]) -> int:
        """Run a command, print its output, and return its exit status."""
        if not name:
            self.environment.update(settings)
            return 0
        self._attach()
        before = self.environment
        self.environment = {**before, **settings} if settings else before
        try:
            with self.inside(self._base()):
                if name in WORDS:
                    print(shell_words.run(self, name, words, text), end="")
                    return 0
                return self._tool(name, words, text)
        finally:
            self.environment = before if settings else self.environment

    def _base(self) -> dict[str, str]:
        """Return the environment around the terminal."""
        return dict(os.environ)

    def _tool(self, name: str, words: list[str], text: str | None) -> int:
        """Run one of ROS's commands: as in a terminal if it only reads files, else as a line magic on the graph."""
        for each in words:
            self._guard(each)
        words = [self.places.real(each) for each in words]
        if COMMANDS[name].is_magic and not tool(name).needs_graph:
            with typed(text or ""):
                return main([name, *words])
        if self._shell.find_line_magic(name) is None:
            raise RosminiError("this notebook has no graph: begin it with %load_ext rosmini")
        if _asks_master(name, words):
            self._reach_master()
        line = " ".join(shlex.quote(each).replace("$", "$$") for each in words)
        result = self._shell.run_line_magic(name, line)
        return int(getattr(result, "status", 0))

    def _reach_master(self) -> None:
        """Raise ``VerbError`` with ROS's message if ``ROS_MASTER_URI`` is not the address of the notebook's Master."""
        given = self.environment.get("ROS_MASTER_URI") or MASTER_URI
        own = default_graph().master_uri.rstrip("/")
        (host, port), (own_host, own_port) = host_and_port(given, "ROS_MASTER_URI"), host_and_port(own)
        is_here = host == own_host or is_loopback(host) or host in (socket.gethostname(), socket.getfqdn())
        if not (is_here and port == own_port):
            raise VerbError(
                f"ERROR: Unable to communicate with master!\nROS_MASTER_URI is {given}, and the only Master that a "
                f"notebook reaches is its own: `export ROS_MASTER_URI={own}`"
            )

    def _guard(self, word: str) -> None:
        """Raise `OutsideHome` for the path of a file outside the folders that this terminal may use."""
        path = Path(self.places.real(word.rpartition("=")[2]))
        leaves = ".." in path.parts or (
            path.is_absolute() and path.parent != Path(path.anchor) and path.parent.is_dir()
        )
        if leaves:
            self.path(str(path))


def _asks_master(name: str, words: Sequence[str]) -> bool:
    """Return whether a ROS command needs the Master."""
    if name == "rosbag":
        return words[:1] in (["record"], ["play"])
    return name in ("rosrun", "roslaunch") or (name != "roscore" and bool(tool(name).purpose))


@contextmanager
def typed(text: str) -> Iterator[None]:
    """Use a text as standard input inside the block."""
    before, sys.stdin = sys.stdin, io.StringIO(text)
    try:
        yield
    finally:
        sys.stdin = before


@word("source", at_least=1)
def source(terminal: Prompt, given: Given) -> str:
    """Run the lines of a file in this terminal: ``source devel/setup.bash``."""
    name = given.words[0]
    if _SETUP.fullmatch(name):
        terminal.set_up()
        return ""
    if name.startswith("/opt/ros/"):
        raise RosminiError(f"{name}: No such file or directory; the ROS of this book is {ROS}")
    path = terminal.path(name)
    if not path.is_file():
        hint = "; run catkin_make in the workspace's folder to make it" if path.parent.name == "devel" else ""
        raise RosminiError(f"{name}: No such file or directory{hint}")
    folders = folders_in(path)
    if folders is not None:
        terminal.set_up(folders)
    elif isinstance(terminal, Terminal):
        terminal.run_file(path)
    return ""


WORDS["."] = WORDS["source"]


@word("roscd")
def roscd(terminal: Prompt, given: Given) -> str:
    """Go to the folder of a package, or without arguments to the workspace."""
    found = located(given.words[0], "cd to") if given.words else workspace(os.environ)
    path = terminal.path(str(found))
    if not path.is_dir():
        raise RosminiError(f"{given.words[0]}: Not a directory")
    terminal.go(path)
    return ""


class Terminals:
    """The terminals of a notebook. They share a home folder, which is removed when the kernel ends.

    ``attach`` is called when output goes elsewhere: to a file, or back to the cell.
    """

    def __init__(self, shell: Any, attach: Callable[[], object] = lambda: None) -> None:
        self._shell = shell
        self._attach = attach
        self._folder: TemporaryFolder | None = None
        self._places: Places | None = None
        self._open: dict[str, Terminal] = {}
        self._own: dict[str, str | None] = {}

    def run(self, line: str, cell: str) -> None:
        """Run the lines of a cell in a terminal.

        ``%%terminal --at NAME`` uses a different terminal, ``%%terminal --new`` starts with an empty home folder.
        """
        words = shlex.split(line)
        name = FIRST
        while words:
            option = words.pop(0)
            if option == "--new":
                self.begin_again()
            elif option == "--at" and words:
                name = words.pop(0)
            else:
                raise UsageError(f"%%terminal: {option}: its options are --at NAME and --new")
        put(self._own)
        try:
            self._at(name).run(cell)
        finally:
            self._publish()

    def begin_again(self) -> None:
        """Close all terminals, and empty the home folder."""
        put(self._own)
        self._own, self._open = {}, {}
        if self._places is not None:
            Prompt(self._places).remove(self._places.home)

    def close(self) -> None:
        """Close all terminals, and remove the home folder."""
        put(self._own)
        self._own, self._open, self._places = {}, {}, None
        if self._folder is not None:
            self._folder.remove()
            self._folder = None

    def _at(self, name: str) -> Terminal:
        if self._places is None:
            self._folder = TemporaryFolder()
            home = self._folder.path / "home"
            home.mkdir()
            self._places = Places(home)
        if name not in self._open:
            self._open[name] = Terminal(self._places, self._shell, self._attach)
        return self._open[name]

    def _publish(self) -> None:
        """Give the notebook's other cells the environment of the first terminal."""
        if FIRST not in self._open:
            return
        wanted = self._open[FIRST].real_environment(os.environ)
        new = {name: value for name, value in wanted.items() if value is not None and value != os.environ.get(name)}
        self._own = {name: os.environ.get(name) for name in new}
        put(new)
