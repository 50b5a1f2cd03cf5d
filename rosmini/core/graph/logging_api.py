"""Log functions of a node, at the five levels of ``rosgraph_msgs/Log`` (http://wiki.ros.org/rosout)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .rosout import LEVELS, LOGGING, caller

if TYPE_CHECKING:
    from .clock import GraphClock, TopicClock
    from .rosout import Logger


class LoggingApi:
    """The part of a node that logs.

    Each function takes ``text`` and

    - ``throttle``: log at most once in so many seconds of the node's time from this place of the program;
    - ``identical``: log only a text that has changed; with ``throttle``, the same text again when it is time;
    - ``once``: log only the first time that this place of the program is reached;
    - ``logger``: the logger ``rosout.<logger>``, which has a level of its own once that is set.
    """

    logger: Logger
    clock: GraphClock | TopicClock

    def logdebug(
        self,
        text: object,
        *,
        throttle: float | None = None,
        identical: bool = False,
        once: bool = False,
        logger: str = "",
    ) -> None:
        """Log at level DEBUG."""
        self._log("DEBUG", text, throttle, identical, once, logger)

    def loginfo(
        self,
        text: object,
        *,
        throttle: float | None = None,
        identical: bool = False,
        once: bool = False,
        logger: str = "",
    ) -> None:
        """Log at level INFO."""
        self._log("INFO", text, throttle, identical, once, logger)

    def logwarn(
        self,
        text: object,
        *,
        throttle: float | None = None,
        identical: bool = False,
        once: bool = False,
        logger: str = "",
    ) -> None:
        """Log at level WARN."""
        self._log("WARN", text, throttle, identical, once, logger)

    def logerr(
        self,
        text: object,
        *,
        throttle: float | None = None,
        identical: bool = False,
        once: bool = False,
        logger: str = "",
    ) -> None:
        """Log at level ERROR."""
        self._log("ERROR", text, throttle, identical, once, logger)

    def logfatal(
        self,
        text: object,
        *,
        throttle: float | None = None,
        identical: bool = False,
        once: bool = False,
        logger: str = "",
    ) -> None:
        """Log at level FATAL."""
        self._log("FATAL", text, throttle, identical, once, logger)

    def _log(
        self, level: str, text: object, throttle: float | None, identical: bool, once: bool, logger: str
    ) -> None:
        shown = str(text)
        if (throttle is None and not identical and not once) or self._is_let_through(
            shown, throttle, identical, once
        ):
            self.logger.log(LEVELS[level], shown, logger=f"rosout.{logger}" if logger else None)

    def _is_let_through(self, text: str, throttle: float | None, identical: bool, once: bool) -> bool:
        frame = caller(2, LOGGING)
        where = (frame.f_code.co_filename, frame.f_lineno, frame.f_lasti)
        gates = self.logger.gates
        if once:
            return gates.is_first(where)
        due = throttle is not None and gates.is_due(where, self.clock.now_ns(), round(throttle * 1e9))
        return (gates.is_new(where, text) or due) if identical else due
