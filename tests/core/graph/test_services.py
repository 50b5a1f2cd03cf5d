"""Services: responses, failures, persistence, servers that come and go, calls from everywhere.

On every transport and clock.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import GraphEnded, ROSException, ROSInterruptException, SerializationError, ServiceException
from rosmini.msgs import define_service
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
from rosmini.msgs.std_msgs.msg import Int32, String
from rosmini.msgs.std_srvs.srv import Empty, SetBool

from .conftest import settle, until

if TYPE_CHECKING:
    from rosmini.core.graph import Graph, Node

ADD = AddTwoInts
RESPONSE = AddTwoInts._response_class


def adder(node: Node) -> Any:
    """Offer /add."""
    return node.service("add", ADD, lambda request: request.a + request.b)


# -- responses ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "answer",
    [
        lambda r: RESPONSE(r.a + r.b),
        lambda r: r.a + r.b,
        lambda r: [r.a + r.b],
        lambda r: (r.a + r.b,),
        lambda r: {"sum": r.a + r.b},
    ],
    ids=["response", "value", "list", "tuple", "dictionary"],
)
def test_a_handler_returns_a_response_or_what_makes_one(graph: Graph, answer: Any) -> None:
    graph.node("server").service("add", ADD, answer)
    client = graph.node("client").service_client("add", ADD)
    assert client(1, 2).sum == 3
    assert client(a=3, b=4).sum == 7
    assert client.call(ADD._request_class(5, 6)).sum == 11


@pytest.mark.parametrize("answer", [[], (), {}, Empty._response_class()], ids=["list", "tuple", "dict", "response"])
def test_a_response_without_fields(graph: Graph, answer: Any) -> None:
    graph.node("server").service("reset", Empty, lambda _: answer)
    assert graph.node("client").service_client("reset", Empty)()._type == "std_srvs/EmptyResponse"


def test_a_handler_that_returns_none_fails_for_an_empty_response_too(
    graph: Graph, capfd: pytest.CaptureFixture[str]
) -> None:
    calls: list[Any] = []
    graph.node("server").service("reset", Empty, calls.append)
    with pytest.raises(ServiceException, match=r"service cannot process request: service handler returned None$"):
        graph.node("client").service_client("reset", Empty)()
    assert len(calls) == 1
    assert "return [] or the response itself" in capfd.readouterr().err


@pytest.mark.parametrize("persistent", [False, True])
def test_both_ends_see_the_connection_header(graph: Graph, persistent: bool) -> None:
    requests: list[Any] = []

    def handle(request: Any) -> Any:
        requests.append(request._connection_header)
        return True, "done"

    graph.node("server").service("lamp", SetBool, handle)
    client = graph.node("client").service_client("lamp", SetBool, persistent=persistent, headers={"cookie": "abc"})
    responses = [client(True)._connection_header, client(False)._connection_header]
    mine = {"callerid": "/client", "cookie": "abc", "md5sum": SetBool._md5sum, "service": "/lamp"}
    assert requests == [mine | ({"persistent": "1"} if persistent else {})] * 2
    theirs = {"callerid": "/server", "md5sum": SetBool._md5sum, "service": "/lamp", "type": "std_srvs/SetBool"}
    assert responses == [theirs] * 2


@pytest.mark.parametrize("headers", [["a"], {"n": 1}, {1: "n"}, {"a=b": "c"}, {"": "x"}])
def test_headers_that_are_no_texts_are_refused(graph: Graph, headers: Any) -> None:
    node = graph.node("node")
    with pytest.raises(ValueError, match="header"):
        node.service_client("lamp", SetBool, headers=headers)
    with pytest.raises(ValueError, match="header"):
        node.publisher("t", String, headers=headers)


def test_a_header_of_the_users_that_is_refused_is_told_as_it_is(graph: Graph) -> None:
    graph.node("server").service("lamp", SetBool, lambda _: (True, ""))
    client = graph.node("client").service_client("lamp", SetBool, headers={"md5sum": "12"})
    with pytest.raises(
        ServiceException, match=r"unable to connect to service \[/lamp\]: .* md5sums do not match: \[12\]"
    ):
        client(True)


def test_two_types_of_one_md5_sum_meet(graph: Graph) -> None:
    """As in rospy and roscpp, which compare the md5 sums only; each end has its own type."""
    text = "bool data\n---\nbool success\nstring message\n"
    twin = define_service("my_robot/Switch", text)
    assert twin._md5sum == SetBool._md5sum
    requests: list[Any] = []

    def handle(request: Any) -> Any:
        requests.append(request)
        return True, "done"

    graph.node("server").service("lamp", twin, handle)
    response = graph.node("client").service_client("lamp", SetBool)(True)
    assert type(requests[0]) is twin._request_class
    assert (requests[0].data, type(response), response.message) == (True, SetBool._response_class, "done")


def test_a_request_that_is_none_after_all_is_an_error_of_the_call(graph: Graph) -> None:
    graph.node("server").service("lamp", SetBool, lambda _: (True, ""))
    client = graph.node("client").service_client("lamp", Empty, headers={"md5sum": "*"})
    with pytest.raises(ServiceException, match=r"error processing request|std_srvs/SetBoolRequest"):
        client()


def test_the_handler_owns_its_request_and_the_client_its_response(graph: Graph) -> None:
    kept: list[Any] = []

    def handler(request: Any) -> Any:
        request.a += 100
        kept.append(RESPONSE(request.a))
        return kept[-1]

    graph.node("server").service("add", ADD, handler)
    request = ADD._request_class(1, 2)
    response = graph.node("client").service_client("add", ADD)(request)
    assert (request.a, response.sum) == (1, 101)
    response.sum = 0
    assert kept[0].sum == 101


# -- failures ----------------------------------------------------------------------------------------------------


def test_a_failing_handler_gives_the_caller_an_error_and_the_server_goes_on(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    def handler(request: Any) -> int:
        return request.a // request.b

    graph.node("server").service("divide", ADD, handler)
    client = graph.node("client").service_client("divide", ADD)
    with pytest.raises(
        ServiceException,
        match=r"service \[/divide\] responded with an error: error processing request: integer division",
    ):
        client(1, 0)
    said = capsys.readouterr().err
    assert "handler of /server, called for /divide, raised ZeroDivisionError" in said
    assert "test_services.py" in said
    assert "return request.a // request.b" in said
    assert "b: 0" in said
    assert client(6, 2).sum == 3


def test_a_service_that_nobody_offers_is_an_error_with_the_nearest_name(graph: Graph) -> None:
    adder(graph.node("server"))
    with pytest.raises(ServiceException, match=r"service \[/ad\] unavailable: .*did you mean /add"):
        graph.node("client").service_client("ad", ADD)(1, 2)


def test_the_wrong_type_names_both(graph: Graph) -> None:
    adder(graph.node("server"))
    with pytest.raises(
        ServiceException,
        match=r"service \[/add\] is a rospy_tutorials/AddTwoInts, and was called as a std_srvs/SetBool",
    ):
        graph.node("client").service_client("add", SetBool)(True)


def test_a_wrong_request_never_leaves(graph: Graph) -> None:
    adder(graph.node("server"))
    client = graph.node("client").service_client("add", ADD)
    with pytest.raises(SerializationError, match="a"):
        client("one", 2)
    with pytest.raises(TypeError):
        client(1)
    with pytest.raises(AttributeError, match="c"):
        client(c=1)


def test_a_node_offers_a_service_once(graph: Graph) -> None:
    node = graph.node("server")
    server = adder(node)
    with pytest.raises(ROSException, match=r"service \[/add\] is already offered by /server"):
        adder(node)
    server.shutdown()
    adder(node)
    assert node.service_client("add", ADD)(1, 1).sum == 2


def test_the_last_to_offer_a_service_answers(graph: Graph) -> None:
    graph.node("old").service("add", ADD, lambda _: 1)
    graph.node("new").service("add", ADD, lambda _: 2)
    assert graph.node("client").service_client("add", ADD)(0, 0).sum == 2


# -- persistence -------------------------------------------------------------------------------------------------


def test_a_persistent_client_keeps_its_connection_and_notices_that_the_server_has_gone(graph: Graph) -> None:
    server = adder(graph.node("server"))
    node = graph.node("client")
    client = node.service_client("add", ADD, persistent=True)
    assert client(1, 2).sum == 3
    assert len(server.sessions) == 1
    assert client(3, 4).sum == 7
    assert len(server.sessions) == 1
    server.shutdown("maintenance")
    with pytest.raises(ServiceException, match="transport error"):
        client(5, 6)
    with pytest.raises(ServiceException, match="was closed; make a new one"):
        client(5, 6)
    successor = adder(graph.node("successor"))
    client = node.service_client("add", ADD, persistent=True)
    assert client(5, 6).sum == 11
    client.close()
    client.close()
    settle(graph)
    assert successor.sessions == []


def test_a_client_that_is_not_persistent_follows_the_service(graph: Graph) -> None:
    client = graph.node("client").service_client("add", ADD)
    for name in ("one", "two"):
        server = adder(graph.node(name))
        assert client(1, 2).sum == 3
        settle(graph)
        assert server.sessions == []
        server.shutdown()


# -- servers that go away ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("who", ["service", "node"])
def test_a_server_that_goes_away_during_a_call_fails_it(graph: Graph, who: str) -> None:
    node = graph.node("server")
    started: list[Any] = []

    def handler(request: Any) -> int:
        started.append(request)
        node.sleep(1e6)
        return 0

    server = node.service("slow", ADD, handler)
    client = graph.node("client")
    failures: list[str] = []

    def main() -> None:
        try:
            client.service_client("slow", ADD)(1, 2)
        except ServiceException as error:
            failures.append(str(error))

    client.run(main)
    until(graph, lambda: started)
    if who == "service":
        server.shutdown("maintenance")
    else:
        node.shutdown("maintenance")
    until(graph, lambda: failures)
    assert "transport error" in failures[0]
    assert "maintenance" in failures[0]


def test_a_client_that_is_shut_down_during_a_call_is_interrupted_as_in_rospy(graph: Graph) -> None:
    server = graph.node("server")
    server.service("slow", ADD, lambda _: server.sleep(1e6))
    client, failures = graph.node("client"), []

    def main() -> None:
        try:
            client.service_client("slow", ADD)(1, 2)
        except ROSInterruptException as error:
            failures.append(str(error))

    client.run(main)
    settle(graph)
    client.shutdown("enough")
    until(graph, lambda: failures)
    assert "node /client was shut down: enough" in failures[0]
    with pytest.raises(ServiceException, match="after node /client was shut down"):
        client.service_client("slow", ADD)(1, 2)


# -- calls from inside the graph ---------------------------------------------------------------------------------


@pytest.mark.parametrize("where", ["same node", "another node"])
def test_a_callback_may_call_a_service_of_the_same_process(graph: Graph, where: str) -> None:
    node = graph.node("node")
    adder(node if where == "same node" else graph.node("server"))
    client = node.service_client("add", ADD)
    sums: list[int] = []
    node.subscriber("n", Int32, lambda message: sums.append(client(message.data, 1).sum))
    publisher = graph.node("talker").publisher("n", Int32)
    publisher.wait_for_subscribers()
    publisher.publish(1)
    publisher.publish(2)
    until(graph, lambda: len(sums) == 2)
    assert sums == [2, 3]


def test_a_node_may_call_itself_and_a_handler_another_service(graph: Graph) -> None:
    node = graph.node("node")
    adder(node)
    inner = node.service_client("add", ADD)
    node.service("twice", ADD, lambda request: inner(request.a, request.a).sum)
    middle = node.service_client("twice", ADD)
    node.service("four_times", ADD, lambda request: middle(middle(request.a, 0).sum, 0).sum)
    assert node.service_client("four_times", ADD)(5, 0).sum == 20


def test_each_caller_has_a_lane_of_its_own(graph: Graph) -> None:
    server = graph.node("server")
    running: list[int] = []

    def handler(request: Any) -> int:
        running.append(request.a)
        while len(running) < 4:  # each waits for the others: in one lane they would wait for ever
            server.sleep(0.5)
        return request.a

    server.service("slow", ADD, handler)
    answers: list[int] = []
    for number in range(4):
        node = graph.node(f"client{number}")
        node.run(lambda node=node, number=number: answers.append(node.service_client("slow", ADD)(number, 0).sum))
    until(graph, lambda: len(answers) == 4)
    assert sorted(answers) == [0, 1, 2, 3]


# -- waiting -----------------------------------------------------------------------------------------------------


def test_waiting_for_a_service_that_comes(graph: Graph) -> None:
    server, client = graph.node("server"), graph.node("client")

    def later() -> None:
        server.sleep(3.0)
        adder(server)

    server.run(later)
    proxy = client.service_client("add", ADD)
    proxy.wait_for_service()
    proxy.wait_for_service(timeout=1.0)
    client.wait_for_service("add", timeout=1.0)
    assert proxy(1, 2).sum == 3


def test_waiting_for_a_service_that_does_not_come(graph: Graph) -> None:
    with pytest.raises(ROSException, match=r"after 1 s .*/nope to be offered: nobody offers /nope"):
        graph.node("client").wait_for_service("nope", timeout=1.0)


def test_waiting_for_a_service_that_can_never_come_ends_in_simulated_time(simulated: Graph) -> None:
    with pytest.raises(GraphEnded, match="waited for the service /nope to be offered, but nothing is left"):
        simulated.node("client").wait_for_service("nope")
