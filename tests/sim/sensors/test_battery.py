"""A battery lasts as long as it is said to, sags under a load, warns, and is cut off."""

import math

import pytest

from rosmini.sim.sensors.battery import BURGER_BATTERY, WAFFLE_BATTERY, Battery, BatteryError


def lifetime(battery, power):
    """Return how long a battery lasts [s] at a load of `power` [W]."""
    return next(10.0 * number for number in range(100_000) if battery.drain(power, 10.0).empty)


@pytest.mark.parametrize(("model", "hours"), [(BURGER_BATTERY, 2.5), (WAFFLE_BATTERY, 2.0)])
def test_a_robot_that_drives_lasts_as_long_as_its_maker_says(model, hours):
    assert lifetime(Battery(model), model.draw(1.0, 1.0)) / 3600 == pytest.approx(hours, rel=0.06)


def test_a_load_pulls_the_voltage_down_and_it_comes_back():
    battery = Battery(level=0.5)
    idle, loaded = battery.drain(0.0, 0.0).voltage, battery.drain(30.0, 0.0)
    assert idle == pytest.approx(3 * 3.84)
    assert loaded.voltage == pytest.approx(idle + battery.model.resistance * loaded.current)
    assert loaded.voltage * -loaded.current == pytest.approx(30.0)
    assert battery.drain(0.0, 0.0).voltage == pytest.approx(idle)


def test_it_warns_below_eleven_volts_and_shows_what_the_firmware_shows():
    full, late = Battery().read(), Battery(level=0.05).read()
    assert not full.low and late.low and not late.empty
    assert full.percentage == pytest.approx(full.voltage / 11.1)
    assert (full.charge, full.level) == (1.8, 1.0)


def test_an_empty_one_is_cut_off_until_it_is_charged():
    battery = Battery(level=0.001)
    seen = battery.drain(8.0, 60.0)
    assert seen.empty and seen.low and (seen.voltage, seen.current) == (0.0, 0.0)
    assert battery.drain(0.0, 10.0).empty
    battery.level = 1.0
    assert not battery.read().empty


@pytest.mark.parametrize("level", [-0.1, 1.1, math.nan])
def test_a_level_that_is_none_is_refused(level):
    with pytest.raises(BatteryError, match="from 0"):
        Battery(level=level)


@pytest.mark.parametrize(("power", "duration"), [(-1.0, 1.0), (1.0, -1.0), (math.nan, 1.0), (1.0, math.inf)])
def test_what_cannot_be_drawn_is_refused(power, duration):
    with pytest.raises(BatteryError, match="finite"):
        Battery().drain(power, duration)
