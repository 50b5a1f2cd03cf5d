"""The picture of a world: what it says, and that it is the same whatever the last bit."""

import math
import re
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import BURGER
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, Walk, World
from rosmini.sim.worlds import world as built_in
from rosmini.viz import ViewError, style
from rosmini.viz.beams import beams_of
from rosmini.viz.world_drawing import MIN_ROBOT
from rosmini.viz.world_pictures import Scene

from ..processes import run

ROOT = Path(__file__).parents[2]
SVG = "{http://www.w3.org/2000/svg}"
WALLS = np.array([(0, 0, 4, 0), (4, 0, 4, 3), (4, 3, 0, 3), (0, 3, 0, 0)], dtype=float)
THINGS = (
    Obstacle("crate", Box(0.4, 0.2), (1.0, 2.0, 0.3), colour="orange", mass=1.0),
    Obstacle("pillar", Cylinder(0.15), (3.0, 1.0, 0.0), colour="green"),
    Obstacle("shelf", Polygon(((0.0, 0.0), (0.5, 0.0), (0.0, 0.5))), (0.0, 0.0, 0.0), colour="wall"),
)
ROOM = World("small", THINGS, walls=WALLS)


def world_picture(world, robot=None, scan=None, scan_from=None, trail=None, odom=None, title=None, size=(660, 540)):
    """Draw a world as the pictures of simulations and runs do."""
    scene = Scene(world)
    scene.robot, scene.trail, scene.odom = robot, trail, odom
    if scan is not None:
        scene.add_scan(beams_of(scan, BURGER.lidar), scan_from or robot, None)
    return scene.picture(title, size)


def ranges(world, pose, noise=0.0):
    """What the Burger's laser would see without noise, shifted by `noise`."""
    x, y, theta = pose
    mount = BURGER.lidar.mount[0]
    seen = raycast(
        world.segments, world.discs, x + mount * math.cos(theta), y + mount * math.sin(theta), theta,
        2 * math.pi / 360, 360, 3.5,
    )  # fmt: skip
    return seen + noise


def colours(svg):
    """How often each colour of the palette is painted with."""
    drawn = svg[svg.index("</style>") :]
    return {name: drawn.count(f'"{value}"') for name, value in style.LIGHT.items() if f'"{value}"' in drawn}


def test_a_world_says_how_large_it_is_and_what_is_in_it():
    view = world_picture(ROOM)
    for part in ("small: 4.00 x 3.00 m", "4 wall segments", "1 wall and 2 obstacles", "1 of them"):
        assert part in view.text
    assert view.alt.startswith("The world small from above: 4.00 by 3.00 m")
    assert "empty: 10.00 x 10.00 m" in world_picture(built_in("empty")).text
    assert {"orange", "green", "muted"} <= set(colours(view.svg))
    assert "blue" not in colours(view.svg)  # no robot


def test_things_of_every_shape_and_colour_are_drawn_and_those_that_move_said():
    things = (
        Obstacle("ball", Sphere(0.2), (1, 1, 0), colour="#123456"),
        Obstacle(
            "top", Compound(((Box(1, 0.5), (0, 0, 0)), (Cylinder(0.2), (0.5, 0, 0)))), (2, 2, 0), 0.8, "sky", bottom=0.7
        ),
        Obstacle("man", Cylinder(0.2), colour="purple", motion=Walk(((0.5, 0.5), (3.5, 0.5)))),
    )
    view = world_picture(World("varied", things, walls=WALLS))
    assert "3 obstacles (1 of them moves by itself)" in view.text
    assert {"sky", "purple"} <= set(colours(view.svg))
    assert '"#123456"' in view.svg
    dashed = [line for line in ET.fromstring(view.svg).iter(f"{SVG}path") if line.get("stroke-dasharray")]
    assert len(dashed) == 1, "the way of the man"
    alone = World("one", (things[2],))
    assert world_picture(alone).text.endswith("1 obstacle (moves by itself)")


def test_everything_is_in_the_text_the_alt_text_and_the_picture():
    pose = (2.0, 1.5, math.pi / 2)
    trail = np.array([(1.0, 0.5, 0.0), (2.0, 0.5, 0.0), (2.0, 1.5, 0.0)])
    odom = np.array([(1.0, 0.5), (2.0, 0.5), (2.03, 1.54)])
    view = world_picture(ROOM, robot=pose, scan=ranges(ROOM, pose), trail=trail, odom=odom, title="A look around")
    lines = view.text.splitlines()
    assert lines[0].startswith("A look around: 4.00 x 3.00 m")
    assert lines[1] == "burger: pose (2.00, 1.50, 90.0 deg)"
    # the pillar is (1, -0.5) away from the robot, and 0.15 thick; the laser is 3.2 cm behind the middle
    distance = math.hypot(1.0, -0.5 + 0.032) - 0.15
    assert "360 of 360 beams" in lines[2] and f"{distance:.2f} m behind on the right (-115 deg)" in lines[2]
    for said in ("heading 90 degrees", "360 of 360 laser beams"):
        assert said in view.alt
    assert "<figcaption>A look around</figcaption>" in view.html
    words = [node.text for node in ET.fromstring(view.svg).iter(f"{SVG}text")]
    assert {"x [m]", "y [m]", "where it was", "where odometry believes it was", "laser hits"} <= set(words)


def test_the_robot_is_drawn_to_scale_but_never_too_small_to_be_seen():
    def length(extent):
        world = World("plain", walls=np.array([(0, 0, extent, 0), (extent, extent, 0, extent)]))
        svg = world_picture(world, robot=(extent / 2, extent / 2, 0.0), size=(600, 600)).svg
        plate, *_ = re.findall(rf'd="([^"]+)"[^>]*fill="{style.LIGHT["blue"]}"', svg)
        return float(np.ptp([float(x) for x, _ in re.findall(r"[ML](\S+?) (\S+?)(?=[A-Za-z])", plate)]))

    footprint = np.ptp(np.array(BURGER.footprint)[:, 0])
    scale = (600 - 54) / (2 * 1.04)
    assert length(2.0) == pytest.approx(scale * footprint, rel=0.02)
    assert length(100.0) == pytest.approx(MIN_ROBOT, rel=0.05)


def test_a_scan_can_be_one_that_was_taken_elsewhere():
    before = (1.0, 1.0, 0.0)
    here = world_picture(ROOM, robot=(2.0, 1.5, 2.0), scan=ranges(ROOM, before), scan_from=before)
    there = world_picture(ROOM, robot=before, scan=ranges(ROOM, before))
    assert here.text.splitlines()[2] == there.text.splitlines()[2]
    (dots,) = re.findall(r'd="(M[^"]+h0)"', here.svg)
    assert dots in there.svg


def test_beams_that_hit_nothing_are_said_and_have_no_point():
    LaserScan = message_class("sensor_msgs/LaserScan")
    step = 2 * math.pi / 360
    message = LaserScan(angle_min=0.0, angle_max=359 * step, angle_increment=step, range_min=0.12, range_max=3.5)
    message.ranges = [math.inf, -math.inf, math.nan, 0.0, 3.6, 1.0] * 60
    view = world_picture(built_in("empty"), robot=(0, 0, 0), scan=message)
    assert "scan: 60 of 360 beams hit, nearest 1.00 m ahead (-1 deg)" in view.text
    assert view.svg.count("h0") == 60
    message.ranges = [math.inf] * 360
    text = world_picture(built_in("empty"), robot=(0, 0, 0), scan=message).text
    assert "scan: 0 of 360 beams hit, nothing within 3.50 m" in text


@pytest.mark.parametrize("walls", [[(0, 0, 50, 0)], [(3, 0, 3, 0.1)], [(1, 1, 1, 1)], [(0, 0, 1e4, 0)]])
def test_a_world_that_is_flat_or_tiny_or_huge_can_be_seen(walls):
    view = world_picture(World("w", walls=np.array(walls, dtype=float)), trail=np.zeros((1, 2)), odom=np.zeros((1, 2)))
    root = ET.fromstring(view.svg)
    assert 200 <= float(root.get("width")) <= 660
    assert 130 <= float(root.get("height")) <= 540
    words = [node for node in root.iter(f"{SVG}text") if node.text == "where odometry believes it was"]
    assert float(words[0].get("x")) + 200 < float(root.get("width"))


BLOCK = np.array([(1, 1, 2, 1), (2, 1, 2, 2), (2, 2, 1, 2), (1, 2, 1, 1)], dtype=float)
HOLE = np.array([(1.5, 1.2, 1.2, 1.5), (1.2, 1.5, 1.5, 1.8), (1.5, 1.8, 1.8, 1.5), (1.8, 1.5, 1.5, 1.2)])


def walls_of(walls, start=(0.0, 0.0, 0.0), *, solid=False):
    """The paths that walls are drawn with."""
    svg = world_picture(World("w", walls=np.array(walls, dtype=float), starts=(start,), solid=solid)).svg
    return [p for p in re.findall(r"<path[^>]*>", svg) if f'"{style.LIGHT["muted"]}"' in p]


def test_walls_that_go_round_something_solid_are_filled_and_others_are_not():
    (blocks,) = walls_of(np.vstack([BLOCK, HOLE]), solid=True)
    assert blocks.count("z") == 2
    assert f'fill="{style.LIGHT["muted"]}"' in blocks
    (room,) = walls_of(BLOCK)
    assert 'fill="none"' in room
    (single,) = walls_of([(0, 0, 1, 0)])
    assert 'fill="none"' in single


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"robot": (0, 0, 0), "scan": np.ones(100)}, "100 ranges were given, but the LDS-01 has 360 beams"),
        ({"robot": (0, 0, 0), "scan": np.ones((2, 360))}, r"array \(n,\), not \(2, 360\)"),
        ({"robot": (0, 0, 0), "scan": "scan"}, "not a str"),
        ({"size": (10, 10)}, "200 to 4000 pixels, not 10"),
    ],
)
def test_what_cannot_be_drawn_is_refused_with_a_reason(options, message):
    with pytest.raises(ViewError, match=message):
        world_picture(ROOM, **options)


def test_importing_viz_loads_neither_numpy_nor_matplotlib_and_names_are_there():
    code = (
        "import sys, rosmini.viz as v; assert {'byte_map', 'plot'} <= set(dir(v)); "
        "print(sorted({'matplotlib', 'numpy', 'IPython', 'sphinx'} & set(sys.modules))); v.plot; "
        "print(sorted({'matplotlib', 'numpy', 'pymunk', 'numba'} & set(sys.modules)))"
    )
    done = run([sys.executable, "-c", code], check=True, cwd=ROOT)
    assert done.stdout.splitlines() == ["[]", "[]"]


@pytest.mark.parametrize(
    ("colour", "edge"),
    [("#ffffff", "line"), ("#f0f0e0", "line"), ("#000000", "line"), ("#0066cc", None), ("blue", None)],
)
def test_what_is_as_light_or_dark_as_a_page_has_a_neutral_edge(colour, edge):
    made = World("w", (Obstacle("pillar", Cylinder(0.2), (0.0, 0.0, 0.0), colour=colour),))
    svg = world_picture(made)._repr_mimebundle_()[0]["image/svg+xml"]
    (pillar,) = (each for each in ET.fromstring(svg).iter(f"{SVG}path") if each.get("fill-opacity"))
    assert pillar.get("stroke") == style.LIGHT.get(edge or colour, colour)
