"""A battery lasts as long as it is said to, sags under a load, and is cut off."""

import pytest

from rosmini.sim.sensors.battery import BURGER_BATTERY, WAFFLE_BATTERY, Battery


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


def test_it_shows_what_the_firmware_shows():
    full = Battery().read()
    assert full.percentage == pytest.approx(full.voltage / 11.1)
    assert full.charge == 1.8


def test_an_empty_one_is_cut_off():
    battery = Battery(level=0.001)
    seen = battery.drain(8.0, 60.0)
    assert seen.empty and (seen.voltage, seen.current) == (0.0, 0.0)
    assert battery.drain(0.0, 10.0).empty
