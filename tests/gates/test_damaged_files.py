"""Whatever is wrong with a file of a robot or a world: its reader soon raises one of our errors, in little memory.

Each reader is given a fixed number of damaged files, made from sound ones by a seeded mutator that knows what such
files are made of: numbers, names, tags and bytes.
"""

from __future__ import annotations

import io
import random
import re
import struct
import tracemalloc
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rosmini.core import rosparam
from rosmini.core.dynamic_reconfigure.description import Description
from rosmini.core.errors import RosminiError
from rosmini.core.maps import load_map
from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.navigation.costmap_2d.footprint import footprint_from_text
from rosmini.navigation.nav_core import plugin_files
from rosmini.ros import launch
from rosmini.ros.catkin.cfg_file import read_cfg
from rosmini.ros.catkin.project import read_project
from rosmini.sim import sdf, urdf
from rosmini.sim.stage import world_file
from rosmini.sim.urdf import meshes
from rosmini.viz.rqt.perspective import Perspective
from rosmini.viz.rviz.config import Config

from ..conftest import nightly

LONGEST = 20_000
"""Characters of an error."""
LARGEST = 300_000_000
"""Bytes that a reader may take for one of these files."""

NUMBERS = (
    "0", "-1", "1", "0.0", "1e308", "-1e308", "1e-320", "nan", "inf", "-inf", "1e400",
    "99999999999999999999999999", "2001-01-01", "true", "", "0x10",
    "1_000", "½", "1,5", "...", "1e9", "65536", "4294967295", "-0.0", "[]", "{}", "~", "*a", "\0",
)  # fmt: skip
WORDS = (
    "name", "", "..", "/", "\0", "x" * 3000, "é", "model://a", "file:///C:/a", "package://a", "$(find a)",
    "${a}", "~x", "%s", "world", "[", "(", "}", "<", "&a;", "'", '"',
)  # fmt: skip
NUMBER = re.compile(rb"-?\d+\.?\d*(?:e-?\d+)?")
WORD = re.compile(rb"[A-Za-z_][\w.:/]*")


def damaged(data: bytes, rng: random.Random) -> bytes:
    """A file that is nearly the same."""
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        how = rng.randrange(8)
        if how <= 1:
            data = _replaced(data, NUMBER, NUMBERS, rng)
        elif how <= 3:
            data = _replaced(data, WORD, WORDS, rng)
        elif how == 4:
            data = _swapped(data, rng)
        else:
            at, size = rng.randrange(len(data) + 1), rng.choice((1, 1, 4, 40, 400))
            piece = data[at : at + size]
            new = {
                5: b"",
                6: bytes(rng.randrange(256) for _ in range(min(size, 4))),
                7: piece * rng.choice((2, 2, 20)),
            }[how]
            data = data[:at] + new + data[at + size :]
    return data if rng.random() < 0.95 else data[: rng.randrange(len(data) + 1)]


def _replaced(data: bytes, what: re.Pattern[bytes], others: tuple[str, ...], rng: random.Random) -> bytes:
    found = list(what.finditer(data))
    if not found:
        return data
    chosen = rng.choice(found)
    return data[: chosen.start()] + rng.choice(others).encode() + data[chosen.end() :]


def _swapped(data: bytes, rng: random.Random) -> bytes:
    """Two words of the file in one another's place."""
    found = list(WORD.finditer(data))
    if len(found) < 2:
        return data
    a, b = sorted(rng.sample(found, 2), key=lambda each: each.start())
    return data[: a.start()] + b[0] + data[a.end() : b.start()] + a[0] + data[b.end() :]


def _assets(pattern: str) -> list[bytes]:
    return [path.read_bytes() for path in sorted((assets_dir() / "ros").glob(pattern))]


def _stl() -> bytes:
    rows = b"".join(struct.pack("<12fH", *range(12), 0) for _ in range(4))
    return bytes(80) + struct.pack("<I", 4) + rows


def _image(kind: str) -> bytes:
    file = io.BytesIO()
    Image.fromarray(np.arange(600, dtype=np.uint8).reshape(20, 30)).save(file, kind)
    return file.getvalue()


def _read_sdf(path: Path) -> None:
    document = sdf.load(path)
    for each in document.worlds:
        sdf.converted(each)
    for each in document.models:
        sdf.to_obstacles(each)


def _read_image(path: Path) -> None:
    numbers = "resolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n"
    described = path.with_suffix(".yaml")
    described.write_text(f"image: {path.name}\n{numbers}", encoding="utf-8")
    load_map(described)


def _read_map(path: Path) -> None:
    Image.new("L", (4, 4)).save(path.with_name("floor.png"))
    load_map(path)


def _read_package(path: Path) -> None:
    index = PackageIndex([path.parent])
    for name in index.names():
        index.find(name)


def _read_launch(path: Path) -> None:
    launch.read(path, environ={"TURTLEBOT3_MODEL": "burger"}, packages=PACKAGES, lenient=True)


def _read_rviz(path: Path) -> None:
    config = Config.read(path)
    config.unknown_classes()
    config.with_parts(config.mappings("Displays"), config.options(), config.mapping("Views", "Current")).text()


def _read_plugins(path: Path) -> None:
    manifest = PACKAGE.replace(b"<metapackage/>", b'<nav_core plugin="${prefix}/plugins.xml"/>')
    path.with_name("package.xml").write_bytes(manifest)
    list(plugin_files._declared(PackageIndex([path.parent]).find("a")))


STL = b"solid a\nfacet normal 0 0 1\nouter loop\n" + b"vertex 1 2 3\n" * 3 + b"endloop\nendfacet\nendsolid a\n"
OBJ = b"o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\ng b\nf -1 -2 -3\n"
DAE = b"""<COLLADA><asset><unit meter="0.01"/></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array count="12">0 0 0 100 0 0 100 100 0 0 100 0</float_array><technique_common>
<accessor stride="3"/></technique_common></source>
<source id="n"><float_array>0 0 1</float_array></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices>
<polylist material="s"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#n" offset="1"/><vcount>4</vcount><p>0 0 1 0 2 0 3 0</p></polylist>
<triangles><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="n1"><translate>0 0 5</translate><rotate>0 0 1 90</rotate>
<scale>1 1 2</scale><instance_geometry url="#g"/></node>
<node><matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1</matrix><instance_node url="#n1"/></node></visual_scene>
</library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>"""
SDF = b"""<sdf version='1.7'><world name='w'><include><uri>model://ground_plane</uri><pose>0 0 0 0 0 0</pose>
</include><gravity>0 0 -9.8</gravity>
<physics type='ode'><max_step_size>0.001</max_step_size><real_time_update_rate>1000</real_time_update_rate></physics>
<frame name='start'><pose>1 1 0 0 0 0</pose></frame>
<model name='m'><pose relative_to='start'>1 0 0.5 0 0 1</pose><link name='l'><inertial><mass>2</mass><inertia>
<ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
<collision name='a'><geometry><box><size>1 1 1</size></box></geometry><surface><bounce>
<restitution_coefficient>0.5</restitution_coefficient></bounce><friction><ode><mu>0.8</mu></ode></friction></surface>
</collision>
<visual name='v'><geometry><cylinder><radius>0.2</radius><length>1</length></cylinder></geometry><material>
<diffuse>1 0 0 1</diffuse></material></visual>
<sensor name='s' type='ray'><update_rate>5</update_rate></sensor></link><link name='k'><pose>0 0 1 0.3 0 0</pose>
<collision name='b'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link>
<joint name='j' type='revolute'><parent>l</parent><child>k</child><axis><xyz>0 0 1</xyz></axis></joint></model>
<model name='t'><static>1</static><link name='l'><collision name='p'><geometry><polyline><point>0 0</point>
<point>2 0</point><point>2 2</point><point>0 2</point><height>1</height></polyline></geometry></collision>
<collision name='c'><pose>3 0 1 0.5 0.5 0</pose><geometry><cylinder><radius>0.3</radius><length>2</length></cylinder>
</geometry></collision></link></model>
<actor name='a'><script><loop>true</loop><delay_start>1</delay_start><trajectory id='0' type='walk'><waypoint>
<time>0</time><pose>0 5 0 0 0 0</pose></waypoint><waypoint><time>5</time><pose>3 5 0 0 0 0</pose></waypoint>
</trajectory></script></actor>
<state world_name='w'><model name='m'><pose>2 2 0.5 0 0 0</pose></model></state></world></sdf>"""
STAGE = b"""name "w"
resolution 0.02
interval_sim 100
define laser ranger ( sensor( range [0.1 8] fov 270 samples 181 ) size [0.1 0.1 0.1] )
define robot position ( size [0.4 0.3 0.2] origin [0 0 0 0] laser( pose [0.1 0 0 0] )
  odom_error [0.01 0.01 0.01 0.1] drive "diff"
  block( points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] z [0 1] ) )
window ( size [ 400 300 ] center [0 0] scale 20 )
model ( name "wall" size [4 0.1 1] pose [0 3 0 0] color "gray30" boundary 1 )
model ( gripper_return 1 mass 2 size [0.3 0.3 0.3] pose [2 1 0 45] color "#ff0000" )
robot ( pose [0 0 0 90] name "r" localization "odom"
  camera( resolution [ 32 32 ] range [ 0.2 8 ] fov [ 70 40 ] pantilt [ 0 0 ] ) )
"""
URDF = b"""<robot name="r"><material name="blue"><color rgba="0 0 1 1"/></material><link name="base"><visual>
<origin xyz="0 0 1" rpy="0 0 0"/><geometry><box size="1 1 1"/></geometry>
<material name="blue"/></visual><collision><geometry><cylinder radius="1" length="2"/></geometry></collision>
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="arm"><visual><geometry><sphere radius="0.1"/></geometry></visual></link><joint name="j" type="revolute">
<parent link="base"/><child link="arm"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
<mimic joint="j2"/><dynamics damping="0.1"/></joint><link name="c"/><joint name="j2" type="continuous">
<parent link="base"/><child link="c"/></joint><gazebo reference="arm"><mu1>0.2</mu1></gazebo></robot>"""
XACRO = b"""<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="n" default="3"/>
<xacro:property name="p" value="${2 * pi}"/>
<xacro:macro name="wheel" params="name radius:=0.1 *origin"><link name="${name}_link"><visual>
<xacro:insert_block name="origin"/><geometry><sphere radius="${radius * 2}"/></geometry></visual></link></xacro:macro>
<xacro:wheel name="left" radius="${max(1, 2) / len([1, 2])}"><origin xyz="0 0 ${sin(p)}"/></xacro:wheel>
<xacro:if value="${'a' in 'abc' and $(arg n) == 3}"><joint name="x$(eval n + 1)" type="fixed">
<parent link="left_link"/><child link="b"/></joint><link name="b"/></xacro:if>
<xacro:property name="d" value="${dict(a=1, b=[i for i in range(3)])}"/>
<xacro:include filename="$(find turtlebot3_description)/urdf/common_properties.xacro"/></robot>"""
YAML = (
    b"a: &a {b: [1, 2.5, deg(90), rad(pi/2)], c: yes, d: 0o10, e: 2001-01-01}\n"
    b"f: {<<: *a, g: !degrees 3}\n---\n_ns: /x\nh: |\n  text\ni: 1:30\nj: !!binary aGk=\n"
)
PACKAGE = b"""<?xml version="1.0"?><package format="3"><name>a</name><version>1.0.0</version><description>A <b>b</b>
</description><maintainer email="a@b.org">A</maintainer>
<license>BSD</license><url type="website">http://a</url><buildtool_depend>catkin</buildtool_depend>
<depend version_gte="1.0" condition="$ROS_VERSION == 1">b</depend><export><metapackage/></export></package>"""
PERSPECTIVE = b"""{"keys": {}, "groups": {"mainwindow": {"keys": {}, "groups": {}}, "pluginmanager": {"keys": {
"running-plugins": {"type": "repr", "repr": "{'rqt_graph/RosGraph': [1], 'rqt_plot/Plot': [1, 2]}"}}, "groups": {
"plugin__rqt_plot__Plot__1": {"keys": {}, "groups": {"plugin": {"keys": {"topics": {"type": "repr",
"repr": "['/odom/twist/twist/linear/x', {'a': (1.5, None, True)}]"}}, "groups": {}}}}}}}}"""
CFG = b"""#!/usr/bin/env python3
PACKAGE = "a"
from dynamic_reconfigure.parameter_generator_catkin import *
from math import pi
gen = ParameterGenerator()
size = gen.enum([gen.const("Small", int_t, 0, "A small one"),
                 gen.const("Large", int_t, 1 << 4, "A large one")], "Sizes")
gen.add("count", int_t, 0, "How many", 50, 0, 100)
gen.add("angle", double_t, 0x1 | 2, "How far", .5, -pi, 2 * pi)
group = gen.add_group("Deeper", type="tab", state=False)
side = "left"
group.add(side + "_on", bool_t, 0, "Whether %s is on" % side, True)
group.add("size", int_t, 0, "A size", 1, 0, 3, edit_method=size)
gen.add("text", str_t, 4, "A text", "hello")
exit(gen.generate(PACKAGE, "a", "A"))
"""
CMAKE = b"""cmake_minimum_required(VERSION 3.0.2)
project(a)
find_package(catkin REQUIRED COMPONENTS rospy std_msgs message_generation dynamic_reconfigure)
set(NAMES A B;C "d e" [[f]]) # a comment #[[ another ]]
list(APPEND NAMES ${PROJECT_NAME} $ENV{HOME})
foreach(name IN LISTS NAMES)
  if(NOT name STREQUAL "A" AND (EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/msg OR 3 VERSION_LESS 4.0))
    message(STATUS "${name}")
  elseif(name MATCHES "^B+$")
    set(${name}_it 1 CACHE STRING "it")
  else()
    unset(NAMES)
  endif()
endforeach()
catkin_python_setup()
add_message_files(FILES Num.msg)
generate_messages(DEPENDENCIES std_msgs)
generate_dynamic_reconfigure_options(cfg/A.cfg)
catkin_package(CATKIN_DEPENDS rospy message_runtime)
install(PROGRAMS scripts/a.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
if(CATKIN_ENABLE_TESTING)
  find_package(rostest REQUIRED)
  add_rostest(test/a.test)
endif()
"""
PLUGINS = b"""<class_libraries><library path="a.planner"><class name="a/Planner" type="a::Planner"
base_class_type="nav_core::BaseGlobalPlanner"><description>A</description></class></library>
<library path="lib/libb"><class type="b::B" base_class_type="nav_core::RecoveryBehavior"/></library>
</class_libraries>"""

RVIZ = b"""Panels:
  - Class: rviz/Displays
    Name: Displays
Visualization Manager:
  Class: ""
  Displays:
    - {Alpha: 0.5, Cell Size: 1, Class: rviz/Grid, Color: 160; 160; 164, Enabled: true, Name: Grid, Value: true}
    - Class: rviz/LaserScan
      Name: Scan
      Size (m): 0.03
      Topic: /scan
      Position Transformer: XYZ
    - Class: rviz/Group
      Displays: [{Class: rviz/Path, Name: Path, Offset: {X: 0, Y: 0, Z: 0}, Topic: /plan}]
      Name: Group
  Global Options: {Background Color: 48; 48; 48, Fixed Frame: map, Frame Rate: 30}
  Tools:
    - Class: rviz/SetGoal
      Topic: /move_base_simple/goal
  Views: {Current: {Class: rviz/Orbit, Distance: 10, Focal Point: {X: 0, Y: 0, Z: 0}, Pitch: 0.785}, Saved: ~}
"""

LAUNCH = b"""<launch>
<arg name="model" default="$(env TURTLEBOT3_MODEL)" doc="burger"/><arg name="n" default="3"/>
<group ns="tb$(arg n)" if="$(eval n > 2 and model == 'burger')"><remap from="scan" to="/front/scan"/>
<param name="robot" type="str" value="$(eval 'a' + str(n * 2))"/><param name="yaml" type="yaml" value="{a: [1, 2.5]}"/>
<node pkg="rospy_tutorials" type="talker.py" name="talker_$(anon it)" args="--rate $(arg n)" output="screen"
respawn="true" respawn_delay="1.5"><rosparam>{b: true, c: [deg(90), 010]}</rosparam><remap from="a" to="b"/></node>
</group><include file="$(find rospy_tutorials)/no.launch" pass_all_args="true"><arg name="n" value="4"/></include>
<rosparam param="list" subst_value="true">[$(arg n), "x"]</rosparam><rosparam command="delete" param="list"/>
<machine name="m" address="localhost" env-loader="a" timeout="10.0"/><env name="A" value="$(optenv B 1)"/>
<test pkg="rospy_tutorials" type="t" test-name="t" time-limit="10.0" retry="2"/></launch>"""

PACKAGES = PackageIndex()

READERS: dict[str, tuple[str, Callable[[Path], object], list[bytes]]] = {
    "SDF": ("a.world", _read_sdf, [SDF, *_assets("turtlebot3_gazebo/worlds/turtlebot3_world.world")]),
    "Stage": ("a.world", world_file.load, [STAGE, *_assets("stage_ros/world/boxes.world")]),
    "URDF": ("a.urdf", urdf.load, [URDF]),
    "xacro": ("a.xacro", urdf.load, [XACRO, *_assets("turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro")]),
    "STL": ("a.stl", meshes.read, [STL, _stl()]),
    "OBJ": ("a.obj", meshes.read, [OBJ]),
    "COLLADA": ("a.dae", meshes.read, [DAE]),
    "map": ("a.yaml", _read_map, _assets("rosmini_sim/maps/floor.yaml")),
    "PGM": ("a.pgm", _read_image, [_image("PPM"), b"P2 3 2 255\n1 2 3\n4 5 6\n"]),
    "PNG": ("a.png", _read_image, [_image("PNG")]),
    "parameters": ("a.yaml", rosparam.load_file, [YAML]),
    "launch": ("a.launch", _read_launch, [LAUNCH]),
    "CMake": ("CMakeLists.txt", lambda path: read_project(path.parent), [CMAKE]),
    "cfg": ("A.cfg", lambda path: Description.of(read_cfg(path).tree), [CFG]),
    "RViz": ("a.rviz", _read_rviz, [RVIZ]),
    "perspective": ("a.perspective", lambda path: Perspective.parse(Perspective.read(path).dumps()), [PERSPECTIVE]),
    "footprint": (
        "footprint", lambda path: footprint_from_text(path.read_text("utf-8", "replace"), "footprint"),
        [b"[[-0.205, -0.155], [-0.205, 0.155], [0.077, 0.155], [0.077, -0.155]]"],
    ),
    "plugins": ("plugins.xml", _read_plugins, [PLUGINS]),
    "package": ("package.xml", _read_package, [PACKAGE]),
}  # fmt: skip


@pytest.mark.parametrize("rounds", [10, *nightly(1500)])
@pytest.mark.parametrize("kind", READERS)
def test_a_damaged_file_is_read_or_refused(kind, rounds, tmp_path, monkeypatch):
    monkeypatch.setenv("STAGEPATH", str(assets_dir() / "ros" / "stage_ros" / "world" / "include"))
    name, read, sound = READERS[kind]
    path = tmp_path / name
    rng = random.Random(kind)
    read_well = 0
    tracemalloc.start()
    try:
        for i in range(rounds):
            data = sound[i] if i < len(sound) else damaged(rng.choice(sound), rng)
            path.write_bytes(data)
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", UserWarning)
                    read(path)
                read_well += 1
            except RosminiError as error:
                if i < len(sound) or len(str(error)) > LONGEST:
                    raise
            except Exception as error:
                raise AssertionError(f"{type(error).__name__} in round {i} of {kind}: {data[:5000]!r}") from error
        assert tracemalloc.get_traced_memory()[1] < LARGEST
    finally:
        tracemalloc.stop()
    assert read_well >= len(sound)
