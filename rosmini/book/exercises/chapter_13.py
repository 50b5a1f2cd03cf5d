"""What is right in the exercises of chapter 13, Services."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect
from rosmini.errors import ROSException, RosminiError, ServiceException
from rosmini.graph import Graph, Node
from rosmini.msgs import define_service, message_class, service_class

if TYPE_CHECKING:
    from collections.abc import Callable

# ---- 13.1: a service type ----

PICTURE = """\
uint32 width
bool colour
---
bool success
string message
sensor_msgs/Image image
"""


def _picture_but(old: str, new: str) -> Callable[[], Any]:
    return lambda: PICTURE.replace(old, new)


@exercise(
    "13.1",
    praise="A client in any language can be built from these six lines.",
    mistakes=[
        _picture_but("---\n", ""),
        _picture_but("uint32", "int32"),
        _picture_but("bool colour\n", ""),
        _picture_but("uint32 width\nbool colour", "bool colour\nuint32 width"),
        _picture_but("sensor_msgs/", ""),
        _picture_but("Image image", "Image picture"),
        _picture_but("---\nbool success", "bool success\n---"),
        _picture_but("string message", "string message\nstring encoding"),
        lambda: ["uint32 width", "bool colour"],
    ],
)
def definition(answer: Any) -> None:
    """The definition of a service with two fields in its request and three in its response."""
    expect(
        isinstance(answer, str),
        f"definition is a {type(answer).__name__}, not a text.",
        'use """three quotes"""',
    )
    try:
        given = define_service("my_robot/TakePicture", answer)
    except RosminiError as error:
        expect(
            False, f"This is no definition: {error}", "a field is 'type name', and --- is a line of its own"
        )
        return
    wanted = define_service("my_robot/TakePicture", PICTURE)
    for half in ("request", "response"):
        found, expected = (_fields(cls, half) for cls in (given, wanted))
        for kind, name in expected:
            kinds = [other for other, field in found if field == name]
            expect(kinds, f"The {half} has no field {name}.", "the request stands above the line ---")
            expect(kinds == [kind], f"The field {name} of the {half} is a {kinds[0]}, not a {kind}.")
        extra = [name for _, name in found if name not in [field for _, field in expected]]
        expect(not extra, f"The {half} has a field that was not asked for: {', '.join(extra)}.")
        expect(found == expected, f"The fields of the {half} are not in the order that was asked for.")
    expect(given._md5sum == wanted._md5sum, "There is a constant that was not asked for.")


def _fields(cls: Any, half: str) -> list[tuple[str, str]]:
    return [(field.type, field.ros_name) for field in getattr(cls, f"_{half}_class")._spec.fields]


def _trigger() -> Any:
    return service_class("std_srvs/Trigger")


def _empty() -> Any:
    return service_class("std_srvs/Empty")


def _string() -> Any:
    return message_class("std_msgs/String")


def _offered(graph: Graph, node: str, name: str, kind: Any) -> None:
    """Expect that a node is there and offers a service of a type."""
    expect(node in graph.nodes, f"There is no node {node}.", f'graph.node("{node.lstrip("/")}")')
    server = graph.nodes[node].services.get(name)
    expect(server, f"{node} offers no service {name}.", "node.service(name, type, handler)")
    if server is not None:
        found = server.service_class._type
        expect(found == kind._type, f"{name} is a {found}, not a {kind._type}.")


# ---- 13.2: two services that share something ----


def _counter(
    *,
    first: int = 0,
    step: int = 1,
    cleared: int = 0,
    name: str = "counter",
    success: bool = True,
    clears: bool = True,
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node(name)
        calls = [first]

        def count(_: Any) -> tuple[bool, str]:
            calls[0] += step
            return success, str(calls[0])

        def clear(_: Any) -> list[Any]:
            calls[0] = cleared
            return []

        node.service("count", _trigger(), count)
        if clears:
            node.service("clear", _empty(), clear)

    return lambda: start


def _number_as_message(graph: Graph) -> None:
    node = graph.node("counter")
    node.service("count", _trigger(), lambda _: (True, 1))
    node.service("clear", _empty(), lambda _: [])


@exercise(
    "13.2",
    praise="Both handlers share one variable, and nobody else can touch it.",
    mistakes=[
        _counter(first=-1),
        _counter(step=0),
        _counter(cleared=1),
        _counter(name="count"),
        _counter(success=False),
        _counter(clears=False),
        lambda: _number_as_message,
        lambda: lambda graph: graph.node("counter"),
    ],
)
def counter(answer: Any) -> None:
    """A service that counts its calls, and one that begins again."""
    with Graph(strict=False) as graph:
        answer(graph)
        _offered(graph, "/counter", "/count", _trigger())
        _offered(graph, "/counter", "/clear", _empty())
        client = graph.node("client")
        count, clear = (
            client.service_client(name, kind) for name, kind in (("count", _trigger()), ("clear", _empty()))
        )
        answers = [count(), count(), count()]
        clear()
        answers.append(count())
    expect(all(found.success for found in answers), "success is false.", "return True and the text")
    messages = [found.message for found in answers]
    expect(messages[:3] == ["1", "2", "3"], f"Three calls gave {messages[:3]}, not '1', '2', '3'.")
    expect(messages[3] == "1", f"After clear the next call gave {messages[3]!r}, not '1'.")


# ---- 13.3: a client that is ready for everything ----


def _careful(
    *, wait: bool = True, catch: bool = True, look: bool = True, limit: float | None = None
) -> Callable[[], Any]:
    def ask(node: Node, seconds: float) -> str:
        if wait:
            try:
                node.wait_for_service("who", timeout=seconds if limit is None else limit)
            except ROSException:
                return "nobody"
        try:
            answer = node.service_client("who", _trigger())()
        except ServiceException:
            if catch:
                return "no answer"
            raise
        return str(answer.message) if answer.success or not look else "no answer"

    return lambda: ask


@exercise(
    "13.3",
    praise="Three ways to fail, and none of them ends your program.",
    mistakes=[
        _careful(wait=False),
        _careful(catch=False),
        _careful(look=False),
        _careful(limit=1.0),
        _careful(limit=60.0),
        lambda: lambda node, seconds: "nobody",  # noqa: ARG005
    ],
)
def who_is_it(answer: Any) -> None:
    """A call that waits for its server, but not for ever, and that may fail."""

    def refuse(_: Any) -> tuple[bool, str]:
        return False, "I do not say"

    def fail(_: Any) -> tuple[bool, str]:
        raise ServiceException("out of order")

    def tell(_: Any) -> tuple[bool, str]:
        return True, "it is me"

    cases = (
        (tell, 0.0, "it is me", "the server is there from the start"),
        (tell, 3.0, "it is me", "the server comes after 3 s, and 5 s may be waited"),
        (tell, 9.0, "nobody", "the server comes after 9 s, and 5 s may be waited"),
        (refuse, 0.0, "no answer", "the answer has success false"),
        (fail, 0.0, "no answer", "the handler raises"),
    )
    for handler, delay, expected, case in cases:
        with Graph(strict=False) as graph:
            server = graph.node("server")

            def offer(_: Any = None, server: Node = server, handler: Any = handler) -> None:
                server.service("who", _trigger(), handler)

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
            "wait_for_service raises ROSException, the call ServiceException",
        )
        expect(waited <= 5.0, f"When {case} it took {waited:g} s.", "wait_for_service(..., timeout=seconds)")


# ---- 13.4: a service that remembers a topic ----


def _secretary(
    *, first: bool = False, before: str = "nothing yet", topic: str = "status", known: bool = True
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node("secretary")
        heard: list[str] = []

        def tell(_: Any) -> tuple[bool, str]:
            return (known, heard[0 if first else -1]) if heard else (False, before)

        node.subscriber(topic, _string(), lambda message: heard.append(message.data))
        node.service("last_status", _trigger(), tell)

    return lambda: start


def _waiting_secretary(graph: Graph) -> None:
    node = graph.node("secretary")
    node.subscriber("status", _string())

    def tell(_: Any) -> tuple[bool, str]:
        try:
            return True, node.wait_for_message("status", _string(), timeout=1.0).data
        except ROSException:
            return False, "nothing yet"

    node.service("last_status", _trigger(), tell)


@exercise(
    "13.4",
    praise="It answers at once, whatever the others do.",
    mistakes=[
        _secretary(first=True),
        _secretary(before=""),
        _secretary(topic="state"),
        _secretary(known=False),
        lambda: _waiting_secretary,
        lambda: lambda graph: graph.node("secretary"),
    ],
)
def secretary(answer: Any) -> None:
    """A node that keeps the last message of a topic and tells it to who asks."""
    with Graph(strict=False) as graph:
        answer(graph)
        _offered(graph, "/secretary", "/last_status", _trigger())
        worker = graph.node("worker").publisher("status", _string())
        graph.run(0.1)
        expect(
            worker.num_connections(), "Nobody subscribes to /status.", "subscriber(...) with the type String"
        )
        ask = graph.node("boss").service_client("last_status", _trigger())
        start, answers = graph.now(), [ask()]
        waited = (graph.now() - start).to_sec()
        for status in ("starting", "driving"):
            worker.publish(status)
            graph.run(0.1)
            start = graph.now()
            answers.append(ask())
            waited += (graph.now() - start).to_sec()
    found = [(each.success, each.message) for each in answers]
    expect(
        waited == 0,
        f"The answers took {waited:g} s.",
        "the callback writes the status down, the handler reads it",
    )
    expect(
        found[0] == (False, "nothing yet"),
        f"Before any status it answers {found[0]}.",
        "success false, and the message 'nothing yet'",
    )
    expect(found[1] == (True, "starting"), f"After the status 'starting' it answers {found[1]}.")
    expect(found[2] == (True, "driving"), f"After 'starting' and 'driving' it answers {found[2]}.")
