"""Set up an IPython shell for ``%load_ext rosmini``."""

from __future__ import annotations

import atexit
import sys
from collections.abc import Callable
from typing import Any

from rosmini.core.errors import RosminiError, UsageError
from rosmini.core.geometry import machine_code
from rosmini.core.graph.notebook import has_reader, kernel_shell
from rosmini.core.packages import PackageIndex
from rosmini.ros.rospy.importer import install, ros_is_installed, uninstall
from rosmini.tools import magics
from rosmini.viz.embed import book_form

from . import file_cells, logo_cell, looking, node_cell, still_widgets
from .output import progress_in_cell
from .saving import save_package
from .session import Session, begin_session, end_session, session_of


def load(shell: Any) -> None:
    """Turn the cells of a notebook into terminals; a second call changes nothing.

    Afterwards ``import rospy`` finds rosmini's, ROS's commands are line magics, and there is a new graph in simulated
    time.
    """
    if is_loaded(shell):
        return
    install(shadow=True)
    if kernel_shell() is not None and not book_form():
        machine_code.show_progress = progress_in_cell
    if book_form() or (kernel_shell() is not None and not has_reader()):
        still_widgets.register(shell)
    report_which_ros()
    session = begin_session(shell)
    magics.register(shell, say=session.say, warn=session.warn, around=lambda: session_of(shell).raising())
    shell.events.register("pre_run_cell", session.begin_cell)
    shell.set_hook("complete_command", complete, str_key="%rosrun")
    atexit.register(end_session, shell)
    for kind, name, act in OWN_MAGICS:
        _register(shell, kind, name, act)


def unload(shell: Any) -> None:
    """Undo :func:`load`: end the graph, remove the notebook's package, and leave ``import rospy`` alone.

    Prints which nodes end with the graph, because ``%reload_ext`` calls this as well.
    """
    if not is_loaded(shell):
        return
    if nodes := [name for name in session_of(shell).graph.nodes if name != "/rosout"]:
        print(f"rosmini: the graph of this notebook ends, and these nodes with it: {', '.join(sorted(nodes))}")
    shell.events.unregister("pre_run_cell", session_of(shell).begin_cell)
    atexit.unregister(end_session)
    end_session(shell)
    uninstall()
    machine_code.show_progress = machine_code.progress


def is_loaded(shell: Any) -> bool:
    """Return whether the shell has a session."""
    return vars(shell).get("rosmini_session") is not None


def complete(_shell: Any, event: Any) -> list[str]:
    """Complete a word after ``%rosrun``: return packages, or executables of the given package, that begin with it."""
    before = event.text_until_cursor.lstrip().removeprefix("%").split()
    if event.text_until_cursor[-1:].isspace():
        before.append("")
    packages = PackageIndex()
    match before:
        case [_, start]:
            names = packages.names()
        case [_, package, start]:
            try:
                names = packages.executables(package)
            except RosminiError:
                return []
        case _:
            return []
    return [name for name in names if name.startswith(start)]


def report_which_ros() -> None:
    """Print which rospy an import finds, if there are two."""
    loaded = getattr(sys.modules.get("rospy"), "__file__", None)
    if loaded is not None and "rosmini" not in loaded:
        print("rosmini: rospy was imported before; restart the kernel, and %load_ext rosmini first.")
    elif ros_is_installed():
        print("rosmini: `import rospy` is rosmini's in this notebook, not that of the installed ROS.")


def roscore(session: Session, line: str) -> None:
    """End the graph and everything in it, and start a new one with the same time and seed, and a new Master.

    Raises ``UsageError`` for arguments.
    """
    if line.strip():
        raise UsageError(f"%roscore takes no arguments, not {line.strip()!r}: in a notebook it only starts a new graph")
    session.attach()
    session.begin()
    session.say(f"ROS_MASTER_URI={session.graph.master_uri}\nstarted core service [/rosout]")


def terminal(session: Session, line: str, cell: str) -> None:
    """Run the lines of a cell in a terminal, which keeps its folder and environment.

    ``%%terminal --at NAME`` uses a different terminal, ``%%terminal --new`` starts with an empty home folder.
    """
    session.attach()
    session.terminals.run(line, cell)


OWN_MAGICS: tuple[tuple[str, str, Callable[..., object]], ...] = (
    ("line", "roscore", roscore),
    ("line", "rosrun", node_cell.rosrun),
    ("line", "roslaunch", node_cell.roslaunch),
    ("cell", "node", node_cell.node),
    ("cell", "terminal", terminal),
    ("cell", "logo", logo_cell.logo),
    ("cell", "msg", file_cells.msg),
    ("cell", "srv", file_cells.srv),
    ("cell", "action", file_cells.action),
    ("cell", "launch", file_cells.launch),
    ("line", "save_package", save_package),
    ("line", "show", looking.show),
    ("line", "record", looking.record),
    ("line", "replay", looking.replay),
    ("line", "drag", looking.drag),
    ("line", "click", looking.click),
)
"""Magics for notebooks only: the kind, the name, and the function, which takes the session and the texts."""


def _register(shell: Any, kind: str, name: str, act: Callable[..., object]) -> None:
    """Register a magic in which only ``$name`` is replaced; ``act`` takes the session as first argument."""
    from IPython.core.magic import no_var_expand

    def magic(*texts: str) -> object:
        session = session_of(shell)
        session.require_main(f"%{'%' * (kind == 'cell')}{name}")
        with session.raising():
            return act(session, *texts)

    magic.__name__, magic.__doc__ = name, act.__doc__
    shell.register_magic_function(no_var_expand(magic), kind, name)
