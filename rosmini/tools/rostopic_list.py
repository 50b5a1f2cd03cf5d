"""Verbs of ``rostopic`` that only query: list, info, type, find."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from rosmini.core.verbs import Call, Parser, Result, VerbError, global_name
from rosmini.ros.introspection import topics
from rosmini.ros.introspection.nodes import namespace_of
from rosmini.ros.introspection.topics import Topic, Topics

if TYPE_CHECKING:
    from optparse import Values


def parser_of(usage: str, description: str, example: str) -> Parser:
    """Return the parser of a verb of ``rostopic``."""
    return Parser("rostopic", f"%prog {usage}", description, example=f"  rosmini rostopic {example}")


# -- list ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class TopicList(Result):
    """Names of topics, sorted; with their types and nodes in ``topics``, and by host if requested."""

    names: tuple[str, ...]
    topics: Topics | None = None
    hosts: dict[str, Topics] | None = None
    sides: tuple[bool, bool] = (True, True)
    """Whether to list published topics, and topics with subscribers."""
    verbose: bool = False
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        if self.hosts is None:
            return self._text(self.topics or Topics((), ()), self.names, "")
        blocks = [
            f"Host [{host}]:\n{self._text(found, tuple(found.names()), '  ')}"
            for host, found in self.hosts.items()
            if any(found)
        ]
        return "\n".join(blocks)

    def _text(self, found: Topics, names: tuple[str, ...], indent: str) -> str:
        if not self.verbose:
            return "\n".join(f"{indent}{name}" for name in names)
        lines = [""]
        if self.sides[0]:
            lines += [f"{indent}Published topics:", *_topic_lines(found.published, "publisher", indent)]
        if self.sides[1]:
            lines += [indent, f"{indent}Subscribed topics:", *_topic_lines(found.subscribed, "subscriber", indent)]
        return "\n".join(lines[0 if self.sides[0] else 1 :]) + "\n"


def _topic_lines(side: tuple[Topic, ...], what: str, indent: str) -> list[str]:
    counted = ((each, len(each.nodes)) for each in side)
    return [
        f"{indent} * {each.name} [{each.type}] {count} {what}{'' if count == 1 else 's'}" for each, count in counted
    ]


def list_parser() -> Parser:
    """Return the parser of ``rostopic list``."""
    parser = parser_of("list [/namespace]", "List the topics, or those in a namespace.", "list -v /robot1")
    parser.add_option("-b", "--bag", metavar="BAGFILE", help="the topics in a bag")
    parser.flag("-v", "--verbose", dest="verbose", help="with types, and the number of nodes")
    parser.flag("-p", dest="publishers", help="only published ones")
    parser.flag("-s", dest="subscribers", help="only those that are subscribed to")
    parser.flag("--host", dest="hostname", help="by the hosts of the nodes")
    return parser


def list_(given: Values, call: Call) -> TopicList:
    """List topics."""
    usage = list_parser()
    if len(given.words) > 1:
        usage.error("you may only specify one input topic")
    within = global_name(given.words[0]) if given.words else None
    if given.bag:
        for option, name in ((given.subscribers, "-s"), (given.publishers, "-p"), (given.hostname, "--host")):
            if option:
                usage.error(f"{name} option is not valid with bags")
        return _in_bag(given.bag, within)
    if given.publishers and given.subscribers:
        usage.error("you may only specify one of -p, -s")
    found = topics.topics(call.peers)
    if within:
        found = found.within(within)
    sides = not given.subscribers, not given.publishers
    found = Topics(found.published if sides[0] else (), found.subscribed if sides[1] else ())
    hosts = topics.by_host(call.peers, found) if given.hostname else None
    names = tuple(found.names())
    return TopicList(names=names, topics=found, hosts=hosts, sides=sides, verbose=given.verbose)


@dataclass(frozen=True, kw_only=True)
class BagTopic(TopicList):
    """Number of messages of a topic, or of those in its namespace, in a bag, with the first and last time."""

    count: int = 0
    span: tuple[float, float] = (0.0, 0.0)

    def __str__(self) -> str:
        first, last = (time.strftime("%d %b %Y %H:%M:%S", time.localtime(when)) for when in self.span)
        return f"{self.count} message(s) from {first} to {last}"


def _in_bag(path: str, name: str | None) -> TopicList:
    from rosmini.ros.bag import Bag

    check_bag(path)
    names: dict[str, None] = {}
    times: list[float] = []
    with Bag(path) as bag:
        for topic, _, when in bag.read_messages(raw=True):
            if name is None or topic == name or topic.startswith(namespace_of(name)):
                names[topic] = None
                times = [*times[:1], when.to_sec()] if name is None or not times else [*times, when.to_sec()]
    if name is None:
        return TopicList(names=tuple(names))
    if not times:
        with Bag(path) as bag:
            known = bag.get_type_and_topic_info().topics
        raise VerbError(f"ERROR: nothing of {name} is in {path}, but of {', '.join(sorted(known))}")
    return BagTopic(names=tuple(names), count=len(times), span=(times[0], times[-1]))


def check_bag(path: str) -> None:
    """Raise ``VerbError`` unless the file exists."""
    from pathlib import Path

    if not Path(path).is_file():
        raise VerbError(f"ERROR: bag file [{path}] does not exist")


# -- info, type and find ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class TopicInfo(Result):
    """A topic's type, its publishers and its subscribers: names with addresses."""

    about: topics.About

    @property
    def type(self) -> str:
        """Type of the topic."""
        return self.about.type

    @property
    def publishers(self) -> dict[str, str]:
        """Publishers of the topic: names and addresses."""
        return self.about.publishers

    @property
    def subscribers(self) -> dict[str, str]:
        """Subscribers of the topic: names and addresses."""
        return self.about.subscribers

    def __str__(self) -> str:
        return str(self.about)


def info_parser() -> Parser:
    """Return the parser of ``rostopic info``."""
    parser = parser_of("info /topic", "Show the type of a topic, and who is on it.", "info /chatter")
    parser.flag("-v", dest="verbose", help="with the number of messages that full queues have dropped (not in ROS)")
    return parser


def info(given: Values, call: Call) -> TopicInfo:
    """Describe a topic."""
    if not given.words:
        info_parser().error("you must specify a topic name")
    if len(given.words) > 1:
        info_parser().error("you may only specify one topic name")
    name = global_name(given.words[0])
    about = topics.about(call.peers, name, count_drops=given.verbose)
    if about is None:
        raise VerbError(f"ERROR: Unknown topic {name}\n{topics.what_next(call.peers, name)}")
    return TopicInfo(about=about)


@dataclass(frozen=True, kw_only=True)
class TopicType(Result):
    """The type of a topic, and of one of its fields if the name continues with one."""

    type: str
    field: str = ""
    field_type: str = ""

    def __str__(self) -> str:
        return f"{self.type} {self.field} {self.field_type}" if self.field else self.type


def type_parser() -> Parser:
    """Return the parser of ``rostopic type``."""
    return parser_of("type /topic/field", "Say of which type a topic is, or a field of it.", "type /chatter/data")


def type_(given: Values, call: Call) -> TopicType:
    """Return the type of a topic or of a field."""
    if len(given.words) != 1:
        type_parser().error("topic must be specified" if not given.words else "you may only specify one input topic")
    name = global_name(given.words[0])
    found = topics.look_up(call.peers, name)
    if found is None:
        raise VerbError(f"unknown topic type [{name}]\n{topics.what_next(call.peers, name)}")
    path = found.path.strip("/")
    if not path:
        return TopicType(type=found.type)
    from rosmini.ros.introspection.fields import field_type

    kind = field_type(found.type, path)
    if kind is None:
        raise VerbError(f"unknown topic type [{name}]\n{found.topic} has messages of {found.type}, without {path}")
    return TopicType(type=found.type, field=path, field_type=kind)


@dataclass(frozen=True, kw_only=True)
class TopicsOfType(Result):
    """The topics of a type."""

    names: tuple[str, ...]
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        return "\n".join(self.names)


def find_parser() -> Parser:
    """Return the parser of ``rostopic find``."""
    return parser_of("find msg-type", "List the topics of a type.", "find std_msgs/String")


def find(given: Values, call: Call) -> TopicsOfType:
    """Return the topics of a type."""
    if not given.words:
        find_parser().error("please specify a message type")
    if len(given.words) > 1:
        find_parser().error("you may only specify one message type")
    names = tuple(topics.by_type(call.peers, given.words[0]))
    if names:
        return TopicsOfType(names=names)
    from rosmini.core.errors import nearest

    hint = nearest(given.words[0], {kind for _, kind in topics.types(call.peers)})
    return TopicsOfType(names=(), complaints=(hint,) if hint else ())
