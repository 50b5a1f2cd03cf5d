"""Generators and worlds that the engine's tests share."""

import numpy as np

from rosmini.sim.world import World


def generator(name):
    return np.random.default_rng(sum(name.encode()))


def pen(half, *obstacles):
    """A world of obstacles within four walls."""
    h = half
    sides = np.array([(-h, -h, h, -h), (h, -h, h, h), (h, h, -h, h), (-h, h, -h, -h)])
    return World("pen", obstacles, walls=sides)
