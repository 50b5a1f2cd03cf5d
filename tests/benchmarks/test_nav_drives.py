"""The driver of the studies goes around what can be pushed, and does not push for long what it meets."""

import numpy as np
import pytest
from rosmini_bench import nav_drives
from rosmini_bench.nav_drives import terrain

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.models import BURGER
from rosmini.sim.simulator import Simulator
from rosmini.sim.worlds import world


def test_what_can_be_pushed_stands_in_the_drivers_way():
    found, places = terrain("house")
    for thing in (each for each in world("house").obstacles if each.movable):
        middle = np.array(found.cell(*thing.pose[:2]))
        assert not found.grid.free[tuple(middle)], thing.name
        assert (np.abs(places - middle).max(axis=1) > 3).all(), thing.name


@pytest.mark.nightly
def test_a_driver_who_meets_something_backs_off():
    with Graph(seed=1) as graph:
        node = graph.node("simulator")
        for name, value in (("x", 5.0), ("y", 3.0), ("yaw", 0.0)):
            node.set_param(f"~{name}", value)
        simulator = Simulator(node, world=world("house"), model=BURGER)
        driver = nav_drives._Driver(graph, "house", simulator, np.random.default_rng(1), 1.0, rest=0.0)
        walls = np.argwhere(driver.terrain.grid.occupied)
        here = np.array(driver.terrain.cell(5.0, 3.0))
        ahead = walls[np.argmin(np.abs(walls - here).sum(axis=1))]
        beyond = ahead + 20 * np.sign(ahead - here)
        driver.path = [driver.terrain.point((int(beyond[0]), int(beyond[1])))]
        speeds = []
        graph.node("ear").subscriber(
            "cmd_vel", message_class("geometry_msgs/Twist"), lambda message: speeds.append(message.linear.x)
        )
        graph.run(20.0)
        assert min(speeds) < 0
