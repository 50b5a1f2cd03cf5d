"""Shared functions of the tools that read a graph's recording."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.core.verbs import VerbError

if TYPE_CHECKING:
    from rosmini.core.graph.observers.recording import Recording
    from rosmini.core.verbs import Call, Parser


def add_duration(parser: Parser) -> None:
    """Add the option that makes a graph record first."""
    parser.add_option(
        "--duration", type="float", metavar="S",
        help="first record for S seconds of graph time: for graphs that do not record from the start, as notebooks' do",
    )  # fmt: skip


def recorded(call: Call, duration: float | None) -> Recording:
    """Return the graph's recording, after ``duration`` seconds more.

    Raises ``VerbError`` if it does not record and no duration is given.
    """
    graph = call.graph
    if duration is not None:
        recording = graph.record()
        graph.run(duration)
        everything = graph.recorded
        recording.stop()
        if everything is not None:
            return everything
    found = graph.recorded
    if found is None:
        raise VerbError(
            "this graph records nothing: --duration 5 records for 5 s from now on, graph.record() in Python until its "
            "stop(); a notebook's graph after %load_ext rosmini always records"
        )
    return found
