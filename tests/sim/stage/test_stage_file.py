"""Stage's world files: what they may say, what it means, and what is told of those that are broken."""

import contextlib
import math
import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.polygons import inside
from rosmini.core.packages import PackageIndex
from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER
from rosmini.sim.shapes import Box, Compound, Polygon
from rosmini.sim.stage.errors import StageError
from rosmini.sim.stage.parse import parse
from rosmini.sim.stage.tokens import tokens
from rosmini.sim.stage.world_file import load
from rosmini.sim.stage.x11_colours import colour

PATH = Path("a.world")
WORLDS = sorted((PackageIndex().path("stage_ros") / "world").glob("*.world"))


def parsed(text):
    return parse(tokens(text, PATH), PATH)


@pytest.fixture
def world(tmp_path):
    def make(text, name="a.world"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text, encoding="utf-8")
        return load(path)

    return make


def robot(text):
    return f"position( ranger( sensor( {text} ) ) )"


# ---- the grammar ----


@given(st.text('ab1.-"#[]() \n', max_size=40))
def test_whatever_is_written_is_read_or_refused_with_its_line(text):
    with contextlib.suppress(StageError):
        parsed(text)
        return
    with pytest.raises(StageError, match=r"^a\.world:\d+: ") as caught:
        parsed(text)
    assert 1 <= caught.value.place.line <= text.count("\n") + 1


def test_a_definition_is_a_base_with_more():
    root = parsed(
        """define wheel model ( size [1 1 1] color "red" )
        define spare wheel ( color "black" block( points 3 ) )
        spare( color "blue" wheel( ) )"""
    ).root
    (spare,) = root.children
    assert (spare.kind, spare.title) == ("model", "spare")
    assert {name: p.values for name, p in spare.properties.items()} == {"size": (1, 1, 1), "color": ("blue",)}
    assert [child.kind for child in spare.children] == ["block", "model"]


def test_a_definition_may_be_used_before_its_base_is_defined_and_the_first_one_stays():
    found = parsed("define a b ( ) define b model ( size [1 1 1] ) define b position ( ) a( ) b( )")
    assert [child.kind for child in found.root.children] == ["model", "model"]
    assert "b is defined already" in found.notes[0][1]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("a (\n b 1", 1, "( after a has no )"),
        ("a 1 )", 1, "a name is missing before )"),
        ("\na", 2, "after a a value is missing"),
        ("a b", 1, "in double quotes"),
        ("a [1 2\n b", 2, "holds numbers and strings, not b"),
        ("m( a [1 2 )", 1, "the [ after a has no ]"),
        ('\n\nname "abc', 3, "has no end on its line"),
        ("size 1e-3", 1, "no exponents"),
        ("size {1}", 1, "nothing in a world file begins with {1}"),
        ("define a", 1, "after define come a name and what it is based on"),
        ("define a b size", 1, "a ( is missing"),
        ("define a b ( ) define b a ( )\na( )", 1, "a is defined by itself: a is a b is a a"),
        ("define a model ( a( ) )\na( )", 1, "a is defined by itself"),
    ],
)  # fmt: skip
def test_broken_files_name_their_line(text, line, words):
    with pytest.raises(StageError) as caught:
        parsed(text)
    assert str(caught.value).startswith(f"a.world:{line}: ")
    assert words in str(caught.value)


@pytest.mark.parametrize("name", ["passwd", "a.inc", "b.world"])
@pytest.mark.parametrize(
    "text",
    [
        "secret",
        "secret:x:0",
        "a secret:x",
        "a [1 secret]",
        "define secret",
        "define secret secret ( ) secret ( )",
        "secret ( )",
        'include "secret"',
        'model ( bitmap "secret" )',
        'position ( name "secret" size [1 1 1] ranger ( sensor ( samples 1000000000 ) ) )',
    ],
)
def test_errors_do_not_quote_a_file_that_is_included(text, name, tmp_path):
    (tmp_path / name).write_text(f"\n{text}\n", encoding="utf-8")
    world = tmp_path / "a.world"
    world.write_text(f'include "{name}"\n', encoding="utf-8")
    with pytest.raises(StageError, match=rf"{name}:2: ") as caught:
        load(world)
    assert "secret" not in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        'secret "secret"',
        "secret [1",
        "define secret model ( ) define secret model ( )",
        'color "secret"',
        'model ( name "secret" pose [0 0 -5 0] )',
        'model ( name "secret" bitmap "secret.png" )',
        'model ( color "secret" )',
        'position ( drive "secret" )',
        'model ( size "secret" )',
        'position ( name "secret" laser ( ) ranger ( ) mass -1 )',
    ],
)
def test_notes_do_not_quote_a_file_that_is_included(text, tmp_path):
    Image.new("L", (4, 4), 255).save(tmp_path / "secret.png")
    (tmp_path / "passwd").write_text(f"\n{text}\n", encoding="utf-8")
    world = tmp_path / "a.world"
    world.write_text('include "passwd"\n', encoding="utf-8")
    read = load(world)
    assert "secret" not in " ".join([*read.notes, *read.left_out])


# ---- including ----


def test_included_files_are_sought_beside_the_world_and_beside_the_file(tmp_path, world, monkeypatch):
    (tmp_path / "inc").mkdir()
    (tmp_path / "inc" / "a.inc").write_text('include "b.inc"\n', encoding="utf-8")
    (tmp_path / "inc" / "b.inc").write_text("\ndefine thing model ( size [1 2 3] colour 3 )\n", encoding="utf-8")
    stage = world('include "inc/a.inc"\nthing( name "t" )\n')
    assert stage.world.obstacles[0].shape == Box(1.0, 2.0)
    assert stage.notes[0].startswith(f"{tmp_path / 'inc' / 'b.inc'}:2: a property")
    assert "did you mean color" in stage.notes[0]
    (tmp_path / "far").mkdir()
    (tmp_path / "inc" / "a.inc").rename(tmp_path / "far" / "a.inc")
    (tmp_path / "inc" / "b.inc").rename(tmp_path / "far" / "b.inc")
    with pytest.raises(StageError, match=r'there is no file "inc/a.inc" to include'):
        world('include "inc/a.inc"\nthing( )\n')
    monkeypatch.setenv("STAGEPATH", str(tmp_path / "far"))
    assert len(world('include "inc/a.inc"\nthing( )\n').world.obstacles) == 1


# ---- models ----


def test_the_defaults_are_those_of_stage(world):
    stage = world("position( ) model( )")
    base = stage.robots[0]
    assert (base.drive, base.localization, base.localization_origin) == ("diff", "gps", (0, 0, 0))
    assert base.velocity_bounds == ((-1, 1), (-1, 1), (-math.pi / 2, math.pi / 2))
    assert base.odom_error == (None, None, None)
    assert base.name == "position:0"
    assert (stage.interval, stage.speedup, stage.paused, stage.quit_time) == (0.1, 1.0, False, 0.0)
    (thing,) = stage.world.obstacles
    assert (thing.name, thing.shape, thing.height, thing.bottom, thing.mass) == ("model:0", Box(0.4, 0.4), 1.0, 0.0,
        None)  # fmt: skip
    assert thing.colour == "#ff0000"


def test_units(world):
    stage = world('unit_length "cm" unit_angle "radians" model( size [100 50 20] pose [200 0 0 1.5] )')
    (thing,) = stage.world.obstacles
    assert (thing.shape, thing.pose, thing.height) == (Box(1.0, 0.5), (2.0, 0.0, 1.5), 0.2)


@given(
    st.floats(-5, 5), st.floats(-5, 5), st.floats(-180, 180), st.floats(-1, 1), st.floats(-1, 1), st.floats(-180, 180)
)
def test_a_body_is_about_its_origin_seen_from_its_pose(tmp_path_factory, x, y, a, ox, oy, oa):
    path = tmp_path_factory.mktemp("stage") / "a.world"
    path.write_text(
        f"model( pose [{x:.6f} {y:.6f} 0 {a:.6f}] origin [{ox:.6f} {oy:.6f} 0 {oa:.6f}] size [2 1 1] )",
        encoding="utf-8",
    )
    (thing,) = load(path).world.obstacles
    heading = math.radians(a)
    expected = complex(x, y) + complex(ox, oy) * complex(math.cos(heading), math.sin(heading))
    assert thing.pose[0] == pytest.approx(expected.real, abs=2e-6)
    assert thing.pose[1] == pytest.approx(expected.imag, abs=2e-6)
    assert thing.pose[2] == pytest.approx(math.radians(a + oa), abs=1e-6)


def test_children_stand_on_their_parents(world):
    stage = world(
        """model( name "table" size [1 1 0.7] pose [1 0 0 90] model( name "vase" size [0.1 0.1 0.2] pose [0.3 0 0 0] ) )
        model( stack_children 0 size [1 1 0.7] pose [5 0 0 0] model( name "drawer" size [0.1 0.1 0.2] ) )"""
    )
    by_name = {each.name: each for each in stage.world.obstacles}
    vase = by_name["vase"]
    assert (vase.bottom, vase.height) == pytest.approx((0.7, 0.9))
    assert vase.pose == pytest.approx((1.0, 0.3, math.pi / 2))
    assert by_name["drawer"].bottom == 0.0


def test_blocks_are_stretched_to_the_size_whatever_they_are_in(world):
    corner = (
        "points 6 point[0] [10 10] point[1] [30 10] point[2] [30 20] point[3] [20 20] point[4] [20 30] point[5] [10 30]"
    )
    (thing,) = world(f"model( size [2 4 1] block( {corner} z [0 3] ) )").world.obstacles
    assert isinstance(thing.shape, Polygon)
    assert thing.shape.corners == ((-1, -2), (1, -2), (1, 0), (0, 0), (0, 2), (-1, 2))
    assert (thing.bottom, thing.height) == (0, 1)
    # the other way round, and the same
    back = "points 4 point[0] [0 0] point[1] [0 1] point[2] [1 1] point[3] [1 0] z [0 1]"
    assert world(f"model( size [2 4 1] block( {back} ) )").world.obstacles[0].shape == Box(2.0, 4.0)


def test_what_can_be_pushed(world):
    two = (
        "block( points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] z [0 1] ) block( "
        "points 3 point[0] [1 0] point[1] [2 0] point[2] [1 1] z [0 2] )"
    )
    stage = world(
        f"""define crate model ( gripper_return 1 mass 3 pose [1 2 0 90] size [0.2 0.1 0.4] )
        crate( name "plain" ) crate( name "two" {two} ) crate( name "heap" model( size [0.1 0.1 0.1] ) )"""
    )
    plain, two_blocks, heap = stage.world.obstacles
    assert (plain.mass, plain.shape, plain.pose) == (3, Box(0.2, 0.1), (1, 2, math.pi / 2))
    assert isinstance(two_blocks.shape, Compound)
    assert len(two_blocks.shape.parts) == 2
    assert isinstance(heap.shape, Compound)
    assert heap.height == pytest.approx(0.5)


def test_a_robot_may_start_on_what_nothing_bumps_into(world):
    stage = world(
        'define zone model( size [4 4 0.01] obstacle_return 0 )\nzone( name "source" )\nposition( )\nactuator( )'
    )
    assert [(each.name, each.passable) for each in stage.world.obstacles] == [("source", True)]
    assert [":4: an actuator" in note for note in stage.notes] == [True]
    assert stage.left_out == {"an actuator": 1}


def test_what_nothing_notices_is_left_out_and_told(world):
    stage = world('model( name "ghost" obstacle_return 0 ranger_return -1 )\nmodel( name "glass" ranger_return -1 '
                  ')\nfiducial( )' )  # fmt: skip
    assert [(each.name, each.seen_by_lasers) for each in stage.world.obstacles] == [("glass", False)]
    fiducial, ghost = stage.notes
    assert ":3: a fiducial" in fiducial
    assert ":1: " in ghost and "ghost" in ghost
    assert stage.left_out["a fiducial"] == 1 and [*stage.left_out.values()] == [1, 1]


# ---- bitmaps ----


def floorplan(tmp_path, dark, **options):
    pixels = np.where(dark, options.get("black", 0), options.get("white", 255)).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / options.get("name", "plan.png"))


def test_a_floor_plan_becomes_walls(tmp_path, world):
    dark = np.zeros((40, 60), dtype=bool)
    dark[[0, -1], :] = dark[:, [0, -1]] = True  # a room
    dark[10:20, 30] = True  # with a wall in it, in the upper half of the picture
    floorplan(tmp_path, dark, black=127, white=128)
    stage = world('model( name "plan" bitmap "plan.png" size [6 4 0.8] pose [1 0 0 90] )')
    assert stage.world.obstacles == ()
    assert stage.world.bounds == pytest.approx((-1, -3, 3, 3))
    assert stage.world.wall_height == pytest.approx(0.8)
    # pixel (30, 10..20) is x from 0 to 0.1 and y from 0 to 1 in the plan's frame: turned by 90 degrees about (1, 0)
    walls = stage.world.walls
    assert inside(np.array([(0.5, 0.05), (0.5, 0.5), (1.5, 0.05)]), walls).tolist() == [True, False, False]
    assert stage.world.blocked((0.5, 0.05, 0.0), 0.1) is not None
    assert stage.notes == ()


def test_a_floor_plan_that_robots_pass_through_is_seen_by_lasers(tmp_path, world):
    dark = np.zeros((40, 40), dtype=bool)
    dark[[0, -1], :] = dark[:, [0, -1]] = True
    floorplan(tmp_path, dark)
    plan = 'model( bitmap "plan.png" size [4 4 1] obstacle_return 0 ranger_return 0.5 boundary 1 )'
    stage = world(f"{plan}\nmodel( pose [0 1 0 0] size [1 0.1 1] ranger_return -1 )")
    engine = Engine(stage.world, lambda name: np.random.default_rng(0), noise=0.0)
    engine.add("car", BURGER, (0.0, 0.0, 0.0))
    assert stage.world.blocked((-2.0, 0.0, 0.0), 0.1) is None
    ranges = engine.scan("car", lidar=replace(BURGER.lidar, beams=360))
    assert np.isfinite(ranges).all()
    assert ranges[90] == pytest.approx(1.9, abs=1e-6)  # the glass at y = 1 is not seen
    assert stage.world.blocked((0.0, 1.0, 0.0), 0.1) == "the obstacle 'model:1'"
    engine.command("car", -0.2, 0.0)
    engine.advance(12.0)
    assert engine.robots["car"].pose[0] < -2.1


def test_white_margins_are_not_counted(tmp_path, world):
    dark = np.zeros((40, 60), dtype=bool)
    dark[10:30, 20:50] = True
    floorplan(tmp_path, dark)
    stage = world('model( bitmap "plan.png" size [6 4 0.8] )')
    assert stage.world.bounds == pytest.approx((-3, -2, 3, 2))
    assert "of the bitmap's 60 x 40 pixels the 30 x 20" in stage.notes[0]


def test_a_boundary_is_a_frame(tmp_path, world):
    dark = np.zeros((40, 60), dtype=bool)
    dark[[0, 39], [0, 59]] = True
    floorplan(tmp_path, dark)
    stage = world('model( name "plan" bitmap "plan.png" size [6 4 0.8] boundary 1 )')
    assert [each.name for each in stage.world.obstacles] == ["plan", "plan (2)", "plan (3)", "plan (4)"]
    assert stage.world.bounds == pytest.approx((-3, -2, 3, 2))
    assert stage.world.blocked((2.99, 0.0, 0.0), 0.05) is not None


def test_a_second_bitmap_is_filled(tmp_path, world):
    ring = np.ones((20, 20), dtype=bool)
    ring[5:15, 5:15] = False
    floorplan(tmp_path, ring)
    stage = world('model( bitmap "plan.png" )\nmodel( name "ring" bitmap "plan.png" size [1 1 1] pose [5 0 0 0] )')
    (thing,) = stage.world.obstacles
    assert (thing.name, thing.shape, thing.pose[:2]) == ("ring", Box(1.0, 1.0), (5, 0))
    assert "1 hollow parts of ring are filled" in stage.notes[0]


# ---- robots and what they carry ----


def test_a_laser_looks_out_above_the_robot(world):
    stage = world(
        """define laser ranger ( sensor( range [0.1 30] fov 270 samples 1081 noise [0.01 0.02 0] ) )
        position( size [0.5 0.4 0.25] pose [1 2 0 90]
          laser( pose [0.05 0 0 0] ) laser( pose [-0.1 0.2 -0.1 180] ) )"""
    )
    (base,) = stage.robots
    assert base.pose == pytest.approx((1, 2, math.pi / 2))
    front, back = base.lasers
    assert front.pose == pytest.approx((0.05, 0, 0.25, 0))
    assert front.height == pytest.approx(0.26)  # over robots like itself
    assert (front.range_min, front.range_max, front.samples, front.noise) == (0.1, 30, 1081, (0.01, 0.02))
    assert front.fov == pytest.approx(math.radians(270))
    assert back.pose == pytest.approx((-0.1, 0.2, 0.15, math.pi))
    assert back.height == pytest.approx(0.16)


def test_cameras_are_left_out_and_of_a_ring_of_sonars_all_but_one(world):
    stage = world("position( camera( ) )\nposition( ranger( sensor( )\nsensor( ) ) )")
    assert stage.left_out == {"a camera": 1}
    sonar = stage.robots[1].lasers[0]
    assert (sonar.samples, sonar.fov, sonar.range_max) == (1, 0.1, 5)
    assert [re.search(r":(\d+):", note)[1] for note in stage.notes] == ["1", "3"]


def test_bounds_and_odometry(world):
    text = (
        'drive "omni" localization "odom" localization_origin [1 1 0 90] odom_error [0.1 0.2 '
        "0 0.3] velocity_bounds [-0.5 2 0 0 0 0 -45 45]"
    )
    (base,) = world(f"position( {text} )").robots
    assert (base.drive, base.localization) == ("omni", "odom")
    assert base.localization_origin == pytest.approx((1, 1, math.pi / 2))
    assert base.odom_error == pytest.approx((0.1, 0.2, math.radians(0.3)))
    assert base.velocity_bounds[0] == (-0.5, 2)
    assert base.velocity_bounds[2] == pytest.approx((-math.pi / 4, math.pi / 4))


# ---- what is wrong ----


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("modle( )", "there is no model 'modle' in Stage, and none is defined before it is used; did you mean model?"),
        (robot("samples 1000000000"), "samples is 1000000000; a ranger has 100000"),
        ('model( bitmap "nothing.png" )', 'there is no bitmap "nothing.png" in'),
        ('model( bitmap "text.png" )', "cannot be read: this is not an image"),
        ("interval_sim 0", "interval_sim is 0; it must be more than 0"),
        ("interval_sim []", "there is none in its brackets"),
    ],
)  # fmt: skip
def test_what_is_not_possible_names_file_and_line(tmp_path, world, text, words):
    (tmp_path / "text.png").write_text("no picture", encoding="utf-8")
    with pytest.raises(StageError) as caught:
        world("\n\n" + text)
    assert str(caught.value).startswith(f"{tmp_path / 'a.world'}:3: ")
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("position( position( ) )", "position:0.position:0 is on another one"),
        ("model( position( ) )", "model:0.position:0 is on a model"),
        ('position( drive "differential" )', '"diff" is used'),
        ("position( drive 3 )", '"diff" is used'),
        ('position( drive "car" )', '"diff" is used'),
        ('position( localization "amcl" )', '"gps" is used'),
        ("position( ranger( ) )", "the ranger position:0.ranger:0 has no sensor( ... )"),
        (robot("range [5 1]"), "a ranger measures from 5 m to 1 m; the first is taken for 0"),
        (robot("range [0 -2]"), "a ranger of 1 samples up to -2 m"),
        (robot("fov 400"), "fov is 400 degrees; 360 is used"),
        (robot("samples 0"), "a ranger of 0 samples"),
        (robot("samples 2.5"), "samples is 2.5; as in Stage it is cut to 2"),
        (robot("noise [-1]"), "noise is negative; 0 is used"),
        ("model( size [1 0 1] )", "1 0 1 becomes 1 0.01 1"),
        ("model( size [1 -2 1] )", "1 -2 1 becomes 1 2 1"),
        ("model( pose [1 2 3 4 5] )", "pose has 5 numbers; only the first 4 count"),
        ("model( pose 3 )", "pose has 1 of its 4 numbers"),
        ('model( pose ["a" 1 1 1] )', 'pose is "a", which Stage reads as the number 0'),
        ("model( pose [1.5.2 1 1 1] )", "Stage reads 1.5.2 as the number 1.5"),
        ('model( color "bleu" )', 'there is no colour "bleu" among those of X11, so it is red, as in Stage'),
        ("model( block( points 2 point[0] [0 0] point[1] [1 0] ) )", "a block needs 3 points or more, not 2"),
        ("model( block( points 3 point[0] [1 1] point[1] [1 0] ) )", "a block has no point[2]"),
        ("model( block( points 3 point[0] [0 0] point[1] [1 0] point[2] [2 0] ) )", "enclose nothing"),
        ("model( block( points 4 point[0] [0 0] point[1] [2 2] point[2] [2 0] point[3] [0 1] ) )",
         "the sides of a block meet"),
        ("model( gripper_return 1 mass 0 )", "10 kg are used"),
        ('model( bitmap "white.png" )', "nothing in the bitmap"),
        ('unit_length "inch"', 'unit_length is "inch"'),
        ('resolution "fine"', 'resolution is "fine", which Stage reads as the number 0'),
        ("quit_time [3 4]", "quit_time has 2 values; only the first counts"),
        ("name [ 1", "the [ after name has no ]"),
    ],
)  # fmt: skip
def test_what_stage_accepts_is_read_with_a_note(tmp_path, world, text, words):
    Image.new("L", (3, 3), 255).save(tmp_path / "white.png")
    notes = world("\n\n" + text).notes
    assert any(note.startswith(f"{tmp_path / 'a.world'}:3: ") and words in note for note in notes), notes


def test_numbers_and_strings_stand_for_each_other(world):
    stage = world('position( name 7 mass "3.5" pose ["1" 2 0 "90"] )\nmodel( obstacle_return "0" )')
    (base,) = stage.robots
    assert (base.name, base.mass, base.pose) == ("7", 3.5, (1.0, 2.0, math.pi / 2))
    assert stage.world.obstacles[0].passable
    assert stage.notes == ()


def test_a_bitmap_and_blocks_make_one_body(tmp_path, world):
    Image.fromarray(np.zeros((10, 10), dtype=np.uint8)).save(tmp_path / "plan.png")
    block = "block( points 4 point[0] [1 -0.5] point[1] [2 -0.5] point[2] [2 0.5] point[3] [1 0.5] )"
    stage = world(f'model( bitmap "plan.png" size [2 2 1] {block} )')
    assert stage.world.bounds == pytest.approx((-1, -1, 1, 1))
    assert stage.world.blocked((0.9, 0.0, 0.0), 0.01) is not None
    assert stage.world.blocked((0.9, 0.8, 0.0), 0.01) is None


# ---- colours, and our own worlds ----


def test_colours_are_those_of_x11():
    table = Path("/etc/X11/rgb.txt")
    names = [
        "red", "gray30", "grey100", "dark blue", "DarkSlateGray", "green", "purple", "gray", "maroon", "red3",
        "blue4", "light goldenrod",
    ]  # fmt: skip
    assert [colour(name) for name in names] == [
        "#ff0000", "#4c4c4c", "#ffffff", "#00008b", "#2f4f4f", "#00ff00", "#a020f0", "#bebebe", "#b03060", "#cd0000",
        "#00008b", "#eedd82",
    ]  # fmt: skip
    assert colour("no colour") is colour("gray101") is None
    if table.exists():
        wrong = []
        for line in table.read_text(encoding="utf-8").splitlines():
            if line.startswith("!"):
                continue
            r, g, b, name = line.split(None, 3)
            ours = colour(name)
            if ours is not None:
                theirs = [int(r), int(g), int(b)]
                off = max(abs(int(ours[1 + 2 * i : 3 + 2 * i], 16) - theirs[i]) for i in range(3))
                wrong += [name] if off > 1 and not name[-1].isdigit() else []
        assert wrong == []


@pytest.mark.parametrize("path", WORLDS, ids=lambda path: path.stem)
def test_our_own_worlds_say_nothing_odd(path):
    stage = load(path)
    assert stage.notes == ()
    assert stage.robots
    for each in stage.robots:
        assert stage.world.blocked(each.pose, 0.25) is None, each.name


# ---- what wants to break something ----


@pytest.mark.parametrize("name", ["~nobody_has_this_name/a", "a\0b", "x" * 5000, "~x", "/" * 5000, "."])
def test_no_name_of_a_file_breaks_more_than_its_world(tmp_path, name):
    with pytest.raises(StageError):
        load(name)
    path = tmp_path / "a.world"
    path.write_text(f'include "{name}"', encoding="utf-8")
    with pytest.raises(StageError, match=r"a.world:1: there is no file"):
        load(path)
    path.write_text(f'model( bitmap "{name}" )', encoding="utf-8")
    with pytest.raises(StageError, match=r"a.world:1: there is no bitmap"):
        load(path)


EXPLODING = "\n".join(f"define m{i} model ( {f'm{i - 1}( ) ' * 10} )" for i in range(1, 12))


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({"a.world": f"define m0 model ( )\n{EXPLODING}\nm11( )"}, "more than 100000 entities"),
        ({"a.world": "model( " * 5000 + ")" * 5000}, "nested more than 100 deep"),
        ({"a.world": 'include "b.inc"', "b.inc": '\ninclude "a.world"'}, r"b.inc:2: .*includes itself"),
        (
            {"a.world": 'include "0.inc"', "20.inc": ""}
            | {f"{i}.inc": 2 * f'include "{i + 1}.inc"\n' for i in range(20)},
            r"inc:1: the world includes more than 100 files",
        ),
        ({"a.world": 'model( bitmap "b.pgm" )', "b.pgm": "P5 100000 100000 255\n"}, r"a.world:1: .*too many pixels"),
        ({"a.world": "position()\nposition()\nposition()"}, r"a.world:3: there are more than 2 robots"),
        ({"a.world": 'model( bitmap "/dev/zero" )'}, "there is no bitmap"),
        ({}, r"a.world:1: there is no such file"),
    ],
)
def test_worlds_have_limits(tmp_path, monkeypatch, files, said):
    monkeypatch.setattr("rosmini.sim.stage.tokens.MAX_FILES", 100)
    monkeypatch.setattr("rosmini.sim.stage.world_file.MAX_ROBOTS", 2)
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(StageError, match=said):
        load(tmp_path / "a.world")


def test_a_package_that_does_not_exist_is_named():
    with pytest.raises(RosminiError, match="stage_rose"):
        load("package://stage_rose/world/willow-erratic.world")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are a matter of POSIX")
def test_what_is_no_file_is_not_opened(tmp_path):
    os.mkfifo(tmp_path / "pipe.world")
    (tmp_path / "a.world").write_text('include "pipe.world"', encoding="utf-8")
    for name, said in (("pipe.world", "this is no file"), ("a.world", "there is no file")):
        with pytest.raises(StageError, match=said):
            load(tmp_path / name)


def test_a_robot_outside_of_the_world_is_noted(tmp_path, world):
    Image.fromarray(np.pad(np.full((20, 20), 255, dtype=np.uint8), 1)).save(tmp_path / "plan.png")
    text = 'model( size [10 10 1] bitmap "plan.png" )\nposition( pose [50 0 0 0] name "r" )'
    assert "a.world:2: r starts outside: (50, 0)" in world(text).notes[0]
