"""`roslaunch` (http://wiki.ros.org/roslaunch) as a function, to be used in notebooks and programs."""

from __future__ import annotations

import os
import sys
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.graph import Graph, running_graph
from rosmini.core.names import is_remapping
from rosmini.core.packages import PackageIndex

from .reader import find_file, read
from .running import Launch, differences, in_graph

if TYPE_CHECKING:
    from .plan import Plan


def plan_of(*words: str | os.PathLike[str], lenient: bool = False, **args: Any) -> Plan:
    """Return the plan of launch files without running anything.

    Args:
        words: a package and a launch file in it, or paths; and ``name:=value`` for arguments.
        lenient: continue if something is missing, see `rosmini.ros.launch.read`.
        args: further arguments as keyword arguments.

    Raises:
        LaunchError: a file is missing or invalid, with file and line; or something else is missing.

    """
    texts = [os.fspath(word) for word in words]
    given = dict(word.split(":=", 1) for word in texts if is_remapping(word))
    given |= {name: str(value).lower() if isinstance(value, bool) else str(value) for name, value in args.items()}
    index = PackageIndex()
    files = find_file([word for word in texts if not is_remapping(word)], index)
    return read(*files, args=given, packages=index, lenient=lenient)


def roslaunch(
    *words: str | os.PathLike[str], graph: Graph | None = None, console: dict[str, Any] | None = None, **args: Any
) -> Launch:
    """Start all nodes of launch files in one graph and return at once; they run while the graph is driven.

    Args:
        words: as for `plan_of`.
        graph: where to run; by default the graph that runs the caller, or else the default graph.
        console: ``stdin``, ``stdout``, ``stderr``, ``prefix`` and ``capture_output`` of
            :class:`~rosmini.ros.scripts.Console`.
        args: arguments of the launch file as keyword arguments.

    Raises:
        LaunchError: as for `plan_of`.

    """
    plan = plan_of(*words, **args)
    used = running_graph() if graph is None else graph
    out = (console or {}).get("stdout") or sys.stdout
    warn = partial(print, file=out, flush=True)
    launch = Launch(plan, used, in_graph(used, **(console or {})), warn=warn)
    plan.warnings += differences(plan)
    launch.start()
    return launch
