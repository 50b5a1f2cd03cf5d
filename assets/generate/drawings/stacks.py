"""A drawing of what ROS is made of: a distribution, one of its stacks, and one of that stack's packages."""

from __future__ import annotations

from rosmini.viz import style
from rosmini.viz.graph_drawing import text
from rosmini.viz.layout import Layout, Rect
from rosmini.viz.svg import element

from .concepts import diagram, named_box, straight

DISTRIBUTION = ("turtlebot3", "slam_gmapping", "hector_slam", "navigation", "geometry2", "common_msgs", "ros_comm")
"""Some stacks of ROS Noetic; most of them need some of those that come later."""
NAVIGATION = (
    "move_base",
    "move_base_msgs",
    "nav_core",
    "navfn",
    "global_planner",
    "carrot_planner",
    "base_local_planner",
    "dwa_local_planner",
    "costmap_2d",
    "voxel_grid",
    "rotate_recovery",
    "clear_costmap_recovery",
    "move_slow_and_clear",
    "amcl",
    "fake_localization",
    "map_server",
)
"""The packages of the stack navigation, version 1.17."""
MAP_SERVER = (
    ("package.xml", "name, version, needs"),
    ("CMakeLists.txt", "how it is built"),
    ("src/", "map_server, map_saver"),
    ("include/", "a library: image_loader"),
    ("scripts/", "crop_map"),
    ("test/", "its tests"),
)
"""The contents of the package map_server."""
WIDTH, GAP, HEAD, ROW = 196.0, 44.0, 32.0, 20.0
STACK, PACKAGE = "navigation", "map_server"


def stacks_and_packages() -> str:
    """Draw a distribution, a stack and a package, each with its contents."""
    height = HEAD + ROW * len(NAVIGATION) + 10
    columns = [Rect(i * (WIDTH + GAP), 0.0, WIDTH, height) for i in range(3)]
    first, second, third = columns
    parts = [
        named_box(first, "a distribution: Noetic", "group", 20.0),
        named_box(second, f"a stack: {STACK}", "topic", 20.0),
        named_box(third, f"a package: {PACKAGE}", "node", 20.0),
    ]
    step = (height - HEAD) / len(DISTRIBUTION)
    for i, name in enumerate(DISTRIBUTION):
        place = Rect(first.x + 16, HEAD + i * step + 4, WIDTH - 32, step - 12)
        parts.append(named_box(place, name, "topic" if name == STACK else "group"))
        if name == STACK:
            parts.append(straight((place.right, place.centre[1]), (second.x, place.centre[1])))
    for i, name in enumerate(NAVIGATION):
        y = HEAD + i * ROW
        if name == PACKAGE:
            place = Rect(second.x + 16, y - 1, WIDTH - 32, ROW + 2)
            parts += [named_box(place, name, "node"), straight((place.right, place.centre[1]), (third.x, y + ROW / 2))]
        else:
            parts.append(_line(name, second.x + WIDTH / 2, y + 14))
    wide = (height - HEAD) / len(MAP_SERVER)
    for i, (name, what) in enumerate(MAP_SERVER):
        x, y = third.x + WIDTH / 2, HEAD + i * wide + wide / 2
        parts += [_line(name, x, y - 2), _line(what, x, y + 14, is_small=True)]
    title = "A distribution, a stack and a package"
    alt = (
        f"Three columns. The distribution Noetic contains stacks: {', '.join(DISTRIBUTION)}. An arrow leads to the "
        f"stack {STACK} with its {len(NAVIGATION)} packages: {', '.join(NAVIGATION)}. An arrow leads to the package "
        f"{PACKAGE} with {', '.join(f'{name} ({what})' for name, what in MAP_SERVER)}."
    )
    return diagram(parts, Layout(third.right, height), title, alt)


def _line(words: str, x: float, y: float, *, is_small: bool = False) -> str:
    if is_small:
        return element("g", text(words, x, y, size=style.LABEL_SIZE, colour="label"), class_="ps-call")
    return element("g", text(words, x, y, kind="ps-name"))
