"""The chapter Costmaps: its cells show what its text says of them."""

from __future__ import annotations

import re

from .conftest import printed


def test_only_the_robot_that_sees_a_ghost_drives_a_detour(figures):
    metres = [float(length) for length in re.findall(r"house: ([\d.]+) m in", "".join(map(str, figures.values())))]
    detour, straight = metres
    assert detour > straight + 0.1


def test_the_beams_ahead_hit_nothing(cells):
    assert printed(cells, '"ahead:"').count("inf") == 5


def test_inflation_by_hand_agrees_with_the_robots(cells):
    same, of = re.findall(r"\d+", printed(cells, "cells agree"))
    assert same == of


def test_only_the_inscribed_radius_closes_the_door(cells):
    costs = dict(re.findall(r"(\w = [\d.]+): (\d+)", printed(cells, "def in_door")))
    assert [name for name, cost in costs.items() if int(cost) >= 253] == ["r = 0.5"]
