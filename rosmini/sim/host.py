"""Time in a graph for one engine, and for the devices that live on it: drives, sensors, whatever happens so many times a second.

`rosmini_sim/simulator`, `stage_ros/stageros` and `gazebo_ros/gzserver` are each a `Host` with an `Engine` and devices. Devices of the same rate are
due at the same instants, counted from the host's time zero, whenever they were added: so one event of the graph's queue serves a hundred robots. The
engine only goes on from one such instant to the next, and where a command comes in.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from rosmini.errors import RosminiError, nearest
from rosmini.graph.clock import GraphClock
from rosmini.time import Time

from .engine.engine import Engine

if TYPE_CHECKING:
    import numpy as np

    from rosmini.graph import Node

SECOND = 1_000_000_000

LAG_S = 0.25
"""A host that is farther behind the clock on the wall lets the time go instead of running after it."""

IDLE_S = 0.1
"""So often a host looks about in which nothing is due, because nobody listens [s]."""

Stamp = tuple[int, int]
"""When something was so, as a message's header has it: seconds and nanoseconds."""

D = TypeVar("D", bound="Device")


class Device:
    """Something of a host that happens `rate` times a second of simulated time. Derive from it, and call `host.add` with it.

    Those that are due at the same instant are served in the sequence of `order`, and of those with the same one in that of their adding.
    """

    always = True
    """False for what may be left out while nobody is there who wants it: then `wanted` is asked first."""
    order = 100

    def __init__(self, host: Host, name: str, rate: float) -> None:
        if not 0 < rate < float("inf"):
            msg = f"the rate of {name!r} is {rate}; it has to be a positive number of times a second"
            raise RosminiError(msg)
        self.host = host
        self.name = name
        """Under which it is saved, and draws its noise: as a rule robot/what, `burger/imu`."""
        self.rate = float(rate)

    def wanted(self) -> bool:
        """Tell whether anybody wants to know; only asked of what is not `always`."""
        return True

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Do what is to be done at this instant, the `number`th of this device from 1 on. What was not wanted is counted too."""

    def reset(self) -> None:
        """Go back to how it was in the beginning, because the world does; a sensor need not do anything."""

    def state(self) -> Any:
        """Everything that changes while it works, as a copy that can be pickled; None: nothing does."""
        return None

    def restore(self, state: Any) -> None:
        """Become as it was when `state` was taken."""

    def close(self) -> None:
        """Leave the graph: end topics and services. Called by `Host.remove`, once."""


@dataclass(frozen=True)
class HostState:
    """All that a host, its engine and its devices will go on from. It can be pickled."""

    time_ns: int
    zero_ns: int
    next_ns: int | None
    engine: Any
    beats: dict[float, tuple[int, int]]
    """Rate: since when, and the number of the next."""
    devices: dict[str, tuple[int, Any]]
    """Name: how many beats there were before its first, and what it told of itself."""


class _Group:
    """Devices of the same rate, and when they are due next [ns since the engine began]."""

    def __init__(self, rate: float, start_ns: int, now_ns: int) -> None:
        self.rate = rate
        self.period = 1e9 / rate
        self.devices: list[Device] = []
        self.before: dict[str, int] = {}
        self.begin(start_ns, now_ns)

    def begin(self, start_ns: int, now_ns: int) -> None:
        """Count from `start_ns`; the next is the first after `now_ns`."""
        self.start_ns = start_ns
        self.to(1)
        self.skip(now_ns)

    def to(self, number: int) -> None:
        """Let this be the next one."""
        self.number = number
        self.due_ns = self.start_ns + round(number * self.period)

    def after(self, now_ns: int) -> int:
        """The number of the first that is after this time, or of the next one, if that is later."""
        if self.due_ns > now_ns:
            return self.number
        number = int((now_ns - self.start_ns) / self.period) + 1
        return number + (self.start_ns + round(number * self.period) <= now_ns)

    def skip(self, now_ns: int) -> None:
        """Go on to the first that is after this time."""
        if self.due_ns <= now_ns:
            self.to(self.after(now_ns))

    def sort(self) -> None:
        """Put the devices into their sequence."""
        self.devices.sort(key=lambda device: device.order)  # a stable sort
        self.always = any(device.always for device in self.devices)
        self._calls = tuple(
            (None if device.always else device.wanted, device.due, self.before[device.name])
            for device in self.devices
        )

    def wanted(self) -> bool:
        """Tell whether any device has something to do."""
        return self.always or any(device.wanted() for device in self.devices)

    def serve(self, stamp: Stamp) -> None:
        """Let the devices do what they have to do now."""
        number = self.number
        for wanted, due, before in self._calls:
            if wanted is None or wanted():
                due(stamp, number - before)


class Host:
    """The time of one simulated world in a graph, and what happens in it.

    Args:
        node: the started node that publishes; its clock is the one by which the world's time goes on.
        engine: the world.
        from_zero: stamps begin at 0 as the simulated time does, as in Gazebo and Stage, which publish them on `/clock`; the host then lives on the
            graph's own time, even with /use_sim_time. Otherwise stamps are the times of the node's clock.
        speed: so many seconds of the world pass in one of the clock.
        paused: whether time stands at first.

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
        self._clock_ns = self.clock.now_ns()  # what the clock showed at _time_ns
        self._groups: dict[float, _Group] = {}
        self._order: tuple[_Group, ...] = ()
        self._devices: dict[str, Device] = {}
        self._lag_ns = int(LAG_S * SECOND * max(1.0, node.scheduler.rate))
        self._due_ns = 0
        self._cancel: Callable[[], None] | None = None
        self._ended = False
        self._serving = False
        node.on_shutdown(self.end)

    def __repr__(self) -> str:
        count = len(self._devices)
        return f"<Host {self.node.name}: {self.now:.3f} s, {count} device{'s' * (count != 1)}{', paused' * self._paused}>"

    # -- time ----------------------------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """The world's time [s]: 0 when the host was made or `reset_time` was called; it stands while the host is paused."""
        return (self._at() - self._zero_ns) * 1e-9

    @property
    def stamp(self) -> Time:
        """The time that a message of now would bear."""
        return Time(*self._stamp(self._at()))

    @property
    def paused(self) -> bool:
        """Whether time stands."""
        return self._paused

    @property
    def speed(self) -> float:
        """So many seconds of the world pass in one of the clock."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        speed = _speed(speed)
        self._hold()
        self._speed = speed
        self._plan()

    @property
    def engine_now(self) -> float:
        """The engine's time that it is now [s]; the engine itself may be a little behind: see `catch_up`."""
        return self._at() * 1e-9

    def catch_up(self) -> None:
        """Let the engine go on to now. To be called before something is changed in it."""
        self.engine.advance(self._at() * 1e-9)

    def pause(self) -> None:
        """Let time stand. Harmless when repeated."""
        if not self._paused:
            if self._cancel is not None and self._due_ns <= self._at():  # its event has not been reached yet
                self._forget()
                self._serve(self._due_ns)
            self._hold()
            self._paused = True
            self._forget()

    def unpause(self) -> None:
        """Let time go on. Harmless when repeated."""
        if self._paused:
            self._paused = False
            self._clock_ns = self.clock.now_ns()
            self._plan()

    def step(self, seconds: float) -> None:
        """Let so much of the world's time pass at once, while it stands otherwise. Raises `RosminiError` if it does not stand."""
        if not self._paused:
            msg = f"the world {self.engine.world.name!r} can only be stepped while its time stands: pause it first"
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

    def reset_time(self) -> None:
        """Let the world's time begin at 0 again; with `from_zero` stamps do too. The devices' own counting goes on."""
        self._hold()
        now = self._zero_ns = self._time_ns
        for group in self._order:
            group.skip(now)
            passed = group.number - 1
            for name in group.before:
                group.before[name] -= passed
            group.begin(now, now)
            group.sort()
        self._plan()

    def end(self) -> None:
        """Stop for ever: nothing is due any more. The devices stay open. Harmless when repeated."""
        self._ended = True
        self._forget()

    def _at(self) -> int:
        """The time now [ns since the engine began]."""
        if self._paused:
            return self._time_ns
        passed = self.clock.now_ns() - self._clock_ns
        return self._time_ns + (passed if self._speed == 1 else round(passed * self._speed))

    def _hold(self) -> None:
        """Take the time that it is as the one to count from."""
        self._time_ns = self._at()
        self._clock_ns = self.clock.now_ns()
        self.catch_up()

    def _stamp(self, time_ns: int) -> Stamp:
        if self._from_zero:
            return divmod(time_ns - self._zero_ns, SECOND)
        return divmod(self._on_clock(time_ns), SECOND)

    def _on_clock(self, time_ns: int) -> int:
        """What the clock shows then."""
        if self._paused:
            return self.clock.now_ns()
        ahead = time_ns - self._time_ns
        return self._clock_ns + (ahead if self._speed == 1 else -int(-ahead // self._speed))

    # -- what happens --------------------------------------------------------------------------------------------

    def add(self, device: D) -> D:
        """Take a device in; it is due for the first time at the next instant of its rate. Raises `RosminiError` for a name that is used."""
        if device.name in self._devices:
            msg = f"the host {self.node.name} has a device {device.name!r} already"
            raise RosminiError(msg)
        now = self._at()
        group = self._groups.get(device.rate)
        if group is None:
            group = self._groups[device.rate] = _Group(device.rate, self._zero_ns, now)
        self._devices[device.name] = device
        group.devices.append(device)
        group.before[device.name] = group.after(now) - 1
        group.sort()
        self._arrange()
        return device

    def remove(self, device: Device) -> None:
        """Close a device, which is not due any more. Harmless when repeated."""
        if self._devices.get(device.name) is not device:
            return
        del self._devices[device.name]
        group = self._groups[device.rate]
        group.devices.remove(device)
        del group.before[device.name]
        if group.devices:
            group.sort()
        else:
            del self._groups[device.rate]
        device.close()
        self._arrange()

    @property
    def devices(self) -> tuple[Device, ...]:
        """What is in it, in the sequence of adding."""
        return tuple(self._devices.values())

    def device(self, name: str) -> Device:
        """Return the device of this name. Raises `RosminiError`."""
        if name not in self._devices:
            hint = nearest(name, self._devices)
            msg = f"the host {self.node.name} has no device {name!r} (devices: {', '.join(self._devices) or 'none'}). {hint}"
            raise RosminiError(msg.rstrip())
        return self._devices[name]

    def count(self, device: Device) -> int:
        """How many instants of a device there have been until the engine's now, this one too: the number that the last one's `due` got."""
        group = self._groups[device.rate]
        # the engine may be a nanosecond short of an instant, whose number is a fraction of one
        return group.after(round(self.engine.now * SECOND) + 1) - 1 - group.before[device.name]

    def rng(self, name: str) -> np.random.Generator:
        """Return the random generator for what is called `name`: the same on each run, and whoever else draws from another."""
        return self.node.graph.rng(f"{self.node.name}/{name}")

    def reset(self) -> None:
        """Put all robots and movable obstacles back to where they began, and the devices with them."""
        self.catch_up()
        self.engine.reset()
        for device in self.devices:
            device.reset()

    def _arrange(self) -> None:
        """Learn that devices have come or gone."""
        groups = sorted(self._groups.values(), key=lambda group: group.devices[0].order)
        self._order = tuple(groups)
        self._plan()

    def _forget(self) -> None:
        if self._cancel is not None:
            self._cancel()
            self._cancel = None

    def _plan(self, since_ns: int | None = None) -> None:
        """Ask to be called when the first device is due after now, or after `since_ns`, wanted or not."""
        if self._serving:  # `_tick` does it when all have been served
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
        """Go on. An event of the queue without a lane, for nothing in it can block."""
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
        """Let all happen that is due now; return when the next thing is."""
        self.engine.advance(due * 1e-9)
        stamp = self._stamp(due)
        following = due + int(IDLE_S * SECOND)
        self._serving = True
        try:
            for group in self._order:
                if group.always or group.wanted():
                    if group.due_ns == due:
                        group.serve(stamp)
                        group.to(group.number + 1)
                    elif group.due_ns < due:
                        group.skip(due)
                    following = min(following, group.due_ns)
        finally:
            self._serving = False
        return following

    # -- saving --------------------------------------------------------------------------------------------------

    def save(self) -> HostState:
        """Everything of now: the engine, the devices, and when they are due. Nothing changes by it."""
        return HostState(
            time_ns=self._at(),
            zero_ns=self._zero_ns,
            next_ns=None if self._cancel is None else self._due_ns,
            engine=self.engine.state(),
            beats={rate: (group.start_ns, group.number) for rate, group in self._groups.items()},
            devices={
                name: (self._groups[device.rate].before[name], device.state())
                for name, device in self._devices.items()
            },
        )

    def restore(self, state: HostState) -> None:
        """Go on from there as it went on then. Raises `RosminiError` for no state, and if there are other devices now than there were."""
        if not isinstance(state, HostState):
            msg = f"the host {self.node.name} can only be restored from what its save() returned, not from a {type(state).__name__}"
            raise RosminiError(msg)
        if set(state.devices) != set(self._devices):
            gone = sorted(set(state.devices) - set(self._devices))
            new = sorted(set(self._devices) - set(state.devices))
            msg = (
                f"the host {self.node.name} has other devices than the state that is to be restored "
                f"(missing: {', '.join(gone) or 'none'}; additional: {', '.join(new) or 'none'})"
            )
            raise RosminiError(msg)
        if set(state.beats) != set(self._groups):
            then, now = (
                ", ".join(f"{rate:g}" for rate in sorted(each)) for each in (state.beats, self._groups)
            )
            msg = f"the devices of the host {self.node.name} have other rates ({now} Hz) than in the state that is to be restored ({then} Hz)"
            raise RosminiError(msg)
        self.engine.restore(state.engine)
        self._time_ns, self._zero_ns = state.time_ns, state.zero_ns
        self._clock_ns = self.clock.now_ns()
        for name, (before, own) in state.devices.items():
            device = self._devices[name]
            self._groups[device.rate].before[name] = before
            device.restore(own)
        self._devices = {name: self._devices[name] for name in state.devices}  # in the sequence of then
        self._groups = {rate: self._groups[rate] for rate in state.beats}
        for rate, group in self._groups.items():
            group.start_ns, number = state.beats[rate]
            group.to(number)
            group.devices = [each for each in self._devices.values() if each.rate == rate]
            group.sort()
        self._order = tuple(sorted(self._groups.values(), key=lambda group: group.devices[0].order))
        if state.next_ns is None or self._paused or self._ended:
            self._plan()
        else:
            self._forget()
            self._call(state.next_ns)


def _speed(speed: float) -> float:
    if not 0 < speed < float("inf"):
        msg = f"a world's speed has to be a positive number of its seconds in one of the clock, not {speed}"
        raise RosminiError(msg)
    return speed
