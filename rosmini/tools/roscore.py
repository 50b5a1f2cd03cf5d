"""`rosmini roscore`: the Master, the Parameter Server and `/rosout`, for the nodes of all processes and machines."""

from __future__ import annotations

import argparse
import os
import sys
import uuid
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, RosminiError

from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    from rosmini.core.graph import Graph
    from rosmini.ros.net.addresses import Addresses
    from rosmini.ros.net.master_server import MasterServer

EPILOG = """\
The Master is at the port that ROS_MASTER_URI names, 11311 if it names none; -p chooses another. Only this machine
reaches it, unless ROS_IP or ROS_HOSTNAME (or __ip:=ADDRESS, __hostname:=NAME here) says under which address others do.

Ctrl-C ends it.

for example: rosmini roscore -p 11322
"""

SIGNS = {
    "registerPublisher": "+PUB",
    "unregisterPublisher": "-PUB",
    "registerSubscriber": "+SUB",
    "unregisterSubscriber": "-SUB",
    "registerService": "+SERVICE",
    "unregisterService": "-SERVICE",
    "setParam": "+PARAM",
    "deleteParam": "-PARAM",
    "subscribeParam": "+CACHEDPARAM",
    "unsubscribeParam": "-CACHEDPARAM",
}
"""Symbols in rosmaster's log for calls that change something."""


def port_number(text: str) -> int:
    """Parse a port number."""
    if text.isascii() and text.isdecimal() and 0 < int(text) < 65536:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r} is not the number of a port, 1 to 65535")


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `roscore`."""
    parser = subparsers.add_parser(
        "roscore",
        help="the Master, the Parameter Server and /rosout",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("-p", "--port", type=port_number, help="the port of the Master")
    parser.add_argument(
        "--core", action="store_true", help="only the Master and the Parameter Server, as `rosmaster --core`"
    )
    parser.add_argument("-v", "--verbose", action="store_true", help="show what is registered and set")
    parser.add_argument("words", nargs="*", metavar="NAME:=VALUE", help="__ip:=, __hostname:=, __master:=")
    return parser


def main(args: argparse.Namespace) -> int:
    """Serve until Ctrl-C, SIGTERM or a call of the Master's `shutdown`."""
    from rosmini.core.graph import Graph
    from rosmini.core.graph.local_transport import LocalTransport
    from rosmini.core.names import Remappings
    from rosmini.ros.net.addresses import addresses
    from rosmini.ros.net.master_server import AddressInUse
    from rosmini.ros.net.network import tcp

    others = Remappings.other_arguments(args.words)
    if others:
        raise RosminiError(f"roscore takes no argument {others[0]!r}; `rosmini roscore --help` shows what it takes")
    where = addresses(arguments=Remappings.from_argv(args.words).special)
    port = args.port or where.master[1]
    end_as_ctrl_c()
    graph = Graph(
        simulated=False,
        strict=False,
        rosout=not args.core,
        transports=[LocalTransport, tcp(where)],
        run_id=str(uuid.uuid1()),
    )
    try:
        try:
            server = serve(graph, where, port, verbose=args.verbose)
        except AddressInUse as error:
            raise refusal(graph, where.uri(port), error) from error
        with suppress(KeyboardInterrupt):
            introduce(graph, where, server, with_rosout=not args.core)
            # `serve` stops only a run that has begun; a request that came earlier is noticed here
            graph.run(until=lambda: server.shutdown_reason is not None)
        if server.shutdown_reason is not None:
            print(server.shutdown_reason, flush=True)
        say_goodbye(with_rosout=not args.core)
        server.close()
    finally:
        graph.shutdown("roscore ends")
    print("done", flush=True)
    return 0


def serve(graph: Graph, where: Addresses, port: int, *, verbose: bool) -> MasterServer:
    """Serve the graph's Master at `port`. Raises `AddressInUse`."""
    from rosmini.ros.net.master_server import MasterServer
    from rosmini.ros.net.network import network_of

    master: Any = graph.master
    network = network_of(graph)
    return MasterServer(
        network.io,
        master,
        where,
        port,
        on_shutdown=lambda _: graph.scheduler.stop(),
        on_call=show_call if verbose else None,
        warn=network.warn,
    )


def show_call(method: str, arguments: tuple[Any, ...], answer: Any) -> None:
    """Print a call that changed something, in the format of rosmaster's log."""
    sign = SIGNS.get(method)
    if sign is None or answer[0] != 1:
        return
    caller, *rest = arguments
    what = rest[1] if method in ("subscribeParam", "unsubscribeParam") else rest[0]
    at = rest[-1] if method.startswith(("register", "unregister")) else ""
    print(f"{sign} [{what}] {caller} {at}".rstrip(), flush=True)


def refusal(graph: Graph, uri: str, error: RosminiError) -> RosminiError:
    """Return the error for a port in use by a Master or another program."""
    from rosmini.ros.net.network import network_of
    from rosmini.ros.net.remote_master import RemoteMaster

    try:
        RemoteMaster(uri, network_of(graph).client).call("getPid", "/roscore")
    except MasterUnreachable:
        return error
    return RosminiError(
        "roscore cannot run as another roscore/master is already running.\n"
        "Please kill other roscore/master processes before relaunching.\n"
        f"The ROS_MASTER_URI is {uri}"
    )


def introduce(graph: Graph, where: Addresses, server: MasterServer, *, with_rosout: bool) -> None:
    """Print the text that roscore prints when it starts."""
    roscore = graph.ask_as("/roscore")
    version = str(roscore.ask("getParam", "/rosversion")).strip()
    distribution = str(roscore.ask("getParam", "/rosdistro")).strip()
    pid = os.getpid()
    lines = [
        *([f"... logging to {graph.log_folder}"] if graph.log_folder else []),
        "Press Ctrl-C to interrupt",
        f"ros_comm version {version}",
        "",
        "",
        "SUMMARY",
        "========",
        "",
        "PARAMETERS",
        f" * /rosdistro: {distribution}",
        f" * /rosversion: {version}",
        "",
        "NODES",
        "",
        "auto-starting new master",
        f"process[master]: started with pid [{pid}]",
        f"ROS_MASTER_URI={graph.master_uri}",
        "",
        f"setting /run_id to {roscore.ask('getParam', '/run_id')}",
        *([f"process[rosout-1]: started with pid [{pid}]", "started core service [/rosout]"] if with_rosout else []),
    ]
    print("\n".join(lines), flush=True)
    if where.announcement is not None:
        print(where.announcement, flush=True)
    warn(where, server.port)


def warn(where: Addresses, port: int) -> None:
    """Print what will prevent others from finding this Master."""
    from rosmini.ros.net.addresses import is_loopback

    host, asked = where.master
    if asked != port:
        print(
            f"rosmini: ROS_MASTER_URI is {where.master_uri}, but this Master is at port {port}: set "
            f"ROS_MASTER_URI={where.uri(port)} where it is to be found",
            file=sys.stderr,
        )
    if where.mistake is not None:
        print(f"WARNING: {where.mistake}", file=sys.stderr)
    if not is_loopback(host) and not where.is_open:
        print(
            f"WARNING: ROS_MASTER_URI [{where.master_uri}] host is not set to this machine: this Master listens on "
            f"{where.bind} only. If {host} is this machine, set ROS_HOSTNAME={host} (or ROS_IP to its address).",
            file=sys.stderr,
        )


def say_goodbye(*, with_rosout: bool) -> None:
    """Print the text that roscore prints when it ends."""
    lines = [
        *(["[rosout-1] killing on exit"] if with_rosout else []),
        "[master] killing on exit",
        "shutting down processing monitor...",
        "... shutting down processing monitor complete",
    ]
    print("\n".join(lines), flush=True)
