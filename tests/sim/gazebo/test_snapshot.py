"""Snapshots of a world: the models as a server or a client shows them."""

import math

import numpy as np
import pytest

from rosmini.sim.gazebo.snapshot import Snapshot
from rosmini.sim.gazebo.spawning import spawn_text
from rosmini.sim.sdf.poses import matrix
from rosmini.sim.urdf.xacro import expand

from .conftest import box, urdf

PAINTED = box(
    "crate",
    static=True,
    extra="""<link name="lid"><pose>0 0 0.4 0 0 0.3</pose>
  <visual name="v"><pose>0.1 0 0 0 0 0</pose><geometry><cylinder><radius>0.1</radius><length>0.02</length>
    </cylinder></geometry>
  <material><diffuse>1 0.5 0 1</diffuse></material></visual></link>""",
)


def turtlebot3(model):
    return expand(f"package://turtlebot3_description/urdf/turtlebot3_{model}.urdf.xacro")


def link(server, name):
    """A link as a client shows it."""
    model, _, own = name.partition("::")
    shown = next(each for each in server.client().snapshot().models if each.name == model)
    return next(each for each in shown.links if each.name == own)


def test_a_model_has_its_links_visuals_and_collisions(bench):
    there = bench()
    there.spawn(PAINTED, "thing", 1.0)
    lid = link(there.server, "thing::lid")
    assert lid.pose == pytest.approx((0, 0, 0.4, 0, 0, 0.3))
    (visual,) = lid.visuals
    assert visual.name == "v"
    assert visual.pose[:3] == pytest.approx((0.1, 0, 0))
    assert (visual.geometry.radius, visual.geometry.length) == (0.1, 0.02)
    assert visual.colour == "#ff8000"
    (collision,) = link(there.server, "thing::link").collisions
    assert collision.geometry.size[0] == 0.4


def test_a_client_sees_wheels_turn(bench):
    there = bench()
    there.spawn(urdf(), "robot")
    client = there.server.client()
    there.drive("cmd_vel", 0.1)
    there.graph.run(3.0)
    there.graph.run(0.0)
    left = next(each for each in client.snapshot().models[-1].links if each.name == "left")
    world = there.server.world
    truth = matrix(world.model("robot").link_in_model("left"))
    assert matrix(left.pose) == pytest.approx(truth, abs=0.02)  # the last pose is up to 1/60 s old
    start = matrix(world.model("robot").link_frame("left"))
    assert not np.allclose(truth[:3, :3], start[:3, :3], atol=0.1)
    now = next(each for each in there.server.snapshot().models[-1].links if each.name == "left")
    assert matrix(now.pose) == pytest.approx(truth, abs=1e-9)


def test_a_client_forgets_what_was_deleted(bench):
    there = bench()
    there.spawn(urdf(), "robot")
    client = there.server.client()
    there.graph.run(0.1)
    there.server.delete("robot")
    there.spawn(box(), "robot", 3.0)
    there.graph.run(0.0)
    (model,) = client.snapshot().models
    assert [each.name for each in model.links] == ["link"]
    assert model.pose == (3.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def test_a_client_knows_what_drives(bench):
    there = bench()
    there.spawn(urdf(axle=0.2), "robot", 1.0, 2.0, math.pi / 2)
    there.spawn(box(), "crate", -1.0)
    spawn_text(there.server.world, box("post", static=True), "post", (0, -2, 0, 0, 0, 0))
    seen = there.server.client().snapshot()
    (robot,) = seen.robots
    assert robot.name == "robot"
    assert robot.pose == pytest.approx((1.0, 2.2, math.pi / 2))
    assert robot.model.drive == "differential"
    assert robot.model.wheel_separation == 0.3
    assert robot.model.lidar is not None
    assert robot.model.lidar.beams == 181
    assert [model.name for model in seen.things] == ["crate"]
    assert [model.name for model in seen.standing] == ["post"]
    assert {each.name for each in seen.world(robots=False).obstacles} == {"crate", "post"}


def test_a_client_hears_when_time_stops_whoever_stops_it(bench):
    there = bench()
    client = there.server.client()
    there.graph.run(1.0)
    assert not client.snapshot().paused
    there.call("pause_physics", "std_srvs/Empty")
    there.graph.run(0.0)
    assert client.snapshot().paused
    assert client.snapshot().time == pytest.approx(there.server.world.now)
    there.server.world.step(500)
    there.graph.run(0.0)
    assert client.snapshot().time == pytest.approx(there.server.world.now)
    there.call("unpause_physics", "std_srvs/Empty")
    there.graph.run(0.0)
    assert not client.snapshot().paused


def test_server_and_client_show_the_same(bench):
    there = bench("-u")
    there.spawn(turtlebot3("burger"), "tb3", 0.5)
    client = there.server.client()
    seen = client.snapshot()
    assert seen.models == there.server.snapshot().models
    assert isinstance(client.snapshot(), Snapshot)
    assert client.show().text == there.server.show().text


def test_each_part_of_a_thing_has_its_own_colour(bench):
    def part(name, z, colour):
        shape = "<geometry><box><size>0.2 0.2 0.2</size></box></geometry>"
        return f"""<link name="{name}"><pose>0 0 {z} 0 0 0</pose><collision name="c">{shape}</collision>
          <visual name="v">{shape}<material><diffuse>{colour} 1</diffuse></material></visual></link>"""

    there = bench()
    tower = f'<sdf version="1.6"><model name="tower">{part("a", 0.1, "1 0 0")}{part("b", 0.3, "0 1 0")}</model></sdf>'
    there.spawn(tower, "tower")
    found = there.server.client().snapshot().world().obstacles
    assert [(each.colour, each.bottom, round(each.height, 6)) for each in found] == [
        ("#ff0000", 0.0, 0.2),
        ("#00ff00", pytest.approx(0.2), 0.4),
    ]
