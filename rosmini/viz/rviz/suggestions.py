"""Displays for published topics: those that a user would choose under Add, By topic."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph import Graph
from rosmini.viz.map_colours import scheme_of
from rosmini.viz.view import ViewError

from .config import Config, kind_of
from .display import Display
from .displays.group import display_from
from .scene import Scene
from .topic_display import TopicDisplay

MAX_DISPLAYS = 40
"""Maximum number of displays."""
SPECIAL = {"tf2_msgs/TFMessage": "rviz/TF"}
NEVER_SUGGESTED = ("rviz/Camera", "rviz/DepthCloud", "rviz/Effort")
"""Displays that are never suggested: others show their messages more simply, or few robots publish them."""
INTERACTIVE = "visualization_msgs/InteractiveMarkerUpdate"
GROUND_TRUTH = "base_pose_ground_truth"
"""A simulator's ground truth of a pose, in a frame `map` that does not exist unless the robot is localised."""
TF_SCALE = 0.35
"""Scale of the axes of frames: at RViz's default they are as long as a TurtleBot3, and hide it."""
SMALL = {"Shaft Length": 0.25, "Shaft Radius": 0.02, "Head Length": 0.1, "Head Radius": 0.05}
"""Dimensions of an arrow for robots of the size of a TurtleBot3: RViz's default is longer than a metre [m]."""
GROUND = ("rviz/Grid", "rviz/Map")
"""Displays that are drawn first, below everything else."""
INTERVAL_NS = 1_000_000_000
"""Interval at which a window asks the Master for new topics [ns of graph time]."""


class Suggestions:
    """Adds displays to a scene for topics that appear after the window was opened.

    It suggests each display once, because the user may have removed it. Unless the user has chosen another fixed frame,
    it also changes the frame to `map` when the first map appears.
    """

    def __init__(self, graph: Graph, scene: Scene, fixed_frame: str | None = None) -> None:
        self._graph, self._scene, self._chosen = graph, scene, fixed_frame
        self._frame = scene.fixed_frame
        self._seen = {(each.plugin_name, each.name) for each in scene}
        self._next_ns = graph.scheduler.now_ns() + INTERVAL_NS

    def add_new(self) -> bool:
        """Ask the Master if an interval has passed, and return True if the scene has new displays."""
        scene, now = self._scene, self._graph.scheduler.now_ns()
        if now < self._next_ns:
            return False
        self._next_ns = now + INTERVAL_NS
        if scene.fixed_frame != self._frame:
            self._chosen = scene.fixed_frame
        try:
            config = suggested(self._graph, self._chosen, apart_from=scene.node.name)
        except RosminiError:
            return False  # the Master has gone, or has not answered yet
        frame = str(config.options()["Fixed Frame"])
        if self._chosen is None and frame != self._frame:
            scene.fixed_frame = self._frame = frame
        there = {self._shows(each) for each in scene}
        trees = {(each["Class"], each["Name"]): each for each in config.mappings("Displays")}
        new = [display_from(tree) for name, tree in trees.items() if name not in self._seen]
        self._seen |= trees.keys()
        added = [each for each in new if self._shows(each) not in there and len(scene.displays) < MAX_DISPLAYS]
        for each in added:
            scene.add(each)
        scene.displays.sort(key=lambda each: each.plugin_name not in GROUND)
        return bool(added)

    def _shows(self, display: Display) -> tuple[str, str]:
        """Return the class of a display and its topic, if it has one."""
        key = display.topic_property if isinstance(display, TopicDisplay) else "Update Topic"
        topic = str(display[key]) if key in display else ""
        return display.plugin_name, topic and self._scene.node.resolve(topic)


def suggested(graph: Graph, fixed_frame: str | None = None, *, apart_from: str = "") -> Config:
    """Return a configuration with a grid and a display for each topic that one can show.

    The fixed frame is `map` if there is a map, and otherwise `odom`. Topics that only the node `apart_from`
    publishes are left out. Raises the errors of the calls of the Master.
    """
    kinds: dict[str, type[TopicDisplay]] = {}
    for name in Display.names():
        found = Display.named(name)
        if issubclass(found, TopicDisplay) and found.message and name not in NEVER_SUGGESTED:
            kinds.setdefault(found.message, found)
    master = graph.ask_as("/rviz")
    types = {str(topic): str(kind) for topic, kind in master.ask("getTopicTypes")}
    published = {str(topic) for topic, nodes in master.ask("getSystemState")[0] if {*nodes} - {apart_from}}
    displays: list[dict[str, Any]] = [{"Class": "rviz/Grid", "Name": "Grid"}]
    for topic, kind in sorted(types.items()):
        if topic not in published or len(displays) >= MAX_DISPLAYS:
            continue
        single = topic.removesuffix("_array")
        if kind.endswith("/MarkerArray") and single != topic and types.get(single) == "visualization_msgs/Marker":
            continue  # the display of single markers also receives them
        if kind in kinds:
            displays.append(_display(kinds[kind], topic))
        elif kind == INTERACTIVE:
            displays.append({"Class": "rviz/InteractiveMarkers", "Name": topic, "Update Topic": topic})
        elif kind in SPECIAL and topic == "/tf":
            displays.append({"Class": SPECIAL[kind], "Name": "TF", "Marker Scale": TF_SCALE})
    if "rviz/RobotModel" in Display.names() and _has_robot(graph):
        displays.insert(1, {"Class": "rviz/RobotModel", "Name": "RobotModel"})
    displays.sort(key=lambda each: each["Class"] not in GROUND)
    config = Config(source="what is published")
    options = config.options()
    has_map = any(each["Class"] == "rviz/Map" for each in displays)
    options["Fixed Frame"] = fixed_frame or ("map" if has_map else "odom")
    if options["Fixed Frame"] != "map":
        displays = [each for each in displays if not each["Name"].endswith(GROUND_TRUTH)]
    return config.with_parts(displays, options, None)


def selected(config: Config, names: Sequence[str]) -> Config:
    """Return a configuration with the grid and the displays that have one of the names, as name, class or topic.

    Raises `ViewError` for a name that no display has.
    """
    displays = config.mappings("Displays")
    found: list[dict[str, Any]] = []
    for name in names:
        matching = [each for each in displays if name in _names(each)]
        if not matching:
            known = sorted({str(each.get("Name", "")) for each in displays})
            hint = nearest(name, known) or f"the displays are: {', '.join(known)}; a file is given by -d FILE"
            raise ViewError(f"there is no display {name!r:.60}; {hint}")
        found += matching
    return config.with_parts(
        [each for each in displays if each in found or kind_of(each) == "rviz/Grid"], config.options(), None
    )


def _names(display: dict[str, Any]) -> set[str]:
    """Return the names by which a display can be selected."""
    kind = kind_of(display)
    topics = {str(value) for key, value in display.items() if key.endswith("Topic") and isinstance(value, str)}
    return {str(display.get("Name", "")), kind, kind.rpartition("/")[2], *topics}


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
