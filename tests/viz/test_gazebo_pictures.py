"""Pictures of a running Gazebo world: robots from above, and visuals or collisions in three dimensions."""

import math
from functools import cache

import numpy as np
import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("meshcat")

from rosmini import Graph
from rosmini.sim.gazebo.server import GazeboServer
from rosmini.sim.gazebo.spawning import spawn_text
from rosmini.sim.urdf.xacro import expand

WALLS = """<sdf version="1.6"><world name="yard">
  <model name="ground"><static>1</static><link name="l">
    <collision name="c"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry></collision>
    <visual name="v"><geometry><plane>
      <normal>0 0 1</normal><size>100 100</size></plane></geometry></visual></link></model>
  <model name="wall"><static>1</static><pose>2 0 0.25 0 0 0</pose><link name="l">
    <collision name="c"><geometry><box><size>0.1 4 0.5</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>0.1 4 0.5</size></box></geometry></visual></link></model>
</world></sdf>"""
BALL = """<sdf version="1.6"><model name="lamp"><static>1</static><link name="l"><pose>0 0 0.5 0.3 0 0</pose>
  <collision name="c"><geometry><box><size>0.1 0.1 1</size></box></geometry></collision>
  <visual name="ball"><pose>0 0 0.4 0 0 0</pose><geometry><sphere><radius>0.1</radius></sphere></geometry>
    <material><diffuse>1 1 0 1</diffuse></material></visual>
  <visual name="pole"><geometry><cylinder><radius>0.02</radius><length>0.8</length></cylinder></geometry></visual>
  <visual name="foot"><pose>0 0 -0.5 0 0 0</pose><geometry>
    <polyline><point>-0.2 -0.2</point><point>-0.2 0.2</point><point>0.2 0</point>
    <height>0.1</height></polyline></geometry></visual></link></model></sdf>"""


@cache
def turtlebot3(model):
    return expand(f"package://turtlebot3_description/urdf/turtlebot3_{model}.urdf.xacro")


def add(server, model, name, pose=(0.0, 0.0, 0.0)):
    server.spawn(turtlebot3(model), name, pose, namespace=name)


@pytest.fixture
def server(tmp_path):
    path = tmp_path / "yard.world"
    path.write_text(WALLS, encoding="utf-8")
    with Graph() as graph:
        yield GazeboServer(graph.node("gazebo"), str(path), "-u")


def crate(name="crate", colour="0.5 0.3 0.1"):
    shape = "<geometry><box><size>0.3 0.3 0.3</size></box></geometry>"
    return f"""<sdf version="1.6"><model name="{name}"><link name="l"><pose>0 0 0.15 0 0 0</pose>
      <inertial><mass>2</mass><inertia><ixx>.03</ixx><iyy>.03</iyy><izz>.03</izz></inertia></inertial>
      <collision name="c">{shape}</collision>
      <visual name="v">{shape}<material><diffuse>{colour} 1</diffuse></material></visual></link></model></sdf>"""


def hexes(view):
    return {part.colour for part in [*view.scene.parts, *view.scene.surfaces]}


def test_from_above_what_drives_is_a_robot_and_what_does_not_is_a_thing(server):
    add(server, "burger", "tb3_0", (0.0, 1.0, 0.5 * math.pi))
    add(server, "waffle", "tb3_1", (0.0, -1.0, 0.0))
    server.spawn(crate(), "crate", (-1.0, 0.0, 0.0))
    picture = server.show()
    head, size, *lines = picture.text.splitlines()
    assert "yard: 0.00 s, paused" in head
    assert size.endswith("2 obstacles")  # the wall and the crate
    assert lines == [
        "tb3_0: pose (0.00, 1.00, 90.0 deg)",
        "tb3_1: pose (-0.06, -1.00, 0.0 deg)" if "-0.06" in lines[1] else "tb3_1: pose (0.00, -1.00, 0.0 deg)",
        "crate: pose (-1.00, 0.00, 0.0 deg)",
        "static: ground, wall",
    ]
    assert "The robot is at x 0.00 m, y 1.00 m, heading 90 degrees." in picture.alt
    drawn = picture._images()["image/svg+xml"].decode()
    assert "tb3_0" in drawn
    assert "tb3_1" in drawn


def test_a_turtlebot3_looks_as_its_meshes_do(server):
    add(server, "waffle", "tb3", (0.0, 1.0, 0.3))
    view = server.show3d(title="The yard")
    assert view.text.startswith("The yard\n")
    assert "3 models, at 0.00 s, paused\ntb3: pose (0.00, 1.00, 17.2 deg)\n" in view.text
    nodes = {part.node for part in view.scene.surfaces}
    assert "models/tb3/wheel_left_link" in nodes
    corners = np.vstack(
        [
            part.surface.vertices @ view.scene.transform(part.node)[:3, :3].T + view.scene.transform(part.node)[:3, 3]
            for part in view.scene.surfaces
        ]
    )
    low, high = corners.min(axis=0), corners.max(axis=0)
    assert low[2] == pytest.approx(0, abs=2e-3)
    assert high[2] == pytest.approx(0.141, abs=2e-3)  # e-manual
    assert np.allclose((low + high)[:2] / 2, (-0.06, 0.98), atol=0.06)
    assert len(hexes(view)) > 5


def test_a_wheel_that_has_turned_is_drawn_turned(server):
    add(server, "burger", "tb3")
    before = server.show3d().scene.transform("models/tb3/wheel_left_link")
    robot = server.engine.robot("tb3")
    server.engine.command("tb3", 0.1, 0.0)
    server.engine.advance(server.engine.now + 0.6)
    after = server.show3d().scene.transform("models/tb3/wheel_left_link")
    turned = robot.left_distance / 0.033
    assert turned > 1
    assert (np.trace(before[:3, :3].T @ after[:3, :3]) - 1) / 2 == pytest.approx(math.cos(turned), abs=1e-6)


def test_what_looks_other_than_it_is_solid_is_drawn_by_its_visuals(server):
    spawn_text(server.world, BALL, "lamp", (0.5, 0.5, 0.0, 0.0, 0.0, 1.0))
    view = server.show3d()
    parts = view.scene.surfaces
    assert {part.colour for part in parts} == {"#ffff00", "#98a3ad"}
    ball = next(part for part in parts if part.colour == "#ffff00").surface
    low, high = ball.bounds
    assert high - low == pytest.approx([0.2, 0.2, 0.2], abs=2e-3)
    assert (low + high) / 2 == pytest.approx([0.0, 0.0, 0.4], abs=1e-9)
    foot = next(part for part in parts if part.colour != "#ffff00").surface
    assert foot.bounds[0][2] == pytest.approx(-0.5)
    tilt = view.scene.transform("models/lamp/l")
    assert tilt[2, 2] == pytest.approx(math.cos(0.3))
    assert view.svg.count("<path") > 20
