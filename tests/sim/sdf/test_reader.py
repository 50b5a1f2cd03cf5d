"""SDF as plain data: what is read, where it is, and what is said about files that are broken."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import RosminiError
from rosmini.sim.sdf import SdfError, load
from rosmini.sim.sdf.poses import compose, from_quaternion, inverse, matrix, pose6, upright

BOX = "<geometry><box><size>1 2 3</size></box></geometry>"


def world(inside):
    return f"<sdf version='1.7'>\n<world name='w'>\n{inside}\n</world>\n</sdf>"


def model(inside, name="m"):
    return f"<sdf version='1.7'>\n<model name='{name}'>\n{inside}\n</model>\n</sdf>"


# ---- poses ----

numbers = st.floats(-20, 20)
angles = st.floats(-math.pi, math.pi)
poses = st.tuples(numbers, numbers, numbers, angles, angles, angles)


@given(poses, poses)
def test_composing_poses_is_multiplying_their_matrices(a, b):
    assert matrix(compose(a, b)) == pytest.approx(matrix(a) @ matrix(b), abs=1e-9)


@given(poses)
def test_a_pose_and_its_inverse_are_none(pose):
    assert matrix(compose(pose, inverse(pose))) == pytest.approx(np.eye(4), abs=1e-6)
    assert matrix(pose6(matrix(pose))) == pytest.approx(matrix(pose), abs=1e-6)


def test_angles_turn_about_fixed_axes_roll_first():
    # A quarter of a turn about x takes y up; one about z after that leaves it up.
    assert matrix((0, 0, 0, math.pi / 2, 0, math.pi / 2))[:3, :3] @ [0, 1, 0] == pytest.approx([0, 0, 1])
    assert matrix((0, 0, 0, 0, math.pi / 2, 0))[:3, :3] @ [1, 0, 0] == pytest.approx([0, 0, -1])
    assert not upright((0, 0, 0, 0.01, 0, 0))
    assert not upright((0, 0, 0, math.pi, 0, 0))
    assert from_quaternion(0, 0, 2 * math.sin(0.3), 2 * math.cos(0.3)) == pytest.approx((0, 0, 0.6))


# ---- what is read ----


def test_a_world_is_read_with_all_its_parts():
    found = load(
        world(
            """
            <physics type='ode'><max_step_size>0.002</max_step_size><real_time_factor>2</real_time_factor>
              <real_time_update_rate>0</real_time_update_rate><ode/></physics>
            <gravity>0 0 -1.62</gravity>
            <plugin name='p' filename='libp.so'><a>1</a></plugin>
            <frame name='start_1'><pose>1 2 0 0 0 3</pose></frame>
            <model name='cart'>
              <pose>1 2 0 0 0 0.5</pose>
              <link name='base'>
                <pose>0 0 0.1 0 0 0</pose>
                <inertial><mass>3</mass><inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.3</izz></inertia></inertial>
                <collision name='c'><geometry><cylinder><radius>0.2</radius><length>0.4</length></cylinder></geometry>
                  <surface><friction><ode><mu>0.7</mu></ode></friction></surface></collision>
                <visual name='v'><geometry><sphere><radius>0.2</radius></sphere></geometry>
                  <material><script><name>Gazebo/Red</name></script></material></visual>
                <sensor name='eye' type='ray'><pose>0.1 0 0 0 0 0</pose><update_rate>5</update_rate>
                  <ray><scan/></ray><plugin name='q' filename='libq.so'/></sensor>
              </link>
              <link name='wheel'><pose>0 0.3 0 0 0 0</pose></link>
              <joint name='axle' type='revolute'><parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz>
                </axis></joint>
              <plugin name='drive' filename='libdrive.so'/>
            </model>
            <actor name='man'><script><loop>false</loop><delay_start>2</delay_start><trajectory id='0' type='walk'>
              <waypoint><time>4</time><pose>2 0 1 0 0 0</pose></waypoint>
              <waypoint><time>0</time><pose>0 0 1 0 0 0</pose></waypoint></trajectory></script></actor>
            """
        )
    )
    (made,) = found.worlds
    assert found.version == "1.7"
    assert (made.physics.max_step_size, made.physics.real_time_factor, made.physics.real_time_update_rate) == (
        0.002,
        2,
        0,
    )
    assert made.gravity == (0, 0, -1.62)
    assert made.plugins[0].filename == "libp.so"
    assert made.plugins[0].element.word("a") == "1"
    assert made.frames == (("start_1", (1, 2, 0, 0, 0, 3)),)
    (cart,) = made.models
    assert cart.pose == (1, 2, 0, 0, 0, 0.5)
    assert not cart.static
    base, wheel = cart.links
    assert base.inertial.mass == 3
    assert base.inertial.inertia == (0.1, 0.2, 0.3, 0, 0, 0)
    assert (base.collisions[0].geometry.radius, base.collisions[0].geometry.length) == (0.2, 0.4)
    assert base.collisions[0].friction == 0.7
    assert base.visuals[0].colour == "#ff0000"
    eye = base.sensors[0]
    assert (eye.type, eye.update_rate, eye.pose[0], eye.plugins[0].filename) == ("ray", 5, 0.1, "libq.so")
    assert eye.element.find("ray/scan") is not None
    assert wheel.pose == (0, 0.3, 0, 0, 0, 0)
    joint = cart.joints[0]
    assert (joint.name, joint.type, joint.parent, joint.child, joint.axis) == (
        "axle",
        "revolute",
        "base",
        "wheel",
        (0, 1, 0),
    )
    assert cart.plugins[0].name == "drive"
    (man,) = made.actors
    assert [moment for moment, _ in man.waypoints] == [0, 4]
    assert (man.loop, man.delay) == (False, 2)
    assert found.notes == ()


def test_poses_are_resolved_through_the_frames_they_name():
    (made,) = load(
        model(
            """
            <frame name='mast' attached_to='base'><pose>0 0 1 0 0 1.5707963267948966</pose></frame>
            <link name='base'><pose>1 0 0 0 0 0</pose></link>
            <link name='head'><pose relative_to='mast'>0.5 0 0 0 0 0</pose>
              <collision name='c'><pose relative_to='base'>0 0 0.2 0 0 0</pose>BOX</collision></link>
            <link name='hand'><pose relative_to='neck'>0 0 0.1 0 0 0</pose></link>
            <joint name='neck' type='fixed'><pose>0 0.1 0 0 0 0</pose><parent>base</parent><child>head</child></joint>
            <model name='inner'><pose relative_to='head'>0 0 0.5 0 0 0</pose><link name='l'>
              <pose>0 0 0.25 0 0 0</pose></link></model>
            <link name='cap'><pose relative_to='inner::l'>0 0 1 0 0 0</pose></link>
            """.replace("BOX", BOX)
        )
    ).models
    links = {link.name: link for link in made.links}
    # The mast stands 1 m above the base and looks along y.
    assert links["head"].pose[:3] == pytest.approx((1, 0.5, 1))
    assert links["hand"].pose[:3] == pytest.approx((0.9, 0.5, 1.1))
    assert made.models[0].pose[:3] == pytest.approx((1, 0.5, 1.5))
    assert links["cap"].pose[:3] == pytest.approx((1, 0.5, 2.75))
    seen = compose(links["head"].pose, links["head"].collisions[0].pose)
    assert seen[:3] == pytest.approx((1, 0, 0.2))


def test_angles_may_be_degrees_or_a_quaternion():
    (made,) = load(
        model(
            "<link name='a'><pose degrees='true'>0 0 0 0 0 90</pose></link>"
            "<link name='b'><pose rotation_format='quat_xyzw'>1 2 3 0 0 1 1</pose></link>"
        )
    ).models
    assert made.links[0].pose[5] == pytest.approx(math.pi / 2)
    assert made.links[1].pose == pytest.approx((1, 2, 3, 0, 0, math.pi / 2))


def test_the_state_of_a_saved_world_counts_more_than_where_its_models_began():
    (made,) = load(
        world(
            "<model name='a'><link name='l'/></model><state world_name='w'><model name='a'>"
            "<pose>1 2 0 0 0 1</pose></model></state>"
        )
    ).worlds
    assert made.models[0].pose == (1, 2, 0, 0, 0, 1)


# ---- includes ----


@pytest.fixture
def brick(tmp_path, monkeypatch):
    folder = tmp_path / "models" / "brick"
    folder.mkdir(parents=True)
    (folder / "model.config").write_text(
        "<model><name>b</name><sdf version='1.4'>old.sdf</sdf><sdf version='1.10'>new.sdf</sdf></model>",
        encoding="utf-8",
    )
    (folder / "new.sdf").write_text(
        model(f"<pose>0 0 1 0 0 0</pose><link name='l'><collision name='c'>{BOX}</collision></link>", "brick"),
        encoding="utf-8",
    )
    monkeypatch.setenv("GAZEBO_MODEL_PATH", f"{tmp_path / 'nowhere'}:{tmp_path / 'models'}")
    return folder


def test_models_are_included_from_the_model_path(brick):
    (made,) = load(
        world(
            "<include><uri>model://brick</uri></include>"
            "<include><uri>model://brick</uri><name>second</name><pose>1 0 0 0 0 0</pose><static>1</static>"
            "<plugin name='p' filename='libp.so'/></include>"
        )
    ).worlds
    first, second = made.models
    assert (first.name, first.pose, first.static) == ("brick", (0, 0, 1, 0, 0, 0), False)
    assert (second.name, second.pose, second.static) == ("second", (1, 0, 0, 0, 0, 0), True)
    assert second.plugins[0].filename == "libp.so"
    assert second.links[0].collisions[0].geometry.size == (1, 2, 3)


def test_a_model_may_hold_another(brick):
    (made,) = load(model("<include><uri>model://brick</uri><pose>2 0 0 0 0 0</pose></include>")).models
    assert made.models[0].pose == (2, 0, 0, 0, 0, 0)


def test_the_ground_and_the_sun_are_fetched_from_no_server():
    server = "https://fuel.example/1.0/OpenRobotics/models"
    found = load(
        world(f"<include><uri>{server}/Ground Plane</uri></include><include><uri>{server}/Sun</uri></include>")
    )
    assert [each.name for each in found.worlds[0].models] == ["ground_plane"]


def test_a_model_is_put_by_one_of_its_frames(brick):
    (brick / "new.sdf").write_text(
        model("<link name='l'/><frame name='top'><pose>0 0 2 0 0 0</pose></frame>", "brick"), encoding="utf-8"
    )
    inside = "<include><uri>model://brick</uri><placement_frame>top</placement_frame><pose>1 0 5 0 0 0</pose></include>"
    assert load(world(inside)).worlds[0].models[0].pose == (1, 0, 3, 0, 0, 0)


def test_actors_are_included_and_lights_are_not_models(brick):
    (brick / "new.sdf").write_text("<sdf version='1.7'><actor name='man'/></sdf>", encoding="utf-8")
    (made,) = load(world("<include><uri>model://brick</uri><name>her</name></include>")).worlds
    assert [each.name for each in made.actors] == ["her"]
    with pytest.raises(SdfError, match="cannot stand in a model"):
        load(model("<include><uri>model://brick</uri></include>"))


@pytest.mark.parametrize("separator", [":", ";"], ids=["unix", "windows"])
def test_packages_may_bring_models(tmp_path, monkeypatch, brick, separator):
    package = tmp_path / "ws" / "bricks"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package><name>bricks</name><version>0.1.0</version><description>d</description>"
        "<maintainer email='a@b.invalid'>m</maintainer>"
        "<license>l</license><export><gazebo_ros gazebo_model_path='${prefix}/no:${prefix}/../../models'/>"
        "</export></package>",
        encoding="utf-8",
    )
    monkeypatch.delenv("GAZEBO_MODEL_PATH")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    monkeypatch.setattr("os.pathsep", separator)  # what a manifest says is the same on all systems
    assert load(world("<include><uri>model://brick</uri></include>")).worlds[0].models[0].name == "brick"
    (package / "a.sdf").write_text(model("<link name='l'/>", "a"), encoding="utf-8")
    assert load("package://bricks/a.sdf").models[0].name == "a"


def test_a_model_that_includes_itself_is_an_error(brick):
    (brick / "new.sdf").write_text(model("<include><uri>model://brick</uri></include>", "brick"), encoding="utf-8")
    with pytest.raises(SdfError, match="include"):
        load(world("<include><uri>model://brick</uri></include>"))


# ---- what is left out ----


def test_what_is_left_out_is_noted_with_its_line():
    found = load(
        world(
            "<light name='lamp' type='point'/>\n<mode1 name='x'/>\n<mine:own/>\n<model name='m'>"
            "<static>1</static><link name='l'>"
            "<collision name='c'><geometry><heightmap/></geometry></collision></link></model>"
        )
    )
    assert [note.line for note in found.notes] == [4, 3, 6]
    for note, part in zip(found.notes, ("<mode1>", "a light", "<heightmap>"), strict=True):
        assert part in note.text
    assert str(found.notes[1]).startswith("<text>:3: ")


MISSING = "<geometry><mesh><uri>{}</uri></mesh></geometry>"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (world("<include><uri>model://grund_plane</uri></include>"),
         "this model is left out: there is no model 'grund_plane'; did you mean ground_plane?"),
        (world("<include><uri>model://ground_plane/none</uri></include>"),
         "this model is left out: 'model://ground_plane/none' is not there"),
        (world("<include><uri>https://fuel.example/x</uri></include>"), "rosmini fetches nothing"),
        (world("<include><uri>package://no_robot/model.sdf</uri></include>"), "there is no package 'no_robot'"),
        (world(f"<include><uri>model://{'x' * 5000}</uri></include>"), "there is no model 'xxx"),
        (world(f"<include><uri>file://{'x' * 5000}</uri></include>"), "is not there"),
        (model(f"<link name='l'><visual name='v'>{MISSING.format('model://none/m.dae')}</visual></link>"),
         "this mesh is left out: there is no model 'none'"),
        (model(f"<link name='l'><collision name='c'>{MISSING.format('file://no.dae')}</collision></link>"),
         "this mesh is left out: 'file://no.dae' is not there"),
        (model("<link name='l'><inertial><mass>0</mass></inertial></link>"),
         "a mass is more than 0 kg, not 0: taken for 1 kg"),
        (model("<link name='l'><inertial><inertia><ixx>-1</ixx></inertia></inertial></link>"),
         "ixx is more than 0 kg m2, not -1: all are taken for 1 kg m2"),
        (model("<link name='l'><collision name='c'><geometry><boxx/></geometry></collision></link>"),
         "<boxx> is left out; did you mean box"),
        (model(f"<link name='l'><collision name='c'>{BOX}<surface><bounce><restitution_coefficient>2"
            "</restitution_coefficient></bounce></surface></collision></link>"), "not 2: 1 is taken"),
        (model("<link name='l'><collision name='c'><geometry><box><size>1 0 1</size></box></geometry>"
            "</collision></link>"), "the size of a box is 0 m: 0.1 mm is taken"),
    ],
)  # fmt: skip
def test_what_is_not_there_or_cannot_be_is_left_out_or_replaced_with_a_warning(text, said):
    found = load(text)
    (note,) = found.notes
    assert note.warning
    assert str(note).startswith("<text>:3: ")
    assert said in str(note)
    for each in found.models:
        assert each.links[0].inertial.mass == 1
        assert each.links[0].inertial.inertia == (1, 1, 1, 0, 0, 0)


@pytest.mark.parametrize(("text", "wanted"), [("True", True), (" 1 ", True), ("FALSE", False), ("0", False)])
def test_booleans_and_white_space_are_read_as_libsdformat_reads_them(text, wanted):
    size = "<geometry><box><size>1\t0\n  3.5e0 </size></box></geometry>"
    found = load(model(f"<static>{text}</static><link name='l'><visual name='v'>{size}</visual></link>")).models[0]
    assert found.static is wanted
    assert found.links[0].visuals[0].geometry.size == (1.0, 1e-4, 3.5)


def test_the_rest_of_a_world_stands_and_all_that_is_wrong_is_told_at_once(tmp_path):
    """In the style of TurtleBot3's public worlds."""
    for name, text in {
        "autorace/course": "<static>true</static><link name='l'><collision name='c'><geometry><plane>"
            "<normal>0 0 1</normal><size>4 4</size></plane></geometry></collision></link>",
        "autorace/bar": "<pose frame=''>0 0 0 0 0 0</pose><link name='bar'><collision name='c'>"
            f"<pose frame=''>-2 1 0.3 0 1.57 0</pose>{BOX}</collision></link><static>1</static>",
        "house": "<link name='Wall_1'><self_collide>0</self_collide><pose frame=''>0 3 0 0 0 -1.5708</pose>"
            "<kinematic>0</kinematic><collision name='w'><laser_retro>0</laser_retro>"
                f"<max_contacts>10</max_contacts>{BOX}<surface><bounce/><friction><ode/><torsional><ode/>"
                    "</torsional></friction><contact><ode/></contact></surface></collision></link>",
    }.items():  # fmt: skip
        folder = tmp_path / name
        folder.mkdir(parents=True)
        (folder / "model.config").write_text(
            "<model><name>m</name><sdf version='1.4'>old.sdf</sdf><sdf version='1.6'>model.sdf</sdf></model>",
            encoding="utf-8",
        )
        (folder / "model.sdf").write_text(
            f"<sdf version='1.6'><model name='{name.replace('/', '_')}'>{text}</model></sdf>", encoding="utf-8"
        )
    text = world(
        """<include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>
<include><uri>model://autorace/course</uri><pose> 0 0 0 0 0 -1.54</pose></include><include>
  <uri>model://autorace/bar</uri></include>
<include><uri>model://autorace/tunnel_wall</uri></include>
<model name='turtlebot3_house'><static>1</static><include><uri>model://house</uri></include></model>
<model name='obstacle_1'><pose>2 2 0.25 0 0 0</pose><link name='link'><inertial><mass>0</mass></inertial>
<collision name='c'><geometry><cylinder><radius>0.12</radius><length>0.5</length></cylinder></geometry></collision>
<visual name='v'><geometry><mesh><uri>model://house/meshes/none.dae</uri></mesh></geometry></visual></link>
  <plugin name='push_animate' filename='libobstacle_1.so'/></model>
<population name='can_population'><model name='can'><include><uri>model://coke_can</uri></include></model>
  <model_count>1000000000</model_count></population>
<light name='l' type='point'/><scene><shadows>false</shadows></scene>
<gui fullscreen='0'><camera name='user_camera'><pose frame=''>0 0 9 0 1.5 0</pose></camera></gui>
<physics type='ode'><real_time_update_rate>1000.0</real_time_update_rate><ode><solver><type>quick</type>
  </solver></ode></physics>
<state world_name='default'><sim_time>1 0</sim_time><model name='obstacle_1'><pose>3 3 0.25 0 0 0</pose></model>
  </state>"""
    )
    found = load(text, models=[tmp_path])
    (made,) = found.worlds
    assert [each.name for each in made.models] == [
        "ground_plane",
        "autorace_course",
        "autorace_bar",
        "turtlebot3_house",
        "obstacle_1",
    ]
    assert made.models[-1].pose[:2] == (3, 3)
    assert [each.line for each in made.warnings] == [6, 8, 10]
    assert [re.search("model|0 kg|mesh", each.text)[0] for each in made.warnings] == ["model", "0 kg", "mesh"]


def test_models_that_include_one_another_end(tmp_path, monkeypatch):
    monkeypatch.setattr("rosmini.sim.sdf.parts.MAX_INCLUDED_ELEMENTS", 10_000)
    for i in range(18):
        folder = tmp_path / f"m{i}"
        folder.mkdir()
        two = "".join(f"<include><uri>model://m{i + 1}</uri><name>{side}</name></include>" for side in "ab")
        (folder / "model.sdf").write_text(
            f"<sdf version='1.6'><model name='m{i}'>{two}</model></sdf>", encoding="utf-8"
        )
    (tmp_path / "m18").mkdir()
    (tmp_path / "m18" / "model.sdf").write_text(
        "<sdf version='1.6'><model name='m18'><link name='l'/></model></sdf>", encoding="utf-8"
    )
    reading = world("<include><uri>model://m0</uri></include>")
    with pytest.raises(SdfError, match="includes of this world have more than 10000 elements"):
        load(reading, models=[tmp_path])
    (tmp_path / "m1" / "model.sdf").write_text(
        "<sdf version='1.6'><model name='m1'><include><uri>model://m1</uri></include></model></sdf>", encoding="utf-8"
    )
    with pytest.raises(SdfError, match=r"m1.model\.sdf:1: .* does 'model://m1' include itself"):
        load(reading, models=[tmp_path])


@pytest.mark.parametrize("before", ["\n\n", "<!-- by hand -->\n", "\ufeff <!-- a -->\n<!-- b -->\n"])
def test_comments_and_blank_lines_may_precede_the_declaration(tmp_path, before):
    path = tmp_path / "late.world"
    text = f"{before}<?xml version='1.0' encoding='UTF-8' ?>\n{world('<modle/>')}"
    path.write_text(text, encoding="utf-8")
    for source in (path, text.lstrip("\ufeff")):
        (note,) = load(source).notes
        assert f":{before.count(chr(10)) + 4}: " in str(note)


def test_more_numbers_than_needed_are_ignored_as_in_gazebo():
    box = "<geometry><box><size>1 2 3 4</size></box></geometry>"
    inside = f"<pose>1 2 3 0 0 0 9 m</pose><link name='l'><collision name='c'>{box}</collision></link>"
    own = "<plugin name='p' filename='f'><pose>1 2 3 4 5 6 7</pose></plugin>"
    made = load(model(inside + own))
    assert made.models[0].pose[:3] == (1, 2, 3)
    assert made.models[0].links[0].collisions[0].geometry.size == (1, 2, 3)
    assert made.models[0].plugins[0].element.need("pose").text == "1 2 3 4 5 6 7"
    assert [(note.line, note.text.partition(";")[0]) for note in made.notes] == [
        (3, "<pose> takes 6 numbers"),
        (3, "<size> takes 3 numbers"),
    ]


# ---- what is wrong ----


@pytest.mark.parametrize(
    ("text", "line", "part"),
    [
        ("<sdf version='1.7'>\n<world name='w'>", 2, "still open"),
        ("<robot name='r'/>", 1, "URDF"),
        ("<urdf/>", 1, "begins with <sdf"),
        ("<sdf><world name='w'/></sdf>", 1, "version"),
        (world("<model/>"), 3, 'name="..." is missing in <model>'),
        (world("<model name='a'><link name='l'/></model>\n<model name='a'><link name='l'/></model>"),
         4, "another model 'a' in line 3"),
        (world("<physics type='ode'>\n<max_step_size>0</max_step_size></physics>"), 4, "more than 0 s"),
        (world("<physics type='ode'><real_time_factor>-1</real_time_factor></physics>"),
         3, "real_time_factor is 0 or more"),
        (world("<gravity>0 0</gravity>"), 3, "3 numbers, not 2"),
        (world("<include/>"), 3, "no <uri>"),
        (world("<include><uri></uri></include>"), 3, "is empty"),
        (world("<include><uri>model://../x</uri></include>"), 3, "there is no model '..'|names no model"),
        (model("<pose>0 0 0 0 0</pose><link name='l'/>"), 3, "6 numbers, not 5"),
        (model("<link name='l'><pose>0 0 nan 0 0 0</pose></link>"), 3, "not finite"),
        (model("<link name='l'><pose>0 0 a 0 0 0</pose></link>"), 3, "'a' .* is not a number"),
        (model("<link name='l'><pose relative_to='bse'>0 0 0 0 0 0</pose></link><link name='base'/>"),
         3, "did you mean base"),
        (model("<link name='a'><pose relative_to='b'/></link>\n<link name='b'><pose relative_to='a'/></link>"),
         4, "circle: a -> b -> a"),
        (model("<link name='l'/><link name='l'/>"), 3, "another link 'l'"),
        (model("<link name='l'><collision name='c'/></link>"), 3, "no <geometry>"),
        (model("<link name='l'><collision name='c'><geometry><box><size>1 -1 1</size></box></geometry>"
            "</collision></link>"), 3, "more than 0"),
        (model("<link name='l'><collision name='c'><geometry><sphere/></geometry></collision></link>"),
         3, "no <radius>"),
        (model("<link name='l'><collision name='c'><geometry><sphere><radius>-1</radius></sphere></geometry>"
            "</collision></link>"), 3, "more than 0 m"),
        (model("<link name='l'><visual name='c'><geometry><polyline><point>0 0</point><point>1 1</point>"
            "</polyline></geometry></visual></link>"), 3, "3 points"),
        (model(f"<link name='l'><visual name='c'>{BOX}<material><diffuse>2 0 0 1</diffuse></material></visual></link>"),
         3, "between 0 and 1"),
        (model("<link name='l'><sensor name='s'/></link>"), 3, "type"),
        (model("<link name='l'><sensor name='s' type='ray'><update_rate>-1</update_rate></sensor></link>"),
         3, "0 .always. or more"),
        (model("<link name='l'/><joint name='j' type='fixed'><parent>k</parent><child>l</child></joint>"),
         3, "no frame 'k'"),
        (model("<link name='l'/><plugin name='p'/>"), 3, "filename"),
        (model("<static>perhaps</static><link name='l'/>"), 3, "true or false"),
        (world("<actor name='a'><script><trajectory id='0' type='w'><waypoint><time>-1</time></waypoint>"
            "</trajectory></script></actor>"), 3, "0 s or more"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_with_its_line(text, line, part):
    with pytest.raises(SdfError, match=part) as caught:
        load(text)
    assert caught.value.line == line
    assert isinstance(caught.value, RosminiError)


def test_a_file_that_is_not_there_is_an_error(tmp_path):
    with pytest.raises(SdfError, match=r"no\.world"):
        load(tmp_path / "no.world")
    (tmp_path / "w.world").write_text(world("<model/>"), encoding="utf-8")
    with pytest.raises(SdfError, match=r"w\.world:3: "):
        load(tmp_path / "w.world")


@given(st.text(alphabet="<>/ame'=sdfworl \n0123", max_size=60), st.integers(0, 200))
def test_a_broken_file_is_an_sdf_error_and_nothing_else(garbage, where):
    text = world(f"<model name='a'><link name='l'><collision name='c'>{BOX}</collision></link></model>")
    broken = text[:where] + garbage + text[where:]
    try:
        found = load("<" + broken.lstrip().lstrip("<"))
    except SdfError:
        return
    assert found.version
