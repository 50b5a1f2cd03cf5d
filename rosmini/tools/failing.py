"""Prints a finding of `roswtf` below the traceback of a cell, if one explains the error."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rosmini.core.graph import Graph
    from rosmini.ros.introspection.wtf.findings import Finding


def register(shell: Any) -> None:
    """Check each failing cell of an IPython shell; may be called repeatedly."""
    shell.events.register("post_run_cell", look)


def look(result: Any) -> None:
    """Print the explanation of a cell's error, if there is one."""
    error = result.error_in_exec
    if error is None:
        return
    with suppress(Exception, KeyboardInterrupt):  # the reader has an error already, or does not want to wait
        finding = explanation(error)
        if finding is not None:
            print(f"roswtf: {finding}")


def explanation(error: BaseException) -> Finding | None:
    """Return the finding that explains an error in the default graph; takes no graph time."""
    from rosmini.ros.introspection.wtf.explaining import explain, is_known
    from rosmini.ros.introspection.wtf.survey import survey

    if not is_known(error):
        return None
    graph = _graph()
    return explain(error, None if graph is None else survey(graph), _static)


def _graph() -> Graph | None:
    """Return the default graph if it exists and all its nodes are in this process: others may not answer."""
    if "rosmini.core.graph" not in sys.modules:
        return None
    from rosmini.core.graph import set_default_graph

    found = set_default_graph(None)
    if found is None:
        return None
    set_default_graph(found)
    if not found.master.is_local:
        return None
    state = found.ask_as("/roswtf").ask("getSystemState")
    names = {name for part in state for _, holders in part for name in holders}
    return found if names <= {*found.nodes} else None


def _static() -> Iterable[Finding]:
    from rosmini.core.packages import PackageIndex
    from rosmini.ros.introspection.wtf.static_rules import RULES

    packages = PackageIndex()
    return [found for rule in RULES for found in rule(os.environ, packages)]
