"""A notebook's graph goes online in a real kernel, and others, in another process, talk to its nodes between cells."""

import pytest

from rosmini.core.graph import Graph
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.msgs import message_class
from rosmini.ros.net import connect
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.master_server import MasterServer
from rosmini.ros.net.network import network_of, tcp

from ..processes import PATIENCE, free_port

String = message_class("std_msgs/String")


@pytest.fixture
def environ():
    return {"ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"}


@pytest.fixture
def elsewhere(environ):
    with connect(environ) as graph:
        yield graph


def hear(graph, words, condition):
    """Drive the graph of this process until a condition holds for what it has heard."""
    report = graph.run(PATIENCE, until=lambda: condition(words))
    assert condition(words), report


def test_others_hear_a_notebook_between_its_cells_until_it_goes_offline(kernel, environ, elsewhere):
    kernel.ok(f"online = graph.online(environ={environ})\nprint(graph.is_live, online)")
    words = []
    node = elsewhere.node("far")
    node.subscriber("chatter", String, lambda message: words.append(message.data))
    back = node.publisher("chatter", String)
    kernel.ok("timer = talker.timer(0.05, lambda event: pub.publish('tick'))")
    hear(elsewhere, words, lambda heard: heard.count("tick") > 3)
    elsewhere.run(PATIENCE, until=lambda: back.num_connections() == 2)
    back.publish("from afar")
    hear(elsewhere, words, lambda heard: "from afar" in heard)
    kernel.until(lambda: "from afar" in kernel.ok("print(heard)").stdout, "what was sent to the notebook")
    said = kernel.ok("timer.shutdown(); graph.offline(); print(graph.is_live, pub.num_connections())")
    assert said.stdout.endswith("False 1\n")
    heard = kernel.ok("pub.publish('among us'); listener.sleep(0.1); print(heard[-1])").stdout
    assert heard.endswith("among us\n")


def test_a_notebook_joins_a_master_and_leaves_it(kernel, environ):
    with Graph(simulated=False, transports=[LocalTransport, tcp()]) as home:
        where = addresses(environ)
        server = MasterServer(network_of(home).io, home.master, where, where.master[1])
        words = []
        home.node("home").subscriber("chatter", String, lambda message: words.append(message.data))
        cell = kernel.send(f"print(graph.online(environ={environ}).joined)")
        home.run(PATIENCE, until=lambda: home.ask_as("/test").find("lookupNode", "/talker"))
        kernel.until(lambda: cell.idle, "going online")
        assert cell.stdout == "True\n"
        kernel.send("timer = talker.timer(0.05, lambda event: pub.publish('tick'))")
        hear(home, words, lambda heard: heard.count("tick") > 3)
        cell = kernel.send("timer.shutdown(); graph.offline(); print(graph.master_uri)")
        home.run(PATIENCE, until=lambda: home.ask_as("/test").find("lookupNode", "/talker") is None)
        kernel.until(lambda: cell.idle, "going offline")
        assert cell.stdout.endswith("http://localhost:11311/\n")
        assert cell.errors == []
        server.close()
