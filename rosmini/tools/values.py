"""Message values in YAML on a command line or standard input, for ``rostopic pub`` and ``rosservice call``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.core.time import Time
    from rosmini.core.verbs import Call


class WrongYaml(RosminiError):
    """A text is not valid YAML."""


def parse(text: str) -> Any:
    """Return the value of a YAML text. Raises ``WrongYaml``."""
    return next(iter(documents_of(text, "this argument")), None)


def documents_of(text: str, source: str) -> Iterator[Any]:
    """Yield the values of the documents in a YAML text; errors name ``source``. Raises ``WrongYaml``."""
    from rosmini.core.yaml_text import documents

    def failure(message: str, where: str, line: int | None) -> WrongYaml:
        return WrongYaml(f"{where}{'' if line is None else f', line {line}'}: {message}")

    for value, _ in documents(text, source, failure):
        yield value


def typed(call: Call) -> Iterator[Any]:
    """Yield the values on standard input, each ended by ---; warn of invalid YAML."""
    read, text = call.read_line, ""
    while read is not None and (line := call.graph.scheduler.in_thread(read)):
        if line.strip() != "---":
            text += line
            continue
        try:
            value = parse(text)
        except WrongYaml as error:
            call.warn(f"Invalid YAML: {error}")
        else:
            if value is not None:
                yield value
        text = ""


def listed(value: Any) -> list[Any]:
    """Return a value as a list of arguments."""
    return value if isinstance(value, list) else [value]


def fields_of(message: Any) -> str:
    """Return the field names of a message or a class, on one line."""
    from rosmini.ros.rospy.aliases.genpy.message import get_printable_message_args

    return get_printable_message_args(message() if isinstance(message, type) else message)


def fill(message: Any, values: list[Any], now: Time) -> None:
    """Fill a message; the text ``now`` means a time, and ``auto`` a header with that time.

    Raises ``MessageException`` and ``ValueError`` for values that do not fit.
    """
    from rosmini.msgs.std_msgs.msg import Header
    from rosmini.ros.rospy.aliases.genpy.message import fill_message_args

    fill_message_args(message, values, {"now": now, "auto": Header(stamp=now)})
