"""Displays for what is published: what one would choose under Add, By topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.errors import RosminiError
from rosmini.viz.map_colours import scheme_of

from .config import Config
from .display import Display
from .topic_display import TopicDisplay

if TYPE_CHECKING:
    from rosmini.graph import Graph

MOST = 40
"""Displays at most."""
SPECIAL = {"tf2_msgs/TFMessage": "rviz/TF"}
ASKED_FOR = ("rviz/Camera", "rviz/DepthCloud", "rviz/Effort")
"""What is shown only if it is asked for: other displays show these messages plainly, or they mean it for few robots."""
INTERACTIVE = "visualization_msgs/InteractiveMarkerUpdate"
TRUTH = "base_pose_ground_truth"
"""A simulator's word on where a robot is, in a frame `map` that nobody publishes where nobody localises a robot."""
TF_SCALE = 0.35
"""Of the axes of frames: at RViz's own they are as long as a TurtleBot3, and hide it."""
SMALL = {"Shaft Length": 0.25, "Shaft Radius": 0.02, "Head Length": 0.1, "Head Radius": 0.05}
"""An arrow for robots of the size of a TurtleBot3: RViz's own is longer than a metre [m]."""


def suggested(graph: Graph, fixed_frame: str | None = None) -> Config:
    """A configuration with a grid and a display for each topic that one can show.

    The fixed frame is `map` where there is a map, and otherwise `odom`. Raises as the Master's questions do.
    """
    kinds: dict[str, type[TopicDisplay]] = {}
    for name in Display.names():
        found = Display.named(name)
        if issubclass(found, TopicDisplay) and found.message and name not in ASKED_FOR:
            kinds.setdefault(found.message, found)
    master = graph.ask_as("/rviz")
    types = {str(topic): str(kind) for topic, kind in master.ask("getTopicTypes")}
    published = {str(topic) for topic, _ in master.ask("getSystemState")[0]}
    displays: list[dict[str, Any]] = [{"Class": "rviz/Grid", "Name": "Grid"}]
    for topic, kind in sorted(types.items()):
        if topic not in published or len(displays) >= MOST:
            continue
        single = topic.removesuffix("_array")
        if (
            kind.endswith("/MarkerArray")
            and single != topic
            and types.get(single) == "visualization_msgs/Marker"
        ):
            continue  # the display of the single markers hears them, too
        if kind in kinds:
            displays.append(_display(kinds[kind], topic))
        elif kind == INTERACTIVE:
            displays.append({"Class": "rviz/InteractiveMarkers", "Name": topic, "Update Topic": topic})
        elif kind in SPECIAL and topic == "/tf":
            displays.append({"Class": SPECIAL[kind], "Name": "TF", "Marker Scale": TF_SCALE})
    if "rviz/RobotModel" in Display.names() and _has_robot(graph):
        displays.insert(1, {"Class": "rviz/RobotModel", "Name": "RobotModel"})
    displays.sort(key=lambda each: each["Class"] not in ("rviz/Grid", "rviz/Map"))
    config = Config(source="what is published")
    options = config.options()
    has_map = any(each["Class"] == "rviz/Map" for each in displays)
    options["Fixed Frame"] = fixed_frame or ("map" if has_map else "odom")
    if options["Fixed Frame"] != "map":
        displays = [each for each in displays if not each["Name"].endswith(TRUTH)]
    return config.with_parts(displays, options, None)


def _display(kind: type[TopicDisplay], topic: str) -> dict[str, Any]:
    named: dict[str, Any] = {"Class": kind.plugin_name, "Name": topic, kind.topic_property: topic}
    if kind.plugin_name == "rviz/Map" and scheme_of(topic) == "costmap":
        named |= {"Color Scheme": "costmap", "Alpha": 0.5}
    if kind.plugin_name == "rviz/Odometry":
        named |= {"Covariance": {"Value": False}, "Keep": 30, "Shape": {"Value": "Arrow", **SMALL}}
    elif kind.plugin_name in ("rviz/Pose", "rviz/PoseWithCovariance"):
        named |= SMALL
    return named


def _has_robot(graph: Graph) -> bool:
    try:
        return bool(graph.ask_as("/rviz").ask("hasParam", "/robot_description"))
    except RosminiError:
        return False
