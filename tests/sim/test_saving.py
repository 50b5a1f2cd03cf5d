"""What was saved is restored: the simulator goes on then as it did, message by message."""

import pickle

import pytest

from rosmini import Graph
from rosmini.core.errors import RosminiError
from rosmini.msgs import message_class
from rosmini.sim.simulator import Simulator

Twist = message_class("geometry_msgs/Twist")
SECOND = 1_000_000_000


class Bench:
    """A simulator with two robots, and a node that hears all and drives."""

    def __init__(self, graph, world="arena"):
        self.graph = graph
        self.robots = ("tb3_0", "tb3_1")
        node = graph.node("simulator")
        for name, value in {"robots": 2, "board": True, "obstacles": True}.items():
            node.set_param(f"~{name}", value)
        self.sim = Simulator(node, world=world)
        self.node = graph.node("ears")
        self.heard = []
        self._drivers = [self.node.publisher(f"{name}/cmd_vel", Twist) for name in self.robots]
        for topic, named in graph.master.getPublishedTopics("/ears", "")[2]:
            if topic not in ("/rosout", "/rosout_agg") and "parameter" not in topic:
                self.node.subscriber(topic, message_class(named), self._ear(topic))
        for driver in self._drivers:
            driver.wait_for_subscribers()

    def _ear(self, topic):
        def hear(message):
            told = type(message)._thaw_numpy(type(message)._freeze(message))
            parts = [told, *getattr(told, "transforms", ()), *getattr(told, "markers", ())]
            for header in (each.header for each in parts if hasattr(each, "header")):
                header.seq = 0
                header.stamp.secs = header.stamp.nsecs = 0  # the node's time, which does not go back
            self.heard.append((topic, type(told)._encode(told)))

        return hear

    def drive(self, seconds):
        """Drive both robots, each its own way."""
        for i, (v, w) in enumerate([(0.2, 0.3), (-0.1, 1.0), (0.22, 0.0), (0.1, -2.0)]):
            for k, driver in enumerate(self._drivers):
                message = Twist()
                message.linear.x, message.angular.z = v, w + 0.1 * k
                driver.publish(message)
            self.graph.run(seconds / 4 + 0.01 * i)

    def to(self, time_ns):
        """Let the graph go on until exactly then."""
        self.graph.scheduler.run(time_ns, None)

    def goes_on(self):
        """What is heard while both drive on."""
        self.heard = []
        self.drive(1.6)
        heard, self.heard = self.heard, []
        return heard


@pytest.fixture
def graph():
    with Graph(seed=3) as made:
        yield made


def test_every_message_is_the_same_after_restoring(graph):
    there = Bench(graph)
    there.drive(0.8)
    graph.run(0.1421)  # no message is on its way then
    state = pickle.loads(pickle.dumps(there.sim.save()))
    first = there.goes_on()
    graph.run(0.0021)  # messages in transit arrive
    there.sim.restore(state)
    assert len(first) > 100
    assert {topic.split("/")[1] for topic, _ in first} >= set(there.robots)
    assert there.goes_on() == first
    with Graph(seed=3) as other:
        again = Bench(other)
        other.run(0.0021)
        again.sim.restore(state)
        again.heard = []
        assert again.goes_on() == first


def test_what_is_on_its_way_when_it_is_saved_belongs_to_the_graph(graph):
    there = Bench(graph)
    start = graph.scheduler.now_ns() - round(there.sim.host.now * SECOND)
    there.drive(0.9)
    there.to(start + SECOND)
    there.heard = []
    state = pickle.loads(pickle.dumps(there.sim.save()))  # just after a step, whose messages have not arrived
    assert there.sim.host.now == pytest.approx(1.0)
    graph.run(0.0001)
    under_way, there.heard = there.heard, []
    assert {topic.split("/")[1] for topic, _ in under_way} >= set(there.robots)
    there.drive(0.9)
    there.to(start + 2 * SECOND)
    first = there.heard
    there.sim.restore(state)
    there.heard = []
    graph.run(0.0001)
    late, there.heard = there.heard, []  # of the moment before it was restored
    assert sorted(topic for topic, _ in late) == sorted(topic for topic, _ in under_way)
    assert late != under_way
    there.drive(0.9)
    there.to(start + 3 * SECOND)
    assert there.heard == first


def test_what_is_no_state_of_it_is_refused(graph):
    there = Bench(graph)
    with Graph() as elsewhere:
        other = Bench(elsewhere, "empty").sim.save()
    graph.run(0.5)
    now = there.sim.host.now
    for state in (None, 3, other, there.sim.save().__dict__):
        with pytest.raises(RosminiError, match=r"can only be restored from|a state of the world"):
            there.sim.restore(state)
    assert there.sim.host.now == now
    there.heard = []
    graph.run(0.5)
    assert there.heard
