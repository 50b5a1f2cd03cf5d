"""When devices of one rate are due: all at the same instants, whenever they were added."""

from __future__ import annotations

from typing import Protocol

Stamp = tuple[int, int]
"""The time in a message's header: seconds and nanoseconds."""


class Due(Protocol):
    """What a group needs of a device; see `rosmini.sim.host.Device`."""

    name: str
    always: bool

    @property
    def order(self) -> float:
        """Its place among the devices that are due at the same instant."""

    def wanted(self) -> bool:
        """Return whether anybody wants it; only asked if not `always`."""

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Do what is due."""


class DeviceGroup:
    """Devices of the same rate, and when they are due next [ns since the engine started]."""

    def __init__(self, rate: float, start_ns: int, now_ns: int) -> None:
        self.rate = rate
        self.period = 1e9 / rate
        self.devices: list[Due] = []
        self.before: dict[str, int] = {}
        self.begin(start_ns, now_ns)

    def begin(self, start_ns: int, now_ns: int) -> None:
        """Count from `start_ns`; the next is the first after `now_ns`."""
        self.start_ns = start_ns
        self.to(1)
        self.skip(now_ns)

    def to(self, number: int) -> None:
        """Make this the next one."""
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
        """Put the devices into their order."""
        self.devices.sort(key=lambda device: device.order)  # a stable sort
        self.always = any(device.always for device in self.devices)
        self._calls = tuple(
            (None if device.always else device.wanted, device.due, self.before[device.name])
            for device in self.devices
        )

    def wanted(self) -> bool:
        """Return whether any device has something to do."""
        return self.always or any(device.wanted() for device in self.devices)

    def serve(self, stamp: Stamp) -> None:
        """Serve the devices that are due now."""
        number = self.number
        for wanted, due, before in self._calls:
            if wanted is None or wanted():
                due(stamp, number - before)
