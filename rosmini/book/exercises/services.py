"""Checks of the exercises in the chapter Services."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import exercise, expect, expect_fields, expect_heard, expect_type
from rosmini.core.errors import RosminiError, ServiceException
from rosmini.core.graph import Graph, Node
from rosmini.msgs import define_service
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Empty, Trigger

# ---- service_type: a service type ----

PICTURE = """\
uint32 width
bool colour
---
bool success
string message
sensor_msgs/Image image
"""


@exercise("service_type", praise="These six lines are enough to write a client in any language.")
def definition(answer: Any) -> None:
    """The definition of a service with two fields in its request and three in its response."""
    expect_type(answer, str, "definition is", "a string", 'write it between """three quotes"""')
    try:
        given = define_service("my_robot/TakePicture", answer)
    except RosminiError as error:
        expect(False, f"This is not a service definition: {error}", "a field is 'type name', --- separates")
        return
    wanted = define_service("my_robot/TakePicture", PICTURE)
    expect_fields(given._request_class, wanted._request_class, "request")
    expect_fields(given._response_class, wanted._response_class, "response")
    expect(given._md5sum == wanted._md5sum, "It has a constant that the task does not mention.")


def _offered(graph: Graph, node: str, name: str, kind: Any) -> None:
    """Expect that a node is there and offers a service of a type."""
    expect(node in graph.nodes, f"There is no node {node}.", f'make it with graph.node("{node.lstrip("/")}")')
    server = graph.nodes[node].services.get(name)
    expect(server, f"{node} offers no service {name}.", "use node.service(name, type, handler)")
    if server is not None:
        found = server.service_class._type
        expect(found == kind._type, f"{name} is a {found}, not a {kind._type}.")


# ---- counter: two services that share something ----


@exercise("counter", praise="Both handlers share one variable, and no other node can change it.")
def counter(answer: Any) -> None:
    """A service that counts its calls, and one that resets the counter."""
    with Graph(strict=False) as graph:
        answer(graph)
        _offered(graph, "/counter", "/count", Trigger)
        _offered(graph, "/counter", "/clear", Empty)
        client = graph.node("client")
        count, clear = (client.service_client(name, kind) for name, kind in (("count", Trigger), ("clear", Empty)))
        answers = [count(), count(), count()]
        clear()
        answers.append(count())
    expect(all(found.success for found in answers), "The field success is false.", "return True and the text")
    messages = [found.message for found in answers]
    expect(messages[:3] == ["1", "2", "3"], f"Three calls gave {messages[:3]}, not '1', '2', '3'.")
    expect(messages[3] == "1", f"After clear the next call gave {messages[3]!r}, not '1'.")


# ---- who_is_it: a client that is ready for everything ----


@exercise("who_is_it", praise="Your program survives all three failures.")
def who_is_it(answer: Any) -> None:
    """A call that waits a limited time for its server, and handles failures."""

    def refuse(_: Any) -> tuple[bool, str]:
        return False, "I do not say"

    def fail(_: Any) -> tuple[bool, str]:
        raise ServiceException("out of order")

    def tell(_: Any) -> tuple[bool, str]:
        return True, "it is me"

    cases = (
        (tell, 0.0, "it is me", "the server is there from the start"),
        (tell, 3.0, "it is me", "the server starts after 3 s, and the limit is 5 s"),
        (tell, 9.0, "nobody", "the server starts after 9 s, and the limit is 5 s"),
        (refuse, 0.0, "no answer", "the field success of the response is false"),
        (fail, 0.0, "no answer", "the handler raises an error"),
    )
    for handler, delay, expected, case in cases:
        with Graph(strict=False) as graph:
            server = graph.node("server")

            def offer(_: Any = None, server: Node = server, handler: Any = handler) -> None:
                server.service("who", Trigger, handler)

            if delay:
                server.timer(delay, offer, oneshot=True)
            else:
                offer()
            start = graph.now()
            found = answer(graph.node("client"), 5.0)
            waited = (graph.now() - start).to_sec()
        expect(
            found == expected,
            f"When {case} it returned {found!r}, not {expected!r}.",
            "wait_for_service raises ROSException, and the call raises ServiceException",
        )
        expect(waited <= 5.0, f"When {case} it took {waited:g} s.", "wait_for_service(..., timeout=seconds)")


# ---- secretary: a service that remembers a topic ----


@exercise("secretary", praise="It answers at once, even while other nodes are busy.")
def secretary(answer: Any) -> None:
    """A node that stores the last message of a topic and returns it on request."""
    with Graph(strict=False) as graph:
        answer(graph)
        _offered(graph, "/secretary", "/last_status", Trigger)
        worker = graph.node("worker").publisher("status", String)
        graph.run(0.1)
        expect_heard(worker)
        ask = graph.node("boss").service_client("last_status", Trigger)
        start, answers = graph.now(), [ask()]
        waited = (graph.now() - start).to_sec()
        for status in ("starting", "driving"):
            worker.publish(status)
            graph.run(0.1)
            start = graph.now()
            answers.append(ask())
            waited += (graph.now() - start).to_sec()
    found = [(each.success, each.message) for each in answers]
    expect(waited == 0, f"The answers took {waited:g} s.", "store the status in the callback, for the handler")
    expect(
        found[0] == (False, "nothing yet"),
        f"Before any status it answers {found[0]}.",
        "return False and the message 'nothing yet'",
    )
    expect(found[1] == (True, "starting"), f"After the status 'starting' it answers {found[1]}.")
    expect(found[2] == (True, "driving"), f"After 'starting' and 'driving' it answers {found[2]}.")
