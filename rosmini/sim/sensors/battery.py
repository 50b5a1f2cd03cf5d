"""A battery that drains: how much of its charge is left, and the voltage that this gives.

The open-circuit voltage E follows from the charge that is left; the robot draws the power P, whatever the voltage,
through the resistance R inside of the battery. From P = V I and V = E - R I:

    I = (E - sqrt(E^2 - 4 R P)) / (2 R),   dq/dt = -I.

Where the numbers are from:

- 11.1 V, 1800 mAh, 19.98 Wh, and that a Burger runs for 2.5 h and a Waffle for 2 h:
  https://emanual.robotis.com/docs/en/platform/turtlebot3/features/. So a Burger draws 8.0 W and a Waffle 10.0 W.
- Of these a laser takes 2.0 W (400 mA at 5 V:
  https://emanual.robotis.com/docs/en/platform/turtlebot3/appendix_lds_01/), and two motors that stand 1.2 W (52 mA each
  at 11.1 V: https://emanual.robotis.com/docs/en/dxl/x/xl430-w250/). That a motor takes 0.8 W more at full speed without
  a load is our estimate; the rest is the computers'. So the published time is that of a robot that always drives; one
  that stands runs longer.
- The firmware warns below 11.0 V (`updateVoltageCheck` in `turtlebot3_core` of https://github.com/ROBOTIS-GIT/OpenCR),
  and so does `turtlebot3_diagnostics`.
- The curve is a usual one of a lithium polymer cell, 4.2 V full, flat around 3.8 V, steep at the end; a cell is cut off
  at 3.0 V. It is of a typical cell, not of this very one, and so is the resistance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rosmini.core.errors import RosminiError

CURVE = (
    (0.0, 3.27), (0.05, 3.61), (0.10, 3.69), (0.20, 3.73), (0.30, 3.77), (0.40, 3.80), (0.50, 3.84),
    (0.60, 3.87), (0.70, 3.95), (0.80, 4.02), (0.90, 4.11), (0.95, 4.15), (1.0, 4.20),
)  # fmt: skip
"""The open-circuit voltage [V] of a cell by how full it is."""

STEP = 1.0
"""The largest step of integration [s]."""


class BatteryError(RosminiError, ValueError):
    """An impossible charge level or load; the message says what is wrong."""


@dataclass(frozen=True)
class BatteryModel:
    """A battery and what drains it. The numbers are a Burger's."""

    capacity: float = 1.8
    """[Ah]"""
    cells: int = 3
    resistance: float = 0.12
    """Of the whole battery and its leads [ohm]."""
    rest: float = 6.4
    """What a robot at rest draws: its computers, its laser, its motors [W]."""
    motor: float = 0.8
    """What each of its two motors draws in addition at its full speed [W]."""
    efficiency: float = 0.3
    """How much of what a motor draws in addition under a load pushes the robot."""
    warning: float = 11.0
    """Below this the firmware warns [V]."""
    cutoff: float = 9.0
    """At this nothing works any more [V]: 3.0 V a cell, before it is damaged."""
    nominal: float = 11.1
    """[V]"""
    name: str = "LiPo 3S 1800 mAh"

    def open_voltage(self, level: float) -> float:
        """The voltage [V] with nothing connected, when `level` (0 to 1) of the charge is left."""
        levels, volts = zip(*CURVE, strict=True)
        return self.cells * float(np.interp(level, levels, volts))

    def draw(self, left: float, right: float, force: float = 0.0, speed: float = 0.0) -> float:
        """The power [W] that a robot draws whose motors turn at `left` and `right` of their full speed (-1 to 1).

        If it pushes something with `force` [N] at `speed` [m/s], that comes on top.
        """
        return self.rest + self.motor * (abs(left) + abs(right)) + abs(force * speed) / self.efficiency


BURGER_BATTERY = BatteryModel()
WAFFLE_BATTERY = BatteryModel(rest=8.4)
"""Of the Waffle and of the Waffle Pi, which differ in their computers and live equally long."""


@dataclass(frozen=True)
class Charge:
    """What a battery shows at one moment."""

    voltage: float
    """Between its poles, under the load of this moment [V]."""
    current: float
    """[A]; negative, as `sensor_msgs/BatteryState` wants it of a battery that is being discharged."""
    charge: float
    """What is left [Ah]."""
    level: float
    """What is left, 0 to 1."""
    percentage: float
    """What TurtleBot3's firmware calls so: its voltage by the nominal 11.1 V.

    A full battery shows 1.13, an empty one about 0.8.
    """
    low: bool
    """The firmware warns: its buzzer sounds, and `turtlebot3_diagnostics` asks for a charger."""
    empty: bool
    """It was cut off: the motors stand still, and nothing more is measured."""


class Battery:
    """One battery, initially full, or at `level` (0 to 1) of its charge."""

    def __init__(self, model: BatteryModel = BURGER_BATTERY, level: float = 1.0) -> None:
        self.model = model
        self.level = level
        self._power = model.rest
        self._empty = False

    @property
    def level(self) -> float:
        """How much of its charge is left, 0 to 1.

        Setting it charges or replaces the battery. Raises `BatteryError`.
        """
        return self._level

    @level.setter
    def level(self, level: float) -> None:
        if not (isinstance(level, (int, float)) and 0.0 <= level <= 1.0):
            raise BatteryError(f"a battery is from 0 (empty) to 1 (full), not {level!r}")
        self._level = float(level)
        self._empty = False

    def drain(self, power: float, duration: float) -> Charge:
        """Draw `power` [W] for `duration` [s]; return what the battery shows after that.

        Raises `BatteryError` for what is negative or no number.
        """
        if not (0.0 <= power < math.inf and 0.0 <= duration < math.inf):
            raise BatteryError(
                f"a battery cannot give {power} W for {duration} s: both have to be finite, and 0 or more"
            )
        self._power = power
        steps = math.ceil(duration / STEP)
        for _ in range(steps):
            if self._spent():
                break
            used = self._current() * duration / steps / 3600.0
            self._level = max(self._level - used / self.model.capacity, 0.0)
        return self.read()

    def read(self) -> Charge:
        """What the battery shows now, under the load that was last drawn."""
        model = self.model
        self._spent()
        voltage = 0.0 if self._empty else self._voltage()
        return Charge(
            voltage=voltage,
            current=0.0 if self._empty else -self._current(),
            charge=self._level * model.capacity,
            level=self._level,
            percentage=voltage / model.nominal,
            low=voltage < model.warning,
            empty=self._empty,
        )

    def remaining(self, power: float) -> float:
        """For how long the battery will last [s] if `power` [W] is drawn from it; inf for 0 W."""
        if power == 0.0:
            return math.inf
        twin = Battery(self.model, self._level)
        spent = 0.0
        while not twin.drain(power, 10.0 * STEP).empty:
            spent += 10.0 * STEP
        return spent

    def _spent(self) -> bool:
        """Cut it off if there is nothing more to take from it.

        It stays off until it is charged: without a load its voltage would come back.
        """
        self._empty = self._empty or self._level <= 0.0 or self._voltage() <= self.model.cutoff
        return self._empty

    def _current(self) -> float:
        model = self.model
        open_voltage = model.open_voltage(self._level)
        # beyond the largest power that the resistance lets through, half of the voltage is lost inside
        left = max(open_voltage**2 - 4 * model.resistance * self._power, 0.0)
        return (open_voltage - math.sqrt(left)) / (2 * model.resistance)

    def _voltage(self) -> float:
        return self.model.open_voltage(self._level) - self.model.resistance * self._current()
