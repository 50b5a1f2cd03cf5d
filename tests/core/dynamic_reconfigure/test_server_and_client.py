"""Servers and clients on nodes, in both clocks."""

from __future__ import annotations

import pytest

from rosmini.core.dynamic_reconfigure import (
    Client,
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
    Server,
)
from rosmini.core.errors import ROSException
from rosmini.msgs.dynamic_reconfigure.msg import Config as ConfigMessage
from rosmini.msgs.dynamic_reconfigure.msg import GroupState, IntParameter
from rosmini.msgs.dynamic_reconfigure.srv import Reconfigure

from .conftest import TREE
from .test_description import Settings


class Served:
    """A server that notes the calls of its callback."""

    def __init__(self, graph, source=TREE, namespace=""):
        self.node = graph.node("tuned")
        self.calls = []
        self.server = Server(self.node, source, self.callback, namespace)

    def callback(self, config, level):
        self.calls.append((config, level))
        return config


def test_a_change_reaches_the_node_the_parameter_server_and_other_clients(graph):
    served = Served(graph)
    heard, described = [], []
    other = Client(graph.node("gui"), "tuned", 5, heard.append, described.append)
    client = Client(graph.node("client"), "/tuned", timeout=5)
    answer = client.update_configuration({"gain": 99, "window": "7", "on": "yes"})
    assert (answer["gain"], answer.window, answer["on"]) == (10.0, 7, True)
    assert [level for _, level in served.calls] == [-1, 1 | 2 | 8]
    assert served.node.get_param("~gain") == 10.0
    graph.run(100.0, until=lambda: len(heard) >= 1 and heard[-1]["gain"] == 10.0)
    assert other.get_configuration(1.0) == heard[-1]
    assert [one["name"] for one in described[0]] == ["gain", "mode", "window", "on", "depth"]
    assert described[0][0]["max"] == 10.0


def test_groups(graph):
    served = Served(graph)
    client = Client(graph.node("client"), "tuned", 5)
    tree = client.get_group_descriptions(5)
    assert tree["groups"]["Filter"]["type"] == "collapse"
    assert [one["name"] for one in tree.groups.Filter.parameters] == ["window", "on"]
    assert served.calls[0][0]["groups"]["groups"]["Filter"]["state"] is False
    answer = client.update_configuration({"groups": {"Filter": True, "Deep": False}, "depth": 2})
    inner = answer["groups"]["groups"]["Filter"]
    assert (inner.state, inner.groups.Deep.state, inner.groups.Deep.parameters.depth) == (True, False, 2.0)
    assert served.calls[-1][0].groups.groups.Filter.state is True
    assert served.calls[-1][1] == 16
    kept = served.server.update_configuration({"gain": 2})
    assert kept.groups.groups.Filter.state is True
    with pytest.raises(DynamicReconfigureParameterException, match="did you mean Filter"):
        client.update_configuration({"groups": {"Filterr": True}})


def test_values_on_the_parameter_server_come_first_and_are_limited(sim, capsys):
    setter = sim.node("setter")
    setter.set_param("/tuned/inner/gain", 3)
    setter.set_param("/tuned/inner/window", 1000.4)
    served = Served(sim, namespace="inner")
    said = capsys.readouterr().err
    assert "/tuned/inner/window is 1000" in said
    assert "99 is used, as its range is 1 ... 99" in said
    assert (served.server.config.gain, served.server.config.window) == (3.0, 99)
    assert served.node.get_param("/tuned/inner/window") == 99
    setter.set_param("/tuned/gain", "much")
    with pytest.raises(DynamicReconfigureParameterException, match=r"/tuned/gain has the type double.*set it again"):
        Server(served.node, TREE, served.callback)


def test_typed_parameters_are_served(graph):
    served = Served(graph, Settings)
    client = Client(graph.node("client"), "tuned", 5)
    assert client.update_configuration({"rate": -3, "window": 3})["rate"] == 0.0
    assert served.calls[-1][1] == 3
    assert Settings.read(served.node) == Settings(rate=0.0, name="laser", window=3)


def test_the_callback_has_the_last_word_and_a_copy(sim):
    node = sim.node("tuned")
    seen = []

    def callback(config, level):
        config.gain = min(config.gain, 4)
        seen.append(config)
        return {"gain": config.gain}

    server = Server(node, TREE, callback)
    assert server.update_configuration({"gain": 9, "mode": "fast"}).gain == 4.0
    assert server.config["mode"] == "fast"
    seen[-1]["mode"] = "broken"
    assert server.config["mode"] == "fast"
    assert node.get_param("~gain") == 4.0


def test_a_callback_that_fails_changes_nothing(graph, capsys):
    node = graph.node("tuned")
    answers = {"fast": None, "typo": {"gian": 1}, "text": {"gain": "much"}}

    def callback(config, level):
        if config.mode == "raise":
            raise ValueError("cannot do that")
        return answers.get(config.mode, config)

    server = Server(node, TREE, callback)
    client = Client(graph.node("client"), "tuned", 5)
    for mode, problem in (("raise", "cannot do that"), ("fast", "returned nothing")):
        with pytest.raises(DynamicReconfigureCallbackException, match=problem):
            client.update_configuration({"mode": mode, "gain": 7})
    for mode, problem in (("typo", "did you mean gain"), ("text", "the str 'much'")):
        with pytest.raises(DynamicReconfigureParameterException, match=problem):
            server.update_configuration({"mode": mode})
    assert (server.config.mode, node.get_param("~gain")) == ("slow", 1.5)
    assert server.update_configuration({"gain": 2.5}).gain == 2.5
    capsys.readouterr()


def test_a_callback_cannot_change_the_configuration_by_the_server(sim):
    node = sim.node("tuned")
    servers = []

    def callback(config, level):
        for one in servers:
            one.update_configuration({"gain": 2})
        return config

    servers.append(Server(node, TREE, callback))
    with pytest.raises(DynamicReconfigureCallbackException, match="cannot call update_configuration"):
        servers[0].update_configuration({"gain": 3})


def test_changes_come_one_after_another_though_the_callback_blocks(graph):
    node = graph.node("tuned")
    events = []

    def callback(config, level):
        events.append(("begin", config.gain))
        node.sleep(0.5)
        events.append(("end", config.gain))
        return config

    Server(node, TREE, callback)
    clients = [graph.node(f"client{count}") for count in range(3)]
    for count, one in enumerate(clients):
        client = Client(one, "tuned", 5)
        one.run(lambda client=client, count=count: client.update_configuration({"gain": count}))
    graph.run(100.0, until=lambda: len(events) == 8)
    assert all(events[index][0] == "begin" and events[index + 1] == ("end", events[index][1]) for index in (0, 2, 4, 6))
    assert sorted(value for _, value in events[2::2]) == [0.0, 1.0, 2.0]


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"gian": 1}, "did you mean gain"),
        ({"gain": "much"}, "'much' cannot be converted to it"),
        ({"gain": None}, "None cannot be converted to it"),
        ({"window": float("inf")}, "inf cannot be converted to it"),
    ],
)
def test_changes_that_a_client_refuses(sim, changes, problem):
    Served(sim)
    client = Client(sim.node("client"), "tuned", 5)
    with pytest.raises(DynamicReconfigureParameterException, match=problem):
        client.update_configuration(changes)


@pytest.mark.parametrize(
    ("request_", "problem"),
    [
        (ConfigMessage(ints=[IntParameter("windw", 1)]), "did you mean window"),
        (ConfigMessage(ints=[IntParameter("mode", 1)]), "the int 1"),
        (ConfigMessage(groups=[GroupState("Filterr", True, 1, 0)]), "did you mean Filter"),
    ],
)
def test_changes_that_a_server_refuses(sim, request_, problem, capsys):
    served = Served(sim)
    call = sim.node("client").service_client("/tuned/set_parameters", Reconfigure)
    with pytest.raises(Exception, match=problem):
        call(request_)
    assert len(served.calls) == 1
    assert problem in capsys.readouterr().err


def test_waiting_for_a_server(graph):
    with pytest.raises(ROSException, match="nobody offers /nobody/set_parameters"):
        Client(graph.node("client"), "nobody", 0.2)
    made = []
    late = graph.node("late")
    late.run(lambda: made.append(Client(late, "tuned")))  # for ever
    graph.run(3.0)
    assert made == []
    Served(graph)
    graph.run(100.0, until=lambda: made)
    assert made[0].get_configuration(5)["gain"] == 1.5


def test_what_a_client_of_a_dumb_server_waits_for(sim):
    """Somebody offers the service and publishes nothing: the waits end."""
    sim.node("dumb").service("/dumb/set_parameters", Reconfigure, lambda request: [request.config])
    client = Client(sim.node("client"), "dumb")
    assert client.get_configuration(0.5) is None
    assert client.get_parameter_descriptions(0.5) is None
    assert client.get_group_descriptions(0.5) is None
