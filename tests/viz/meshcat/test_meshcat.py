"""Scenes in three dimensions: the viewer's commands, the drawing of the same scene, texts, and no server."""

import json
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("meshcat")

import umsgpack

from rosmini import Graph
from rosmini.sim.models import BURGER, model
from rosmini.sim.recording import Moved, Recording
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, World
from rosmini.sim.worlds import world
from rosmini.viz import ViewError
from rosmini.viz.meshcat.drawing import HEIGHT, WIDTH, draw
from rosmini.viz.meshcat.runs import replay_3d
from rosmini.viz.meshcat.scene3d import Camera, Scene3D, planar
from rosmini.viz.meshcat.solids import Ball, Prism, Rod
from rosmini.viz.meshcat.view import MeshcatView, camera_for, robot_3d
from rosmini.viz.replay.layers import Shape, Shapes
from rosmini.viz.replay.run import Body, Run

from ..replay import unpacking

POSE = (0.5, -0.25, math.pi / 2)
SMALL = World(
    "small",
    (
        Obstacle("crate", Box(0.4, 0.2), (1.0, 0.5, math.pi / 2), 0.3, "blue"),
        Obstacle("pillar", Cylinder(0.15), (-1.0, 0.5, 0.0), 0.6, "green"),
        Obstacle("corner", Polygon(((0, 0), (1, 0), (1, 0.2), (0.2, 0.2), (0.2, 1), (0, 1))), (0, 1, 0), 0.25),
    ),
    walls=np.array([(-2.0, -1.0, 2.0, -1.0)]),
    wall_height=0.4,
)


def world_3d(world, **options):
    """Show only a world."""
    usual = {"distance": None, "azimuth": None, "elevation": None}
    scene = Scene3D(camera_for(world, None, focus="world", **usual | options))
    scene.add_world(world)
    return MeshcatView(scene, label="a world", text="3D", alt="A world.")


def commands(view_or_scene):
    scene = getattr(view_or_scene, "scene", view_or_scene)
    return [umsgpack.unpackb(command) for command in scene.commands]


def objects(view):
    return {c["path"]: c["object"] for c in commands(view) if c["type"] == "set_object"}


def transforms(view):
    return {c["path"]: np.array(c["matrix"]).reshape(4, 4).T for c in commands(view) if c["type"] == "set_transform"}


def vertices(thing):
    """The vertices (n, 3) of a mesh that was sent."""
    (geometry,) = thing["geometries"]
    return np.frombuffer(geometry["data"]["attributes"]["position"]["array"].data, np.float32).reshape(-1, 3)


# What the viewer is sent


def run(duration=12.0):
    """Ahead for 6 s, then a left turn on an arc; odometry drifts to the left."""
    times = np.arange(0, duration + 0.01, 0.1)
    heading = np.where(times < 6, 0.0, (times - 6) * 0.5)
    steps = 0.02 * np.column_stack([np.cos(heading[:-1] + 0.025), np.sin(heading[:-1] + 0.025)])
    steps[times[:-1] < 5.99] = (0.02, 0.0)
    way = np.vstack([[0.0, 0.0], np.cumsum(steps, axis=0)])
    truth = np.column_stack([way, heading])
    odom = truth + np.outer(times, (0.0, 0.01, 0.0))
    scan_times = np.arange(0, duration, 0.2)
    ranges = np.where(np.arange(360) < 180, 1.0, np.inf) + np.zeros((len(scan_times), 1))
    return Recording(SMALL, BURGER, times, truth, odom, np.zeros((0, 3)), scan_times, ranges)


def test_the_robot_and_the_obstacles_stand_where_they_are():
    view = robot_3d(SMALL, BURGER, POSE)
    at = transforms(view)
    assert at["/meshcat/robots/robot"] == pytest.approx(planar(POSE), abs=1e-5)
    assert at["/meshcat/robots/robot/wheel_left"][:3, 3] == pytest.approx([0, 0.08, 0.033])
    assert at["/meshcat/robots/robot/wheel_right"][:3, 3] == pytest.approx([0, -0.08, 0.033])
    assert at["/meshcat/obstacles/crate"] == pytest.approx(planar((1.0, 0.5, math.pi / 2)), abs=1e-6)
    # What the camera looks at is in the middle of the viewer: the robot, a little above the ground.
    assert at["/meshcat"][:3, 3] == pytest.approx([-POSE[0], -POSE[1], -0.09])


def test_obstacles_and_walls_have_their_sizes():
    sent = objects(world_3d(SMALL))
    crate = vertices(sent["/meshcat/obstacles/crate/solid"])
    assert crate.min(axis=0) == pytest.approx([-0.2, -0.1, 0.0])
    assert crate.max(axis=0) == pytest.approx([0.2, 0.1, 0.3])
    (pillar,) = sent["/meshcat/obstacles/pillar/solid/0"]["geometries"]
    assert (pillar["type"], pillar["radiusTop"], pillar["radiusBottom"], pillar["height"]) == (
        "CylinderGeometry", pytest.approx(0.15), pytest.approx(0.15), pytest.approx(0.6),
    )  # fmt: skip
    wall = vertices(sent["/meshcat/walls"])
    assert wall.min(axis=0) == pytest.approx([-2.015, -1.015, 0.0])
    assert wall.max(axis=0) == pytest.approx([2.015, -0.985, 0.4])
    assert vertices(sent["/meshcat/obstacles/corner/solid"])[:, 2].max() == pytest.approx(0.25)


def test_the_robot_is_as_large_as_its_model_says():
    view = robot_3d(World("empty"), BURGER, (0.0, 0.0, 0.0))
    corners = np.vstack(
        [
            face @ view.scene.transform(part.node)[:3, :3].T + view.scene.transform(part.node)[:3, 3]
            for part in view.scene.parts
            for solid in part.solids
            for face in solid.faces()
        ]
    )
    low, high = corners.min(axis=0), corners.max(axis=0)
    # 0.138 x 0.178 x 0.192 m: TurtleBot3's e-manual, "Features".
    assert high - low == pytest.approx([0.138, 0.178, 0.192], abs=0.004)
    assert low[2] == pytest.approx(0.0, abs=1e-3)
    laser = next(part for part in view.scene.parts if part.name == "laser_window")
    assert laser.solids[0].centre == pytest.approx(BURGER.lidar.mount)


def test_a_scan_is_where_the_laser_saw_it():
    ranges = np.full(360, np.inf)
    ranges[0], ranges[90] = 1.0, 2.0
    view = robot_3d(SMALL, BURGER, POSE, ranges)
    ahead, left = view.scene.scans[0]
    # The laser sits 3.2 cm behind the axle, and the robot looks along y.
    assert ahead == pytest.approx([0.5, -0.25 - 0.032 + 1.0, 0.182], abs=1e-4)
    assert left == pytest.approx([0.5 - 2.0, -0.25 - 0.032, 0.182], abs=1e-4)
    for part in ("burger at (0.50, -0.25, 90.0 deg)", "2 of 360 beams", "1 wall, 3 obstacles"):
        assert part in view.text
    moved = robot_3d(SMALL, BURGER, (0.5, 0.75, math.pi / 2), ranges, scan_from=POSE)
    assert moved.scene.scans[0] == pytest.approx(view.scene.scans[0], abs=1e-4)
    # of a sweep, each beam from its own pose
    poses = np.tile(POSE, (360, 1))
    poses[90] = (0.6, -0.25, 0.0)
    ahead, left = robot_3d(SMALL, BURGER, (0.5, 0.75, math.pi / 2), ranges, scan_from=poses).scene.scans[0]
    assert ahead == pytest.approx(view.scene.scans[0][0], abs=1e-4)
    assert left == pytest.approx([0.6 - 0.032, -0.25 + 2.0, 0.182], abs=1e-4)
    with pytest.raises(ViewError, match=r"has 360 ranges, not \(10,\)"):
        robot_3d(SMALL, BURGER, POSE, np.ones(10))


def test_obstacles_of_names_that_look_alike_in_a_path_are_both_there():
    twins = World("twins", (Obstacle("a/b", Cylinder(0.1)), Obstacle("a b", Cylinder(0.2), (1, 0, 0))))
    radii = [
        thing["geometries"][0]["radiusTop"] for path, thing in objects(world_3d(twins)).items() if "obstacles" in path
    ]
    assert radii == pytest.approx([0.1, 0.2])


# The same everywhere, and nothing started


def test_the_pages_html_in_both_forms(monkeypatch):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    view = robot_3d(SMALL, BURGER, POSE, title="A robot")
    book = view.html
    assert len(book) < 160_000
    assert "packed" not in book
    assert "<figcaption>A robot</figcaption>" in book
    assert view.svg in book
    monkeypatch.delenv("ROSMINI_DISPLAY")
    assert len(view.html) > len(book) + 200_000
    assert view.page == view.html
    data = json.loads(re.search(r'application/json">(.*?)</script>', book, re.DOTALL)[1])
    assert set(data["themes"]["dark"]) == set(data["themes"]["light"]) >= {"/meshcat/ground", "/meshcat/grid"}


def test_a_view_is_saved_with_all_that_it_needs(monkeypatch, tmp_path):
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    saved = world_3d(SMALL).save(tmp_path / "a.html").read_text(encoding="utf-8")
    assert "const book = false" in saved


# The drawing


def test_the_drawing_has_the_texts_of_its_view_and_stays_small():
    view = robot_3d(world("room"), BURGER, POSE, np.linspace(0.2, 3, 360))
    root = ET.fromstring(view.svg)
    assert root.get("aria-label") == view.alt
    assert "TurtleBot3 Burger in a furnished room of 4 m by 3.5 m" in view.alt
    assert "360 of 360 beams hit" in view.alt
    assert len(view.svg) < 45_000
    data, metadata = view._repr_mimebundle_()
    assert list(data) == ["text/plain", "image/svg+xml", "text/html"]
    assert metadata["image/svg+xml"]["alt"] == view.alt


def paths(svg):
    return [p for p in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}path") if p.get("d")]


def test_a_box_is_drawn_where_the_camera_sees_it():
    """The top of a cube, seen along x from 45 degrees above: its corners by hand."""
    scene = Scene3D(Camera((0.0, 0.0, 0.0), 4.0, azimuth=0.0, elevation=45.0, field_of_view=60.0))
    scene.add_obstacle(Obstacle("cube", Box(1.0, 1.0), height=1.0, colour="blue"))
    drawn = [p.get("d") for p in paths(draw(scene, title="t", alt="a"))]
    scale = HEIGHT / 2 / math.tan(math.radians(30))
    eye = 4 / math.sqrt(2)

    def seen(x, y, z):
        ahead = ((eye - x) + (eye - z)) / math.sqrt(2)
        up = (z - x) / math.sqrt(2)
        return WIDTH / 2 + scale * y / ahead, HEIGHT / 2 - scale * up / ahead

    top = [seen(x, y, 1.0) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))]
    numbers = [[float(n) for n in re.findall(r"[-\d.]+", d)] for d in drawn]
    wanted = [c for point in top for c in point]
    assert any(len(n) == 8 and n == pytest.approx(wanted, abs=0.1) for n in numbers), (numbers, wanted)


def test_points_of_a_laser_are_drawn_where_nothing_hides_them():
    scene = Scene3D(Camera((0.0, 0.0, 0.5), 6.0, azimuth=-90.0, elevation=0.0))
    scene.add_obstacle(Obstacle("wall", Box(2.0, 0.2), (1.0, 0.0, 0.0), height=1.0))
    # Before the wall, on it, within its noise, behind it, beside it, and behind the camera.
    ys = [(0.5, -1.0), (0.5, -0.1), (0.5, -0.07), (0.5, 1.0), (-0.5, 1.0), (0.5, -9.0)]
    scene.scans.append(np.array([(x, y, 0.5) for x, y in ys]))
    drawn = "".join(p.get("d") for p in paths(draw(scene, title="t", alt="a")) if p.get("stroke-width") == "3")
    assert drawn.count("h0") == 4


def test_a_wall_behind_the_camera_is_cut_not_mirrored():
    scene = Scene3D(Camera((0.0, 0.0, 0.0), 1.0, azimuth=0.0, elevation=10.0))
    scene.add_world(World("behind", walls=np.array([(3.0, -1.0, 3.0, 1.0), (-3.0, 0.2, 3.0, 0.2)])))
    coordinates = [float(n) for p in paths(draw(scene, title="t", alt="a")) for n in re.findall(r"[-\d.]+", p.get("d"))]
    assert np.isfinite(coordinates).all()


# Runs


def keys(view):
    """Times [s] and values (n, k) of what moves, by path and property, as a page gets them."""
    found = {}
    for path, name, packed in view.data["tracks"]:
        rows = unpacking.columns(packed, 4 if name == "position" else 2)
        found[path, name] = rows[:, 0] * 1e-3, rows[:, 1:] * 1e-4
    return found


def test_a_replay_moves_the_robot_as_it_moved_and_turns_its_wheels():
    recording = run()
    view = replay_3d(recording)
    tracks = keys(view)
    assert view.scene.duration == pytest.approx(12.0)
    for (path, name), column in (
        (("/meshcat/robots/robot", "position"), recording.truth[:, 0]),
        (("/meshcat/robots/robot", "rotation[z]"), recording.truth[:, 2]),
    ):
        times, values = tracks[path, name]
        assert len(times) < 60
        assert np.interp(recording.times, times, values[:, 0]) == pytest.approx(column, abs=0.011)
    left, right = (tracks[f"/meshcat/robots/robot/wheel_{side}", "rotation[y]"][1][-1, 0] for side in ("left", "right"))
    # 12 s at 0.2 m/s, and 3 rad of turning with wheels 16 cm apart of 33 mm radius.
    assert (left + right) / 2 * 0.033 == pytest.approx(2.4, abs=0.005)
    assert (right - left) * 0.033 / 0.160 == pytest.approx(3.0, abs=0.005)


def test_a_replays_scans_are_every_second_beam_in_millimetres():
    scan = replay_3d(run()).extra["scan"]
    assert scan["unit"] == 0.001
    ranges = unpacking.unpack(scan["ranges"]).reshape(len(scan["times"]), scan["beams"])
    assert ranges.shape == (60, 180)
    assert (ranges[:, :90] == 1000).all()
    assert (ranges[:, 90:] == 0).all()
    assert "scan" not in replay_3d(run(), scans=False).extra
    long = replay_3d(run(60.0)).extra["scan"]
    assert len(long["times"]) <= 120
    assert unpacking.unpack(long["ranges"]).max() * long["unit"] == pytest.approx(1.0)


def test_what_the_camera_looks_at_is_asked_for_with_care():
    with pytest.raises(ViewError, match="'robot' or 'world', not 'moon'"):
        robot_3d(SMALL, BURGER, POSE, focus="moon")
    with pytest.raises(ViewError, match="metres above 0, not nan"):
        world_3d(SMALL, distance=math.nan)
    assert world_3d(SMALL, distance=9.0, azimuth=10.0, elevation=80.0).scene.camera.distance == 9.0
    assert replay_3d(run(), focus="world").scene.camera.target != replay_3d(run()).scene.camera.target


def test_a_simulator_shows_itself_as_it_is_now():
    graph = Graph()
    try:
        simulator = Simulator(graph.node("simulator"), world=SMALL)
        before = simulator.show3d()
        assert "beams" not in before.text
        graph.run(1.0)
        view = simulator.show3d(focus="world", title="Now")
        assert view.text.startswith("Now\n3D: burger at ")
        assert "of 360 beams hit\nsmall with 1 wall, 3 obstacles" in view.text
        assert len(view.scene.scans) == 1
    finally:
        graph.shutdown()


# Several robots, and things of other shapes and colours


def test_shapes_and_colours_of_all_kinds_stand_where_they_are():
    things = World("things", [
        Obstacle("ball", Sphere(0.2), (1.0, 2.0, 0.0), colour="#123456", bottom=0.5),
        Obstacle(
            "pair",
            Compound(((Box(0.2, 0.2), (0, 0, 0)), (Cylinder(0.1), (0.5, 0, 0)))),
            (0.0, 0.0, 0.0),
            0.4,
            bottom=0.1,
        ),
    ])  # fmt: skip
    view = world_3d(things)
    ball = next(part for part in view.scene.parts if part.node == "obstacles/ball")
    assert (ball.colour, ball.solids) == ("#123456", (Ball((0.0, 0.0, 0.7), 0.2),))
    pair = next(part for part in view.scene.parts if part.node == "obstacles/pair")
    assert [type(solid) for solid in pair.solids] == [Prism, Rod]
    assert (pair.solids[0].bottom, pair.solids[0].top) == (0.1, 0.4)


def test_what_solid_walls_go_round_has_a_top():
    ring = [(0, 0, 2, 0), (2, 0, 2, 1), (2, 1, 0, 1), (0, 1, 0, 0)]
    open_, solid = (world_3d(World("block", walls=ring, wall_height=0.4, solid=s)) for s in (False, True))
    assert not [part for part in open_.scene.parts if part.name == "blocks"]
    [top] = [part for part in solid.scene.parts if part.name == "blocks"]
    corners = np.vstack(list(top.solids[0].faces()))
    assert corners.min(axis=0).tolist() == [0, 0, 0.4] and corners.max(axis=0).tolist() == [2, 1, 0.4]


def test_a_replay_of_several_robots_moves_each_and_what_was_pushed():
    own = run()
    crate = SMALL.obstacles[0]
    moved = Moved(crate, np.array([0.0, 12.0]), np.array([(0.0, 0.0, 0.0), (0.5, 0.0, 0.0)]))
    other = replace(own, truth=own.truth + (0.0, 1.0, 0.0), name="robot", model=model("waffle"))
    view = replay_3d(replace(own, name="first", others=(other,), things=(moved,)))
    tracks = keys(view)
    ys = tracks["/meshcat/others/robot", "position"][1][:, 1]
    assert ys[0] == pytest.approx(1.0) and ys[-1] == pytest.approx(other.truth[-1, 1], abs=0.01)
    pushed = tracks[f"/meshcat/obstacles/{crate.name}", "position"][1]
    assert pushed[-1, 0] == pytest.approx(0.5)
    assert [trail.name for trail in view.scene.trails] == ["odometry", "truth", "robot"]
    assert "robot (waffle): " in view.text and "Beside it drive robot." in view.alt


# Shapes


def test_a_run_of_layers_has_its_robots_and_what_lies_on_the_ground():
    times = np.linspace(0.0, 4.0, 9)
    along = np.column_stack([times / 4, 0 * times, 0 * times])
    bodies = (Body("base_link", times, along), Body("/odom", times, along))
    plan = Shapes("/plan", np.array([1.0]), ((Shape("line", along[:, :2]),),))
    view = replay_3d(Run("drive.bag", 0.0, 4.0, bodies, (plan,)), robot="burger")
    assert [name for name in view.scene.nodes if name.startswith(("robots", "others")) and name.count("/") == 1] == [
        "robots/robot"
    ], "what a topic says of the robot is no robot of its own"
    tracks = keys(view)
    assert tracks["/meshcat/robots/robot", "position"][1][-1, 0] == pytest.approx(1.0)
    pasted = view.data["layered"]
    assert [each["name"] for each in pasted["layers"]] == ["/plan"]
    assert [each["name"] for each in pasted["bodies"]] == ["base_link", "/odom"]
    assert view.text.startswith("3D replay: drive.bag: 4.0 s\nbase_link: start (0.00, 0.00, 0.0 deg)")
    assert "rosmini-meshcat-layers.js" in view.scripts
    assert "rosmini-meshcat-layers.js" not in replay_3d(run()).scripts
    flat = replay_3d(Run("drive.bag", 0.0, 4.0, bodies, (plan,)))
    assert flat.data["follow"] is None
    assert not any(name.startswith("robots") for name in flat.scene.nodes)


def test_runs_side_by_side_have_one_clock_and_the_world_once():
    one, other = replay_3d(run()), replay_3d(run(6.0))
    both = replay_3d(run(), run(6.0), names=["as it was", "faster"], title="Two")
    data = both.data
    assert [each["title"] for each in data["runs"]] == ["as it was", "faster"]
    assert data["duration"] == 12.0
    assert [each["duration"] for each in data["runs"]] == [12.0, 6.0]
    assert sum(each["count"] for each in data["runs"]) == len(one.scene.commands) + len(other.scene.commands)
    assert len(data["commands"]) < 1.2 * len(one.data["commands"])
    assert both.text.startswith("Two\nas it was: 3D replay: burger in small, 12.0 s")
    assert both.fallback.count("<svg") == 2
    with pytest.raises(ViewError, match="as many names as runs, not 1 and"):
        replay_3d(run(), names=["one", "two"])
