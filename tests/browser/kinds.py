"""One small picture of each kind, the same on every machine: what reference images are made of."""

import math

import numpy as np
from matplotlib.figure import Figure

from rosmini import Graph
from rosmini.core.tf import FrameTree
from rosmini.core.tf.rigid import rigid
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid, Path
from rosmini.sim.turtlesim.frame import Frame
from rosmini.sim.turtlesim.turtle import STEP_S
from rosmini.sim.worlds import world
from rosmini.viz import action_states, byte_map, matplotlib_picture, plot, rqt_graph, sequence_diagram
from rosmini.viz.beams import beams_of
from rosmini.viz.figures import WIDTH
from rosmini.viz.rqt.tf_tree import tf_tree
from rosmini.viz.rviz import Scene
from rosmini.viz.rviz.picture import still
from rosmini.viz.turtle_pictures import turtle_picture
from rosmini.viz.world_pictures import HEIGHT
from rosmini.viz.world_pictures import Scene as WorldScene

SYSTEM = [
    [["/chatter", ["/talker"]], ["/scan", ["/robot"]]],
    [["/chatter", ["/listener"]], ["/scan", ["/listener"]]],
    [],
]


def _world():
    way = [(0.0, 0.0), (0.5, 0.2), (1.0, 0.6), (1.0, 1.0)]
    odom = [(x, y - 0.2 * x) for x, y in way]
    scene = WorldScene(world("room"))
    scene.robot, scene.trail, scene.odom = (1.0, 1.0, 1.0), np.array(way), np.array(odom)
    scene.add_scan(beams_of(np.ones(360), scene.model.laser), scene.robot, None)
    return scene.picture(None, (WIDTH, HEIGHT))


def _plot():
    times = np.arange(0.0, 5.01, 0.25)
    series = {"wanted": (times, np.sign(times - 2)), "sent": (times, np.tanh(times - 2)), "rest": (times, 0.1 * times)}
    return plot(series, x="time [s]", y="speed [m/s]")


def _frames():
    tree = FrameTree()
    for tenth in range(10, 21):
        tree.set("map", "odom", rigid(), tenth * 100_000_000, "/amcl")
        tree.set("odom", "base_footprint", rigid(), tenth * 100_000_000, "/simulator")
    tree.set("base_footprint", "base_scan", rigid(), 0, "/state_publisher", static=True)
    return tf_tree(tree)


def _turtles():
    frame = Frame()
    turtle, other = frame.spawn(2.0, 3.0, 0.5), frame.spawn(8.0, 8.0, -2.0)
    other.set_pen(0, 0, 0, 0, 1)
    turtle.set_pen(255, 220, 0, 5, 0)
    for update in range(100):
        turtle.command(2.0, 0.0, 1.0 if update > 60 else 0.0)
        frame.step(update * STEP_S)
    return turtle_picture(frame)


def _own_figure():
    figure = Figure(figsize=(6, 3), layout="constrained")
    axes = figure.subplots()
    turns = np.linspace(0, 6, 60)
    axes.plot(turns, np.round(np.sin(turns), 2), label="sine")
    axes.plot(turns, np.round(np.cos(turns), 2), "C3.", label="cosine")
    axes.set(xlabel="angle [rad]", ylabel="value")
    axes.legend()
    return matplotlib_picture(figure, text="waves", alt="Two waves.", form="svg")


def _rviz():
    """A costmap over a map, and a path, in RViz's colours."""
    with Graph() as graph:
        node = graph.node("robot")
        cells = np.zeros((20, 30), dtype=np.int8)
        cells[0], cells[:, 0], cells[8:12, 14:18], cells[:, 25:] = 100, 100, 100, -1
        costs = np.clip(100 - 8 * np.hypot(*np.meshgrid(np.arange(30) - 15, np.arange(20) - 9)), 0, 100).astype(np.int8)
        for topic, values in (("/map", cells), ("/costmap", costs)):
            message = OccupancyGrid(data=values.ravel().tolist())
            message.header.frame_id = "map"
            message.info.height, message.info.width = values.shape
            message.info.resolution, message.info.origin.orientation.w = 0.1, 1.0
            node.publisher(topic, OccupancyGrid, latch=True).publish(message)
        path = Path()
        path.header.frame_id = "map"
        for i in range(9):
            pose = PoseStamped()
            pose.pose.position.x, pose.pose.position.y = 0.3 + 0.2 * i, 0.3 + 0.5 * math.sin(0.6 * i) ** 2
            pose.pose.orientation.w = 1.0
            path.poses.append(pose)
        node.publisher("/plan", Path, latch=True).publish(path)
        graph.run(0.1)
        with Scene(graph, fixed_frame="map") as scene:
            scene.add("rviz/Map", {"Topic": "/map"})
            scene.add("rviz/Map", {"Topic": "/costmap", "Color Scheme": "costmap", "Alpha": 0.4})
            scene.add("rviz/Path", {"Topic": "/plan"})
            graph.run(0.1)
            return still(scene, width=480, fit=True)


KINDS = {
    "world": _world,
    "plot": _plot,
    "graph": lambda: rqt_graph(SYSTEM),
    "frames": _frames,
    "sequence": lambda: sequence_diagram(
        [("listener", "Master", "registerSubscriber", "[TALKER]"), ("talker", "listener", "a message", None)],
        title="it",
    ),
    "states": lambda: action_states("client"),
    "bytes": lambda: byte_map(b"\x05\0\0\0hello", [(4, "length: 5"), (5, "data")], title="it"),
    "turtles": _turtles,
    "own_figure": _own_figure,
    "rviz": _rviz,
}
"""By name, the function that makes it."""
