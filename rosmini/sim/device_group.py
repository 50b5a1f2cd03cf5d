"""Schedule of devices with the same rate: all are due at the same instants, whenever they were added."""

from __future__ import annotations

from typing import Protocol

Stamp = tuple[int, int]
"""The time in a message's header: seconds and nanoseconds."""


class Due(Protocol):
    """The part of a device that a group uses; see `rosmini.sim.host.Device`."""

    name: str
    always: bool

    @property
    def order(self) -> float:
        """Sort key among the devices that are due at the same instant."""

    def wanted(self) -> bool:
        """Return True if any node listens; only called if not `always`."""

    def due(self, stamp: Stamp, number: int, /) -> None:
        """Do the device's work for this instant."""


class DeviceGroup:
    """Devices of the same rate, and the time at which they are due next [ns since the engine started]."""

    def __init__(self, rate: float, start_ns: int, now_ns: int) -> None:
        self.rate = rate
        self.period = 1e9 / rate
        self.devices: list[Due] = []
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
            (None if device.always else device.wanted, device.due, self.offsets[device.name])
            for device in self.devices
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
