"""Things as markers, and back; and a recorder that reads them."""

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.markers import ADD, DELETE, Markers, MarkersError, first_poses, obstacles_of
from rosmini.sim.models import BURGER
from rosmini.sim.recorder import Recorder
from rosmini.sim.recording import Moved, Recording
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, Walk, World

STAMP = (3, 500)
THINGS = [
    Obstacle("crate", Box(0.4, 0.2), (1.0, 2.0, 0.5), 0.3, "#c05020"),
    Obstacle("post", Cylinder(0.1), (1.0, -2.0, 0.0), 0.7, "#102030", bottom=0.2),
    Obstacle("ball", Sphere(0.15), (0.0, 1.0, 0.0), colour="#00ff00"),
    Obstacle("wedge", Polygon(((0, 0), (1, 0), (0, 1))), (1.0, 0.0, 3.0), 0.4, "#808080"),
    Obstacle("pair", Compound(((Box(0.2, 0.1), (0.3, 0, 0)), (Cylinder(0.1), (0, 0.5, 0)))), (2.0, 2.0, 1.0), 0.6,
        "#112233"),
]  # fmt: skip
WALKING = World(
    "walk",
    [
        Obstacle("walker", Cylinder(0.1), (2.0, 2.0, 0.0), 0.5, "orange", motion=Walk(((2.0, 2.0), (2.0, 0.0)), 0.5)),
        Obstacle("crate", Box(0.3, 0.3), (0.5, 0.0, 0.0), 0.3, mass=0.2),
        Obstacle("rock", Box(0.3, 0.3), (-2.0, 0.0, 0.0), 0.3),
    ],
    starts=((0.0, 0.0, 0.0), (-1.0, 1.0, 0.0)),
)


@pytest.mark.parametrize("thing", THINGS, ids=lambda thing: thing.name)
def test_a_thing_comes_back_from_its_markers(thing):
    message = Markers("map").message([thing], STAMP)
    found = obstacles_of(message)[thing.name]
    if isinstance(thing.shape, Compound):
        assert first_poses(message)["pair"] == pytest.approx(found.pose)
    else:
        assert found.pose == pytest.approx(thing.pose)
    assert (found.height, found.colour) == (pytest.approx(thing.height), thing.colour)
    assert found.bottom == pytest.approx(thing.bottom)
    one, other = World("w", [thing]), World("w", [found])
    np.testing.assert_allclose(one.segments, other.segments, atol=1e-9)
    np.testing.assert_allclose(sorted(one.discs.tolist()), sorted(other.discs.tolist()), atol=1e-9)


def test_markers_say_what_rviz_needs():
    [marker] = Markers("map").message(THINGS[:1], STAMP).markers
    assert (marker.ns, marker.id, marker.type, marker.action) == ("crate", 0, 1, ADD)
    assert (marker.header.frame_id, marker.header.stamp.secs, marker.header.stamp.nsecs) == ("map", 3, 500)
    assert (marker.scale.x, marker.scale.y, marker.scale.z) == (0.4, 0.2, 0.3)
    assert marker.pose.position.z == pytest.approx(0.15)
    assert (marker.color.r, marker.color.a) == (pytest.approx(0xC0 / 255), 1.0)


def test_what_is_gone_is_deleted_once():
    markers = Markers()
    markers.message(THINGS, STAMP)
    gone = markers.message(THINGS[:-1], STAMP).markers
    assert [(m.ns, m.id) for m in gone if m.action == DELETE] == [("pair", 0), ("pair", 1)]
    assert all(m.action == ADD for m in markers.message(THINGS[:-1], STAMP).markers)


def test_an_arrow_is_no_thing():
    message = Markers().message(THINGS[:1], STAMP)
    message.markers[0].type = 0
    with pytest.raises(MarkersError, match="'crate' 0 has the type 0"):
        obstacles_of(message)


def drive(graph, topic, v, w, seconds):
    publisher = graph.node(topic.strip("/").replace("/", "_") + "_driver").publisher(
        topic, message_class("geometry_msgs/Twist")
    )
    graph.run(0.05)
    for _ in range(round(seconds * 5)):
        message = message_class("geometry_msgs/Twist")()
        message.linear.x, message.angular.z = v, w
        publisher.publish(message)
        graph.run(0.2)


@pytest.fixture
def simulated():
    with Graph() as graph:
        node = graph.node("simulator")
        node.set_param("~obstacles", True)
        node.set_param("~noise", 0.0)
        yield graph, Simulator(node, world=WALKING, model="burger")


def test_several_robots_and_what_moves_are_recorded_from_messages(simulated):
    graph, simulator = simulated
    simulator.spawn("tb3_1", "waffle", (-1.0, 1.0, 0.0))
    recorder = Recorder(graph, simulator)
    drive(graph, "/cmd_vel", 0.2, 0.0, 4.0)
    recording = recorder.recording()
    assert recording.name == "burger"
    assert [(run.name, run.model.name) for run in recording.others] == [("tb3_1", "waffle")]
    assert recording.truth[-1] == pytest.approx(simulator.truth(), abs=0.01)
    assert recording.others[0].truth[-1] == pytest.approx((-1.0, 1.0, 0.0))
    things = {thing.obstacle.name: thing for thing in recording.things}
    assert set(things) == {"crate", "walker"}
    assert things["walker"].distance == pytest.approx(0.5 * 4.0, abs=0.15)
    crate = things["crate"]
    assert crate.obstacle.pose == pytest.approx((0.5, 0.0, 0.0))
    now = {o.name: o for o in simulator.engine.obstacles()}
    world = recording.world_at(float(recording.times[-1]))
    seen = {o.name: o for o in world.obstacles}
    assert seen["crate"].pose == pytest.approx(now["crate"].pose, abs=0.05)
    assert seen["crate"].pose[0] > 0.6 and seen["rock"].pose == (-2.0, 0.0, 0.0)


def test_states_of_gazebo_tell_where_things_are():
    with Graph() as graph:
        simulator = Simulator(graph.node("simulator"), world=WALKING, model="burger")
        recorder = Recorder(graph, simulator, things="/gazebo/model_states")
        states, pose = message_class("gazebo_msgs/ModelStates"), message_class("geometry_msgs/Pose")
        publisher = graph.node("gazebo").publisher("/gazebo/model_states", states)
        graph.run(0.1)
        for x in (0.5, 0.7):
            there = pose()
            there.position.x, there.orientation.w = x, 1.0
            publisher.publish(states(name=["crate", "burger"], pose=[there, pose()], twist=[]))
            graph.run(0.5)
        [crate] = recorder.recording().things
        assert crate.obstacle.name == "crate" and crate.poses[-1][0] == 0.7


def test_the_simulator_says_nothing_of_obstacles_unless_asked():
    with Graph() as graph:
        Simulator(graph.node("simulator"), world=WALKING)
        assert "nobody publishes" in graph.who_publishes("/obstacles")


def moved(*poses):
    return Moved(THINGS[0], np.arange(len(poses), dtype=float), np.array(poses, dtype=float))


def test_a_thing_is_between_where_it_was_seen():
    thing = moved((0, 0, 0), (1, 0, 0), (1, 2, 0))
    assert thing.at(0.25).pose == pytest.approx((0.25, 0, 0))
    assert thing.at(9.0).pose == pytest.approx((1, 2, 0))
    assert thing.distance == pytest.approx(3.0)
    part = thing.window(0.5, 1.5)
    assert part.poses.tolist() == [[0.5, 0, 0], [1, 0, 0], [1, 1, 0]]


def still(name, **more):
    times = np.array([0.0, 1.0, 2.0])
    return Recording(
        WALKING, BURGER, times, np.zeros((3, 3)), np.zeros((3, 3)), np.empty((0, 3)), np.empty(0), np.empty((0, 360)),
        name=name, **more,
    )  # fmt: skip


def test_a_recording_names_all_robots():
    assert "a and b" in repr(still("a", others=(still("b"),)))
