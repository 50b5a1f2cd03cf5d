"""The configurations of RViz that launch files name, written as RViz writes them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rosmini import Graph
from rosmini.viz.rviz import Scene
from rosmini.viz.rviz.properties import Vector
from rosmini.viz.rviz.views import Orbit, TopDownOrtho, ViewController

Displays = Iterator[tuple[str, str, dict[str, Any]]]
"""Of each display the class, the name, and the properties that differ from RViz's own."""

COLOURS = ((0, 85, 255), (255, 85, 0), (0, 170, 0), (170, 0, 255))
"""Of robots, in order."""
RED, GREEN, ORANGE = (255, 25, 0), (25, 255, 0), (255, 140, 0)
SMALL_ARROW = {"Shaft Length": 0.4, "Shaft Radius": 0.04, "Head Length": 0.2, "Head Radius": 0.1}


def _scan(topic: str, colour: tuple[int, int, int] = RED) -> tuple[str, str, dict[str, Any]]:
    return "LaserScan", "LaserScan", {
        "Topic": topic, "Color Transformer": "FlatColor", "Color": colour, "Size (m)": 0.04,
    }  # fmt: skip


def _robot(prefix: str = "") -> tuple[str, str, dict[str, Any]]:
    description = f"{prefix}/robot_description" if prefix else "robot_description"
    return "RobotModel", "RobotModel", {"Robot Description": description, "TF Prefix": prefix}


def _costmap(name: str, topic: str, alpha: float) -> tuple[str, str, dict[str, Any]]:
    return "Map", name, {"Topic": topic, "Color Scheme": "costmap", "Alpha": alpha}


def _navigation(node: str, planner: str, *, global_plan: str) -> Displays:
    """What move_base shows, by its name and its planners'."""
    yield _costmap("Global Costmap", f"{node}/global_costmap/costmap", 0.35)
    yield _costmap("Local Costmap", f"{node}/local_costmap/costmap", 0.6)
    yield "Path", "Global Plan", {"Topic": global_plan, "Color": ORANGE, "Line Style": "Billboards"}
    yield "Path", "Local Plan", {"Topic": f"{node}/{planner}/local_plan", "Color": (255, 255, 0)}
    yield "Polygon", "Footprint", {"Topic": f"{node}/local_costmap/footprint"}
    yield "Pose", "Goal", {"Topic": f"{node}/current_goal", "Color": RED, **SMALL_ARROW}


def _particles(topic: str = "/particlecloud") -> tuple[str, str, dict[str, Any]]:
    return "PoseArray", "Particles", {"Topic": topic, "Color": (0, 192, 0), "Arrow Length": 0.1}


MAP = ("Map", "Map", {"Topic": "/map", "Alpha": 1.0, "Draw Behind": True})
GRID = ("Grid", "Grid", {"Plane Cell Count": 20})
TF = ("TF", "TF", {"Show Names": False, "Marker Scale": 0.35})
AXES = ("TF", "TF", {"Show Names": False, "Marker Scale": 0.2})
NAVFN, DWA, ROLLOUT = "NavfnROS/plan", "DWAPlannerROS", "TrajectoryPlannerROS"
BOUNDARY = (
    ("Marker", "Exploration Polygon", {"Marker Topic": "/exploration_polygon_marker"}),
    (
        "PointCloud2",
        "Frontiers",
        {"Topic": "/explore_server/explore_costmap/explore_boundary/frontiers", "Size (m)": 0.05},
    ),
)


def _turtlebot3(*more: tuple[str, str, dict[str, Any]]) -> Displays:
    yield MAP
    yield _scan("/scan")
    yield _robot()
    yield from _navigation("/move_base", DWA, global_plan=f"/move_base/{NAVFN}")
    yield from more


def _stage(*more: tuple[str, str, dict[str, Any]]) -> Displays:
    yield MAP
    yield _scan("/base_scan")
    yield from _navigation("/move_base_node", ROLLOUT, global_plan=f"/move_base_node/{NAVFN}")
    yield from more


def _robots(names: tuple[str, ...], scan: str, node: str, *, models: bool) -> Displays:
    """One map, and of each robot a group's worth of displays in its own colour."""
    yield MAP
    for name, colour in zip(names, COLOURS, strict=False):
        kind, _, properties = _scan(f"/{name}/{scan}", colour)
        yield kind, f"{name} scan", properties
        if models:
            kind, _, properties = _robot(name)
            yield kind, f"{name} model", properties
        move_base = f"/{name}/{node}"
        yield _costmap(f"{name} costmap", f"{move_base}/local_costmap/costmap", 0.5)
        wide = {"Color": colour, "Line Style": "Billboards"}
        yield "Path", f"{name} plan", {"Topic": f"{move_base}/{NAVFN}", **wide}
        yield "Polygon", f"{name} footprint", {
            "Topic": f"{move_base}/local_costmap/footprint", "Color": colour,
        }  # fmt: skip
        yield "Pose", f"{name} goal", {"Topic": f"{move_base}/current_goal", "Color": colour, **SMALL_ARROW}


View = dict[str, Any]
"""The properties of an Orbit view."""

CLOSE: View = {"Distance": 0.9, "Focal Point": Vector(0.0, 0.0, 0.1), "Pitch": 0.45, "Yaw": 0.7}
"""A TurtleBot3 from close up."""

FILES: dict[str, tuple[str, View | tuple[float, float, float], Any]] = {
    "turtlebot3_bringup/rviz/model.rviz": (
        "base_footprint", CLOSE, lambda: iter((GRID, _robot(), AXES, _scan("/scan"))),
    ),
    "turtlebot3_navigation/rviz/turtlebot3_navigation.rviz": (
        "map", (0.0, 0.0, 45.0), lambda: _turtlebot3(_particles()),
    ),
    "turtlebot3_slam/rviz/turtlebot3_gmapping.rviz": ("map", (0.0, 0.0, 45.0), _turtlebot3),
    "turtlebot3_slam/rviz/turtlebot3_hector.rviz": ("map", (0.0, 0.0, 45.0), _turtlebot3),
    "turtlebot3_slam/rviz/turtlebot3_frontier_exploration.rviz": (
        "map", (0.0, 0.0, 45.0), lambda: _turtlebot3(*BOUNDARY),
    ),
    "navigation_stage/single_robot.rviz": ("map", (5.0, 0.0, 55.0), lambda: _stage(_particles(), *BOUNDARY[:1])),
    "navigation_stage/multi_robot.rviz": (
        "map", (5.0, 0.0, 55.0),
        lambda: _robots(("robot_0", "robot_1"), "base_scan", "move_base_node", models=False),
    ),
    "turtlebot3_navigation/rviz/multi_turtlebot3_navigation.rviz": (
        "map", (0.0, 0.0, 45.0),
        lambda: _robots(("tb3_0", "tb3_1", "tb3_2", "tb3_3"), "scan", "move_base", models=True),
    ),
}  # fmt: skip
"""Of each file its fixed frame, its view (from above: its middle x, y [m] and its scale [px/m]), and its displays."""


def texts() -> dict[str, str]:
    """Every file's text, by its path in assets/ros."""
    return {path: _text(*what) for path, what in FILES.items()}


def _text(frame: str, view: View | tuple[float, float, float], displays: Any) -> str:
    with Graph() as graph, Scene(graph, fixed_frame=frame) as scene:
        for kind, name, properties in displays():
            scene.add(kind, properties).name = name
        made: ViewController = Orbit()
        if not isinstance(view, dict):
            made, view = TopDownOrtho(), dict(zip(("X", "Y", "Scale"), view, strict=True))
        for key, value in view.items():
            made[key] = value
        scene.view = made
        return scene.saved().text()
