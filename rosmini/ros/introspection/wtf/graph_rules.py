"""Rules for a graph: nodes, topics, types, connections, parameters."""

from __future__ import annotations

import ipaddress
from typing import TYPE_CHECKING

from rosmini.core.errors import nearest
from rosmini.core.peers import host_of

from .findings import Finding

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from .survey import Node, Survey

TOOLS = ("/roswtf", "/rostopic", "/rqt_", "/rosbag_record")
"""Name prefixes of nodes that only observe, so their subscriptions do not indicate a fault."""

UNPUBLISHED = ("/clock", "/rosout")
"""Topics that may have subscribers without a publisher: in wall-clock time, and in a graph with only a Master."""


def silent_nodes(graph: Survey) -> Iterator[Finding]:
    """Find nodes that the Master lists but that do not answer."""
    found = tuple(
        f"{node.name}: {node.silence.removeprefix('ERROR: ')}" for node in graph.nodes.values() if node.silence
    )
    if found:
        yield Finding(
            "silent_nodes", "ERROR", "These nodes do not answer:", found,
            "If they have crashed, `rosnode cleanup` takes them off the Master's list. If they run on another machine, "
            "this one cannot reach the address that they gave: set ROS_IP there to an address that it can reach.",
        )  # fmt: skip


def types_differ(graph: Survey) -> Iterator[Finding]:
    """Find topics whose nodes disagree about the type, so that they never connect."""
    found: list[str] = []
    for topic in _topics(graph):
        kinds = graph.types(topic)
        if len(kinds) > 1:
            found += [f"{topic}:", *(f" {kind}: {', '.join(names)}" for kind, names in kinds.items())]
    if found:
        yield Finding(
            "types_differ", "ERROR", "Nodes disagree about the type of a topic and are not connected:", tuple(found),
            "Give both the same type, or one of them another topic: `topic:=other` behind `rosrun`, <remap> in a "
            "launch file.",
        )  # fmt: skip


def not_connected(graph: Survey) -> Iterator[Finding]:
    """Find publishers and subscribers of the same topic and type without a connection."""
    found: list[str] = []
    for topic in _topics(graph):
        if len(graph.types(topic)) > 1:
            continue  # types_differ reports the reason
        for to in _alive(graph, graph.subscribers.get(topic, ())):
            found += [
                f"{source.name} -> {to.name} ({topic})"
                for source in _alive(graph, graph.publishers.get(topic, ()))
                if source is not to and not {(topic, source.uri), (topic, source.name)} & to.sources
            ]
    if found:
        yield Finding(
            "not_connected", "ERROR", "These nodes should be connected but are not:", tuple(found),
            "Ask again in a second, if one has just started. Otherwise their definitions of the type differ (compare "
            "`rosmsg md5 TYPE` where each of them runs), or one cannot reach the address of the other (ROS_IP).",
        )  # fmt: skip


def unheard_topics(graph: Survey) -> Iterator[Finding]:
    """Find subscriptions without a publisher, with the topic that was probably meant."""
    found: list[str] = []
    for topic, names in sorted(graph.subscribers.items()):
        heard = [name for name in names if not name.startswith(TOOLS)]
        if heard and not graph.publishers.get(topic) and topic not in UNPUBLISHED:
            found.append(f"{topic}, to which {_listed(heard)} subscribe{'s' if len(heard) == 1 else ''}")
            found += [f" {hint}" for hint in _meant(graph, topic)]
    if found:
        yield Finding(
            "no_publisher", "WARNING", "Nobody publishes these topics:", tuple(found),
            "Nothing is wrong if the publisher comes later, or if you publish by hand. If the name is wrong, "
            "remap it where the node starts: `old:=new`.",
        )  # fmt: skip


def dropped_messages(graph: Survey) -> Iterator[Finding]:
    """Find connections whose queues have dropped messages."""
    found = tuple(
        str(flow)
        for node in graph.nodes.values()
        if not node.name.startswith(TOOLS)
        for flow in node.flows
        if flow.dropped and not flow.subscriber.startswith(TOOLS)
    )
    if found:
        yield Finding(
            "dropped_messages", "WARNING", "Queues were full, and dropped the oldest messages:", found,
            "The subscriber's callback takes longer than the messages are apart. That is fine where only the newest "
            "message counts. Otherwise make the callback faster, publish less often, or set a larger queue_size.",
        )  # fmt: skip


def no_clock(graph: Survey) -> Iterator[Finding]:
    """Find simulated time without a clock, a clock that no node uses, or one that several nodes set."""
    publishers = graph.publishers.get("/clock", ())
    simulated = graph.parameter("use_sim_time")
    if simulated and not publishers:
        yield Finding(
            "no_clock", "ERROR", "/use_sim_time is set but no publisher of /clock is present", (),
            "Time stands still, and every sleep and timer waits for ever. Start the simulator or "
            "`rosbag play --clock`, or say `rosparam set /use_sim_time false` and start the nodes again.",
        )  # fmt: skip
    if publishers and not simulated:
        yield Finding(
            "clock_unused", "WARNING", "/clock is published and /use_sim_time is not set:", publishers,
            "Nodes use wall-clock time and treat simulated data as old: `rosparam set /use_sim_time true` before "
            "they start.",
        )  # fmt: skip
    if len(publishers) > 1:
        yield Finding(
            "several_clocks", "ERROR", "Several nodes set the time on /clock:", publishers,
            "Time jumps back and forth. Leave one of them; `rosbag play` without --clock beside a simulator.",
        )  # fmt: skip


def several_drivers(graph: Survey) -> Iterator[Finding]:
    """Find robots that are driven by several nodes at once."""
    found = []
    for topic, names in sorted(graph.publishers.items()):
        kinds = graph.types(topic)
        if len(names) > 1 and set(kinds) <= {"geometry_msgs/Twist", "geometry_msgs/TwistStamped"} and kinds:
            found.append(f"{topic}: {', '.join(names)}")
    if found:
        yield Finding(
            "several_drivers", "WARNING", "Several nodes drive the same robot:", tuple(found),
            "It obeys the latest command. End one, or let a multiplexer choose (topic_tools mux, twist_mux).",
        )  # fmt: skip


def strangers_parameters(graph: Survey) -> Iterator[Finding]:
    """Find private parameters of a missing node when a node with a similar name exists."""
    known = [name.strip("/") for name in graph.nodes if name.count("/") == 1]
    found = []
    for name, value in sorted(graph.parameters.items()):
        if isinstance(value, dict) and name not in known and not _is_namespace(graph, name):
            hint = nearest(name, known)
            if hint:
                found.append(f"/{name}: {hint}")
    if found:
        yield Finding(
            "strangers_parameters", "WARNING", "Parameters were set for nodes that are not there:", tuple(found),
            "A node reads its parameters under its own name when it starts: set them under that name and start it "
            "again.",
        )  # fmt: skip


def loopback_addresses(graph: Survey) -> Iterator[Finding]:
    """Find nodes that advertise an address that only their own machine can reach, in a graph of several machines."""
    hosts = {node.name: host_of(node.uri) for node in graph.nodes.values()}
    local = tuple(f"{name} ({host})" for name, host in hosts.items() if host and _is_loopback(host))
    if local and any(host and not _is_loopback(host) for host in hosts.values()):
        yield Finding(
            "loopback_addresses", "ERROR", "These nodes gave addresses that no other machine can reach:", local,
            "Set ROS_IP, where they start, to the address of that machine in the network (`hostname -I`).",
        )  # fmt: skip


RULES: tuple[Callable[[Survey], Iterator[Finding]], ...] = (
    silent_nodes,
    types_differ,
    not_connected,
    unheard_topics,
    dropped_messages,
    no_clock,
    several_drivers,
    strangers_parameters,
    loopback_addresses,
)


# -- helpers ---------------------------------------------------------------------------------------------------------


def _topics(graph: Survey) -> list[str]:
    return sorted({*graph.publishers, *graph.subscribers})


def _alive(graph: Survey, names: tuple[str, ...]) -> list[Node]:
    return [graph.nodes[name] for name in names if not graph.nodes[name].silence]


def _listed(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _meant(graph: Survey, topic: str) -> list[str]:
    """Return the topics published under another name that were probably meant, as sentences."""
    kinds = set(graph.types(topic))
    free = [
        other
        for other in sorted(graph.publishers)
        if other != topic and (not kinds or not graph.types(other) or kinds & set(graph.types(other)))
    ]
    hint = nearest(topic, free)
    return [hint] if hint else []


def _is_namespace(graph: Survey, name: str) -> bool:
    inside = f"/{name}/"
    return any(each.startswith(inside) for each in (*graph.nodes, *_topics(graph)))


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
