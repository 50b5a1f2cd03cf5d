"""What was recorded, as calls from one to another."""

from __future__ import annotations

import pytest

from rosmini import Graph
from rosmini.core.errors import RosminiError
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Trigger


@pytest.fixture
def graph():
    with Graph() as graph:
        graph.run(0.1)
        yield graph


def talk(graph):
    graph.node("listener").subscriber("chatter", String, lambda _: None)
    talker = graph.node("talker").publisher("chatter", String)
    talker.wait_for_subscribers()
    talker.publish("hello")
    graph.run(0.1)


REGISTRATION = [
    ("/listener", "Master", "registerSubscriber(/chatter, std_msgs/String)", "[]"),
    ("/talker", "Master", "registerPublisher(/chatter, std_msgs/String)", "[/listener]"),
    ("Master", "/listener", "publisherUpdate(/chatter, [/talker])", "1"),
    ("/listener", "/talker", "requestTopic(/chatter)", "INPROC"),
    ("/listener", "/talker", "connection header: /chatter, std_msgs/String", None),
    ("/talker", "/listener", "/chatter: 'hello'", None),
]


def test_registration_and_a_message_are_drawn_from_what_happened(graph):
    with graph.record() as recording:
        talk(graph)
    assert recording.calls() == REGISTRATION
    assert recording.calls("/chatter") == REGISTRATION
    picture = recording.show("/chatter", title="Figure 1")
    assert picture.text.startswith("Figure 1: 6 calls between 3\n  /listener -> Master: registerSubscriber")


def test_names_of_nodes_choose_what_goes_between_them(graph):
    with graph.record() as recording:
        talk(graph)
        graph.node("other").subscriber("chatter", String, lambda _: None)
        graph.run(0.1)
    assert recording.calls("/listener", "/talker") == REGISTRATION
    assert {who for who, *_ in recording.calls("/other")} == {"/other"}
    assert recording.calls("/other", "/chatter") == recording.calls("/other")
    assert len(recording.calls(everything=True)) > len(recording.calls())


def test_a_service_call_has_its_answer_beside_it_unless_something_came_between(graph):
    server = graph.node("server")
    said = server.publisher("said", String)
    graph.node("listener").subscriber("said", String, lambda _: None)
    server.service("quiet", Trigger, lambda _: (True, ""))

    def loud(_):
        said.publish("I am asked")
        server.sleep(0.1)
        return True, ""

    server.service("loud", Trigger, loud)
    client = graph.node("client")
    graph.run(0.1)
    with graph.record() as recording:
        client.service_client("quiet", Trigger)()
        client.service_client("loud", Trigger)()
    assert [call for call in recording.calls() if call[1] != "Master"] == [
        ("/client", "/server", "/quiet()", "success: True"),
        ("/client", "/server", "/loud()", None),
        ("/server", "/listener", "/said: 'I am asked'", None),
        ("/server", "/client", "answer of /loud: success: True", None),
    ]
    assert ("/client", "Master", "lookupService(/quiet)", "/server") in recording.calls()


def test_a_span_of_time_and_a_limit(graph):
    recording = graph.record()
    talk(graph)
    then = graph.now().to_sec()
    graph.run(1)
    graph.nodes["/talker"].publications["/chatter"].handles[0].publish("again")
    graph.run(0.1)
    assert recording.calls(since=then + 0.5) == [("/talker", "/listener", "/chatter: 'again'", None)]
    assert recording.show(limit=2).text.startswith("What happened (and 5 more calls after these): 2 calls")


def test_a_message_from_a_node_to_itself_is_recorded_but_not_its_connection(graph):
    server = graph.node("server")
    goals = server.publisher("goal", String)
    server.subscriber("goal", String, lambda _: None)
    with graph.record() as recording:
        graph.run(0.1)
        goals.publish("there")
        graph.run(0.1)
    assert recording.calls("/goal") == [("/server", "/server", "/goal: 'there'", None)]


def test_a_misspelt_name_is_answered_with_the_nearest(graph):
    recording = graph.record()
    with pytest.raises(RosminiError, match=r"nothing was recorded about /chater: let time pass"):
        recording.show("/chater")
    talk(graph)
    with pytest.raises(RosminiError, match=r"/chater: .*/chatter"):
        recording.show("/chater")


def test_recording_changes_nothing_and_repeats_itself():
    def run(*, record):
        heard = []
        with Graph() as graph:
            recording = graph.record() if record else None
            talk(graph)
            graph.node("late").subscriber("chatter", String, lambda message: heard.append(message.data))
            graph.run(0.1)
            graph.nodes["/talker"].publications["/chatter"].handles[0].publish("again")
            graph.run(1)
            return heard, graph.now(), recording and recording.calls(everything=True)

    first, second, plain = run(record=True), run(record=True), run(record=False)
    assert first == second
    assert first[:2] == plain[:2]
