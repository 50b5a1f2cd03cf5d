"""The message types of an action."""

from __future__ import annotations

from typing import Any, NamedTuple

from rosmini.msgs.importer import how_to_import

from .errors import ActionException

__all__ = ["ActionTypes"]


class ActionTypes(NamedTuple):
    """The message classes behind an action class such as ``FibonacciAction``."""

    action_goal: Any
    action_result: Any
    action_feedback: Any
    goal: Any
    result: Any
    feedback: Any

    @classmethod
    def of(cls, spec: Any) -> ActionTypes:
        """Return the types of the action class ``spec``. Raises ``ActionException`` for anything else."""
        try:
            action = spec()
            parts = [type(getattr(action, f"action_{part}")) for part in ("goal", "result", "feedback")]
            inner = [
                type(getattr(part(), name))
                for part, name in zip(parts, ("goal", "result", "feedback"), strict=True)
            ]
        except (AttributeError, TypeError) as error:
            name = getattr(spec, "__name__", repr(spec))
            ends = [end for end in ("Goal", "Result", "Feedback") if name.endswith(end)]
            hint = (
                f"give {name.removesuffix(ends[0]).removesuffix('Action')}Action"
                if ends
                else how_to_import(spec)
            )
            told = f": {hint}" if hint else ""
            raise ActionException(f"{name} is not an action type, such as FibonacciAction{told}") from error
        return cls(*parts, *inner)
