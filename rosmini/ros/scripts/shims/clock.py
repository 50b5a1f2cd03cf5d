"""``time`` and ``datetime`` that use graph time in simulated time; ``sleep`` always parks the lane.

In simulated time every clock of ``time`` shows graph time: clocks since the epoch (``time``, ``localtime()``)
directly, the others (``monotonic``, ``perf_counter``, ``process_time``) since the start of the script.
``datetime.now()``, ``utcnow()`` and ``date.today()`` use it too. In wall-clock time they are the real functions.
"""

from __future__ import annotations

import datetime as dt
import math
import time as real_time
from typing import TYPE_CHECKING, Any

from . import as_builtins, copy_of

if TYPE_CHECKING:
    from types import ModuleType

    from rosmini.ros.scripts.context import ScriptContext

_COUNTERS = ("monotonic", "perf_counter", "process_time", "thread_time")


def make_time(context: ScriptContext) -> ModuleType:
    """Create the ``time`` of one script."""
    module = copy_of(real_time)
    scheduler = context.scheduler

    def sleep(seconds: float, /) -> None:
        if seconds < 0:
            raise ValueError("sleep length must be non-negative")
        if math.isnan(seconds):
            raise ValueError("Invalid value NaN (not a number)")
        context.pause(f"time.sleep({seconds:g}) to end", round(seconds * 1e9))

    as_builtins(module, sleep=sleep)
    if not scheduler.simulated:
        return module
    start = scheduler.now_ns()

    def epoch() -> float:
        return scheduler.now_ns() / 1e9

    def counter_ns() -> int:
        return scheduler.now_ns() - start

    def localtime(seconds: float | None = None, /) -> real_time.struct_time:
        return real_time.localtime(epoch() if seconds is None else seconds)

    def gmtime(seconds: float | None = None, /) -> real_time.struct_time:
        return real_time.gmtime(epoch() if seconds is None else seconds)

    def ctime(seconds: float | None = None, /) -> str:
        return real_time.ctime(epoch() if seconds is None else seconds)

    def asctime(when: Any = None, /) -> str:
        return real_time.asctime(localtime() if when is None else when)

    def strftime(layout: str, when: Any = None, /) -> str:
        return real_time.strftime(layout, localtime() if when is None else when)

    as_builtins(
        module,
        time=epoch,
        time_ns=scheduler.now_ns,
        localtime=localtime,
        gmtime=gmtime,
        ctime=ctime,
        asctime=asctime,
        strftime=strftime,
    )
    for name in _COUNTERS:
        as_builtins(module, **{name: lambda: counter_ns() / 1e9, f"{name}_ns": counter_ns})
    return module


def make_datetime(context: ScriptContext) -> ModuleType:
    """Create the ``datetime`` of one script: the real one in wall-clock time."""
    module = copy_of(dt)
    if not context.scheduler.simulated:
        return module

    def now() -> float:
        return context.scheduler.now_ns() / 1e9

    class LikeReal(type):
        """Treats objects made by other libraries as instances too."""

        def __instancecheck__(cls, instance: object) -> bool:
            return isinstance(instance, reals[cls]) if cls in reals else super().__instancecheck__(instance)

        def __subclasscheck__(cls, subclass: type) -> bool:
            return issubclass(subclass, reals[cls]) if cls in reals else super().__subclasscheck__(subclass)

    class date(dt.date, metaclass=LikeReal):  # noqa: N801 - its name in the module
        @classmethod
        def today(cls) -> Any:
            return cls.fromtimestamp(now())

        def __repr__(self) -> str:
            return _real_repr(super().__repr__())

    class datetime(dt.datetime, metaclass=LikeReal):  # noqa: N801
        @classmethod
        def now(cls, tz: dt.tzinfo | None = None) -> Any:
            return cls.fromtimestamp(now(), tz)

        @classmethod
        def today(cls) -> Any:
            return cls.fromtimestamp(now())

        @classmethod
        def utcnow(cls) -> Any:
            return cls.fromtimestamp(now(), dt.UTC).replace(tzinfo=None)

        def __repr__(self) -> str:
            return _real_repr(super().__repr__())

        def __reduce_ex__(self, protocol: Any) -> Any:
            # Pickled as the real class, which is available wherever it is unpickled.
            return (dt.datetime, dt.datetime.__reduce_ex__(self, protocol)[1])

    reals: dict[type, type] = {date: dt.date, datetime: dt.datetime}
    for cls in reals:
        cls.__module__, cls.__qualname__ = "datetime", cls.__name__
    module.__dict__.update(date=date, datetime=datetime)
    return module


def _real_repr(shown: str) -> str:
    """Add the module, which Python omits from the repr of a class not written in C."""
    return shown if shown.startswith("datetime.") else f"datetime.{shown}"
