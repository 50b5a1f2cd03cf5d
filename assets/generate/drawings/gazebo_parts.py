"""Drawings of Gazebo's parts: its processes with both Masters, and the libraries that they use."""

from __future__ import annotations

from rosmini.viz import style
from rosmini.viz.graph_drawing import arrow
from rosmini.viz.layout import Edge, Layout, Rect, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import element

from .concepts import diagram, named_box, straight

HERE, THERE = Rect(0.0, 0.0, 260.0, 330.0), Rect(440.0, 0.0, 190.0, 154.0)
MASTER, SERVER, PLUGIN, ROS_MASTER = (
    Rect(20.0, 34.0, 220.0, 40.0),
    Rect(20.0, 106.0, 220.0, 118.0),
    Rect(34.0, 172.0, 192.0, 40.0),
    Rect(20.0, 272.0, 220.0, 40.0),
)
CLIENT, NODES = Rect(460.0, 34.0, 150.0, 108.0), Rect(460.0, 172.0, 150.0, 70.0)
PROCESSES_ALT = (
    "At the left, the computer that simulates: Gazebo's Master, gzserver with the plugin gazebo_ros in it, and the ROS "
    "Master. At the right, another computer with gzclient, and below it ROS nodes. gzserver sends ~/pose/info and "
    "~/response to gzclient, and gzclient sends ~/request and ~/world_control to gzserver; both register with Gazebo's "
    "Master. The plugin sends /clock, /scan and /odom to the nodes and receives /cmd_vel and service calls; both "
    "register with the ROS Master."
)

NEEDS = {
    "gzserver": ("sensors", "physics"),
    "gzclient": ("GUI",),
    "GUI": ("rendering", "Qt", "communication"),
    "sensors": ("rendering", "physics"),
    "physics": ("ODE, Bullet, Simbody, DART", "communication"),
    "rendering": ("OGRE",),
    "communication": ("Protobuf", "Boost ASIO"),
}
"""Gazebo's programs and libraries, and what each of them uses."""
EXTERNAL = ("Qt", "ODE, Bullet, Simbody, DART", "OGRE", "Protobuf", "Boost ASIO")
"""Those of them that are separate projects."""


def gazebo_processes() -> str:
    """Draw Gazebo's server and client on two computers, with ROS nodes and both Masters."""
    parts = [
        named_box(HERE, "simulation computer", "group", 22.0),
        named_box(THERE, "your computer", "group", 22.0),
        named_box(MASTER, "Gazebo Master", "topic"),
        named_box(SERVER, "gzserver: physics, sensors", "node", 26.0),
        named_box(PLUGIN, "plugin gazebo_ros", "group"),
        named_box(ROS_MASTER, "ROS Master", "topic"),
        named_box(CLIENT, "gzclient", "node"),
        named_box(NODES, "ROS nodes", "node"),
        straight((130.0, SERVER.y), (130.0, MASTER.bottom), "registers", (140.0, 94.0), "start"),
        straight((CLIENT.x, 54.0), (MASTER.right, 54.0), "registers", (350.0, 48.0)),
        straight((SERVER.right, 116.0), (CLIENT.x, 116.0), "~/pose/info, ~/response", (350.0, 110.0)),
        straight((CLIENT.x, 134.0), (SERVER.right, 134.0), "~/request, ~/world_control", (350.0, 149.0)),
        straight((PLUGIN.right, 188.0), (NODES.x, 188.0), "/clock, /scan, /odom", (350.0, 182.0)),
        straight((NODES.x, 204.0), (PLUGIN.right, 204.0), "/cmd_vel, services", (350.0, 219.0)),
        straight((130.0, PLUGIN.bottom), (130.0, ROS_MASTER.y), "registers", (140.0, 254.0), "start"),
        straight((NODES.x, 236.0), (ROS_MASTER.right, 290.0), "registers", (362.0, 276.0), "start"),
    ]
    return diagram(parts, Layout(THERE.right, HERE.bottom), "The processes of Gazebo and ROS", PROCESSES_ALT)


def gazebo_libraries() -> str:
    """Draw which libraries Gazebo's programs use, its own and those of others."""
    names = dict.fromkeys([*NEEDS, *(each for needs in NEEDS.values() for each in needs)])
    vertices = [Vertex(each, text_width(each, style.TEXT_SIZE) + 26, 34.0, "box") for each in names]
    edges = [Edge(f"{each} {need}", each, need, 0.0, 0.0) for each, needs in NEEDS.items() for need in needs]
    layout = layered(vertices, edges, direction="down")
    parts = [element("g", arrow(layout.edges[edge.name]), class_="ps-call") for edge in edges]
    for each in names:
        kind = "topic" if each in EXTERNAL else "node" if each.startswith("gz") else "group"
        parts.append(named_box(layout.vertices[each], each, kind))
    lines = [f"{each} uses {', '.join(needs)}" for each, needs in NEEDS.items()]
    alt = f"Graph: {'; '.join(lines)}."
    return diagram(parts, layout, "The libraries of Gazebo", alt)
