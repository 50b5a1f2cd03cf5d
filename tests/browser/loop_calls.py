"""Calls of all compiled loops in small worlds: `python tests/browser/loop_calls.py FILE` writes them as JSON."""

import io
import json
import sys
from base64 import b64encode
from importlib import import_module

import numpy as np

from rosmini import Graph, rosrun
from rosmini.core.geometry import machine_code

compile_ = machine_code.machine_code
calls = {}


def described(value):
    if isinstance(value, tuple):
        return [described(part) for part in value]
    if isinstance(value, np.ndarray):
        return {"type": value.dtype.str, "shape": value.shape, "data": b64encode(value.tobytes()).decode()}
    return value.item() if isinstance(value, np.generic) else value


def recording(function, signature, helpers=()):
    """Compile a loop, and record its calls number 1, 4, 16 and 64."""
    compiled, recorded, count = compile_(function, signature, helpers), calls.setdefault(function.__name__, []), 0

    def run(*arguments):
        nonlocal count
        count += 1
        if count not in {1, 4, 16, 64}:
            return compiled(*arguments)
        before = described(arguments)
        result = compiled(*arguments)
        recorded.append([before, described(arguments), described(result)])
        return result

    return run


machine_code.machine_code = recording  # before the modules with loops import it
machine_code.Deferral.due = lambda self, work: True

from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist, Vector3
from rosmini.navigation.base_local_planner.costmap_model import footprint_cost
from rosmini.navigation.costmap_2d import voxels
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.global_planner.search import GlobalAStar
from rosmini.ros.launch import roslaunch
from rosmini.sim.engine import Engine, scene
from rosmini.sim.models import BURGER
from rosmini.sim.world import Box, Cylinder, Obstacle, World


def launch(graph, package, file, **arguments):
    roslaunch(package, file, graph=graph, console={"stdout": io.StringIO(), "stderr": io.StringIO()}, **arguments)


def contacts():
    """Robots measure one another and push crates and one another in a narrow room."""
    scene.COMPILE_AFTER_BODIES = 0
    walls = np.array([(-1, -1, 1, -1), (1, -1, 1, 1), (1, 1, -1, 1), (-1, 1, -1, -1)], dtype=float)
    crates = (
        Obstacle("crate", Box(0.2, 0.15), (0.1, 0.5, 0.4), mass=1.0),
        Obstacle("ball", Cylinder(0.08), (0.5, -0.4, 0.0), mass=0.2),
    )
    rng = np.random.default_rng
    engine = Engine(World("narrow", crates, walls), lambda name: rng(len(name)))
    for n, (x, y) in enumerate(((-0.5, -0.5), (-0.5, 0.5), (0.0, -0.5), (0.5, 0.3))):
        engine.add(f"robot {n}", BURGER, (x, y, 0.3 * n))
        engine.command(f"robot {n}", 0.2, 0.5 * n - 0.6)
    engine.advance(engine.now + 8)


def navigation():
    """A robot localises itself and drives to a goal."""
    tree = import_module("rosmini.core.tf.tree")
    tree.LOOKUPS_LOADED = tree.LOOKUPS_TO_LOAD = 1
    with Graph() as graph:
        launch(graph, "rosmini_sim", "navigation.launch", localization="amcl")
        publisher = graph.node("goal").publisher("move_base_simple/goal", PoseStamped, latch=True)
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x = -1.0
        goal.pose.position.y = 1.0
        goal.pose.orientation.w = 1.0
        publisher.publish(goal)
        graph.run(4)


def mapping():
    """A robot turns, and two programs map the room."""
    with Graph() as graph:
        graph.master.setParam("/test", "/simulator/cmd_vel_timeout", 0.0)
        launch(graph, "rosmini_sim", "simulator.launch", world="room")
        launch(graph, "turtlebot3_bringup", "turtlebot3_remote.launch", model="burger")
        rosrun("gmapping", "slam_gmapping", "_particles:=3", "_base_frame:=base_footprint", graph=graph)
        settings = ("_map_size:=200", "_base_frame:=base_footprint", "_pub_map_odom_transform:=false")
        rosrun("hector_mapping", "hector_mapping", *settings, graph=graph)
        graph.node("driver").publisher("cmd_vel", Twist, latch=True).publish(Twist(angular=Vector3(z=1.0)))
        graph.run(6)


def grids():
    """A* finds a path between obstacles, a footprint lies across some, and rays clear voxels."""
    rng = np.random.default_rng(7)
    costs = rng.choice(np.array([0, 40, 254], dtype=np.uint8), (60, 80), p=[0.6, 0.3, 0.1])
    costs[5, 5] = costs[50, 70] = 0
    GlobalAStar(costs, (5, 5), (70, 50)).expand()
    grid = Costmap2D(80, 60, 0.1)
    grid.costs[...] = np.minimum(costs, 200)
    footprint_cost(grid, (3.0, 2.0, 0.4), np.array([(0.3, 0.2), (-0.3, 0.2), (-0.3, -0.2), (0.3, -0.2)]))
    columns = np.full((20, 20), voxels.UNKNOWN * 0x10001, dtype=np.int64)
    frame = np.array((0.0, 0.0, 0.0, 0.1, 0.2, 2.0))
    costs, ends = np.full((20, 20), 254, dtype=np.uint8), rng.uniform(-0.5, 2.5, (50, 3))
    voxels.compiled_clear_voxels()(columns, costs, frame, np.array((1.0, 1.0, 0.3)), ends, 10, 100, 0, 15 + 6)


if __name__ == "__main__":
    contacts()
    navigation()
    mapping()
    grids()
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump(calls, file)
    print({name: len(recorded) for name, recorded in calls.items()})
