"""SDF made into flat worlds, and flat worlds written as SDF."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assets.generate.worlds.sdf_writer import to_sdf
from rosmini.sim.sdf import SdfError, converted, load, to_obstacles
from rosmini.sim.sdf.convert import to_world
from rosmini.sim.sdf.material_colours import HOUSE
from rosmini.sim.world import Box, Compound, Cylinder, Door, Obstacle, Polygon, Sphere, Walk, World
from rosmini.viz.style import LIGHT


def geometry(inside, pose="0 0 0 0 0 0", name="c"):
    return f"<collision name='{name}'><pose>{pose}</pose><geometry>{inside}</geometry></collision>"


BOX = "<box><size>2 1 0.5</size></box>"


def model(collisions, *, name="m", pose="0 0 0 0 0 0", static=True, more=""):
    return (
        f"<model name='{name}'><static>{str(static).lower()}</static><pose>{pose}</pose>"
        f"<link name='l'>{collisions}</link>{more}</model>"
    )


def flat(*models):
    (world,) = load(f"<sdf version='1.7'><world name='w'>{''.join(models)}</world></sdf>").worlds
    return converted(world)


def obstacles(*models):
    return flat(*models)[0].obstacles


# ---- static things ----


def test_what_stands_upright_is_as_it_is():
    (box,) = obstacles(model(geometry(BOX), pose="1 2 0.25 0 0 0.7"))
    assert box == Obstacle("m", Box(2, 1), (1, 2, 0.7), 0.5)
    (pillar,) = obstacles(model(geometry("<cylinder><radius>0.3</radius><length>2</length></cylinder>", "0 0 1 0 0 0")))
    assert (pillar.shape, pillar.bottom, pillar.height) == (Cylinder(0.3), 0, 2)
    (lamp,) = obstacles(model(geometry("<sphere><radius>0.2</radius></sphere>", "0 1 2 0 0 0")))
    assert (lamp.shape, lamp.pose, lamp.height) == (Sphere(0.2), (0, 1, 0), pytest.approx(2.2))
    assert lamp.bottom == pytest.approx(1.8)


def test_poses_of_model_link_and_collision_add_up():
    text = (
        "<model name='m'><static>1</static><pose>1 0 0 0 0 1.5707963267948966</pose><link name='l'><pose>1 0 0 0 0 "
        f"0</pose>{geometry(BOX, '1 0 0.5 0 0 0.5')}</link></model>"
    )
    (box,) = obstacles(text)
    assert box.pose == pytest.approx((1, 2, math.pi / 2 + 0.5))
    assert (box.bottom, box.height) == (0.25, 0.75)


@given(st.floats(-1.2, 1.2), st.floats(-1.2, 1.2), st.floats(-3, 3))
def test_what_stands_aslant_is_its_shadow(roll, pitch, yaw):
    (box,) = obstacles(model(geometry(BOX), pose=f"0 0 5 {roll} {pitch} {yaw}"))
    # The extent along any direction of a box is the sum of what its sides have of it.
    x = (math.cos(pitch) * 2, abs(math.sin(pitch) * math.sin(roll)) * 1, abs(math.sin(pitch) * math.cos(roll)) * 0.5)
    y = (0.0, math.cos(roll) * 1, abs(math.sin(roll)) * 0.5)
    z = (abs(math.sin(pitch)) * 2, abs(math.cos(pitch) * math.sin(roll)), math.cos(pitch) * math.cos(roll) * 0.5)
    turned = box.outline() @ [[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]]
    assert np.ptp(turned, axis=0) == pytest.approx((sum(x), sum(y)), abs=1e-5)
    assert box.height - box.bottom == pytest.approx(sum(z), abs=1e-5)


def test_what_is_tilted_is_noted_and_what_lies_on_a_side_of_it_is_exact():
    world, notes = flat(
        model(geometry(BOX), name="a", pose="0 0 1 0.3 0 0"),
        model(geometry(BOX), name="b", pose="5 0 1 1.5707963267948966 0 0"),
        model(
            geometry("<cylinder><radius>0.3</radius><length>2</length></cylinder>"),
            name="c",
            pose="9 0 1 0 1.5707963267948966 0",
        ),
    )
    assert [("'a' is tilted" in note.text, "'c' lies on its side" in note.text) for note in notes] == [
        (True, False),
        (False, True),
    ]
    _, lying, roll = world.obstacles
    assert np.ptp(lying.outline(), axis=0) == pytest.approx((2, 0.5))
    assert (lying.bottom, lying.height) == pytest.approx((0.5, 1.5))
    assert np.ptp(roll.outline(), axis=0) == pytest.approx((2, 0.6))
    assert (roll.bottom, roll.height) == pytest.approx((0.7, 1.3))


def test_a_static_model_is_an_obstacle_for_each_part_with_colours_of_its_visuals():
    collisions = geometry(BOX, "0 0 1 0 0 0", "top") + geometry(BOX, "3 0 0.25 0 0 0", "foot")
    visual = (
        f"<visual name='top'><geometry>{BOX}</geometry><material><diffuse>0 0.447 0.698 1</diffuse></material></visual>"
    )
    foot = (
        f"<visual name='foot'><geometry>{BOX}</geometry><material><diffuse>0.2 0.4 0.6 1</diffuse></material></visual>"
    )
    found = obstacles(model(collisions + visual + foot, name="table"))
    assert [(each.name, each.bottom, each.colour) for each in found] == [
        ("table::top", 0.75, "blue"),
        ("table::foot", 0, "#336699"),
    ]


def test_the_colours_of_the_house_are_those_of_the_pictures():
    assert {name: colour for colour, name in HOUSE.items() if name not in ("wall", "grey")} == {
        name: LIGHT[name] for name in ("blue", "orange", "green", "vermilion", "purple", "sky")
    }


def test_the_ground_is_no_obstacle_and_neither_is_what_is_under_it_or_flat_on_it():
    plane = geometry("<plane><normal>0 0 1</normal></plane>")
    slope = geometry("<plane><normal>0 1 1</normal></plane>", name="slope")
    world, notes = flat(
        model(plane + slope, name="ground"),
        model(geometry(BOX), name="cellar", pose="0 0 -1 0 0 0"),
        model(geometry("<box><size>1 1 0.01</size></box>"), name="carpet"),
        model(geometry(BOX), name="half", pose="0 0 0.1 0 0 0"),
    )
    assert [(each.name, each.bottom, each.height) for each in world.obstacles] == [("half", 0, pytest.approx(0.35))]
    ground, carpet = (note.text for note in notes)
    assert "'ground'" in ground
    assert "'carpet' is 5 mm high" in carpet


def test_polylines_are_polygons_and_rings_of_them_are_hollow():
    def square(r):
        return "".join(f"<point>{x} {y}</point>" for x, y in ((-r, -r), (-r, r), (r, r), (r, -r)))

    (block,) = obstacles(model(geometry(f"<polyline>{square(1)}<height>0.4</height></polyline>", "0 0 0.2 0 0 0")))
    assert isinstance(block.shape, Polygon)
    assert (block.bottom, block.height) == pytest.approx((0.2, 0.6))
    fence = World(
        "fence",
        obstacles(
            model(geometry(f"<polyline>{square(2)}<height>1</height></polyline><polyline>{square(1.9)}</polyline>"))
        ),
    )
    for x, y in ((0, 0), (1.8, 1.8), (-1.85, 0.3), (2.1, 0)):
        assert fence.blocked((x, y, 0), 0.01) is None
    for angle in np.linspace(0, 6, 30):
        r = 1.95 / max(abs(math.cos(angle)), abs(math.sin(angle)))
        assert fence.blocked((r * math.cos(angle), r * math.sin(angle), 0), 0.01) is not None


# ---- movable things, doors and people ----


def test_a_model_that_is_not_static_is_one_thing_with_the_mass_of_its_links():
    link = "<link name='k'><pose>0 1 0 0 0 0</pose><inertial><mass>2</mass></inertial>" + geometry(BOX) + "</link>"
    wheel = "<joint name='j' type='revolute'><parent>l</parent><child>k</child></joint>"
    world, notes = flat(model(geometry(BOX), pose="1 1 0.25 0 0 1", static=False, more=link + wheel))
    (thing,) = world.obstacles
    assert (thing.name, thing.mass, thing.pose) == ("m", 3, (1, 1, 1))
    assert thing.shape == Compound(((Box(2, 1), (0, 0, 0)), (Box(2, 1), (0, 1, 0))))
    assert ["joints of the model 'm'" in note.text for note in notes] == [True]
    (ball,) = obstacles(model(geometry("<sphere><radius>0.1</radius></sphere>"), pose="3 1 0.1 0 0 1", static=False))
    assert ball == Obstacle("m", Sphere(0.1), (3, 1, 1), mass=1)


def test_a_model_can_be_put_elsewhere():
    (found,) = load(f"<sdf version='1.7'>{model(geometry(BOX), pose='0 0 0.25 0 0 0')}</sdf>").models
    assert to_obstacles(found, (3, 4, 0.5))[0] == Obstacle("m", Box(2, 1), (3, 4, 0.5), 0.5)
    assert to_obstacles(found, (3, 4, 1.25, 0, 0, 0.5))[0].bottom == 1
    assert to_obstacles(found)[0].pose == (0, 0, 0)


def test_a_model_without_anything_solid_is_left_out():
    world, notes = flat("<model name='ghost'><link name='l'/></model>")
    assert world.obstacles == ()
    assert "nothing solid" in notes[0].text


def door(joint, plugin):
    more = (
        f"<joint name='h' type='{joint}'><pose>-1 0 0 0 0 0</pose><parent>world</parent><child>l</child><axis><xyz>0 "
        f"1 0</xyz></axis></joint><plugin name='d' filename='librosmini_door.so'>{plugin}</plugin>"
    )
    return model(geometry(BOX), pose="0 0 0.25 0 0 0", static=False, more=more)


def test_doors_turn_about_their_hinges_or_slide():
    (turning,) = obstacles(door("revolute", "<opening>1</opening><open>3</open>"))
    assert turning.motion == Door(1, hinge=(-1, 0), open=3)
    assert turning.mass is None
    (sliding,) = obstacles(door("prismatic", "<opening>0.9</opening>"))
    assert sliding.motion == Door(0.9, slide=math.pi / 2)
    for joint, plugin, part in (
        ("revolute", "<oping>1</oping>", "did you mean opening"),
        ("fixed", "", "hangs in a joint"),
        ("revolute", "<moving>0</moving>", "moving of a door"),
    ):
        with pytest.raises(SdfError, match=part):
            obstacles(door(joint, plugin))


def actor(times, *, loop=True):
    points = "".join(f"<waypoint><time>{t}</time><pose>{x} {y} 1 0 0 0</pose></waypoint>" for t, x, y in times)
    return (
        f"<actor name='a'><script><loop>{str(loop).lower()}</loop>"
        f"<trajectory id='0' type='w'>{points}</trajectory></script></actor>"
    )


def test_actors_walk():
    (man,) = obstacles(actor([(0, 0, 0), (4, 2, 0), (5, 2, 0), (9, 2, 2)], loop=False))
    assert man.motion == Walk(((0, 0), (2, 0), (2, 2)), 0.5, 0.5, loop=False)
    assert man.shape == Cylinder(0.2)
    (still,) = obstacles(actor([(0, 1, 2)]))
    assert still.motion is None
    assert still.pose[:2] == (1, 2)


# ---- where robots start ----


def test_robots_start_at_frames_of_that_name():
    world, _ = flat(
        "<frame name='start_1'><pose>1 2 0 0 0 3</pose></frame><frame name='other'/><frame name='Start 2'/>"
    )
    assert world.starts == ((1, 2, 3), (0, 0, 0))
    assert flat()[0].starts == ((0, 0, 0),)


# ---- there and back ----

HEXAGON = Polygon(tuple((math.cos(i * math.pi / 3), math.sin(i * math.pi / 3)) for i in range(6)))
HALL = World(
    "hall",
    (
        Obstacle("shelf", HEXAGON, (1.0, -2.0, 0.7), 1.5, "#12ab34", bottom=0.25),
        Obstacle("ball", Sphere(0.2), (3.0, 0.0, -1.0), 0.4, "blue"),
        Obstacle("cart", Compound(((Box(0.3, 0.5), (0.1, 0.2, 0.3)), (HEXAGON, (2.0, 0.0, 1.0)))), (5.0, 5.0, 2.0), 0.6,
            "orange", 2.5, drag=0.3, restitution=0.5),
        Obstacle("leaf", Box(1.0, 0.05), (-3.0, 1.0, 0.5), 2.0, "sky", motion=Door(0.9, (0.5, 0.0), None, 1.5, 4, 3)),
        Obstacle("gate", Box(1.0, 0.05), (-6.0, 1.0, 0.5), 2.0, "sky",
            motion=Door(0.9, slide=1.5, moving=1.5, open=4, closed=3, phase=0.5)),
        Obstacle("man", Cylinder(0.2), (8.0, 0.0, 0.0), 1.75, "purple",
            motion=Walk(((8, 0), (9, 0), (9, 2)), speed=0.5, wait=2.0, loop=False)),
    ),
    starts=((0.5, 0.5, 1.0), (7.0, 7.0, 0.0)),
)  # fmt: skip


def test_a_world_that_is_written_is_read_as_it_was():
    after = to_world(load(to_sdf(HALL)).worlds[0])
    assert np.array(after.starts) == pytest.approx(np.array(HALL.starts))
    by_name = {each.name: each for each in after.obstacles}
    assert by_name.keys() == {each.name for each in HALL.obstacles}
    for old in HALL.obstacles:
        new = by_name[old.name]
        assert (new.colour, new.mass, new.drag, new.restitution) == (old.colour, old.mass, old.drag, old.restitution)
        assert (new.bottom, new.height, *new.pose) == pytest.approx((old.bottom, old.height, *old.pose), abs=1e-5)
        for (shape, pose), (other, place) in zip(old.parts(), new.parts(), strict=True):
            assert type(other) is type(shape)
            assert place == pytest.approx(pose, abs=1e-5)
            if isinstance(shape, (Box, Polygon)):
                assert other.outline == pytest.approx(shape.outline, abs=1e-5)
            else:
                assert other.radius == pytest.approx(shape.radius)
        for t in (0.0, 2.0, 3.7, 9.0):
            assert new.at(t) == pytest.approx(old.at(t), abs=1e-4)


def test_thin_walls_are_written_as_boxes():
    after = to_world(load(to_sdf(World("w", walls=[(0, 0, 2, 0), (2, 0, 2, 1)]))).worlds[0])
    assert [each.name for each in after.obstacles] == ["walls::1", "walls::2"]
    assert after.bounds == pytest.approx((0, -0.01, 2.01, 1))


@pytest.mark.nightly
def test_a_world_of_100_000_sides_is_read():
    """In about 3 s; with work for each pair of sides it would be ended by pytest's time limit."""
    many = "".join(
        f"<model name='m{i}'><static>1</static><pose>{i % 160 * 2} {i // 160 * 2} 0.25 0 0 {i}</pose><link "
        f"name='l'>{geometry(BOX)}</link></model>\n"
        for i in range(25_000)
    )
    world, _ = flat(many)
    assert world.segments.shape == (100_000, 4)
