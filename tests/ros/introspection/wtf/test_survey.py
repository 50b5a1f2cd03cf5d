"""What a graph is asked."""

from __future__ import annotations

from rosmini import Graph
from rosmini.msgs.std_msgs.msg import Int32, String
from rosmini.msgs.std_srvs.srv import Empty, EmptyResponse
from rosmini.ros.introspection.wtf.survey import survey


def test_a_graph_in_this_process_answers_for_all_its_nodes() -> None:
    with Graph() as graph:
        talker, listener = graph.node("talker"), graph.node("listener")
        talker.publisher("chatter", String)
        listener.subscriber("chatter", String, print)
        listener.subscriber("number", Int32, print)
        listener.service("go", Empty, lambda _: EmptyResponse())
        listener.set_param("/rate", 5)
        graph.run(0.1)
        found = survey(graph)
        assert found.nodes["/talker"].published["/chatter"] == "std_msgs/String"
        assert ("/chatter", talker.uri) in found.nodes["/listener"].sources
        assert found.types("/number") == {"std_msgs/Int32": ["/listener"]}
        assert found.publishers["/chatter"] == ("/talker",)
        assert found.services["/go"] == ("/listener",)
        assert (found.parameter("rate"), found.parameter("rate", "x"), found.parameter("none")) == (5, None, None)
        assert not any(node.silence for node in found.nodes.values())


def test_messages_that_queues_drop_are_counted_by_connection() -> None:
    with Graph() as graph:
        talker, listener = graph.node("talker"), graph.node("listener")
        listener.subscriber("n", Int32, lambda _: listener.sleep(1.0), queue_size=1)
        publisher = talker.publisher("n", Int32)
        publisher.wait_for_subscribers()
        for number in range(10):
            publisher.publish(number)
        graph.run(5.0)
        found = survey(graph)
    sent, received = (
        next(flow for flow in found.nodes[name].flows if flow.topic == "/n") for name in ("/talker", "/listener")
    )
    assert sent == ("/n", "/talker", "/listener", "publisher", 0)
    assert received == ("/n", "/talker", "/listener", "subscriber", 8)


def test_nodes_that_do_not_answer_or_answer_nonsense_are_silent() -> None:
    class Peers:
        transport = scheduler = property(lambda self: self)
        master_uri = ""

        def ask_as(self, _name: str) -> Peers:
            return self

        def ask(self, _method: str) -> object:
            return [[["/x", ["/gone", "/odd"]]], [], []]

        def find(self, method: str, name: str) -> object:
            return {"/odd": "http://odd:1/"}.get(name) if method == "lookupNode" else 7

        def call(self, _uri: str, _method: str, *_: object) -> object:
            return [1, "", 7]

    found = survey(Peers())  # type: ignore[arg-type]
    assert "has no address" in found.nodes["/gone"].silence
    assert "[/odd] answers what no ROS node does" in found.nodes["/odd"].silence
    assert found.parameters == {}
