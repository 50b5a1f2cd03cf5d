"""A node: the object API of the computation graph, in ROS's vocabulary.

>>> from rosmini import Graph
>>> from rosmini.msgs.std_msgs.msg import String
>>> graph = Graph()
>>> listener = graph.node("listener")
>>> subscriber = listener.subscriber("chatter", String, lambda message: print("heard", message.data))
>>> talker = graph.node("talker")
>>> publisher = talker.publisher("chatter", String, queue_size=10)
>>> publisher.wait_for_subscribers()
>>> publisher.publish("hello")
>>> graph.run(0.1).reason
heard hello
'time'
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.errors import (
    CallbackError,
    DuplicateNode,
    ROSException,
    ROSInterruptException,
    ServiceException,
    TransportInitError,
    TypeMismatch,
)
from rosmini.names import Remappings, canonicalize, check_base_name, check_name, resolve
from rosmini.time import Duration

from .blocking_api import BlockingApi
from .callbacks import describe_failure
from .clock import GraphClock, Rate, Timer, TimerEvent, TopicClock
from .lanes import Lane, LaneContext, Waiter
from .logging_api import LoggingApi
from .parameter_api import ParameterApi
from .publisher import Publication, Publisher
from .rosout import LEVELS, Logger
from .service import ServiceClient, ServiceServer, Session, timed_out
from .slave import SlaveApi
from .subscriber import Subscriber, Subscription
from .transport import extra_fields

if TYPE_CHECKING:
    from collections.abc import Callable

    from .graph import Graph
    from .transport import Header, Sender, Triple


class Node(BlockingApi, ParameterApi, LoggingApi):
    """A node of a :class:`~rosmini.graph.graph.Graph`; made by ``graph.node(name)`` or ``Node(name)``.

    Args:
        name: the node's base name (``talker``), resolved in ``namespace``.
        graph: the graph; the process's default graph if not given.
        namespace: where relative names of this node start (``__ns:=``).
        remappings: ``{"chatter": "/robot1/chatter"}`` as on a ROS command line, or a :class:`~rosmini.names.Remappings`.
        anonymous: append a number that makes the name unique.

    A node of the same name that already runs is shut down, as in ROS. Raises ``IllegalName``.

    """

    def __init__(
        self,
        name: str,
        graph: Graph | None = None,
        *,
        namespace: str = "/",
        remappings: dict[str, str] | Remappings | None = None,
        anonymous: bool = False,
        context: LaneContext | None = None,
    ) -> None:
        if graph is None:
            from .graph import default_graph  # the graph module builds nodes itself

            graph = default_graph()
        self.graph = graph
        self.scheduler = graph.scheduler
        self.context = context
        if not isinstance(remappings, Remappings):
            remappings = Remappings(remappings or {})
        self.remappings = remappings
        self.namespace = canonicalize("/" + check_name(remappings.namespace or namespace, "namespace"))
        base = check_base_name(remappings.node_name or name)
        if anonymous and remappings.node_name is None:
            base = graph.anonymous_name(base)
        self.name = resolve(base, self.namespace)
        self.shutdown_reason: str | None = None
        self.publications: dict[str, Publication] = {}
        self.subscriptions: dict[str, Subscription] = {}
        self.services: dict[str, ServiceServer] = {}
        self._hooks: list[Callable[[], object]] = []
        self._waiters: dict[Waiter, None] = {}
        self._connections = 0
        self._parameter_callbacks: dict[str, list[Callable[[Any], object]]] = {}
        self._parameter_told: dict[str, Any] = {}
        self._stopped = False
        self.clock: GraphClock | TopicClock = GraphClock(self.scheduler)
        self.logger = Logger(self)
        self.slave = SlaveApi(self)
        self.uri = ""
        self.scheduler.on_hub(self._start)

    def _start(self) -> None:
        """Register: the Master hears of the node by its first registration, that of ``/rosout``."""
        graph = self.graph
        self.uri = graph.transport.attach(self)
        graph.add_node(self)
        for key, value in self.remappings.private_parameters.items():
            graph.master.setParam(self.name, resolve("~" + key, self.namespace, self.name), value)
        publication = Publication(self, "/rosout", graph.log_class)
        publication.latch = True  # as rospy's: the last message is for a listener that comes later, too
        self.publications["/rosout"] = publication
        self._ask("registerPublisher", "/rosout", graph.log_class._type, self.uri)
        graph.offer_logger_services(self)
        code, _, use_sim_time = graph.master.getParam(self.name, "/use_sim_time")
        if code == 1 and use_sim_time is True:
            self._follow_clock_topic()

    def _follow_clock_topic(self) -> None:
        clock = TopicClock(self.scheduler, self.logwarn)
        self.clock = clock
        self.subscriber("/clock", self.graph.clock_class, clock.update)

    def _ask(self, method: str, *arguments: Any) -> Any:
        """Call the Master and return the value of its answer. Raises ``ROSException`` with its status for any code but 1."""
        code, status, value = getattr(self.graph.master, method)(self.name, *arguments)
        if code != 1:
            msg = f"the Master refused {method} of node {self.name}: {status}"
            raise ROSException(msg)
        return value

    def __repr__(self) -> str:
        return f"<Node {self.name}{' (shut down)' if self._stopped else ''}>"

    # -- names ---------------------------------------------------------------------------------------------------

    def resolve(self, name: str) -> str:
        """Return the global name that ``name`` means here: namespace, private names and remappings applied."""
        return resolve(name, self.namespace, self.name, self.remappings)

    # -- topics --------------------------------------------------------------------------------------------------

    def publisher(
        self,
        topic: str,
        message_class: Any,
        *,
        queue_size: int | None = 10,
        latch: bool = False,
        on_connect: Callable[[str], object] | None = None,
        on_disconnect: Callable[[str], object] | None = None,
        headers: Header | None = None,
    ) -> Publisher:
        """Publish ``message_class`` on ``topic``.

        ``queue_size`` bounds what waits for one subscriber between two turns of the queue (None: no bound); ``latch`` gives late
        subscribers the last message. ``on_connect``/``on_disconnect`` are called with the other node's name. ``headers`` are further
        fields of the connection header, for subscribers that connect from now on.
        Raises ``TypeMismatch`` when this node publishes the topic with a type of another md5 sum.
        """
        return self.scheduler.on_hub(
            lambda: self._publisher(
                self.resolve(topic), message_class, queue_size, latch, headers, on_connect, on_disconnect
            )
        )

    def _publisher(
        self,
        topic: str,
        cls: Any,
        queue_size: int | None,
        latch: bool,
        headers: Header | None,
        *callbacks: Any,
    ) -> Publisher:
        self._require_running(f"publish {topic}")
        publication = self.publications.get(topic)
        if publication is None:
            publication = self.publications[topic] = Publication(self, topic, cls)
            publication.latch, publication.queue_size = latch, queue_size or None
            self._ask("registerPublisher", topic, cls._type, self.uri)
            self.graph.changed()
        elif publication.message_class._md5sum != cls._md5sum:
            msg = f"{self.name} already publishes {topic} as {publication.message_class._type}, not {cls._type}: use another topic."
            raise TypeMismatch(msg)
        else:
            publication.latch = publication.latch or latch
            publication.queue_size = queue_size or None
        publication.headers.update(extra_fields(headers))
        return Publisher(publication, *callbacks)

    def subscriber(
        self,
        topic: str,
        message_class: Any,
        callback: Callable[..., object] | None = None,
        *,
        arguments: tuple[Any, ...] = (),
        queue_size: int | None = None,
        numpy: bool = True,
        on_connect: Callable[[str], object] | None = None,
        on_disconnect: Callable[[str], object] | None = None,
        receipt: Callable[[Any], Callable[[Any], Any] | None] | None = None,
    ) -> Subscriber:
        """Call ``callback(message, *arguments)`` for each message on ``topic``.

        ``queue_size`` bounds what waits while a callback blocks (None: no bound; the oldest are dropped). ``numpy`` gives numeric
        arrays as read-only numpy arrays, else as rospy's tuples. ``receipt`` overrides both: see ``Subscriber.thaw_for``. All
        subscribers of this node to one topic get the same object, of the kind that the first asked for. Raises ``TypeMismatch`` for a
        type with another md5 sum than that of the first.
        """

        def make() -> Subscriber:
            name = self.resolve(topic)
            self._require_running(f"subscribe to {name}")
            subscription = self.subscriptions.get(name)
            fresh = subscription is None
            if subscription is None:
                subscription = self.subscriptions[name] = Subscription(self, name, message_class)
            elif subscription.disagrees_with(message_class):
                msg = f"{self.name} already subscribes to {name} as {subscription.message_class._type}, not {message_class._type}."
                raise TypeMismatch(msg)
            handle = Subscriber(
                subscription,
                message_class,
                callback,
                arguments,
                queue_size=queue_size,
                numpy=numpy,
                on_connect=on_connect,
                on_disconnect=on_disconnect,
                receipt=receipt,
            )
            if fresh:
                uris = self._ask("registerSubscriber", name, message_class._type, self.uri)
                subscription.update_publishers(uris)
                self.graph.changed()
            return handle

        return self.scheduler.on_hub(make)

    def drop_publication(self, publication: Publication) -> None:
        """Leave a topic. For the publisher handles only."""
        self.publications.pop(publication.topic, None)
        publication.close()
        self.graph.master.unregisterPublisher(self.name, publication.topic, self.uri)
        self.graph.changed()

    def drop_subscription(self, subscription: Subscription) -> None:
        """Leave a topic. For the subscriber handles only."""
        self.subscriptions.pop(subscription.topic, None)
        subscription.close()
        self.graph.master.unregisterSubscriber(self.name, subscription.topic, self.uri)
        self.graph.changed()

    def wait_for_message(
        self, topic: str, message_class: Any, timeout: float | None = None, *, numpy: bool = True
    ) -> Any:
        """Block until one message arrives on ``topic`` and return it. Raises ``ROSException`` after ``timeout`` seconds."""
        name = self.resolve(topic)
        waiter = self.waiter(f"a message on {name}")
        subscriber = self.subscriber(topic, message_class, waiter.wake, numpy=numpy)
        try:
            if not self.wait(waiter, timeout):
                raise timed_out(timeout or 0, f"a message on {name}: {self.graph.who_publishes(name)}")
        finally:
            subscriber.unregister()
        return waiter.value

    # -- services ------------------------------------------------------------------------------------------------

    def service(
        self, name: str, service_class: Any, handler: Callable[[Any], Any], *, numpy: bool = True
    ) -> ServiceServer:
        """Offer a service: ``handler(request)`` returns the response. Raises ``ROSException`` if this node offers it already."""

        def make() -> ServiceServer:
            resolved = self.resolve(name)
            self._require_running(f"offer {resolved}")
            if resolved in self.services:
                msg = f"service [{resolved}] is already offered by {self.name}: shut the first one down before offering it again"
                raise ROSException(msg)
            server = self.services[resolved] = ServiceServer(
                self, resolved, service_class, handler, numpy=numpy
            )
            uri = self.graph.transport.service_uri(self.uri)
            self._ask("registerService", resolved, uri, self.uri)
            self.graph.changed()
            return server

        return self.scheduler.on_hub(make)

    def service_client(
        self,
        name: str,
        service_class: Any,
        *,
        persistent: bool = False,
        numpy: bool = True,
        headers: Header | None = None,
    ) -> ServiceClient:
        """Return what calls a service, whether it is there yet or not. ``headers`` are further fields of the connection header."""
        return ServiceClient(
            self, self.resolve(name), service_class, persistent=persistent, numpy=numpy, headers=headers
        )

    def drop_service(self, server: ServiceServer) -> None:
        """Withdraw a service. For the server only."""
        if self.services.get(server.name) is server:
            del self.services[server.name]
        self.graph.master.unregisterService(
            self.name, server.name, self.graph.transport.service_uri(self.uri)
        )
        self.graph.changed()

    def wait_for_service(self, name: str, timeout: float | None = None) -> None:
        """Block until somebody offers the service. Raises ``ROSException`` after ``timeout`` seconds."""
        resolved = self.resolve(name)
        self.wait_until(
            lambda: self.graph.master.lookupService(self.name, resolved)[0] == 1,
            timeout,
            f"the service {resolved} to be offered",
            lambda: f"nobody offers {resolved}",
        )

    # -- what runs by itself -------------------------------------------------------------------------------------

    def rate(self, hz: float, *, reset: bool = False) -> Rate:
        """Return what keeps a loop at ``hz`` turns a second."""
        return Rate(self, hz, reset=reset)

    def timer(
        self,
        period: float | Duration,
        callback: Callable[[TimerEvent], object],
        *,
        oneshot: bool = False,
        reset: bool = False,
    ) -> Timer:
        """Call ``callback(event)`` every ``period`` seconds."""
        span = period if isinstance(period, Duration) else Duration.from_sec(period)
        return self.scheduler.on_hub(lambda: Timer(self, span, callback, oneshot=oneshot, reset=reset))

    def spawn(self, name: str, task: Callable[[], object] | None = None) -> Lane:
        """Return a lane of this node; ``task`` may block in it."""
        lane = Lane(self.scheduler, name, node=self, context=self.context, on_error=self._lane_error)
        if task is not None:
            lane.submit(task)
        return lane

    def run(self, task: Callable[[], object], name: str | None = None) -> Lane:
        """Run ``task`` as this node's main program: it may sleep, wait and call services while the graph goes on."""
        return self.spawn(name or f"{self.name} {getattr(task, '__name__', 'task')}", task)

    # -- callbacks that fail -------------------------------------------------------------------------------------

    def guarded(self, callback: Callable[..., object], *arguments: Any, what: str) -> None:
        """Call a user's callback; an error is reported and goes no further."""
        try:
            callback(*arguments)
        except Exception as error:
            self.callback_failed(error, callback, what, None)

    def callback_failed(
        self,
        error: Exception,
        callback: Callable[..., object],
        where: str,
        message: Any,
        *,
        service: bool = False,
    ) -> None:
        """Report an exception that a callback let out, with the user's own frame, where it came from, and the message."""
        if self._ended_by_shutdown(error):
            return
        self.graph.report(
            describe_failure(error, callback, where, message, self.name), self, raise_strict=not service
        )

    def _lane_error(self, error: BaseException) -> None:
        if not self._ended_by_shutdown(error):
            self.graph.report(error, self)

    def _ended_by_shutdown(self, error: BaseException) -> bool:
        """Tell whether an error only says that the node, or the whole graph with the servers in it, ends."""
        if isinstance(error, ServiceException):
            return self.graph.closing
        return self._stopped and isinstance(error, ROSInterruptException)

    # -- the end -------------------------------------------------------------------------------------------------

    def on_shutdown(self, hook: Callable[[], object]) -> None:
        """Call ``hook()`` when the node shuts down, while it can still publish."""
        self._hooks.append(hook)

    def shutdown(self, reason: str = "") -> None:
        """Shut the node down: hooks, then blocked calls, then connections and registrations. Harmless when repeated."""
        self.scheduler.on_hub(lambda: self._shutdown(reason))

    def shutdown_requested(self, caller: str, reason: str) -> None:
        """Learn by the slave API that the node is to end; it does so in a lane of its own."""
        self.logger.console(LEVELS["WARN"], f"shutdown request: {reason}")
        if caller == "/master" and "same name" in reason:
            problem = DuplicateNode(
                f"{self.name} was shut down because another node registered under its name. Give one of them another name: "
                f"__name:=other on the command line, anonymous=True, or another namespace."
            )
            self.graph.report(problem, self, raise_strict=False)
        self.spawn(f"{self.name} shutdown", lambda: self._shutdown(reason))

    def _shutdown(self, reason: str) -> None:
        if self.shutdown_reason is not None:
            return
        self.shutdown_reason = reason
        problem = self._run_hooks()
        self._stopped = True
        graph, master = self.graph, self.graph.master
        for waiter in list(self._waiters):
            waiter.fail(ROSInterruptException(self._shutdown_message()))
        for server in list(self.services.values()):
            server.shutdown(reason)
        for topic, subscription in self.subscriptions.items():
            for subscriber in subscription.handles:
                subscriber.detach()
            subscription.close()
            master.unregisterSubscriber(self.name, topic, self.uri)
        for topic, publication in self.publications.items():
            for publisher in publication.handles:
                publisher.detach()
            publication.close()
            master.unregisterPublisher(self.name, topic, self.uri)
        if isinstance(self.clock, TopicClock):
            self.clock.close()
        graph.transport.detach(self.uri)
        graph.remove_node(self)
        if problem is not None:
            raise problem

    def _run_hooks(self) -> CallbackError | None:
        """Run the shutdown hooks, all of them; return the first error that is to be raised here."""
        problem = None
        for hook in self._hooks:
            try:
                self.guarded(hook, what="shutdown hook")
            except CallbackError as error:
                problem = problem or error
        return problem

    def _require_running(self, what: str) -> None:
        if self.shutdown_reason is not None:
            msg = f"{self._shutdown_message()}; it cannot {what} any more. Make a new node."
            raise ROSException(msg)

    # -- called across the transport seam ------------------------------------------------------------------------

    def slave_call(self, method: str, *arguments: Any) -> Triple:
        """Answer the slave API."""
        return self.slave.call(method, *arguments)

    def accept_subscriber(self, header: Header, sender: Sender) -> Header:
        """Take a subscriber's connection."""
        publication = self.publications.get(header.get("topic", ""))
        if publication is None:
            raise TransportInitError(
                f"[{self.name}] is not a publisher of [{header.get('topic')}]. Topics are {self.slave.getPublications('')[2]}"
            )
        return publication.accept(header, sender)

    def accept_client(self, header: Header) -> Session:
        """Take a service client's connection."""
        server = self.services.get(header.get("service", ""))
        if server is None:
            raise TransportInitError(f"[{self.name}] is not a provider of [{header.get('service')}]")
        return server.accept(header)

    def next_connection_id(self) -> int:
        """Return a number for a new connection."""
        self._connections += 1
        return self._connections

    def connections_changed(self) -> None:
        """Learn that a connection opened or closed."""
        self.graph.changed()
