"""``rostopic.CallbackEcho``: a callback that prints messages as ``rostopic echo`` does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from rosmini.msgs.text import strify_message
from rosmini.ros.introspection.fields import cells, chosen, title_line
from rosmini.ros.rospy.rostime import get_rostime

CLEAR = "\033[2J\033[;H"
"""Escape sequence that clears a terminal."""


class CallbackEcho:
    """Prints each message passed to its ``callback``, until ``done``; ``rostopic echo -h`` explains the options.

    Args:
        topic: the messages' topic, or a namespace with `echo_all_topics`; other topics are ignored.
        msg_eval: selects the part of a message to print (`msgevalgen`), None for all of it.
        plot: print lines of comma-separated values after a line of titles.
        filter_fn: called with a message, which is printed if the result is true.
        echo_clear: clear the terminal before each message.
        echo_all_topics: print messages of any topic.
        offset_time: print times relative to now.
        count: maximum number of messages; None for any number.
        field_filter_fn: selects the fields of a message that `plot` prints (`create_field_filter`).
        fixed_numeric_width: number of characters for each number.
        value_transform_fn: called with a value and the name of its type; its result is printed.

    """

    def __init__(
        self,
        topic: str,
        msg_eval: Callable[[Any], Any] | None,
        plot: bool = False,
        filter_fn: Callable[[Any], Any] | None = None,
        echo_clear: bool = False,
        echo_all_topics: bool = False,
        offset_time: bool = False,
        count: int | None = None,
        field_filter_fn: Callable[[Any], Any] | None = None,
        fixed_numeric_width: int | None = None,
        value_transform_fn: Callable[[Any, Any], Any] | None = None,
    ) -> None:
        self.topic = topic.rstrip("/") or "/"
        self.msg_eval, self.plot, self.filter_fn = msg_eval, plot, filter_fn
        self.prefix = CLEAR if echo_clear else ""
        self.suffix = "" if plot else "\n---"
        self.echo_all_topics, self.offset_time = echo_all_topics, offset_time
        self.field_filter = field_filter_fn or chosen(strings=False, arrays=False)
        self.fixed_numeric_width, self.value_transform = fixed_numeric_width, value_transform_fn
        self.max_count, self.count, self.done = count, 0, count == 0
        self.first = True

    def callback(self, data: Any, callback_args: Mapping[str, Any], current_time: Any = None) -> None:
        """Print a message; ``callback_args`` has its ``topic`` and optionally its ``type_information``."""
        topic = callback_args["topic"].rstrip("/")
        if self.done or (self.filter_fn is not None and not self.filter_fn(data)):
            return
        if not (self.echo_all_topics or self.topic == topic or self.topic.startswith(f"{topic}/")):
            return
        value = data if self.msg_eval is None else self.msg_eval(data)
        if value is None:
            return
        self.count += 1
        kind = callback_args.get("type_information")
        print(f"{self.prefix}{self._line(data, value, current_time) if self.plot else self._text(value, kind)}"
              f"{self.suffix}", flush=True)  # fmt: skip
        self.done = self.max_count is not None and self.count >= self.max_count

    def _text(self, value: Any, kind: Any) -> str:
        if self.value_transform is not None:
            value = self.value_transform(value, kind)
        offset = get_rostime() if self.offset_time else None
        return strify_message(value, time_offset=offset, fixed_numeric_width=self.fixed_numeric_width)

    def _line(self, message: Any, value: Any, current_time: Any) -> str:
        when = current_time
        if when is None:
            when = message.header.stamp if getattr(type(message), "_has_header", False) else get_rostime()
        line = f"{when.to_nsec()},{','.join(cells(value, self.field_filter))}"
        if not self.first:
            return line
        self.first = False
        return f"{title_line(value, self.field_filter)}\n{line}"
