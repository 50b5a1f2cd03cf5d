"""Robots in three dimensions as their URDF describes them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("meshcat")

from rosmini.sim.models import RobotModel, model
from rosmini.sim.recording import Recording
from rosmini.sim.shapes import Box, Cylinder, Part
from rosmini.sim.urdf import load
from rosmini.sim.urdf.errors import UnknownJoint
from rosmini.sim.worlds import world
from rosmini.viz.meshcat.drawing import DepthBuffer
from rosmini.viz.meshcat.runs import replay_3d
from rosmini.viz.meshcat.scene3d import OMITTED_COLOURS
from rosmini.viz.meshcat.urdf import urdf_3d
from rosmini.viz.meshcat.view import robot_3d
from rosmini.viz.view import ViewError

from ...conftest import nightly

URDF = "package://turtlebot3_description/urdf"
LAMP = """<robot name="lamp"><link name="foot">
<visual><geometry><cylinder radius="0.1" length="0.02"/></geometry>
<material name="red"><color rgba="1 0 0 1"/></material></visual>
<visual><geometry><box size="0.02 0.02 0.4"/></geometry><origin xyz="0 0 0.2"/></visual>
<collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="head"><visual><geometry><sphere radius="0.05"/></geometry>
<material name="y"><color rgba="1 1 0 1"/></material></visual></link>
<link name="nothing"/>
<joint name="neck" type="continuous">
<parent link="foot"/><child link="head"/><origin xyz="0 0 .4"/><axis xyz="0 1 0"/></joint>
<joint name="j" type="fixed"><parent link="foot"/><child link="nothing"/></joint></robot>"""


def turtlebot3(name):
    return load(f"package://turtlebot3_description/urdf/turtlebot3_{name}.urdf.xacro")


def test_any_robot():
    lamp = load(LAMP)
    view = urdf_3d(lamp, joints={"neck": 0.5}, title="A lamp")
    for part in ("A lamp\n", "0.200 x 0.200 x 0.460 m", "2 links to see of 3", "neck at 0.50"):
        assert part in view.text
    assert "foot, head; neck at 0.50." in view.alt
    assert {part.node.rpartition("/")[2] for part in view.scene.surfaces} == {"foot", "head"}
    assert {part.colour for part in view.scene.surfaces} == {"#ff0000", "#98a3ad", "#ffff00"}
    low = min(
        (part.surface.vertices @ view.scene.transform(part.node)[:3, :3].T + view.scene.transform(part.node)[:3, 3])[
            :, 2
        ].min()
        for part in view.scene.surfaces
    )
    assert low == pytest.approx(0, abs=2e-3)  # it stands on the ground
    assert view.html == urdf_3d(lamp, joints={"neck": 0.5}, title="A lamp").html


def test_shapes_that_touch_others():
    view = urdf_3d(load(LAMP), collisions=True)
    for part in ("collision", "lamp, 0.200 x 0.200 x 0.200 m", "1 link to see of 3"):
        assert part in view.text
    assert {part.colour for part in view.scene.surfaces} == {"#e69e00"}


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (
            lambda: urdf_3d(load('<robot name="r"><link name="a"/></robot>')),
            ViewError,
            "the robot 'r' has no visual shapes",
        ),
        (lambda: urdf_3d(load(LAMP), distance=0), ViewError, "above 0, not 0"),
        (lambda: urdf_3d(load(LAMP), joints={"nek": 1}), UnknownJoint, "did you mean neck?"),
        (
            lambda: urdf_3d(load(f"{URDF}/turtlebot3_burger.urdf.xacro", meshes=False)),
            ViewError,
            "load the robot with meshes=True",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_shown(make, error, message):
    with pytest.raises(error) as caught:
        make()
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("burger", "0.138 x 0.179 x 0.192"),
        *nightly(("waffle_pi", "0.282 x 0.307 x 0.142"), ("waffle", "0.270 x 0.307 x 0.142")),
    ],
)
def test_turtlebot3(name, size):
    view = turtlebot3(name).show3d()
    # e-manual: 138 x 178 x 192 mm, 281 x 306 x 141 mm
    assert f"turtlebot3_{name}, {size} m" in view.text
    assert view.svg.count("<path") > 100
    assert len(view.svg) < 100_000
    assert sum(map(len, view.scene.commands)) < 200_000


@pytest.mark.parametrize("name", ["waffle_pi", *nightly("waffle")])
def test_waffles_in_a_world_are_drawn_from_their_description(name):
    known = model(name)
    view = robot_3d(world("room"), known, (0.3, 0.2, 0.4), np.full(known.laser.beams, 0.6))
    scene = view.scene
    nodes = {part.node for part in scene.surfaces}
    assert {"robots/robot/base_link", "robots/robot/wheel_left/wheel_left_link", "robots/robot/base_scan"} <= nodes
    place = scene.transform("robots/robot/base_scan")
    c, s = math.cos(0.4), math.sin(0.4)
    assert place[:3, 3] == pytest.approx([0.3 - 0.064 * c, 0.2 - 0.064 * s, 0.132])
    # The wheel's own frame has its axle along z; it turns about the y of the node above it.
    hub = scene.transform("robots/robot/wheel_left")
    wheel = scene.transform("robots/robot/wheel_left/wheel_left_link")
    assert wheel[:3, 2] == pytest.approx(hub[:3, 1])
    assert wheel[:3, 3] == pytest.approx(hub[:3, 3], abs=1e-3)
    assert "<svg" in view.svg


def test_robots_of_which_only_outlines_are_known():
    cart = RobotModel(
        name="cart", mass=1.0, inertia=0.1, footprint=((-0.2, -0.1), (0.2, -0.1), (0.2, 0.1), (-0.2, 0.1)), height=0.3,
        drive="holonomic",
        parts=(
            Part(Box(0.4, 0.2), (0.0, 0.0, 0.0), 0.05, 0.2, "#336699"),
            Part(Cylinder(0.05), (0.1, 0.0, 0.0), 0.2, math.inf, "blue"),
        ),
    )  # fmt: skip
    view = robot_3d(world("room"), cart, (0.0, 0.0, 0.0))
    parts = [part for part in view.scene.parts if part.node == "robots/robot"]
    assert parts[0].colour == "#336699"
    assert parts[1].solids[0].length == pytest.approx(0.1)  # no higher than the robot
    assert "<svg" in view.svg


def square(x, y, size):
    return np.array([(x, y), (x + size, y), (x + size, y + size), (x, y + size)], dtype=float)


def painted(*faces):
    """The order of outlines, each with the depths of its first three vertices."""
    outlines = [np.array(outline, dtype=float) for outline, _ in faces]
    planes = [
        np.linalg.solve(np.column_stack([outline[:3], np.ones(3)]), 1 / np.broadcast_to(depths, 3))
        for outline, (_, depths) in zip(outlines, faces, strict=True)
    ]
    return DepthBuffer(outlines, np.array(planes), 100, 100)


@given(st.lists(st.tuples(*[st.integers(1, 39)] * 2, st.integers(2, 25), st.floats(1, 9)), min_size=1, max_size=8))
def test_painting_in_this_order_shows_what_is_nearest_everywhere(places):
    # No edge goes through the middle of a pixel.
    faces = [(square(x + 0.23, y + 0.31, size), round(depth, 3)) for x, y, size, depth in places]
    order = painted(*faces).order
    assert len(order) == len(set(order))
    shown = np.full((64, 64), np.inf)
    for i in order:
        own = cover(*faces[i])
        shown[np.isfinite(own)] = own[np.isfinite(own)]
    assert np.array_equal(shown, np.min([cover(*face) for face in faces], axis=0))


def cover(outline, depth):
    """The depth of a square at the pixels that it covers, elsewhere infinity."""
    x, y = np.meshgrid(np.arange(64) + 0.5, np.arange(64) + 0.5)
    (x0, y0), (x1, y1) = outline[0], outline[2]
    return np.where((x > x0) & (x < x1) & (y > y0) & (y < y1), depth, np.inf)


@pytest.mark.parametrize(("name", "turning"), [("waffle", 2), ("cart", 0)])
def test_runs_of_robots_with_wheels_and_without(name, turning):
    cart = RobotModel(
        name="cart", mass=1.0, inertia=0.1, footprint=((-0.2, -0.1), (0.2, -0.1), (0.2, 0.1)), height=0.3,
        drive="holonomic", lidar=model("burger").lidar,
    )  # fmt: skip
    known = model(name) if name != "cart" else cart
    times = np.linspace(0, 1, 11)
    truth = np.column_stack([times * 0.2, 0 * times, 0 * times])
    scans = np.zeros((0, 360))
    run = Recording(world("room"), known, times, truth, truth, np.zeros((0, 3)), np.zeros(0), scans)
    motions = replay_3d(run).scene.motions
    assert [motion.name for motion in motions].count("rotation[y]") == turning


def test_in_a_world_a_described_robot_is_drawn_without_its_holes():
    alone = urdf_3d(load("package://turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro")).scene.surfaces
    there = robot_3d(world("empty"), model("waffle"), (0.0, 0.0, 0.0)).scene.surfaces
    left_out = {part.colour for part in alone} - {part.colour for part in there}
    assert left_out == set(OMITTED_COLOURS)
    assert sum(len(part.surface.faces) for part in alone if part.colour in OMITTED_COLOURS) > 1000
    assert len(there) == len(alone) - 1
