"""`rosmini rosnode`: the verbs of ROS's tool, with its options and output (http://wiki.ros.org/rosnode).

In a terminal they act on the graph of the Master at ``ROS_MASTER_URI``; in Python on a graph of this process:
``TOOL.run("list", graph=graph).names``. `rosmini rosnode list + rosmini_sim/simulator` acts on the nodes after the +.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.errors import TransportException, nearest
from rosmini.core.peers import host_of
from rosmini.core.verbs import Call, Lines, Parser, Result, Tool, VerbError, global_name
from rosmini.ros.introspection import nodes

if TYPE_CHECKING:
    from collections.abc import Iterable
    from optparse import Values

    from rosmini.ros.introspection.nodes import Contact, Description

TOOL = Tool(
    "rosnode", "nodes: list them, show what they do and whether they answer; end them", example="ping",
    purpose="printing information about ROS Nodes",
)  # fmt: skip

PINGS = 3
"""Default number of pings in Python."""


def _parser(usage: str, description: str, example: str) -> Parser:
    return Parser("rosnode", f"%prog {usage}", description, example=f"  rosmini rosnode {example}")


def _hint(name: str, known: Iterable[str]) -> tuple[str, ...]:
    """Return the most similar name on a separate line, if there is one."""
    hint = nearest(name, known)
    return (hint,) if hint else ("`rosnode list` lists the nodes that there are.",)


# -- ping ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Pings(Result):
    """Response times of nodes [ms], by name; empty for a node that does not answer."""

    times: dict[str, tuple[float, ...]]


def _ping_parser() -> Parser:
    parser = _parser("ping [options] <node>", "Ask a node whether it is there, once a second.", "ping -c 3 /talker")
    parser.flag("--all", "-a", dest="ping_all", help="ping all nodes, once")
    parser.add_option("-c", dest="count", metavar="COUNT", type="int", help="so many pings; not with --all")
    return parser


@TOOL.verb("test connectivity to node", parser=_ping_parser, only_asks=True, takes="node")
def ping(given: Values, call: Call) -> Pings:
    """Ping one node or all nodes."""
    words, usage = given.words, _ping_parser()
    if given.ping_all:
        if words:
            usage.error(f"Invalid arguments '{' '.join(words)}' used with --all")
        if given.count:
            usage.error("-c may not be used with --all")
        return _ping_all(call)
    if not words:
        listed = "\n".join(nodes.names(call.peers))
        usage.error(f"Please enter a node to ping. Available nodes are:\n{listed}")
    if len(words) > 1:
        usage.error("you may only specify one input node")
    name = global_name(words[0])
    call.say(f"rosnode: node is [{name}]")
    return _ping(call, name, given.count or (None if call.in_terminal else PINGS))


def _ping_all(call: Call) -> Pings:
    names = nodes.names(call.peers)
    call.say("Will ping the following nodes: \n" + "".join(f" * {name}\n" for name in names))
    done = [_ping(call, name, 1) for name in names]
    return Pings(
        times={name: taken for each in done for name, taken in each.times.items()},
        complaints=tuple(line for each in done for line in each.complaints),
    )


def _ping(call: Call, name: str, count: int | None) -> Pings:
    uri = nodes.uri_of(call.peers, name)
    if uri is None:
        complaint = f"cannot ping [{name}]: unknown node"
        return Pings(times={name: ()}, complaints=(complaint, *_hint(name, nodes.names(call.peers))))
    call.say(f"pinging {name} with a timeout of 3.0s")
    times: list[float] = []
    clock = call.peers.scheduler
    try:
        while True:
            times.append(nodes.ping(call.peers, uri))
            call.say(f"xmlrpc reply from {uri}\ttime={times[-1]:f}ms")
            if count and len(times) >= count:
                break
            clock.sleep_until(clock.now_ns() + 1_000_000_000)
    except TransportException as error:
        found = nodes.uri_of(call.peers, name)
        is_moved = found not in (None, uri)
        moved = f"it is at {found} now: ping it again" if is_moved else _way_out(uri, error)
        said = (nodes.why_silent(error, name, uri), moved)
        return Pings(times={name: tuple(times)}, complaints=said)
    except KeyboardInterrupt:
        pass
    if len(times) > 1:
        call.say(f"ping average: {sum(times) / len(times):f}ms")
    return Pings(times={name: tuple(times)})


def _way_out(uri: str, error: TransportException) -> str:
    """Return a hint for a node that the Master lists but that does not answer."""
    from rosmini.ros.net.addresses import addresses

    reason = error.__cause__ or ConnectionRefusedError()  # nobody has an address in this process any more
    return f"The Master lists it at {uri}. {addresses().advice(host_of(uri), reason)}."


# -- list ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class NodeList(Result):
    """Names of nodes, sorted, and their addresses if requested."""

    names: tuple[str, ...]
    uris: tuple[str, ...] | None = None
    only_uris: bool = False
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        if self.uris is None:
            return "\n".join(self.names)
        if self.only_uris:
            return "\n".join(self.uris)
        return "\n".join(f"{uri} \t{name}" for uri, name in zip(self.uris, self.names, strict=True))


def _list_parser() -> Parser:
    parser = _parser("list [namespace]", "List the nodes, or those in a namespace.", "list -a /robot1")
    parser.flag("-u", dest="only_uris", help="only the addresses of their slave APIs")
    parser.flag("-a", "--all", dest="all", help="names and addresses")
    return parser


@TOOL.verb("list active nodes", name="list", parser=_list_parser, only_asks=True, takes="node")
def list_(given: Values, call: Call) -> NodeList:
    """List nodes."""
    if len(given.words) > 1:
        _list_parser().error("invalid args: you may only specify one namespace")
    names = nodes.names(call.peers, global_name(given.words[0]) if given.words else None)
    if not (given.all or given.only_uris):
        return NodeList(names=tuple(names))
    uris = tuple(nodes.uri_of(call.peers, name) or "unknown address" for name in names)
    return NodeList(names=tuple(names), uris=uris, only_uris=given.only_uris and not given.all)


# -- info ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class NodeInfo:
    """The Master's information on a node, its address (None: unknown), and its own information if requested."""

    description: Description
    uri: str | None = None
    contact: Contact | None = None
    was_asked: bool = False

    def __str__(self) -> str:
        text = f"{'-' * 80}\n{self.description}"
        if self.was_asked:
            text += f"\n\ncontacting node {self.uri} ..."
        return text if self.contact is None else f"{text}\n{self.contact}"


@dataclass(frozen=True, kw_only=True)
class NodeInfos(Result):
    """Information on nodes."""

    nodes: tuple[NodeInfo, ...]

    def __str__(self) -> str:
        return "\n".join(map(str, self.nodes))


def _info_parser() -> Parser:
    parser = _parser(
        "info [options] node1 [node2...]",
        "Say what nodes publish, subscribe to and offer, and to whom they are connected.", "info /talker",
    )  # fmt: skip
    parser.flag("-q", "--quiet", help="only what the Master knows: the nodes are not asked")
    return parser


@TOOL.verb("print information about node", parser=_info_parser, only_asks=True, takes="node")
def info(given: Values, call: Call) -> NodeInfos:
    """Describe nodes."""
    if not given.words:
        _info_parser().error("You must specify at least one node name")
    found: list[NodeInfo] = []
    complaints: list[str] = []
    for name in map(global_name, given.words):
        about, uri = nodes.describe(call.peers, name), nodes.uri_of(call.peers, name)
        if uri is None:
            complaints += [f"cannot contact [{name}]: unknown node", *_hint(name, nodes.names(call.peers))]
        if uri is None or given.quiet:
            found.append(NodeInfo(about, uri))
            continue
        try:
            found.append(NodeInfo(about, uri, nodes.contact(call.peers, uri), was_asked=True))
        except TransportException as error:
            found.append(NodeInfo(about, uri, was_asked=True))
            complaints += [f"ERROR: Communication with node[{uri}] failed!", _way_out(uri, error)]
            return NodeInfos(nodes=tuple(found), complaints=tuple(complaints), status=1)
    return NodeInfos(nodes=tuple(found), complaints=tuple(complaints))


# -- machine ---------------------------------------------------------------------------------------------------------


def _machine_parser() -> Parser:
    text = "List the machines on which nodes run, or the nodes on one."
    return _parser("machine [machine-name]", text, "machine localhost")


@TOOL.verb(
    "list nodes running on a particular machine or list machines",
    parser=_machine_parser,
    only_asks=True,
    takes="machine",
)
def machine(given: Values, call: Call) -> Lines:
    """List machines, or the nodes on one."""
    if len(given.words) > 1:
        _machine_parser().error("please enter only one machine name")
    if not given.words:
        return Lines(lines=tuple(nodes.machines(call.peers)))
    found = nodes.nodes_on(call.peers, given.words[0])
    if found is None:
        known = nodes.machines(call.peers)
        hint = nearest(given.words[0], known) or f"nodes run on {', '.join(known) or 'no machine'}"
        raise VerbError(f"ERROR: cannot resolve machine name [{given.words[0]}] to address\n{hint}")
    return Lines(lines=tuple(found))


# -- kill and cleanup ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Killed(Result):
    """Nodes that were asked to shut down."""

    names: tuple[str, ...]
    wanted: tuple[str, ...]

    def __str__(self) -> str:
        if not self.wanted:
            return ""
        one = len(self.wanted) == 1
        listed = self.wanted[0] if one else "\n".join(f" * {name}" for name in self.wanted)
        return (f"killing {listed}" if one else f"killing:\n{listed}") + ("" if self.status else "\nkilled")


def _kill_parser() -> Parser:
    parser = _parser("kill [node]...", "Ask nodes to shut down.", "kill /talker /listener")
    parser.flag("-a", "--all", dest="kill_all", help="all nodes")
    return parser


@TOOL.verb("kill a running node", parser=_kill_parser, only_asks=True, takes="node")
def kill(given: Values, call: Call) -> Killed:
    """Ask nodes to shut down."""
    there = nodes.names(call.peers)
    wanted = [global_name(name) for name in given.words]
    if given.kill_all and wanted:
        _kill_parser().error("invalid arguments with kill all (-a) option")
    if given.kill_all:
        wanted = there
    elif not wanted:
        wanted = [_chosen(there, call)] if there else []
    if not wanted:
        return Killed(names=(), wanted=(), complaints=("No nodes running",))
    unknown = [name for name in wanted if name not in there]
    if unknown:
        listed = "\n".join(f" * {name}" for name in unknown)
        raise VerbError("\n".join([f"ERROR: Unknown node(s):\n{listed}", *_hint(unknown[0], there)]))
    asked, failed = nodes.kill(call.peers, wanted)
    _settle(call)
    if failed:
        complaint = "ERROR: Failed to kill:\n" + "\n".join(f" * {name}" for name in failed)
        return Killed(names=tuple(asked), wanted=tuple(wanted), complaints=(complaint,), status=1)
    return Killed(names=tuple(asked), wanted=tuple(wanted))


def _chosen(there: list[str], call: Call) -> str:
    """Return the node whose number the user types."""
    if call.read_line is None:
        _kill_parser().error("name the nodes, or give -a for all of them")
    listed = "\n".join(f"{number}. {name}" for number, name in enumerate(there, 1))
    call.say(f"{listed}\n\nPlease enter the number of the node you wish to kill.")
    while True:
        typed = call.read_line()
        if typed.strip().isdecimal() and 1 <= int(typed) <= len(there):
            return there[int(typed) - 1]
        if not typed:
            raise VerbError("ERROR: no number was entered")
        call.say(f"ERROR: please enter a number from 1 to {len(there)} (ctrl-C to cancel)")


def _settle(call: Call) -> None:
    """Let nodes of this process carry out the request."""
    settle: Any = getattr(call.peers.scheduler, "yield_to_others", None)
    if settle is not None:
        settle()


@dataclass(frozen=True, kw_only=True)
class Cleaned(Result):
    """Nodes that were unregistered because they did not answer."""

    names: tuple[str, ...] = ()


def _cleanup_parser() -> Parser:
    return _parser(
        "cleanup",
        "Make the Master forget the nodes that do not answer. In a terminal it asks first; in Python it does not.",
        "cleanup",
    )


@TOOL.verb("purge registration information of unreachable nodes", parser=_cleanup_parser, only_asks=True)
def cleanup(_given: Values, call: Call) -> Cleaned:
    """Unregister the nodes that do not answer."""
    silent = nodes.silent(call.peers, nodes.names(call.peers))
    if not silent:
        return Cleaned()
    for reason in silent.values():
        call.warn(reason)
    call.say("Unable to contact the following nodes:")
    call.say("\n".join(f" * {name}" for name in silent))
    call.say("Warning: these might include alive and functioning nodes, e.g. in unstable networks.")
    call.say("Cleanup will purge all information about these nodes from the master.")
    if not _agreed(call):
        call.say("aborting")
        return Cleaned()
    gone = []
    for name in silent:
        uri = nodes.uri_of(call.peers, name)
        if not nodes.silent(call.peers, [name]) or nodes.uri_of(call.peers, name) != uri:
            # It was busy, or has been restarted meanwhile.
            call.say(f"{name} answers now, and stays")
            continue
        call.say(f"Unregistering {name}")
        nodes.forget(call.peers, [name])
        gone.append(name)
    call.say("done")
    return Cleaned(names=tuple(gone))


def _agreed(call: Call) -> bool:
    if call.read_line is None:
        return True
    call.say("Please type y or n to continue:")
    while typed := call.read_line():
        if typed.strip() in ("y", "n"):
            return typed.strip() == "y"
    return False
