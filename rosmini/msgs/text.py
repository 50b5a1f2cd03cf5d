"""Messages as text, as shown by ``print``, ``rostopic echo`` and ``rosmsg``: YAML in genpy's layout."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.time import Time, TVal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .contract import MessageContract

PLAIN_WIDTH = 70  # up to this length PyYAML puts a quoted string on one line


def strify_message(
    val: Any,
    indent: str = "",
    time_offset: Time | None = None,
    current_time: Time | None = None,  # noqa: ARG001 (genpy's signature)
    field_filter: Callable[[MessageContract], Iterable[str]] | None = None,
    fixed_numeric_width: int | None = None,
) -> str:
    """Return a message or a field value as YAML text, identical to the output of genpy's function.

    Text with an indent starts with a newline. Times are shown relative to ``time_offset`` if given.
    ``field_filter`` selects the fields to show; ``fixed_numeric_width`` is a number of characters.
    ``current_time`` is unused, for compatibility.
    """
    return _Writer(time_offset, field_filter, fixed_numeric_width).text(val, indent)


class _Writer:
    def __init__(
        self,
        time_offset: Time | None,
        field_filter: Callable[[MessageContract], Iterable[str]] | None,
        width: int | None,
    ) -> None:
        self.time_offset, self.field_filter, self.width = time_offset, field_filter, width

    def text(self, val: Any, indent: str) -> str:
        if hasattr(type(val), "_spec"):
            return self.message(val, indent)
        kind = type(val)
        if kind in (int, float) and self.width is not None:
            return self.number(val, self.width)
        if kind in (int, float, bool):
            return str(val)
        if isinstance(val, str):
            return _quoted(val)
        if isinstance(val, TVal):
            return self.time(val, indent)
        if kind in (list, tuple):
            return self.sequence(val, indent)
        return str(val)

    def number(self, val: float, width: int) -> str:
        if not isinstance(val, float):
            return f"{val:{width}d}"
        text = f"{val:.{width}f}"
        return text[: max(text.find("."), width)]

    def time(self, val: TVal, indent: str) -> str:
        shown: TVal = val
        if self.time_offset is not None and isinstance(val, Time):
            shown = val - self.time_offset
        secs = str(shown.secs) if self.width is None else f"{shown.secs:{self.width}d}"
        nsecs = f"{shown.nsecs:{9 if self.width is None else self.width}d}"
        return f"\n{indent}secs: {secs}\n{indent}nsecs: {nsecs}"

    def sequence(self, val: list[Any] | tuple[Any, ...], indent: str) -> str:
        if not val:
            return "[]"
        first = type(val[0])
        if first in (int, float) and self.width is not None:
            return "[" + "".join(f"{self.text(element, indent)}, " for element in val).rstrip(", ") + "]"
        if isinstance(val[0], str):
            import yaml

            return "\n" + "\n".join(indent + line for line in yaml.dump(val).rstrip("\n").splitlines())
        if first in (int, float, bool):
            return str(list(val))
        return "\n" + "\n".join(f"{indent}- {self.text(element, indent + '  ')}" for element in val)

    def message(self, val: MessageContract, indent: str) -> str:
        names = [field.name for field in val._spec.fields]
        chosen = names if self.field_filter is None else list(self.field_filter(val))
        lines = []
        for field in val._spec.fields:
            if field.name not in chosen:
                continue
            value = getattr(val, field.name)
            if "uint8[" in field.type:  # bytes are shown as numbers, except those of a char[]
                value = (
                    list(value)
                    if isinstance(value, bytes)
                    else [ord(c) for c in value]
                    if isinstance(value, str)
                    else value
                )
            lines.append(f"{indent}{field.name}: {self.text(value, indent + '  ')}")
        body = "\n".join(lines)
        return f"\n{body}" if indent else body


def _quoted(val: str) -> str:
    if not val:
        return "''"
    if len(val) <= PLAIN_WIDTH and val.isascii() and val.isprintable() and '"' not in val and "\\" not in val:
        return f'"{val}"'
    import yaml

    return str(yaml.dump(val, default_style='"')).rstrip("\n")
