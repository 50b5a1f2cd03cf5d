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

from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Unpack

from rosmini.core.errors import (
    CallbackError,
    DuplicateNode,
    MasterUnreachable,
    ROSException,
    ROSInterruptException,
    ROSTimeMovedBackwardsException,
    ServiceException,
    TransportInitError,
    TypeMismatch,
)
from rosmini.core.names import Remappings, canonicalize, check_base_name, check_name, resolve
from rosmini.core.time import Duration, Time

from .callbacks import describe_failure
from .clock import GraphClock, Rate, Timer, TimerEvent, TopicClock
from .lanes import Lane, Waiter
from .master_port import MasterProxy
from .observers.topic_statistics import TopicStatistics, are_wanted
from .parameter_client import UNSET, ParameterClient
from .publisher import Publication, Publisher
from .rosout import LEVELS, Logger, logger_services
from .service import ServiceClient, Services, ServiceServer, Session, timed_out
from .slave import SlaveApi
from .subscription import Subscriber, Subscription
from .transport import extra_fields

if TYPE_CHECKING:
    from collections.abc import Callable

    from .graph import Graph
    from .lanes import LaneContext
    from .rosout import LogOptions
    from .transport import Header, Sender, Triple


TICKS_PER_REFUSAL = 100
"""Number of ticks charged for a blocking call that raises because its node was shut down: raising is expensive."""

POLL_NS = 100_000_000
"""Interval at which a Master in another process is queried for changes [ns]."""


class Node:
    """A node of a :class:`~rosmini.core.graph.graph.Graph`; made by ``graph.node(name)`` or ``Node(name)``.

    Args:
        name: the node's base name (``talker``), resolved in ``namespace``.
        graph: the graph; the process's default graph if not given.
        namespace: the namespace in which relative names of this node are resolved (``__ns:=``).
        remappings: ``{"chatter": "/robot1/chatter"}``, or a :class:`~rosmini.core.names.Remappings`.
        anonymous: append a number that makes the name unique.
        context: the script that the node belongs to, or None.
        has_rosout: publish the node's log on ``/rosout``.

    A running node of the same name is shut down, as in ROS. Raises ``IllegalName`` for an illegal name or namespace.

    """

    default_graph: ClassVar[Callable[..., Graph]]
    """Function that returns the graph of a node for which none is given."""

    def __init__(
        self,
        name: str,
        graph: Graph | None = None,
        *,
        namespace: str = "/",
        remappings: dict[str, str] | Remappings | None = None,
        anonymous: bool = False,
        context: LaneContext | None = None,
        has_rosout: bool = True,
    ) -> None:
        self.graph = graph = self.default_graph() if graph is None else graph
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
        self.master = MasterProxy(graph, self.name, self._stop_reason)
        self.shutdown_reason: str | None = None
        self.is_registered = False
        """True once the node has registered at the Master."""
        self.on_exit: Callable[[], object] | None = None
        """Called once, when the node has been shut down and unregistered."""
        self.process: Any = None
        """The object that runs the node and can ``kill()`` it, or None."""
        self.program: Any = None
        """The object behind a built-in node, such as a `Simulator`, once it is set up."""
        self.publications: dict[str, Publication] = {}
        self.subscriptions: dict[str, Subscription] = {}
        self.services = Services(self)
        self._hooks: list[Callable[[], object]] = []
        self.timers: dict[Timer, None] = {}
        """The running timers."""
        self._waiters: dict[Waiter, None] = {}
        self._connections = 0
        self.parameters = ParameterClient(self)
        self._stopped = False
        self.clock: GraphClock | TopicClock = GraphClock(self.scheduler)
        self.logger = Logger(self)
        self.slave = SlaveApi(self)
        self.uri = ""
        self.scheduler.run_in_scheduler(lambda: self._start(has_rosout=has_rosout))

    def _start(self, *, has_rosout: bool) -> None:
        """Register the node and its basic services at the Master, and choose its clock."""
        graph = self.graph
        self.uri = graph.transport.attach(self)
        log_file = graph.add_node(self)
        if log_file is not None:
            self.logger.open_file(log_file)
        for key, value in self.remappings.private_parameters.items():
            name = resolve("~" + key, self.namespace, self.name)
            self.master.insist("setParam", name, value, warn=self.logerr)
        if has_rosout:
            publication = Publication(self, "/rosout", graph.log_class)
            publication.latch = True  # as in rospy: later listeners also get the last message
            self._publish(publication)
        for service, service_class, handler in logger_services(self.logger):
            self.service(service, service_class, handler)
        self.is_registered = True
        code, _, use_sim_time = self.master.insist("getParam", "/use_sim_time", warn=self.logerr)
        if code == 1 and use_sim_time is True and not graph.keeps_time:
            self._follow_clock_topic()

    def _follow_clock_topic(self) -> None:
        clock = TopicClock(self.scheduler, self.logwarn)
        self.clock = clock
        self.subscriber("/clock", self.graph.clock_class, clock.update)

    def __repr__(self) -> str:
        return f"<Node {self.name}{' (shut down)' if self._stopped else ''}>"

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
        """Return a publisher of ``message_class`` on ``topic``.

        ``queue_size`` limits the messages that wait for a slow subscriber once the connection's buffers are full; the
        oldest are dropped (None or 0: no limit). ``latch`` gives late subscribers the last message.
        ``on_connect``/``on_disconnect`` get the other node's name. ``headers`` are additional fields of the connection
        header for subscribers that connect from now on. Raises ``TypeMismatch`` if this node already publishes the
        topic with a type whose md5 sum differs.
        """
        return self.scheduler.run_in_scheduler(
            lambda: self._publisher(
                self.resolve(topic), message_class, queue_size, latch, headers, on_connect, on_disconnect
            )
        )

    def _publisher(
        self, topic: str, cls: Any, queue_size: int | None, latch: bool, headers: Header | None, *callbacks: Any
    ) -> Publisher:
        self.require_running(f"publish {topic}")
        publication = self.publications.get(topic)
        if publication is None:
            publication = Publication(self, topic, cls)
            publication.latch, publication.queue_size = latch, queue_size or None
            self._publish(publication)
        elif publication.message_class._md5sum != cls._md5sum:
            mine = publication.message_class._type
            msg = f"{self.name} already publishes {topic} as {mine}, not {cls._type}: use another topic."
            raise TypeMismatch(msg)
        else:
            publication.latch = publication.latch or latch
            publication.queue_size = queue_size or None
        publication.headers.update(extra_fields(headers))
        return Publisher(publication, *callbacks)

    def _publish(self, publication: Publication) -> None:
        topic = publication.topic
        self.publications[topic] = publication
        self.slave.topics_changed()  # subscribers may ask before the Master has answered
        try:
            self.master.register(
                "registerPublisher", topic, publication.message_class._type, self.uri, warn=self.logerr
            )
        except ROSException:
            del self.publications[topic]
            self.slave.topics_changed()
            raise

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
        tcp_nodelay: bool = False,
        skip_own_mismatch: bool = False,
        takes_batches: bool = False,
    ) -> Subscriber:
        """Call ``callback(message, *arguments)`` for each message on ``topic``.

        ``queue_size`` limits the messages that wait while a callback blocks (None: no limit; the oldest are dropped).
        With ``takes_batches``, as in rospy, all messages that wait when a callback returns are delivered, even if newer
        ones arrive meanwhile; otherwise newer messages replace them, as in roscpp.

        With ``numpy``, numeric arrays are read-only numpy arrays, otherwise tuples as in rospy. ``receipt`` overrides
        both: see ``Subscriber.thaw_for``. All subscribers of this node to one topic get the same object, in the form
        that the first one requested.

        With ``tcp_nodelay``, publishers of other processes are asked to send each message at once.
        ``skip_own_mismatch`` allows this node itself to publish the topic with another type, as roscpp does. Raises
        ``TypeMismatch`` for a type whose md5 sum differs from that of the first subscriber.
        """

        def make() -> Subscriber:
            name = self.resolve(topic)
            self.require_running(f"subscribe to {name}")
            statistics = TopicStatistics(self, name) if are_wanted(self, name) else None
            if self._stopped:  # shut down while it waited for the Master
                raise ROSInterruptException(self._shutdown_message())
            subscription = self.subscriptions.get(name)
            fresh = subscription is None
            if subscription is None:
                subscription = self.subscriptions[name] = Subscription(self, name, message_class)
                subscription.statistics = statistics
            elif subscription.disagrees_with(message_class):
                mine = subscription.message_class._type
                msg = f"{self.name} already subscribes to {name} as {mine}, not {message_class._type}."
                raise TypeMismatch(msg)
            subscription.tcp_nodelay |= tcp_nodelay
            subscription.skips_own_mismatch |= skip_own_mismatch
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
                takes_batches=takes_batches,
            )
            if fresh:
                self._subscribe(subscription)
            return handle

        return self.scheduler.run_in_scheduler(make)

    def _subscribe(self, subscription: Subscription) -> None:
        topic = subscription.topic
        self.slave.topics_changed()
        before = subscription.updates
        try:
            uris = self.master.register(
                "registerSubscriber", topic, subscription.message_class._type, self.uri, warn=self.logerr
            )
        except ROSException:
            del self.subscriptions[topic]
            self.slave.topics_changed()
            raise
        # Updates from the Master since then are newer than this response, and the node may have left the topic by now.
        if subscription.updates == before and self.subscriptions.get(topic) is subscription:
            subscription.update_publishers(uris)

    def publishers_changed(self, topic: str, uris: list[str]) -> None:
        """Connect to the current publishers of a topic, which the Master has reported."""
        subscription = self.subscriptions.get(topic)
        if subscription is not None:
            subscription.update_publishers(uris)

    def drop_publication(self, publication: Publication) -> None:
        """Stop publishing a topic. Called only by the publisher handles."""
        self.publications.pop(publication.topic, None)
        self.slave.topics_changed()
        publication.close()
        self.master.unregister("unregisterPublisher", publication.topic, self.uri, warn=self.logwarn)

    def drop_subscription(self, subscription: Subscription) -> None:
        """Unsubscribe from a topic. Called only by the subscriber handles."""
        self.subscriptions.pop(subscription.topic, None)
        self.slave.topics_changed()
        subscription.close()
        self.master.unregister("unregisterSubscriber", subscription.topic, self.uri, warn=self.logwarn)

    def wait_for_message(
        self, topic: str, message_class: Any, timeout: float | None = None, *, numpy: bool = True
    ) -> Any:
        """Block until one message arrives on ``topic`` and return it.

        Raises ``ROSException`` after ``timeout`` seconds.
        """
        name = self.resolve(topic)
        waiter = self.waiter(f"a message on {name}")
        subscriber = self.subscriber(topic, message_class, waiter.wake, numpy=numpy)
        try:
            if not self.wait(waiter, timeout):
                raise timed_out(timeout or 0, f"a message on {name}: {self.master.who_publishes(name)}")
        finally:
            subscriber.unregister()
        return waiter.value

    # -- services ------------------------------------------------------------------------------------------------

    def service(
        self, name: str, service_class: Any, handler: Callable[[Any], Any], *, numpy: bool = True
    ) -> ServiceServer:
        """Offer a service, and return its server; ``handler(request)`` returns the response.

        Raises ``ROSException`` if this node offers it already.
        """
        return self.services.offer(name, service_class, handler, numpy=numpy)

    def service_client(
        self,
        name: str,
        service_class: Any,
        *,
        persistent: bool = False,
        numpy: bool = True,
        headers: Header | None = None,
    ) -> ServiceClient:
        """Return a client that calls a service; the service need not exist yet.

        ``headers`` are additional fields of the connection header.
        """
        return ServiceClient(
            self, self.resolve(name), service_class, persistent=persistent, numpy=numpy, headers=headers
        )

    def wait_for_service(self, name: str, timeout: float | None = None) -> None:
        """Block until a node that responds offers the service. Raises ``ROSException`` after ``timeout`` seconds."""
        self.services.wait_for(name, timeout)

    # -- parameters ----------------------------------------------------------------------------------------------

    def get_param(self, name: str, default: Any = UNSET, *, expect: type | tuple[type, ...] | None = None) -> Any:
        """Return a parameter's value, or ``default`` if it is not set.

        Raises ``ParameterNotSet``, which names similar parameters, if it is not set and there is no default. Raises
        ``ParameterError`` if the value does not have a type in ``expect`` (an int is accepted for a float).
        """
        return self.parameters.get(name, default, expect=expect)

    def set_param(self, name: str, value: Any) -> None:
        """Set a parameter; a dictionary sets a whole tree. Raises ``ParameterError`` if ROS cannot store the value."""
        self.parameters.set(name, value)

    def has_param(self, name: str) -> bool:
        """Return True if a parameter, or a tree of them, is set."""
        return self.parameters.has(name)

    def delete_param(self, name: str) -> None:
        """Delete a parameter or a tree of them. Raises ``ParameterNotSet`` if it is not set."""
        self.parameters.delete(name)

    def search_param(self, name: str) -> str | None:
        """Return the full name of the nearest parameter, searching upwards from the node's namespace, or None."""
        return self.parameters.search(name)

    def param_names(self) -> list[str]:
        """Return the names of all parameters, sorted."""
        return self.parameters.names()

    # -- names ---------------------------------------------------------------------------------------------------

    def resolve(self, name: str) -> str:
        """Return the global name of ``name``, resolved by the node's namespace, private names and remappings."""
        return resolve(name, self.namespace, self.name, self.remappings)

    def resolve_parameter(self, name: str) -> str:
        """Return the global name of a parameter's ``name``; as in rospy its characters are not checked."""
        return resolve(name, self.namespace, self.name, self.remappings, what="parameter name", check=False)

    # -- log messages --------------------------------------------------------------------------------------------

    def logdebug(self, text: object, **options: Unpack[LogOptions]) -> None:
        """Log ``text`` at level DEBUG."""
        self.logger.write("DEBUG", text, **options)

    def loginfo(self, text: object, **options: Unpack[LogOptions]) -> None:
        """Log ``text`` at level INFO."""
        self.logger.write("INFO", text, **options)

    def logwarn(self, text: object, **options: Unpack[LogOptions]) -> None:
        """Log ``text`` at level WARN."""
        self.logger.write("WARN", text, **options)

    def logerr(self, text: object, **options: Unpack[LogOptions]) -> None:
        """Log ``text`` at level ERROR."""
        self.logger.write("ERROR", text, **options)

    def logfatal(self, text: object, **options: Unpack[LogOptions]) -> None:
        """Log ``text`` at level FATAL."""
        self.logger.write("FATAL", text, **options)

    # -- time ----------------------------------------------------------------------------------------------------

    def now(self) -> Time:
        """Return the node's time."""
        return Time.from_nsec(self.clock.now_ns())

    def sleep(self, duration: float | Duration) -> None:
        """Block for ``duration`` [s] of the node's time; for zero or less, only let other lanes run.

        Raises ``ROSInterruptException`` if the node shuts down meanwhile, ``ROSTimeMovedBackwardsException`` if its
        clock jumps back.
        """
        self.sleep_ns(duration.to_nsec() if isinstance(duration, Duration) else int(duration * 1e9))

    def sleep_ns(self, span: int) -> None:
        """Block for ``span`` [ns] of the node's time; see :meth:`sleep`."""
        if span <= 0 and not self._stopped:
            self.scheduler.yield_to_others()  # a loop that cannot keep its rate must not block the other lanes
        if self._stopped:
            self._refuse_to_block()
        if span <= 0:
            return
        clock = self.clock
        if isinstance(clock, GraphClock):
            waiter = Waiter(self.scheduler, "time to pass")
            self._waiters[waiter] = None
            try:
                waiter.wait(span)
            finally:
                self._waiters.pop(waiter, None)
            return
        if clock.now_ns() == 0:
            self._wait_on_topic(clock, 1, "the first message on /clock")
        start = clock.now_ns()
        self._wait_on_topic(clock, start + span, "time to pass")
        now = clock.now_ns()
        if now < start:
            raise ROSTimeMovedBackwardsException((now - start) / 1e9)

    def _wait_on_topic(self, clock: TopicClock, when_ns: int, reason: str) -> None:
        waiter = self.waiter(reason)
        cancel = self.scheduler.run_in_scheduler(lambda: clock.call_at(when_ns, waiter.wake))
        try:
            self.wait(waiter)
        finally:
            cancel()

    # -- blocking ------------------------------------------------------------------------------------------------

    def waiter(self, reason: str, *, remote: bool = False) -> Waiter:
        """Return a new waiter; ``reason`` completes "... was waiting for".

        ``remote``: True if another process will wake it.
        """
        return self.scheduler.waiter(reason, remote=remote)

    def wait(self, waiter: Waiter, timeout: float | None = None, *, timeout_ns: int | None = None) -> bool:
        """Block until ``waiter`` is woken (True) or ``timeout`` seconds have passed (False).

        Raises ``ROSInterruptException`` if the node shuts down meanwhile.
        """
        if self._stopped:
            self._refuse_to_block()
        if timeout is not None and timeout_ns is None:
            timeout_ns = int(timeout * 1e9)
        self._waiters[waiter] = None
        try:
            return waiter.wait(timeout_ns)
        finally:
            self._waiters.pop(waiter, None)

    def _refuse_to_block(self) -> NoReturn:
        """Raise ``ROSInterruptException``; a loop that ignores it still lets other lanes run."""
        self.scheduler.tick(TICKS_PER_REFUSAL)
        raise ROSInterruptException(self._shutdown_message())

    def wait_until(
        self, condition: Callable[[], bool], timeout: float | None, reason: str, failure: Callable[[], str]
    ) -> None:
        """Block until ``condition()`` is true. It may use only this node's own data, and must not block.

        Raises ``ROSException`` with the text ``failure()`` after ``timeout`` seconds.
        """
        waiter = self.waiter(reason)

        def begin() -> None:
            self.graph.changes.watch(condition, waiter)

        self.scheduler.run_in_scheduler(begin)
        if not self.wait(waiter, timeout):
            waiter.wake()
            msg = f"timeout exceeded after {timeout:g} s while waiting for {reason}: {failure()}"
            raise ROSException(msg)

    def wait_for_master(
        self,
        is_so: Callable[[], bool],
        timeout: float | None,
        reason: str,
        failure: Callable[[], str],
        must_poll: Callable[[], bool] = lambda: False,
    ) -> None:
        """Block until ``is_so()``, which queries the Master, returns True.

        It is called after each change there, and periodically if the Master is in another process, or while
        ``must_poll()`` returns True.

        Raises ``ROSException`` with the text ``failure()`` after ``timeout`` seconds.
        """
        scheduler = self.scheduler
        end = None if timeout is None else scheduler.now_ns() + int(timeout * 1e9)
        while True:
            waiter = self.waiter(reason)
            scheduler.run_in_scheduler(
                partial(self.graph.changes.next, waiter)
            )  # before the call, so that no change is missed
            try:
                if self._is_answered(is_so):
                    return
                span = None if end is None else max(end - scheduler.now_ns(), 0)
                if not self.graph.master.is_local or must_poll():
                    span = POLL_NS if span is None else min(span, POLL_NS)
                if not self.wait(waiter, timeout_ns=span) and end is not None and scheduler.now_ns() >= end:
                    msg = f"timeout exceeded after {timeout:g} s while waiting for {reason}: {failure()}"
                    raise ROSException(msg)
            finally:
                waiter.wake()

    def _is_answered(self, is_so: Callable[[], bool]) -> bool:
        try:
            return is_so()
        except MasterUnreachable:
            return False  # it may come back; rospy also keeps trying

    def spin(self) -> None:
        """Block until the node is shut down; callbacks continue to run."""
        if not self._stopped:
            waiter = self.waiter("spin")
            self._waiters[waiter] = None
            try:
                waiter.wait()
            except ROSInterruptException:
                return
            finally:
                self._waiters.pop(waiter, None)

    # -- lanes and callbacks -------------------------------------------------------------------------------------

    def spawn(self, name: str, task: Callable[[], object] | None = None) -> Lane:
        """Start a lane of this node and return it; if given, ``task`` runs in it and may block."""
        lane = Lane(self.scheduler, name, node=self, context=self.context, on_error=self._lane_error)
        if task is not None:
            lane.submit(task)
        return lane

    def run(self, task: Callable[[], object], name: str | None = None) -> Lane:
        """Run ``task`` as this node's main program: it may sleep, wait and call services while the graph continues."""
        return self.spawn(name or f"{self.name} {getattr(task, '__name__', 'task')}", task)

    def guarded(self, callback: Callable[..., object], *arguments: Any, what: str) -> None:
        """Call a user's callback; report an exception instead of raising it."""
        try:
            callback(*arguments)
        except Exception as error:
            self.callback_failed(error, callback, what, None)

    def callback_failed(
        self, error: Exception, callback: Callable[..., object], where: str, message: Any, *, service: bool = False
    ) -> None:
        """Report an exception of a callback, with the line of the user's code, ``where`` and the message.

        An exception of a ``service`` handler is only logged, even if the graph is strict: the client receives it too.
        """
        if self._is_by_shutdown(error):
            return
        problem = describe_failure(error, callback, where, message, self.name)
        self.graph.report(problem, self, raise_strict=not service)

    def _lane_error(self, error: BaseException) -> None:
        if not self._is_by_shutdown(error):
            self.graph.report(error, self)

    def _is_by_shutdown(self, error: BaseException) -> bool:
        """Return True if an error only means that the node, or the whole graph with its servers, is shutting down."""
        if isinstance(error, ServiceException):
            return self.graph.closing
        return self._stopped and isinstance(error, ROSInterruptException)

    # -- rates and timers ----------------------------------------------------------------------------------------

    def rate(self, hz: float, *, reset: bool = False) -> Rate:
        """Return a ``Rate``, which keeps a loop at ``hz`` cycles per second.

        Raises ``InvalidRate`` if ``hz`` is not positive.
        """
        return Rate(self, hz, reset=reset)

    def timer(
        self,
        period: float | Duration,
        callback: Callable[[TimerEvent], object],
        *,
        oneshot: bool = False,
        reset: bool = False,
    ) -> Timer:
        """Return a ``Timer`` that calls ``callback(event)`` every ``period`` seconds, or once with ``oneshot``.

        ``reset`` lets it survive a clock that jumps back. Raises ``RosminiError`` if the period is not positive.
        """
        span = period if isinstance(period, Duration) else Duration.from_sec(period)
        return self.scheduler.run_in_scheduler(lambda: Timer(self, span, callback, oneshot=oneshot, reset=reset))

    # -- shutdown ------------------------------------------------------------------------------------------------

    def on_shutdown(self, hook: Callable[[], object]) -> None:
        """Call ``hook()`` when the node shuts down, while it can still publish."""
        self._hooks.append(hook)

    def shutdown(self, reason: str = "", *, hooks: bool = True) -> None:
        """Run the shutdown hooks, end blocked calls, close connections, and unregister. Safe to call again.

        With ``hooks`` False, no hook runs, and the call does not wait for one that is already running.
        """
        self.scheduler.run_in_scheduler(lambda: self._shutdown(reason, hooks=hooks))

    def kill(self) -> None:
        """End like a killed process: no hook runs, and the Master is not notified."""
        self.master.skips_unregister = True
        if self.process is not None:
            self.scheduler.run_in_scheduler(self.process.kill)
        self.shutdown("it was killed", hooks=False)

    def shutdown_requested(self, caller: str, reason: str) -> None:
        """Shut down in a separate lane, as requested through the slave API.

        A notice about two nodes with another name is ignored: it was meant for a node that had this address before.
        """
        is_replaced = caller == "/master" and "same name" in reason
        if is_replaced and reason.startswith("[/") and not reason.startswith(f"[{self.name}]"):
            return
        self.logger.console(LEVELS["WARN"], f"shutdown request: {reason}")
        if is_replaced:
            problem = DuplicateNode(
                f"{self.name} was shut down because another node registered under its name. Give one of them another "
                f"name: __name:=other on the command line, anonymous=True, or another namespace."
            )
            self.graph.report(problem, self, raise_strict=False)
        self.spawn(f"{self.name} shutdown", lambda: self._shutdown(reason))

    def _shutdown(self, reason: str, *, hooks: bool = True) -> None:
        if self._stopped or (hooks and self.shutdown_reason is not None):
            return
        self.shutdown_reason = self.shutdown_reason or reason
        problem = self._run_hooks() if hooks else None
        if self._stopped:  # it was shut down while a hook was running
            return
        self._stopped = True
        graph = self.graph
        for waiter in list(self._waiters):
            waiter.fail(ROSInterruptException(self._shutdown_message()))
        for timer in list(self.timers):
            timer.shutdown()
        servers, subscriptions = list(self.services.values()), list(self.subscriptions.values())
        publications = list(self.publications.values())
        for server in servers:
            server.close_sessions(reason)
        for subscription in subscriptions:
            subscription.end()
        self.slave.end()
        for publication in publications:
            publication.end()
        for server in servers:  # the Master last, because it may take time
            server.shutdown(reason)
        for subscription in subscriptions:
            self.master.unregister("unregisterSubscriber", subscription.topic, self.uri, warn=self.logwarn)
        for publication in publications:
            self.master.unregister("unregisterPublisher", publication.topic, self.uri, warn=self.logwarn)
        if isinstance(self.clock, TopicClock):
            self.clock.close()
        graph.transport.detach(self.uri)
        graph.remove_node(self)
        self.logger.close_file()
        if self.on_exit is not None:
            self.on_exit()
        if problem is not None:
            raise problem

    def _run_hooks(self) -> CallbackError | None:
        """Run all shutdown hooks; return the first error that must be raised here."""
        problem = None
        for hook in self._hooks:
            try:
                self.guarded(hook, what="shutdown hook")
            except CallbackError as error:
                problem = problem or error
        return problem

    def is_shutdown(self) -> bool:
        """Return True if the node has been shut down."""
        return self._stopped

    def _stop_reason(self) -> str | None:
        return self._shutdown_message() if self._stopped else None

    def _shutdown_message(self) -> str:
        return f"node {self.name} was shut down" + (f": {self.shutdown_reason}" if self.shutdown_reason else "")

    def require_running(self, what: str) -> None:
        """Raise ``ROSException`` if the node has been shut down and can no longer do ``what``."""
        if self.shutdown_reason is not None:
            msg = f"{self._shutdown_message()}; it cannot {what} any more. Make a new node."
            raise ROSException(msg)

    # -- called by the transports --------------------------------------------------------------------------------

    def slave_call(self, method: str, *arguments: Any) -> Triple:
        """Return the response to a call of the slave API: [code, status, value]."""
        return self.slave.call(method, *arguments)

    def accept_subscriber(self, header: Header, sender: Sender) -> Header:
        """Accept a subscriber's connection; return the header for it.

        Raises ``TransportInitError`` if the node does not publish the topic, or the subscriber's type does not match.
        """
        publication = None if self._stopped else self.publications.get(header.get("topic", ""))
        if publication is None:
            raise TransportInitError(
                f"[{self.name}] is not a publisher of [{header.get('topic')}]. Topics are "
                f"{self.slave.getPublications('')[2]}"
            )
        return publication.accept(header, sender)

    def accept_client(self, header: Header) -> Session:
        """Accept a service client's connection; return its session.

        Raises ``TransportInitError`` if the node does not offer the service.
        """
        return self.services.accept(header)

    def next_connection_id(self) -> int:
        """Return a number for a new connection."""
        self._connections += 1
        return self._connections

    def connections_changed(self) -> None:
        """Notify the slave API, and code that waits for a change, that a connection has opened or closed."""
        self.slave.connections_changed()
        self.graph.changes.notify()
