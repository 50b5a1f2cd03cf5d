"""A battery that drains: the remaining charge, and the voltage that results from it.

The open-circuit voltage E follows from the remaining charge; the robot draws the power P, whatever the voltage,
through the battery's internal resistance R. From P = V I and V = E - R I:

    I = (E - sqrt(E^2 - 4 R P)) / (2 R),   dq/dt = -I.

Sources of the numbers:

- 11.1 V, 1800 mAh, 19.98 Wh, and run times of 2.5 h for a Burger and 2 h for a Waffle:
  https://emanual.robotis.com/docs/en/platform/turtlebot3/features/. So a Burger draws 8.0 W and a Waffle 10.0 W.
- Of these a laser takes 2.0 W (400 mA at 5 V:
  https://emanual.robotis.com/docs/en/platform/turtlebot3/appendix_lds_01/), and two motors at rest 1.2 W (52 mA each
  at 11.1 V: https://emanual.robotis.com/docs/en/dxl/x/xl430-w250/). The 0.8 W that a motor takes in addition at full
  speed without a load are our estimate; the rest is for the computers. So the published time applies to a robot that
  always drives; one at rest runs longer.
- The curve is the usual one of a lithium polymer cell, 4.2 V full, flat around 3.8 V, steep at the end; a cell is cut
  off at 3.0 V. The curve and the resistance are those of a typical cell, not of this model.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

CURVE = (
    (0.0, 3.27), (0.05, 3.61), (0.10, 3.69), (0.20, 3.73), (0.30, 3.77), (0.40, 3.80), (0.50, 3.84),
    (0.60, 3.87), (0.70, 3.95), (0.80, 4.02), (0.90, 4.11), (0.95, 4.15), (1.0, 4.20),
)  # fmt: skip
"""A cell's open-circuit voltage [V] by its charge level."""

STEP = 1.0
"""Maximum integration step [s]."""


@dataclass(frozen=True)
class BatteryModel:
    """A battery and its loads. The defaults are a Burger's."""

    capacity: float = 1.8
    """Capacity [Ah]."""
    cells: int = 3
    resistance: float = 0.12
    """Resistance of the whole battery and its leads [ohm]."""
    rest: float = 6.4
    """Power of a robot at rest: its computers, its laser, its motors [W]."""
    motor: float = 0.8
    """Additional power of each of its two motors at full speed [W]."""
    efficiency: float = 0.3
    """Fraction of a motor's additional power under load that pushes the robot."""
    cutoff: float = 9.0
    """Cutoff voltage [V]: 3.0 V a cell, before it is damaged."""
    nominal: float = 11.1
    """Nominal voltage [V]."""
    name: str = "LiPo 3S 1800 mAh"

    def open_voltage(self, level: float) -> float:
        """Return the voltage [V] without a load at the charge level `level` (0 to 1)."""
        levels, volts = zip(*CURVE, strict=True)
        return self.cells * float(np.interp(level, levels, volts))

    def draw(self, left: float, right: float, force: float = 0.0, speed: float = 0.0) -> float:
        """Return the power [W] of a robot whose motors turn at `left` and `right` of their full speed (-1 to 1).

        Pushing an object with `force` [N] at `speed` [m/s] is added to it.
        """
        return self.rest + self.motor * (abs(left) + abs(right)) + abs(force * speed) / self.efficiency


BURGER_BATTERY = BatteryModel()
WAFFLE_BATTERY = BatteryModel(rest=8.4)
"""Battery of the Waffle and the Waffle Pi, which differ in their computers and have the same run time."""


@dataclass(frozen=True)
class Charge:
    """The state of a battery at one moment."""

    voltage: float
    """Voltage between its terminals, under the current load [V]."""
    current: float
    """[A]; negative, as `sensor_msgs/BatteryState` requires for a battery that is being discharged."""
    charge: float
    """Remaining charge [Ah]."""
    percentage: float
    """Percentage as defined by TurtleBot3's firmware: the voltage divided by the nominal 11.1 V.

    It is 1.13 for a full battery and about 0.8 for an empty one.
    """
    empty: bool
    """True after the cutoff: the motors stop, and nothing more is measured."""


class Battery:
    """A battery, initially full, or at the charge level `level` (0 to 1)."""

    def __init__(self, model: BatteryModel = BURGER_BATTERY, level: float = 1.0) -> None:
        self.model = model
        self.level = level
        """The remaining fraction of its charge, 0 to 1."""
        self._power = model.rest
        self._empty = False

    def drain(self, power: float, duration: float) -> Charge:
        """Draw `power` [W] for `duration` [s]; return the state after it."""
        self._power = power
        steps = math.ceil(duration / STEP)
        for _ in range(steps):
            if self._spent():
                break
            used = self._current() * duration / steps / 3600.0
            self.level = max(self.level - used / self.model.capacity, 0.0)
        return self.read()

    def read(self) -> Charge:
        """Return the current state, under the last load."""
        model = self.model
        self._spent()
        voltage = 0.0 if self._empty else self._voltage()
        return Charge(
            voltage=voltage,
            current=0.0 if self._empty else -self._current(),
            charge=self.level * model.capacity,
            percentage=voltage / model.nominal,
            empty=self._empty,
        )

    def _spent(self) -> bool:
        """Cut the battery off if it is exhausted; return True if it is off.

        It stays off, although without a load its voltage would recover.
        """
        self._empty = self._empty or self.level <= 0.0 or self._voltage() <= self.model.cutoff
        return self._empty

    def _current(self) -> float:
        model = self.model
        open_voltage = model.open_voltage(self.level)
        # beyond the maximum power for this resistance, half of the voltage is lost inside
        left = max(open_voltage**2 - 4 * model.resistance * self._power, 0.0)
        return (open_voltage - math.sqrt(left)) / (2 * model.resistance)

    def _voltage(self) -> float:
        return self.model.open_voltage(self.level) - self.model.resistance * self._current()
