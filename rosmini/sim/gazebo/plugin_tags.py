"""Child tags of a plugin, declared once: tag, type, default and meaning.

>>> from rosmini.core.markup import parse
>>> @dataclass(frozen=True)
... class PushTags(Tags):
...     speed: float = tag("speed", 0.1, "how fast to push", unit="m/s")
>>> PushTags.read(parse("<plugin><speed>0.4</speed></plugin>"), print).speed
0.4
>>> PushTags.read(parse("<plugin><sped>0.4</sped></plugin>"), print).speed
<text>:1: <sped> means nothing to the plugin; did you mean speed?
0.1
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, ClassVar, Self, get_args, get_type_hints

from rosmini.core.errors import nearest
from rosmini.core.markup import Element

COMMON = ("robotNamespace", "alwaysOn", "rosDebugLevel", "debug", "enableDebug")
"""Tags that any plugin of gazebo_ros may contain."""


def tag(name: str, default: Any = MISSING, meaning: str = "", *, unit: str = "") -> Any:
    """Declare one tag of a class derived from `Tags`; without a default it is required."""
    about = {"tag": name, "meaning": meaning, "unit": unit}
    return field(metadata=about) if default is MISSING else field(default=default, metadata=about)


@dataclass(frozen=True)
class Tags:
    """The base of a plugin's tags; the type of a field is bool, int, float or str, or one of these or None."""

    ignored: ClassVar[tuple[str, ...]] = ()
    """Tags of the real plugin that have no effect here."""

    @classmethod
    def read(cls, element: Element, complain: Callable[[str], object]) -> Self:
        """Read an element; `complain` is called for unknown tags. Raises `MarkupError` for wrong values."""
        declared = {each.metadata["tag"]: each for each in fields(cls)}
        types = get_type_hints(cls)
        values: dict[str, Any] = {}
        for child in element:
            if child.tag in declared:
                each = declared[child.tag]
                values[each.name] = _value(child, types[each.name])
            elif child.tag not in COMMON and child.tag not in cls.ignored and ":" not in child.tag:
                hint = nearest(child.tag, (*declared, *COMMON)) or f"its tags are: {', '.join(declared) or 'none'}"
                complain(f"{child.path}:{child.line}: <{child.tag}> means nothing to the plugin; {hint}")
        for name, each in declared.items():
            if each.name not in values and each.default is MISSING:
                raise element.error(f"the plugin needs a <{name}>: {each.metadata['meaning']}")
        return cls(**values)


def _kind(hint: Any) -> type:
    return next((part for part in get_args(hint) if part is not type(None)), hint)  # type: ignore[no-any-return]


def _value(element: Element, hint: Any) -> Any:
    kind = _kind(hint)
    if kind is bool:
        return element.flag(element.text)
    if kind is str:
        return element.text
    number = element.floats(element.text, 1)[0]
    return int(number) if kind is int else number
