"""ROS's ``time`` and ``duration``: two integers, seconds and nanoseconds.

The classes follow genpy (http://wiki.ros.org/rospy/Overview/Time) in the types of operands and results, in the
canonical form (0 <= nsecs < 1e9, so -0.5 s is ``Duration(-1, 500000000)``), and in their mutable fields
(``msg.header.stamp.secs = 3`` works; call :meth:`TVal.canon` if a field is out of range).

There is no ``now()`` here: only a node knows the time.
"""

from __future__ import annotations

from numbers import Integral, Real
from typing import Any, ClassVar, Self, overload

NSECS_PER_SEC = 1_000_000_000


class TVal:
    """Base class of :class:`Time` and :class:`Duration`.

    ``secs`` is an integer or fractional number of seconds. ``nsecs`` is a number of nanoseconds to add.
    Raises ``ValueError`` for fractional seconds together with nanoseconds.
    """

    __slots__ = ("nsecs", "secs")
    _slot_types: ClassVar[list[str]] = ["int32", "int32"]  # tools print times like messages
    _peer: ClassVar[type[TVal]]  # the class of comparable values; set after each class is defined

    secs: int
    nsecs: int

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        if type(secs) is int and type(nsecs) is int and 0 <= nsecs < NSECS_PER_SEC:
            self.secs = secs
            self.nsecs = nsecs
            return
        if isinstance(secs, Integral):
            whole, rest = int(secs), int(nsecs)
        elif nsecs != 0:
            given = f"{type(self).__name__}({secs!r}, {nsecs!r})"
            raise ValueError(f"{given}: give nanoseconds only beside whole seconds")
        else:
            whole = int(secs)
            rest = int((secs - whole) * NSECS_PER_SEC)
        carry, self.nsecs = divmod(rest, NSECS_PER_SEC)
        self.secs = whole + carry

    @classmethod
    def from_sec(cls, float_secs: float) -> Self:
        """Return a time or duration from seconds as a float, truncated to nanoseconds."""
        secs = int(float_secs)
        return cls(secs, int((float_secs - secs) * NSECS_PER_SEC))

    @classmethod
    def from_nsec(cls, nsecs: int) -> Self:
        """Return a time or duration from an integer number of nanoseconds."""
        secs, rest = divmod(nsecs, NSECS_PER_SEC)
        return cls(secs, rest)

    @property
    def sec(self) -> int:
        """The field ``secs``, under the name that ROS 2 and rosbags use."""
        return self.secs

    @property
    def nanosec(self) -> int:
        """The field ``nsecs``, under the name that ROS 2 and rosbags use."""
        return self.nsecs

    def set(self, secs: int, nsecs: int) -> None:
        """Set both fields as given, without normalising them."""
        self.secs = secs
        self.nsecs = nsecs

    def canon(self) -> None:
        """Normalise the fields, carrying whole seconds from ``nsecs`` to ``secs``."""
        carry, self.nsecs = divmod(self.nsecs, NSECS_PER_SEC)
        self.secs += carry

    def is_zero(self) -> bool:
        """Return whether both fields are zero."""
        return self.secs == 0 and self.nsecs == 0

    def to_sec(self) -> float:
        """Return seconds as a float (with a resolution of about 200 ns for today's dates)."""
        return float(self.secs) + float(self.nsecs) / 1e9

    def to_nsec(self) -> int:
        """Return nanoseconds as an integer, exactly."""
        return self.secs * NSECS_PER_SEC + self.nsecs

    def __bool__(self) -> bool:
        return self.secs != 0 or self.nsecs != 0

    def __hash__(self) -> int:
        return hash((self.secs, self.nsecs))

    def __str__(self) -> str:
        return str(self.to_nsec())

    def __repr__(self) -> str:
        return f"genpy.{self._peer.__name__}[{self.to_nsec()}]"

    def __getstate__(self) -> list[int]:
        return [self.secs, self.nsecs]

    def __setstate__(self, state: list[int]) -> None:
        self.secs, self.nsecs = state

    def __eq__(self, other: object) -> bool:
        # Never NotImplemented: a Time equals neither a Duration nor a mock or number.
        return isinstance(other, self._peer) and self.to_nsec() == other.to_nsec()

    def __lt__(self, other: Any) -> bool:
        return self.to_nsec() < other.to_nsec() if isinstance(other, self._peer) else NotImplemented

    def __le__(self, other: Any) -> bool:
        return self.to_nsec() <= other.to_nsec() if isinstance(other, self._peer) else NotImplemented

    def __gt__(self, other: Any) -> bool:
        return self.to_nsec() > other.to_nsec() if isinstance(other, self._peer) else NotImplemented

    def __ge__(self, other: Any) -> bool:
        return self.to_nsec() >= other.to_nsec() if isinstance(other, self._peer) else NotImplemented

    def __cmp__(self, other: Any) -> int:
        """Compare as in Python 2, for old scripts: -1, 0 or 1. Raises ``TypeError`` for other types."""
        if not isinstance(other, self._peer):
            raise TypeError(f"cannot compare {self!r} to {other!r}: it is no {self._peer.__name__}")
        return (self > other) - (self < other)


TVal._peer = TVal  # noqa: SLF001


class Time(TVal):
    """A point in time: seconds and nanoseconds since 1970-01-01 (or since the start of a simulation).

    Raises ``TypeError`` for a negative time, as genpy does.
    """

    __slots__ = ("nsecs", "secs")

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        if type(secs) is int and type(nsecs) is int and 0 <= nsecs < NSECS_PER_SEC:
            self.secs = secs
            self.nsecs = nsecs
        else:
            super().__init__(secs, nsecs)
        if self.secs < 0:
            raise TypeError(f"time values must be positive, not {self.to_sec()} s: is this a Duration?")

    def to_time(self) -> float:
        """Return seconds as a float, like ``time.time()``."""
        return self.to_sec()

    __hash__ = TVal.__hash__

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Time) and self.secs == other.secs and self.nsecs == other.nsecs

    def __add__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    @overload
    def __sub__(self, other: Time) -> Duration: ...
    @overload
    def __sub__(self, other: Duration) -> Self: ...
    def __sub__(self, other: Time | Duration) -> Duration | Self:
        if isinstance(other, Time):
            return Duration(self.secs - other.secs, self.nsecs - other.nsecs)
        if isinstance(other, Duration):
            return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)
        return NotImplemented


class Duration(TVal):
    """A difference between two times, which may be negative."""

    __slots__ = ("nsecs", "secs")

    __hash__ = TVal.__hash__

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self.secs == other.secs and self.nsecs == other.nsecs

    def __neg__(self) -> Self:
        return type(self)(-self.secs, -self.nsecs)

    def __abs__(self) -> Self:
        return self if self.secs >= 0 else -self

    def __add__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    def __sub__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)

    def __mul__(self, factor: float) -> Self:
        if isinstance(factor, Integral):
            return type(self)(self.secs * int(factor), self.nsecs * int(factor))
        if isinstance(factor, Real):
            return self.from_sec(self.to_sec() * factor)
        return NotImplemented

    __rmul__ = __mul__

    @overload
    def __truediv__(self, other: Duration) -> float: ...
    @overload
    def __truediv__(self, other: float) -> Self: ...
    def __truediv__(self, other: float | Duration) -> float | Self:
        if isinstance(other, Duration):
            return self.to_sec() / other.to_sec()
        if isinstance(other, Real):
            return self.from_sec(self.to_sec() / other)
        return NotImplemented

    @overload
    def __floordiv__(self, other: Duration) -> int: ...
    @overload
    def __floordiv__(self, other: float) -> Self: ...
    def __floordiv__(self, other: float | Duration) -> int | Self:
        if isinstance(other, Duration):
            return int(self.to_sec() // other.to_sec())
        if isinstance(other, Real):
            return self.from_sec(self.to_sec() // other)
        return NotImplemented

    def __mod__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return self.from_sec(self.to_sec() % other.to_sec())

    def __divmod__(self, other: Duration) -> tuple[int, Self]:
        if not isinstance(other, Duration):
            return NotImplemented
        quotient, remainder = divmod(self.to_sec(), other.to_sec())
        return int(quotient), self.from_sec(remainder)


Time._peer = Time  # noqa: SLF001
Duration._peer = Duration  # noqa: SLF001
