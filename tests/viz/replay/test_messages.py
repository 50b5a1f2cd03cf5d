"""Runs from messages: what is found in a bag, by type, and what a bad one says."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from rosmini.core.geometry.angles import quaternion_from_yaw
from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag
from rosmini.ros.bag.mcap import to_mcap
from rosmini.sim.recorder import Recorder
from rosmini.sim.simulator import Simulator
from rosmini.viz import ViewError
from rosmini.viz.replay.grids import Grids
from rosmini.viz.replay.images import Images
from rosmini.viz.replay.layers import Scans, Shapes
from rosmini.viz.replay.messages import BagLog, NothingToSee, run_of
from rosmini.viz.replay.player import replay

from .unpacking import columns

START = 100.0


def made(kind: str, frame: str = "", stamp: float = 0.0, **fields):
    """A message with a header, if it has one."""
    message = message_class(kind)()
    if hasattr(message, "header"):
        message.header.frame_id, message.header.stamp = frame, Time.from_sec(stamp)
    for path, value in fields.items():
        thing, names = message, path.split("__")
        for name in names[:-1]:
            thing = getattr(thing, name)
        setattr(thing, names[-1], value)
    return message


def pose(x: float, y: float, yaw: float = 0.0):
    found = message_class("geometry_msgs/Pose")()
    found.position.x, found.position.y = x, y
    q = found.orientation
    q.x, q.y, q.z, q.w = quaternion_from_yaw(yaw)
    return found


def transform(parent: str, child: str, stamp: float, x: float, y: float = 0.0, yaw: float = 0.0):
    each = made("geometry_msgs/TransformStamped", parent, stamp, child_frame_id=child)
    each.transform.translation.x, each.transform.translation.y = x, y
    q = each.transform.rotation
    q.x, q.y, q.z, q.w = quaternion_from_yaw(yaw)
    return made("tf2_msgs/TFMessage", transforms=[each])


def a_map(cells, frame="map", resolution=0.1, origin=(0.0, 0.0)):
    array = np.asarray(cells, dtype=np.int8)
    height, width = array.shape
    return made(
        "nav_msgs/OccupancyGrid", frame, info__width=width, info__height=height, info__resolution=resolution,
        info__origin=pose(*origin), data=array.ravel(),
    )  # fmt: skip


def path(points, frame="map"):
    poses = [made("geometry_msgs/PoseStamped", frame, pose=pose(*point)) for point in points]
    return made("nav_msgs/Path", frame, poses=poses)


def marker(number=0, kind=8, action=0, points=(), lifetime=0.0, **fields):
    there = [message_class("geometry_msgs/Point")(x=float(x), y=float(y), z=0.0) for x, y in points]
    return made(
        "visualization_msgs/Marker", "map", id=number, type=kind, action=action, points=there, pose=pose(0.0, 0.0),
        lifetime=message_class("visualization_msgs/Marker")().lifetime.from_sec(lifetime), color__b=1.0, **fields,
    )  # fmt: skip


@pytest.fixture
def bag(tmp_path):
    """Writes (time, topic, message) into a bag that can be read."""

    def write(*messages):
        with Bag(tmp_path / "demo.bag", "w") as bag:
            for time, topic, message in messages:
                bag.write(topic, message, Time.from_sec(START + time))
        return Bag(tmp_path / "demo.bag")

    return write


def driving(seconds=4.0, rate=10):
    """Transforms of a robot that drives along x at 0.5 m/s; odometry is 1 m beside the map."""
    for i in range(round(seconds * rate) + 1):
        stamp = START + i / rate
        yield i / rate, "/tf", transform("odom", "base_footprint", stamp, 0.5 * i / rate)
        yield i / rate, "/tf", transform("map", "odom", stamp, 0.0, 1.0)


def layer(run, name):
    return next(each for each in run.layers if each.name == name)


def test_everything_is_found_by_its_type_and_laid_into_the_map(bag):
    scan = made(
        "sensor_msgs/LaserScan", "base_footprint", START + 2.0, angle_min=0.0, angle_increment=0.5, range_min=0.1,
        range_max=3.0, ranges=np.array([1.0, 9.0, 0.05, np.nan], dtype=np.float32),
    )  # fmt: skip
    image = made(
        "sensor_msgs/Image", "camera", width=2, height=1, encoding="rgb8", step=6, data=bytes([255, 0, 0, 0, 0, 0])
    )
    particles = made("geometry_msgs/PoseArray", "map", poses=[pose(1.0, 2.0, 0.5), pose(2.0, 1.0, 0.0)])
    messages = [
        *driving(),
        (0.5, "/map", a_map([[0, 100], [-1, 0]])),
        (1.0, "/move_base/plan", path([(0.0, 0.0), (1.0, 0.0)], "odom")),
        (1.5, "/particlecloud", particles),
        (2.0, "/scan", scan),
        (2.5, "/camera/image", image),
        (3.0, "/frontiers", made("visualization_msgs/MarkerArray", markers=[marker(points=[(1, 1), (2, 2)])])),
    ]
    run = run_of(BagLog(bag(*sorted(messages, key=lambda each: each[0]))))
    assert run.frame == "map"
    assert run.duration == pytest.approx(4.0)
    [robot] = run.bodies
    assert robot.name == "base_footprint"
    assert robot.poses[-1] == pytest.approx((2.0, 1.0, 0.0), abs=1e-6)
    assert layer(run, "/map").grids[0].cells.tolist() == [[0, 100], [255, 0]]
    [line] = layer(run, "/move_base/plan").items[0]
    assert line.points.tolist() == [[0.0, 1.0], [1.0, 1.0]], "odom is 1 m beside the map"
    [arrows] = layer(run, "/particlecloud").items[0]
    assert (arrows.mode, arrows.points[0]) == ("arrows", pytest.approx((1.0, 2.0, 0.5)))
    scans = layer(run, "/scan")
    assert scans.poses[0] == pytest.approx((1.0, 1.0, 0.0))
    assert np.isfinite(scans.ranges[0]).tolist() == [True, False, False, False]
    assert layer(run, "/camera/image").images[0].tolist() == [[48, 0]]
    [points] = layer(run, "/frontiers").items[0]
    assert (points.mode, points.colour, len(points.points)) == ("points", "#0000ff", 2)
    kinds = [type(each) for each in run.layers]
    assert kinds == [Grids, Images, Scans, Shapes, Shapes, Shapes]


def test_a_bag_is_played_by_its_path_and_by_its_method(bag):
    with bag(*driving(), (0.0, "/map", a_map([[0, 100]]))) as given:
        view = given.replay(title="A drive", robot="burger")
        assert view.text.startswith("A drive: 4.0 s, ") and view.text.splitlines()[0].endswith(" map")
        assert "outline" in view.data["bodies"][0]
        same = replay(given.filename, title="A drive", robot="burger")
    assert same.html == view.html
    track = columns(view.data["bodies"][0]["track"], 4)
    assert track[0, 0] == view.data["start"] == 100_000


def test_updates_change_the_map_and_a_stale_one_is_left_out(bag):
    early = made("map_msgs/OccupancyGridUpdate", "map", x=0, y=0, width=1, height=1, data=[5])
    good = made("map_msgs/OccupancyGridUpdate", "map", x=1, y=0, width=1, height=2, data=[7, 8])
    outside = made("map_msgs/OccupancyGridUpdate", "map", x=1, y=1, width=2, height=2, data=[1] * 4)
    run = run_of(
        BagLog(
            bag(
                (0.0, "/map_updates", early),
                (1.0, "/map", a_map([[0, 0], [0, 0]])),
                (2.0, "/map_updates", good),
                (3.0, "/map_updates", outside),
            )
        )
    )
    [grids] = run.layers
    assert [each.cells.tolist() for each in grids.grids] == [[[0, 0], [0, 0]], [[0, 7], [0, 8]]]
    assert any("before the first map" in note for note in run.notes)
    assert any("outside of its map" in note for note in run.notes)


def test_markers_are_there_until_they_are_deleted_or_expire(bag):
    run = run_of(
        BagLog(
            bag(
                (0.0, "/m", marker(1, points=[(1, 1)])),
                (1.0, "/m", marker(2, points=[(2, 2)], lifetime=1.5)),
                (2.0, "/m", marker(1, action=2)),
                (4.0, "/m", marker(3, kind=4, points=[(0, 0), (1, 0)])),
                (5.0, "/m", marker(0, action=3)),
            )
        )
    )
    [shapes] = run.layers
    said = [[(s.mode, *s.points[0].tolist()) for s in item] for item in shapes.items]
    assert said == [
        [("points", 1.0, 1.0)],
        [("points", 1.0, 1.0), ("points", 2.0, 2.0)],
        [("points", 2.0, 2.0)],
        [("line", 0.0, 0.0)],
        [],
    ]


def test_poses_without_a_transform_are_laid_on_the_robots_start_with_a_word(bag):
    truth = [
        (t, "/truth", made("nav_msgs/Odometry", "world", START + t, pose__pose=pose(5.0, 5.0 + t, math.pi / 2)))
        for t in (0.0, 0.5, 1.0, 1.5, 2.0)
    ]
    run = run_of(BagLog(bag(*sorted([*driving(2.0), *truth], key=lambda each: each[0]))))
    body = next(each for each in run.bodies if each.name == "/truth")
    assert body.poses[0] == pytest.approx(run.bodies[0].poses[0])
    assert body.poses[-1, :2] - body.poses[0, :2] == pytest.approx((2.0, 0.0), abs=1e-6)
    assert "/truth is in the frame world" in run.notes[0]


def test_odometry_from_before_the_first_transform_does_not_move_what_comes_later(bag):
    """amcl speaks half a second after the robot: what odometry says until then cannot be laid into the map."""
    late = [each for each in driving(2.0) if each[2].transforms[0].child_frame_id != "odom" or each[0] >= 0.5]
    odometry = [
        (t, "/odom", made("nav_msgs/Odometry", "odom", START + t, pose__pose=pose(0.5 * t, 0.0)))
        for t in (0.0, 0.25, 0.5, 1.0, 1.5, 2.0)
    ]
    run = run_of(BagLog(bag(*sorted([*late, *odometry], key=lambda each: each[0]))))
    body = next(each for each in run.bodies if each.name == "/odom")
    assert body.times - START == pytest.approx((0.5, 1.0, 1.5, 2.0))
    assert body.poses[:, :2] == pytest.approx(np.array([(0.25, 1.0), (0.5, 1.0), (0.75, 1.0), (1.0, 1.0)]))
    assert run.notes == ()


def test_turtles_are_bodies(bag):
    poses = [(i / 10, "/turtle1/pose", made("turtlesim/Pose", x=5.5 + i / 10, y=5.5, theta=0.0)) for i in range(11)]
    [turtle] = run_of(BagLog(bag(*poses))).bodies
    assert turtle.poses[-1] == pytest.approx((6.5, 5.5, 0.0), abs=1e-6)


# ---- bad input ----


def test_an_empty_bag_and_one_without_anything_to_see_say_so(bag):
    with pytest.raises(ViewError, match=r"demo\.bag contains no messages"):
        run_of(BagLog(bag()))
    text = made("std_msgs/String", data="hello")
    with pytest.raises(NothingToSee, match=r"nothing in demo\.bag .*: it has /chatter \[std_msgs/String\]"):
        run_of(BagLog(bag((0.0, "/chatter", text))))


def test_a_topic_or_frame_that_is_not_there_is_named(bag):
    log = BagLog(bag(*driving(1.0)))
    with pytest.raises(ViewError, match=r"has no message on '/tff'"):
        run_of(log, topics=["/tff"])
    with pytest.raises(ViewError, match=r"the frame 'moon'.*base_footprint, map, odom"):
        run_of(log, frame="moon")


def test_maps_of_no_size_and_of_the_wrong_size_are_left_out_with_a_word(bag):
    wrong = a_map([[0, 0]])
    wrong.info.width = 7
    turned = a_map([[0, 0]])
    turned.info.origin.position.x = math.nan
    given = bag(
        (0.0, "/map", a_map(np.zeros((0, 0)))), (1.0, "/map", wrong), (2.0, "/map", turned),
        (3.0, "/map", a_map([[0, 100]])),
    )  # fmt: skip
    run = run_of(BagLog(given))
    assert len(layer(run, "/map").grids) == 1
    said = " ".join(run.notes)
    for reason in ("0 x 0 cells", "has data for 2", "nan or infinite"):
        assert reason in said


def test_a_map_of_4000_cells_a_side_is_small_in_the_page(bag):
    cells = np.full((4000, 4000), -1, dtype=np.int8)
    cells[500:3500, 500:3500] = 0
    cells[500:3500:50, 500] = 100
    view = bag((0.0, "/map", a_map(cells, resolution=0.05))).replay()
    assert "500 x 500 cells of 0.400 m" in view.text
    assert view.still.svg.count("#708986") == 1, "what is unknown is one rectangle below the rest"
    assert len(view.still.svg) < 30_000
    assert len(view.html.encode()) < 100_000


def test_numbers_that_are_none_are_left_out(bag):
    bad = path([(math.nan, 0.0), (1.0, 1.0)])
    none = path([(math.inf, 0.0)])
    scan = made("sensor_msgs/LaserScan", "map", angle_increment=math.nan, ranges=np.zeros(3, dtype=np.float32))
    run = run_of(BagLog(bag((0.0, "/a", bad), (1.0, "/b", none), (2.0, "/scan", scan))))
    assert [each.name for each in run.layers] == ["/a"]
    assert layer(run, "/a").items[0][0].points.tolist() == [[1.0, 1.0]]
    assert len(run.notes) == 2


def test_a_quaternion_of_zeros_is_no_rotation_and_one_of_nan_is_left_out(bag):
    unset = a_map([[0, 100]])
    unset.info.origin.orientation.w = 0.0
    bad = a_map([[100, 0]])
    bad.info.origin.orientation.w = math.nan
    run = run_of(BagLog(bag((0.0, "/map", unset), (1.0, "/map", bad))))
    [only] = layer(run, "/map").grids
    assert only.origin == (0.0, 0.0, 0.0)
    assert "a quaternion is not finite" in run.notes[0]


def test_clocks_that_jump_back_break_nothing(bag):
    again = [(time + 3.0, topic, message) for time, topic, message in driving(2.0)]  # stamps begin anew
    run = run_of(BagLog(bag(*driving(2.0), *again, (5.0, "/map", a_map([[0]])))))
    [robot] = run.bodies
    assert (np.diff(robot.times) > 0).all()
    assert replay(run).html


def test_twenty_thousand_messages_become_a_small_page(bag):
    one = path([(0.0, 0.0), (1.0, 1.0)])
    many = ((i / 200, "/plan", one) for i in range(20_000))
    run = run_of(BagLog(bag(*many)))
    plans = layer(run, "/plan")
    assert plans.found == 20_000
    assert plans.count <= 260
    assert plans.times[-1] == pytest.approx(START + 99.995), "the last one is there"
    assert len(json.dumps(run.data())) < 20_000


# ---- beside a recording ----


def test_a_recorder_with_layers_keeps_what_can_be_seen_and_a_window_what_is_in_force():
    graph = Graph()
    recorder = Recorder(graph, Simulator(graph.node("simulator")), layers=True)
    maps = graph.node("map_server").publisher("/map", message_class("nav_msgs/OccupancyGrid"), latch=True)
    maps.publish(a_map([[0, 100]]))
    graph.run(2.0)
    recording = recorder.recording()
    assert "/map" in {topic for _, topic, _ in recording.messages}
    view = recording.replay()
    [layer] = view.data["layers"]
    assert (layer["kind"], layer["name"]) == ("grid", "/map")
    assert "/map: 1 message, the last 2 x 1 cells" in view.text
    plain = recording.replay(topics=())
    assert "layers" not in plain.data


def test_of_the_images_of_a_camera_a_recorder_keeps_one_a_second():
    """30 a second, of 1920 x 1080 pixels, filled four gigabytes in the eight seconds that a chapter records.

    Between them nobody subscribes, so that the camera need not render: that took 40 seconds.
    """
    graph = Graph()
    recorder = Recorder(graph, Simulator(graph.node("simulator")), layers=True)
    camera = graph.node("camera")
    images = camera.publisher("/camera/image", message_class("sensor_msgs/Image"), latch=True)
    image = made("sensor_msgs/Image", "camera", width=2, height=1, encoding="rgb8", step=6, data=bytes(6))
    rendered = []

    def render(_event):
        if images.num_connections():
            rendered.append(graph.scheduler.now_ns())
            images.publish(image)

    camera.timer(1 / 30, render)
    graph.run(4.0)
    assert len(rendered) <= 6
    kept = [time for time, topic, _ in recorder.recording().messages if topic == "/camera/image"]
    assert 4 <= len(kept) <= 5


def test_a_topic_without_a_message_in_this_run_is_no_error_but_an_unknown_one_is():
    """A cell with a replay that is run again, when the robot is already at its goal, records no plan."""
    graph = Graph()
    recorder = Recorder(graph, Simulator(graph.node("simulator")), layers=True)
    planner = graph.node("planner")
    planner.publisher("/map", message_class("nav_msgs/OccupancyGrid"), latch=True).publish(a_map([[0, 100]]))
    planner.publisher("/plan", message_class("nav_msgs/Path"))
    graph.run(2.0)
    recording = recorder.recording()
    assert "/plan: no message in this time." in recording.replay(topics=["/map", "/plan"]).text.splitlines()
    with pytest.raises(NothingToSee, match="/plan: no message in this time"):
        recording.replay(topics=["/plan"])
    with pytest.raises(ViewError, match=r"no message on '/plam'.*/plan"):
        recording.replay(topics=["/plam"])


def test_odometry_of_a_robot_with_a_prefix_is_not_drawn_twice():
    graph = Graph()
    graph.node("owner").set_param("/simulator/robots", [{"name": "amy", "x": 1.0, "y": 0.5}, {"name": "bob"}])
    recorder = Recorder(graph, Simulator(graph.node("simulator")), layers=True)
    graph.run(2.0)
    view = recorder.recording().replay()
    assert "odom" not in view.text.partition("recorded")[2]


@pytest.mark.parametrize(
    ("first", "map_at"),
    [
        pytest.param((0.0, 0.0, 0.0), (1.0, 0.5), id="SLAM"),
        pytest.param((0.02, -0.05, 0.01), (1.0, 0.5), id="amcl on a map that SLAM has saved"),
        pytest.param((1.02, 0.45, math.pi / 2), (0.0, 0.0), id="amcl on a map of the world"),
        pytest.param((3.0, 2.0, 0.0), (0.0, 0.0), id="amcl that is lost"),
    ],
)
def test_a_map_is_laid_on_the_world(first, map_at):
    graph = Graph()
    simulator = Simulator(graph.node("simulator"))
    simulator.place((1.0, 0.5, math.pi / 2))
    recorder = Recorder(graph, simulator, layers=True)
    slam = graph.node("slam")
    sender = slam.publisher("/tf", message_class("tf2_msgs/TFMessage"))
    maps = slam.publisher("/map", message_class("nav_msgs/OccupancyGrid"), latch=True)
    for _ in range(20):
        graph.run(0.1)
        pose = simulator.odometry
        base = transform("odom", "base_footprint", graph.now().to_sec(), *pose)
        here = transform("map", "odom", graph.now().to_sec(), *first)
        sender.publish(made("tf2_msgs/TFMessage", transforms=[*base.transforms, *here.transforms]))
    maps.publish(a_map([[0, 100]]))
    graph.run(0.5)
    view = recorder.recording().replay()
    place = columns(view.data["layers"][0]["places"], 8)[0]
    assert place[3:5] / 1000 == pytest.approx(map_at, abs=0.01)
    [believed] = view.data["bodies"]
    assert (believed["name"], believed["colour"]) == ("base_footprint in map", "purple"), "the true path is blue"


def test_an_mcap_file_is_played_as_the_bag_it_was_made_from(bag, tmp_path):
    pytest.importorskip("mcap")
    source = bag(*driving())
    to_mcap(source, tmp_path / "demo.mcap")
    played, wanted = replay(tmp_path / "demo.mcap"), replay(source)
    assert {**played.data, "name": ""} == {**wanted.data, "name": ""}
    assert played.text.startswith("Replay of demo.mcap: 4.0 s")
