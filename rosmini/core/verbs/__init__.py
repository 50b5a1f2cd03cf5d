"""Command-line tools: verbs, their options and results, and verbs that listen."""

from __future__ import annotations

from .listening import SECOND, Span, tool_node
from .options import Parser, add_duration, below_here, dashed_remapping, duration_ns, global_name
from .tool import NOT_A_VERB, ArgumentParser, Call, Lines, Overview, Prompt, Result, Shown, Tool, Verb, VerbError, shown

__all__ = [
    "NOT_A_VERB",
    "SECOND",
    "ArgumentParser",
    "Call",
    "Lines",
    "Overview",
    "Parser",
    "Prompt",
    "Result",
    "Shown",
    "Span",
    "Tool",
    "Verb",
    "VerbError",
    "add_duration",
    "below_here",
    "dashed_remapping",
    "duration_ns",
    "global_name",
    "shown",
    "tool_node",
]
