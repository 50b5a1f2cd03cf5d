"""What all sensors share, shown with one that is a single small file."""

import pickle

import pytest

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import Box, Obstacle, World

from .ultrasonic import Ultrasonic

WALL = World("wall", obstacles=(Obstacle("barrier", Box(0.2, 4.0), (2.1, 0.0, 0.0), height=1.0),))


@pytest.fixture
def simulator():
    with Graph() as graph:
        node = graph.node("simulator")
        node.set_param("~tf_prefix", "tb3")
        yield Simulator(node, world=WALL)


def hear(simulator, topic, kind="sensor_msgs/Range"):
    heard = []
    simulator.node.graph.node("ears").subscriber(topic, message_class(kind), heard.append)
    return heard


def test_a_new_sensor_is_one_file(simulator):
    sonar = simulator.robot().add(Ultrasonic, noise=0.0)
    heard = hear(simulator, "sonar")
    simulator.node.graph.run(1.05)
    assert len(heard) == pytest.approx(10, abs=1)
    last = heard[-1]
    assert (last.header.frame_id, last.radiation_type) == ("tb3/sonar_link", last.ULTRASOUND)
    assert last.header.stamp.to_sec() == pytest.approx(simulator.host.stamp.to_sec(), abs=0.1)
    assert last.range == pytest.approx(1.95, abs=1e-6)
    assert [message.header.seq for message in heard] == list(range(1, len(heard) + 1))
    assert sonar.name == "burger/sonar"


def test_it_samples_only_while_somebody_listens_and_what_it_keeps_is_saved(simulator):
    graph = simulator.node.graph
    sonar = simulator.robot().add(Ultrasonic)
    before = sonar.rng.bit_generator.state
    graph.run(1.0)
    assert sonar.rng.bit_generator.state == before
    heard = hear(simulator, "sonar")
    graph.run(0.55)
    state = pickle.loads(pickle.dumps(simulator.save()))
    heard.clear()
    graph.run(1.0)
    once = [message.range for message in heard]
    simulator.restore(state)
    heard.clear()
    graph.run(1.0)
    assert [message.range for message in heard] == once
    assert len(set(once)) > 5


def test_a_sample_of_nothing_is_not_published(simulator):
    simulator.robot().add(Ultrasonic)
    simulator.place((0.0, 0.0, 3.14))
    heard = hear(simulator, "sonar")
    simulator.node.graph.run(1.0)
    assert heard == []


def test_sensors_of_several_robots_have_topics_and_names_of_their_own(simulator):
    other = simulator.spawn("other", pose=(0.0, 1.0, 0.0))
    for robot in (simulator.robot(), other):
        robot.add(Ultrasonic)
    with pytest.raises(RosminiError, match="has a device 'other/sonar' already"):
        other.add(Ultrasonic)
    heard = hear(simulator, "other/sonar")
    simulator.node.graph.run(0.5)
    assert heard[-1].header.frame_id == "other/sonar_link"
    simulator.delete("other")
    simulator.node.graph.run(0.1)
    topics = {name for name, _ in simulator.node.graph.master.getPublishedTopics("/test", "")[2]}
    assert "/sonar" in topics
    assert "/other/sonar" not in topics
