"""Command lines of ``rosbag record`` and ``rosbag play``: ROS's options, for rosmini's recorder and player."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from optparse import Values
from typing import Any, TypeVar

from rosmini.core.errors import UsageError
from rosmini.core.verbs import Parser as ToolParser

from .errors import ROSBagException
from .player import PlayOptions
from .recorder import MEGABYTE, RecordOptions
from .records import Compression

Options = TypeVar("Options", RecordOptions, PlayOptions)


class BagUsageError(ROSBagException, UsageError):
    """An invalid command line; the text says which ones are valid."""


class Parser(ToolParser):
    """Parser of a ``rosbag`` command."""

    def __init__(self, usage: str, description: str, example: str) -> None:
        example = f"  rosmini rosbag {example}"
        super().__init__("rosbag", usage, description, example=example, failure=BagUsageError)


_UNITS = {"s": 1.0, "m": 60.0, "h": 3600.0}


def record_parser() -> Parser:
    """Return the parser of ``rosbag record``."""
    parser = Parser(
        "rosbag record TOPIC1 [TOPIC2 TOPIC3 ...]",
        "Write what goes over topics into a bag file.",
        "record -O drive.bag /odom /scan",
    )
    add = parser.add_option
    add("-a", "--all", action="store_true", default=False, help="all topics, those that come later included")
    add("-e", "--regex", action="store_true", default=False, help="the topics are regular expressions")
    add("-x", "--exclude", metavar="EXCLUDE_REGEX", help="not the topics that match (with -a or -e)")
    add("-q", "--quiet", action="store_true", default=False, help="print nothing")
    add("-o", "--output-prefix", metavar="PREFIX", help="name the bag PREFIX_DATE.bag")
    add("-O", "--output-name", metavar="NAME", help="name the bag NAME.bag")
    add(
        "--split",
        action="store_true",
        default=False,
        help="begin the next bag when one is full: see --size, --duration",
    )
    add("--size", type="int", help="a bag is full at SIZE MB")
    add("--duration", help="a bag is full after DURATION seconds, or minutes (5m), or hours (1h)")
    add(
        "-b",
        "--buffsize",
        type="int",
        default=256,
        metavar="SIZE",
        help="what may wait to be written, in MB (256; 0: anything)",
    )
    add("--chunksize", type="int", default=768, metavar="SIZE", help="chunks of SIZE KB (768)")
    add("-l", "--limit", type="int", metavar="NUM", help="only NUM messages of each topic")
    add(
        "-j",
        "--bz2",
        dest="compression",
        action="store_const",
        const=Compression.BZ2,
        default=Compression.NONE,
        help="compress with bz2",
    )
    add("--lz4", dest="compression", action="store_const", const=Compression.LZ4, help="compress with lz4")
    add("--repeat-latched", action="store_true", default=False, help="begin each bag with what is latched")
    return parser  # fmt: skip


def seconds(parser: Parser, text: str) -> float:
    """Return a duration such as ``30``, ``5m`` or ``1h`` in seconds."""
    unit = _UNITS.get(text[-1:], 0.0)
    try:
        return float(text[:-1]) * unit if unit else float(text)
    except ValueError:
        parser.error(f"{text!r} is not a duration: write seconds (30), minutes (5m) or hours (1h)")


def record_options(args: Sequence[str]) -> RecordOptions:
    """Return the recording options of a command line. Raises ``UsageError``."""
    parser = record_parser()
    given, topics = parser.parse_args(list(args))
    if not (topics or given.all):
        parser.error("You must specify a topic name or else use the '-a' option.")
    try:
        return _options(
            RecordOptions,
            given,
            topics=tuple(topics),
            size=None if given.size is None else given.size * MEGABYTE,
            duration=None if given.duration is None else seconds(parser, given.duration),
            buffsize=given.buffsize * MEGABYTE,
            chunksize=given.chunksize * 1024,
        )
    except UsageError:
        raise
    except ROSBagException as error:
        parser.error(str(error))


def _several(_option: Any, _text: str, _value: Any, parser: Any) -> None:
    """Take all words up to the next option."""
    taken = []
    while parser.rargs and not (parser.rargs[0].startswith("-") and len(parser.rargs[0]) > 1):
        taken.append(parser.rargs.pop(0))
    parser.values.topics = [*parser.values.topics, *taken]


def play_parser() -> Parser:
    """Return the parser of ``rosbag play``."""
    parser = Parser(
        "rosbag play BAGFILE1 [BAGFILE2 BAGFILE3 ...]",
        "Publish what is in bag files, in the order of time.",
        "play --clock drive.bag",
    )
    add = parser.add_option
    add("-p", "--prefix", default="", help="put PREFIX before all topics")
    add("-q", "--quiet", action="store_true", default=False, help="print nothing")
    add("-i", "--immediate", action="store_true", default=False, help="do not wait between messages")
    add("--pause", action="store_true", default=False, help="begin paused")
    add("--queue", type="int", default=100, metavar="SIZE", help="queues of SIZE messages (100)")
    add("--clock", action="store_true", default=False, help="publish the time on /clock")
    add("--hz", type="float", default=100.0, metavar="HZ", help="so often (100)")
    add(
        "-d",
        "--delay",
        type="float",
        default=0.2,
        metavar="SEC",
        help="wait SEC seconds before the first message (0.2)",
    )
    add("-r", "--rate", type="float", default=1.0, metavar="FACTOR", help="play FACTOR times as fast")
    add("-s", "--start", type="float", default=0.0, metavar="SEC", help="begin SEC seconds into the bags")
    add("-u", "--duration", type="float", metavar="SEC", help="play SEC seconds of the bags")
    add("-l", "--loop", action="store_true", default=False, help="begin again at the end")
    add("-k", "--keep-alive", action="store_true", default=False, help="stay at the end, for what is latched")
    add("--topics", dest="topics", default=[], action="callback", callback=_several, help="play these topics")
    add("--bags", help="a bag, after --topics")
    add("--wait-for-subscribers", action="store_true", default=False, help="begin when each topic has a subscriber")
    return parser  # fmt: skip


def play_options(args: Sequence[str]) -> tuple[list[str], PlayOptions]:
    """Return the bags and the playing options of a command line. Raises ``UsageError``."""
    parser = play_parser()
    given, bags = parser.parse_args(list(args))
    if given.bags:
        bags.append(given.bags)
    if not bags:
        parser.error("You must specify at least 1 bag file to play back.")
    try:
        return bags, _options(PlayOptions, given, topics=tuple(given.topics))
    except ROSBagException as error:
        parser.error(str(error))


def _options(cls: type[Options], given: Values, **changed: Any) -> Options:
    """Return the options of a recorder or player: values whose names are its fields, with some changed."""
    named = {each.name: getattr(given, each.name) for each in fields(cls) if hasattr(given, each.name)}
    return cls(**{**named, **changed})
