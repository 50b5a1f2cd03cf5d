"""Names of nodes and what is in them: namespaces, remapping, private and anonymous names, bad ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import IllegalName
from rosmini.core.graph import Graph
from rosmini.core.names import Remappings
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Empty

from .conftest import until

if TYPE_CHECKING:
    from collections.abc import Callable


@pytest.mark.parametrize(
    ("name", "resolved"),
    [
        ("chatter", "/robot1/chatter"),
        ("/chatter", "/chatter"),
        ("~chatter", "/robot1/node/chatter"),
        ("a/b", "/robot1/a/b"),
    ],
)
def test_names_mean_what_they_mean_in_ros(simulated: Graph, name: str, resolved: str) -> None:
    node = simulated.node("node", namespace="/robot1")
    assert node.name == "/robot1/node"
    assert node.resolve(name) == resolved
    assert node.publisher(name, String).topic == resolved
    assert node.subscriber(name, String).topic == resolved
    assert node.service(name, Empty, lambda _: None).name == resolved
    assert node.service_client(name, Empty).name == resolved


@pytest.mark.parametrize("namespace", ["robot1", "/robot1", "/robot1/", "//robot1"])
def test_a_namespace_may_be_written_in_several_ways(simulated: Graph, namespace: str) -> None:
    assert simulated.node("node", namespace=namespace).name == "/robot1/node"


def test_remapped_nodes_meet(graph: Graph) -> None:
    heard: list[Any] = []
    listener = graph.node("listener", remappings={"chatter": "/radio/channel"})
    listener.subscriber("chatter", String, heard.append)
    talker = graph.node("talker", namespace="/radio", remappings={"chatter": "channel"})
    publisher = talker.publisher("chatter", String)
    publisher.wait_for_subscribers()
    publisher.publish("hello")
    until(graph, lambda: heard)
    assert publisher.topic == "/radio/channel"


def test_the_command_line_names_a_node_and_its_namespace(simulated: Graph) -> None:
    node = simulated.node("node", remappings=Remappings.from_argv(["__name:=other", "__ns:=/robot2", "a:=b"]))
    assert node.name == "/robot2/other"
    assert node.resolve("a") == "/robot2/b"


def test_anonymous_names_are_unique_and_the_same_on_each_run() -> None:
    def names() -> list[str]:
        with Graph() as graph:
            return [graph.node("node", anonymous=True).name for _ in range(3)]

    first = names()
    assert len(set(first)) == 3
    assert all(name.startswith("/node_") for name in first)
    assert names() == first


def test_a_name_from_the_command_line_is_not_made_anonymous(simulated: Graph) -> None:
    node = simulated.node("node", anonymous=True, remappings=Remappings.from_argv(["__name:=other"]))
    assert node.name == "/other"


@pytest.mark.parametrize("name", ["my-node", "1node", "a b", "no/slash", "", "~node"])
def test_an_illegal_node_name_is_refused(simulated: Graph, name: str) -> None:
    before = dict(simulated.nodes)
    with pytest.raises(IllegalName):
        simulated.node(name)
    assert simulated.nodes == before


@pytest.mark.parametrize(
    "use",
    [
        lambda node: node.publisher("my-topic", String),
        lambda node: node.subscriber("my-topic", String),
        lambda node: node.service("my-topic", Empty, lambda _: None),
        lambda node: node.service_client("my-topic", Empty),
        lambda node: node.wait_for_message("my-topic", String),
    ],
)
def test_an_illegal_name_has_a_caret_under_the_bad_character(simulated: Graph, use: Callable[[Any], object]) -> None:
    node = simulated.node("node")
    with pytest.raises(IllegalName) as caught:
        use(node)
    shown, caret = [line for line in str(caught.value).splitlines() if "my-topic" in line or line.strip() == "^"][-2:]
    assert caret.index("^") == shown.index("-")
    assert node.subscriptions == {}
