"""The time of one engine in a graph, and its devices: drives, sensors, anything that happens at a fixed rate.

`rosmini_sim/simulator`, `stage_ros/stageros` and `gazebo_ros/gzserver` are each a `Host` with an `Engine` and
devices. Devices of the same rate are due at the same instants, counted from the host's time zero, whenever they were
added: so one event of the graph's queue serves a hundred robots. The engine advances to each of these instants, and
to the time of each command.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph import Node
from rosmini.core.graph.clock import GraphClock
from rosmini.core.time import Time

from .engine.engine import Engine

SECOND = 1_000_000_000

LAG_S = 0.25
"""Lag behind the clock beyond which a host skips time instead of catching up [s]."""

IDLE_S = 0.1
"""Interval at which a host checks again while no node listens [s]."""

Stamp = tuple[int, int]
"""The time in a message's header: seconds and nanoseconds."""

D = TypeVar("D", bound="Device")


class Device:
    """An action that happens `rate` times a second of simulated time. Derive from it, and add it with `host.add`.

    Devices due at the same instant are served by `order`, and in insertion order if it is equal.
    """

    always = True
    """False if it may be skipped while no node needs it: then `wanted` is asked first."""
    order: ClassVar[float] = 100.0
    """TurtleBot3's: time 0, drive 10, transforms 20, joints 30, truth 40, laser 50, IMU 60, battery 70, bumper 75,
    board 80, cameras 90."""

    def __init__(self, host: Host, name: str, rate: float) -> None:
        if not 0 < rate < float("inf"):
            msg = f"the rate of {name!r} is {rate}; it must be a positive number of times a second"
            raise RosminiError(msg)
        self.host = host
        self.name = name
        """Name for saved states and random generators, usually robot/sensor: `burger/imu`."""
        self.rate = float(rate)

    def wanted(self) -> bool:
        """Return True if any node needs it; only called if not `always`."""
        return True

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Do the device's work for the `number`th time, counted from 1; skipped instants are counted too."""

    def reset(self) -> None:
        """Return to the initial state, because the world does; most sensors need not do anything."""

    saved: ClassVar[tuple[str, ...]] = ()
    """The attributes that change at run time and are saved."""

    def state(self) -> Any:
        """Return everything that changes at run time, as a copy that can be pickled."""
        return copy.deepcopy({name: getattr(self, name) for name in self.saved})

    def restore(self, state: Any) -> None:
        """Restore what `state` returned."""
        for name, value in copy.deepcopy(state).items():
            setattr(self, name, value)

    def close(self) -> None:
        """Close topics and services. Called by `Host.remove`, once."""


@dataclass(frozen=True)
class HostState:
    """Everything that a host, its engine and its devices need to continue. It can be pickled."""

    time_ns: int
    zero_ns: int
    next_ns: int | None
    engine: Any
    instants: dict[float, tuple[int, int]]
    """For each rate: its start, and the number of its next instant."""
    devices: dict[str, tuple[int, Any]]
    """For each name: the number of instants of its rate before its first one, and its own state."""


class Host:
    """The time of one simulated world in a graph, and its devices.

    Args:
        node: the started node that publishes; its clock drives the world's time.
        engine: the world.
        from_zero: stamps start at 0, as in Gazebo and Stage, which publish them on `/clock`; the host then follows the
            graph's own time, even with /use_sim_time. Otherwise stamps are times of the node's clock.
        speed: seconds of the world's time per second of the clock.
        paused: True if time is paused initially.

    """

    def __init__(
        self, node: Node, engine: Engine, *, from_zero: bool = False, speed: float = 1.0, paused: bool = False
    ) -> None:
        self.node = node
        self.engine = engine
        self.clock = GraphClock(node.scheduler) if from_zero else node.clock
        self._from_zero = from_zero
        self._speed = _speed(speed)
        self._paused = paused
        self._time_ns = self._zero_ns = round(engine.now * SECOND)  # since the engine began
        self._clock_ns = self.clock.now_ns()  # the clock's time at _time_ns
        self._groups: dict[float, DeviceGroup] = {}
        self._order: tuple[DeviceGroup, ...] = ()
        self._devices: dict[str, Device] = {}
        self._lag_ns = int(LAG_S * SECOND * max(1.0, node.scheduler.rate))
        self._due_ns = 0
        self._cancel: Callable[[], None] | None = None
        self._ended = False
        self._serving = False
        self.on_time: list[Callable[[], object]] = []
        """Called after time was paused, resumed, stepped or set."""
        node.on_shutdown(self.end)

    # -- time ----------------------------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """The world's time [s] since the host was created or `reset_time` was called; it stops while paused."""
        return (self._at() - self._zero_ns) * 1e-9

    @property
    def stamp(self) -> Time:
        """The stamp of a message published now."""
        return Time(*self._stamp(self._at()))

    @property
    def paused(self) -> bool:
        """True if time is paused."""
        return self._paused

    @property
    def speed(self) -> float:
        """Seconds of the world's time per second of the clock."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        speed = _speed(speed)
        self._rebase()
        self._speed = speed
        self._plan()

    @property
    def engine_now(self) -> float:
        """The engine's time now [s]; the engine itself may be slightly behind: see `catch_up`."""
        return self._at() * 1e-9

    def catch_up(self) -> None:
        """Advance the engine to the current time. Call it before changing anything in the engine."""
        self.engine.advance(self._at() * 1e-9)

    def pause(self) -> None:
        """Stop time; harmless when repeated."""
        if not self._paused:
            if self._cancel is not None and self._due_ns <= self._at():  # its event has not been reached yet
                self._forget()
                self._serve(self._due_ns)
            self._rebase()
            self._paused = True
            self._forget()
            self.tell_time()

    def unpause(self) -> None:
        """Resume time; harmless when repeated."""
        if self._paused:
            self._paused = False
            self._clock_ns = self.clock.now_ns()
            self._plan()
            self.tell_time()

    def step(self, seconds: float) -> None:
        """Advance the world's time by `seconds` at once. Raises `RosminiError` unless it is paused."""
        if not self._paused:
            msg = f"the world {self.engine.world.name!r} can only be stepped while it is paused: pause it first"
            raise RosminiError(msg)
        if not 0 < seconds < float("inf"):
            msg = f"a step has to take a positive number of seconds, not {seconds}"
            raise RosminiError(msg)
        end = self._time_ns + round(seconds * SECOND)
        while self._order:
            due = min(group.due_ns for group in self._order)
            if due > end:
                break
            self._time_ns = due
            self._serve(due)
            for group in self._order:
                group.skip(due)
        self._time_ns = end
        self.catch_up()
        self.tell_time()

    def tell_time(self) -> None:
        """Call all callbacks of `on_time`."""
        for callback in self.on_time:
            callback()

    def reset_time(self) -> None:
        """Start the world's time at 0 again; with `from_zero` stamps too. The devices keep their counts."""
        self._rebase()
        now = self._zero_ns = self._time_ns
        for group in self._order:
            group.skip(now)
            passed = group.number - 1
            for name in group.offsets:
                group.offsets[name] -= passed
            group.begin(now, now)
            group.sort()
        self._plan()
        self.tell_time()

    def end(self) -> None:
        """Stop permanently: no device is served after this. The devices stay open. Harmless when repeated."""
        self._ended = True
        self._forget()

    def _at(self) -> int:
        """Return the time now [ns since the engine began]."""
        if self._paused:
            return self._time_ns
        passed = self.clock.now_ns() - self._clock_ns
        return self._time_ns + (passed if self._speed == 1 else round(passed * self._speed))

    def _rebase(self) -> None:
        """Count the world's time from the current instant on."""
        self._time_ns = self._at()
        self._clock_ns = self.clock.now_ns()
        self.catch_up()

    def _stamp(self, time_ns: int) -> Stamp:
        if self._from_zero:
            return divmod(time_ns - self._zero_ns, SECOND)
        return divmod(self._on_clock(time_ns), SECOND)

    def _on_clock(self, time_ns: int) -> int:
        """Return the clock's time at an instant of the world."""
        if self._paused:
            return self.clock.now_ns()
        ahead = time_ns - self._time_ns
        return self._clock_ns + (ahead if self._speed == 1 else -int(-ahead // self._speed))

    # -- devices and events --------------------------------------------------------------------------------------

    def add(self, device: D) -> D:
        """Add a device; it is first due at the next instant of its rate.

        Raises `RosminiError` if there is a device of its name, and closes the new one.
        """
        if device.name in self._devices:
            device.close()
            msg = f"the host {self.node.name} has a device {device.name!r} already"
            raise RosminiError(msg)
        now = self._at()
        group = self._groups.get(device.rate)
        if group is None:
            group = self._groups[device.rate] = DeviceGroup(device.rate, self._zero_ns, now)
        self._devices[device.name] = device
        group.devices.append(device)
        group.offsets[device.name] = group.number_after(now) - 1
        group.sort()
        self._arrange()
        return device

    def remove(self, device: Device) -> None:
        """Close and remove a device; harmless when repeated."""
        if self._devices.get(device.name) is not device:
            return
        del self._devices[device.name]
        group = self._groups[device.rate]
        group.devices.remove(device)
        del group.offsets[device.name]
        if group.devices:
            group.sort()
        else:
            del self._groups[device.rate]
        device.close()
        self._arrange()

    @property
    def devices(self) -> tuple[Device, ...]:
        """All devices, in insertion order."""
        return tuple(self._devices.values())

    def device(self, name: str) -> Device:
        """Return the device of this name. Raises `RosminiError`."""
        if name not in self._devices:
            hint = nearest(name, self._devices)
            there = ", ".join(self._devices) or "none"
            msg = f"the host {self.node.name} has no device {name!r} (devices: {there}). {hint}"
            raise RosminiError(msg.rstrip())
        return self._devices[name]

    def count(self, device: Device) -> int:
        """Return the number of a device's instants up to the engine's time, as last passed to `due`."""
        group = self._groups[device.rate]
        # the engine may be a nanosecond short of an instant, and would miss it
        return group.number_after(round(self.engine.now * SECOND) + 1) - 1 - group.offsets[device.name]

    def rng(self, name: str) -> np.random.Generator:
        """Return the random generator of a name: the same on each run, and independent of all others."""
        return self.node.graph.rng(f"{self.node.name}/{name}")

    def reset(self) -> None:
        """Return all robots and movable obstacles to their initial poses, and reset the devices."""
        self.catch_up()
        self.engine.reset()
        for device in self.devices:
            device.reset()

    def _arrange(self) -> None:
        """Sort the groups after a device was added or removed."""
        groups = sorted(self._groups.values(), key=lambda group: group.devices[0].order)
        self._order = tuple(groups)
        self._plan()

    def _forget(self) -> None:
        if self._cancel is not None:
            self._cancel()
            self._cancel = None

    def _plan(self, since_ns: int | None = None) -> None:
        """Schedule the first device due after now, or after `since_ns`, whether or not it is wanted."""
        if self._serving:  # `_tick` does it after all devices have been served
            return
        self._forget()
        if self._order and not self._paused and not self._ended:
            since = self._at() if since_ns is None else since_ns
            for group in self._order:
                group.skip(since)
            self._call(min(group.due_ns for group in self._order))

    def _call(self, due_ns: int) -> None:
        self._due_ns = due_ns
        self._cancel = self.clock.call_at(self._on_clock(due_ns), self._wake)

    def _wake(self) -> None:
        """Serve the devices that are due. This event has no lane, because nothing in it blocks."""
        due = self._due_ns
        self._cancel = None
        try:
            self.node.guarded(self._tick, what="physics")
        finally:
            if self._cancel is None and not self._paused and not self._ended:  # an error, or Ctrl-C
                self._plan(due)

    def _tick(self) -> None:
        due = self._due_ns
        behind = self.clock.now_ns() - self._on_clock(due)
        if abs(behind) > self._lag_ns:  # the computer is too slow, or the clock was set
            self._clock_ns += behind
        order = self._order
        following = self._serve(due)
        if self._order is not order:
            self._plan(due)
        elif not self._paused and not self._ended:
            self._call(following)

    def _serve(self, due: int) -> int:
        """Serve everything due now; return the time at which something is due next."""
        self.engine.advance(due * 1e-9)
        stamp = self._stamp(due)
        following = due + int(IDLE_S * SECOND)
        self._serving = True
        try:
            for group in self._order:
                if group.always or group.wanted():
                    if group.due_ns == due:
                        group.serve(stamp)
                        group.set_next(group.number + 1)
                    elif group.due_ns < due:
                        group.skip(due)
                    following = min(following, group.due_ns)
        finally:
            self._serving = False
        return following

    # -- saving --------------------------------------------------------------------------------------------------

    def save(self) -> HostState:
        """Return the state of the engine and the devices, and when they are due; nothing changes."""
        return HostState(
            time_ns=self._at(),
            zero_ns=self._zero_ns,
            next_ns=None if self._cancel is None else self._due_ns,
            engine=self.engine.state(),
            instants={rate: (group.start_ns, group.number) for rate, group in self._groups.items()},
            devices={
                name: (self._groups[device.rate].offsets[name], device.state())
                for name, device in self._devices.items()
            },
        )

    def restore(self, state: HostState) -> None:
        """Continue from a saved state. Raises `RosminiError` if it belongs to other devices."""
        if set(state.devices) != set(self._devices):
            others = sorted(set(state.devices) ^ set(self._devices))
            raise RosminiError(f"{self.node.name} has other devices than the state to restore: {', '.join(others)}")
        self.engine.restore(state.engine)
        self._time_ns, self._zero_ns = state.time_ns, state.zero_ns
        self._clock_ns = self.clock.now_ns()
        for name, (before, own) in state.devices.items():
            device = self._devices[name]
            self._groups[device.rate].offsets[name] = before
            device.restore(own)
        self._devices = {name: self._devices[name] for name in state.devices}  # in the saved order
        self._groups = {rate: self._groups[rate] for rate in state.instants}
        for rate, group in self._groups.items():
            group.start_ns, number = state.instants[rate]
            group.set_next(number)
            group.devices = [each for each in self._devices.values() if each.rate == rate]
            group.sort()
        self._order = tuple(sorted(self._groups.values(), key=lambda group: group.devices[0].order))
        if state.next_ns is None or self._paused or self._ended:
            self._plan()
        else:
            self._forget()
            self._call(state.next_ns)
        self.tell_time()


def _speed(speed: float) -> float:
    if not 0 < speed < float("inf"):
        msg = f"a world's speed is its seconds per second of the clock, a positive number, not {speed}"
        raise RosminiError(msg)
    return speed


class DeviceGroup:
    """Devices of the same rate, and the time at which they are due next [ns since the engine started]."""

    def __init__(self, rate: float, start_ns: int, now_ns: int) -> None:
        self.rate = rate
        self.period = 1e9 / rate
        self.devices: list[Device] = []
        self.offsets: dict[str, int] = {}
        self.begin(start_ns, now_ns)

    def begin(self, start_ns: int, now_ns: int) -> None:
        """Count from `start_ns`; the next instant is the first after `now_ns`."""
        self.start_ns = start_ns
        self.set_next(1)
        self.skip(now_ns)

    def set_next(self, number: int) -> None:
        """Make this the number of the next instant."""
        self.number = number
        self.due_ns = self.start_ns + round(number * self.period)

    def number_after(self, now_ns: int) -> int:
        """Return the number of the first instant after this time, or of the next one if that is later."""
        if self.due_ns > now_ns:
            return self.number
        number = int((now_ns - self.start_ns) / self.period) + 1
        return number + (self.start_ns + round(number * self.period) <= now_ns)

    def skip(self, now_ns: int) -> None:
        """Skip to the first instant after this time."""
        if self.due_ns <= now_ns:
            self.set_next(self.number_after(now_ns))

    def sort(self) -> None:
        """Sort the devices by their order."""
        self.devices.sort(key=lambda device: device.order)  # a stable sort
        self.always = any(device.always for device in self.devices)
        self._calls = tuple(
            (None if device.always else device.wanted, device.due, self.offsets[device.name]) for device in self.devices
        )

    def wanted(self) -> bool:
        """Return True if any device has something to do."""
        return self.always or any(device.wanted() for device in self.devices)

    def serve(self, stamp: Stamp) -> None:
        """Serve the devices that are due now."""
        number = self.number
        for wanted, due, before in self._calls:
            if wanted is None or wanted():
                due(stamp, number - before)
