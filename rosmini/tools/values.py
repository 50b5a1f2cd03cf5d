"""Message values in YAML on a command line, for ``rostopic pub`` and ``rosservice call``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from rosmini.core.time import Time


class WrongYaml(RosminiError):
    """A text is not valid YAML."""


def parse(text: str) -> Any:
    """Return the value of a YAML text. Raises ``WrongYaml``."""
    from rosmini.core.yaml_text import documents

    def failure(message: str, where: str, line: int | None) -> WrongYaml:
        return WrongYaml(f"{where}{'' if line is None else f', line {line}'}: {message}")

    return next((value for value, _ in documents(text, "this argument", failure)), None)


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
