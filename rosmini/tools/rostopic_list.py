"""Verbs of ``rostopic`` that only query: list, info, type, find."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from rosmini.core.verbs import Call, Parser, Result, VerbError, global_name
from rosmini.ros.introspection import topics
from rosmini.ros.introspection.topics import Topic, Topics

if TYPE_CHECKING:
    from optparse import Values


def parser_of(usage: str, description: str, example: str) -> Parser:
    """Return the parser of a verb of ``rostopic``."""
    return Parser("rostopic", f"%prog {usage}", description, example=f"  rosmini rostopic {example}")


# -- list ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class TopicList(Result):
    """Names of topics, sorted; with their types and nodes in ``topics``."""

    names: tuple[str, ...]
    topics: Topics
    sides: tuple[bool, bool] = (True, True)
    """Whether to list published topics, and topics with subscribers."""
    verbose: bool = False
    always_printed: ClassVar[bool] = True

    def __str__(self) -> str:
        if not self.verbose:
            return "\n".join(self.names)
        lines = [""]
        if self.sides[0]:
            lines += ["Published topics:", *_topic_lines(self.topics.published, "publisher")]
        if self.sides[1]:
            lines += ["", "Subscribed topics:", *_topic_lines(self.topics.subscribed, "subscriber")]
        return "\n".join(lines[0 if self.sides[0] else 1 :]) + "\n"


def _topic_lines(side: tuple[Topic, ...], what: str) -> list[str]:
    counted = ((each, len(each.nodes)) for each in side)
    return [f" * {each.name} [{each.type}] {count} {what}{'' if count == 1 else 's'}" for each, count in counted]


def list_parser() -> Parser:
    """Return the parser of ``rostopic list``."""
    parser = parser_of("list [/namespace]", "List the topics, or those in a namespace.", "list -v /robot1")
    parser.flag("-v", "--verbose", dest="verbose", help="with types, and the number of nodes")
    parser.flag("-p", dest="publishers", help="only published ones")
    parser.flag("-s", dest="subscribers", help="only those that are subscribed to")
    return parser


def list_(given: Values, call: Call) -> TopicList:
    """List topics."""
    usage = list_parser()
    if len(given.words) > 1:
        usage.error("you may only specify one input topic")
    within = global_name(given.words[0]) if given.words else None
    if given.publishers and given.subscribers:
        usage.error("you may only specify one of -p, -s")
    found = topics.topics(call.peers)
    if within:
        found = found.within(within)
    sides = not given.subscribers, not given.publishers
    found = Topics(found.published if sides[0] else (), found.subscribed if sides[1] else ())
    return TopicList(names=tuple(found.names()), topics=found, sides=sides, verbose=given.verbose)


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
