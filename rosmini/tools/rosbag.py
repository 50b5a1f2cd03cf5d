"""`rosmini rosbag`: the verbs of ROS's tool, with its options and output (http://wiki.ros.org/rosbag/Commandline).

In a terminal `record` and `play` run in wall-clock time in a new graph, with the nodes after a `+`, as in `run`:
`rosmini rosbag record -a + rosmini_sim/simulator + drive.py`. In Python they start their node in the graph and return
its handle.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.names import Remappings
from rosmini.core.verbs import Call, Result, Tool, VerbError
from rosmini.ros.bag import (
    Bag,
    Compression,
    FilterError,
    ROSBagException,
    ROSBagUnindexedException,
    changed_types,
    filter_bag,
    fix_bag,
    recompress,
    reindex,
)
from rosmini.ros.bag.info import info_text, info_yaml
from rosmini.ros.bag.options import Parser, play_options, play_parser, record_options, record_parser
from rosmini.ros.bag.tools import Copied, Reindexed, TypeChange, compile_expression

if TYPE_CHECKING:
    from optparse import Values

    from rosmini.core.time import Time
    from rosmini.ros.scripts import NodeHandle, ScriptHandle

TOOL = Tool(
    "rosbag",
    "record, play and look into bags",
    elsewhere=("decrypt", "encrypt"),
    reads_files=True,
    why_elsewhere="a bag that GnuPG has encrypted is read by a real ROS with its keys",
)


def _complaint(path: str | Path, error: Exception) -> str:
    """Return the message of ROS's tool about a bag that it cannot read or write, with our reason."""
    if isinstance(error, ROSBagUnindexedException):
        return f"ERROR bag unindexed: {path}.  Run rosbag reindex."
    if isinstance(error, OSError) and error.filename and Path(error.filename) != Path(path):
        return f"ERROR writing {error.filename}: {error.strerror}"
    return f"ERROR reading {path}: {error}"


# -- looking into bags -------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class BagInfos(Result):
    """Contents of bags: the text of each, or the YAML, depending on the options."""

    texts: tuple[str, ...]

    def __str__(self) -> str:
        return "\n---\n".join(self.texts)


def _info_parser() -> Parser:
    parser = Parser("rosbag info [options] BAGFILE1 [BAGFILE2 BAGFILE3 ...]", "Summarize bag files.", "info drive.bag")
    parser.add_option("-y", "--yaml", action="store_true", default=False, help="print YAML")
    parser.add_option("--freq", action="store_true", default=False, help="print how often messages came")
    return parser


@TOOL.verb("summarize bag files", parser=_info_parser)
def info(given: Values, _call: Call) -> BagInfos:
    """Return the contents of bag files, up to the first unreadable one."""
    if not given.words:
        _info_parser().error("You must specify at least 1 bag file.")
    texts: list[str] = []
    for path in given.words:
        try:
            with Bag(path) as bag:
                texts.append((info_yaml if given.yaml else info_text)(bag, freq=given.freq))
        except (ROSBagException, OSError) as error:
            return BagInfos(texts=(*texts, ""), complaints=(_complaint(path, error),), status=1)
    return BagInfos(texts=tuple(texts))


@dataclass(frozen=True, kw_only=True)
class TypeChanges(Result):
    """The types of a bag that differ from this system's."""

    changes: tuple[TypeChange, ...]

    def __str__(self) -> str:
        if not self.changes:
            return "Bag file does not need any migrations."
        return "\n".join(["The following migrations need to occur:", *(f" * {change}" for change in self.changes)])


def _check_parser() -> Parser:
    return Parser("rosbag check BAG", "List the types in a bag that differ from this system's.", "check drive.bag")


@TOOL.verb("list the types in a bag that differ from this system's", parser=_check_parser)
def check(given: Values, _call: Call) -> TypeChanges:
    """Return the types of a bag that differ here; migration rules are not supported."""
    if len(given.words) != 1:
        _check_parser().error("You must specify a bag file to check.")
    try:
        with Bag(given.words[0]) as bag:
            return TypeChanges(changes=tuple(changed_types(bag)))
    except (ROSBagException, OSError) as error:
        raise VerbError(_complaint(given.words[0], error)) from None


# -- making bags of bags -----------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Written(Result):
    """Bags that were written, each with its message."""

    bags: tuple[tuple[Path, str], ...] = ()
    quiet: bool = False

    def __str__(self) -> str:
        return "" if self.quiet else "\n".join(f"{path}: {said}" for path, said in self.bags)


def _filter_parser() -> Parser:
    parser = Parser(
        "rosbag filter [options] INBAG OUTBAG EXPRESSION",
        "Copy the messages for which EXPRESSION is true: a Python expression of topic, m (the message), t (its time: "
        "t.secs, t.to_sec()). It can compute and compare; it cannot import, open or change anything.",
        "filter drive.bag turns.bag \"topic == '/cmd_vel' and m.angular.z != 0\"",
    )
    parser.add_option("-p", "--print", dest="shown", metavar="PRINT-EXPRESSION", help="print this of each message")
    return parser


@TOOL.verb("copy the messages for which an expression is true", name="filter", parser=_filter_parser)
def filter_(given: Values, call: Call) -> Written:
    """Copy the messages for which an expression is true."""
    missing = ("an in bag, an out bag, and an expression.", "an out bag and an expression.", "an expression.")
    if len(given.words) < 3:
        _filter_parser().error(f"You must specify {missing[len(given.words)]}")
    if len(given.words) > 3:
        _filter_parser().error("Too many arguments.")
    source, target, expression = given.words
    if not Path(source).is_file():
        raise VerbError(f"Cannot locate input bag file [{source}]", 2)
    if Path(source).resolve() == Path(target).resolve():
        raise VerbError(f"Cannot use same file as input and output [{source}]", 3)
    try:
        tell = None if given.shown is None else _teller(compile_expression(given.shown), call)
        kept, total = filter_bag(source, target, expression, tell=tell)
    except FilterError as error:
        raise VerbError(f"ERROR: {error}") from error
    except (ROSBagException, OSError) as error:
        raise VerbError(_complaint(source, error)) from None
    return Written(bags=((Path(target), f"{kept} of {total} messages"),))


def _teller(shown: Callable[[str, Any, Any], Any], call: Call) -> Callable[[bool, str, Any, Time], object]:
    return lambda kept, topic, m, t: call.say(f"{'MATCH' if kept else 'NO MATCH'} {shown(topic, m, t)}")


def _fix_parser() -> Parser:
    parser = Parser(
        "rosbag fix [options] INBAG OUTBAG",
        "Make the messages of a bag ones of this system's types, field by field. Rule files are not read: they are "
        "programs.",
        "fix old.bag new.bag",
    )
    parser.add_option(
        "--force", action="store_true", default=False,
        help="also where fields do not go together: what is new is empty, what is gone is lost",
    )  # fmt: skip
    return parser


@TOOL.verb("repair the messages in a bag file, so that they are of this system's types", parser=_fix_parser)
def fix(given: Values, _call: Call) -> Written:
    """Convert the messages of a bag to this system's types."""
    missing = ("You must pass input and output bag files.", "You must pass an output bag file.")
    if len(given.words) < 2:
        _fix_parser().error(missing[len(given.words)])
    source, target, *rules = given.words
    if rules:
        _fix_parser().error(f"{rules[0]}: rule files are programs, and are not run here")
    if Path(target).suffix != ".bag":
        _fix_parser().error("Output file must be a bag file.")
    try:
        fixed = fix_bag(source, target, force=given.force)
    except (ROSBagException, OSError) as error:
        raise VerbError(_complaint(source, error)) from None
    obstacles = [
        f" * From: {change.type} [{change.md5sum}]\n   To:   {change.type} [{change.local}]"
        + "".join(f"\n     {line}" for line in lines)
        for change, lines in fixed.obstacles.items()
    ]
    if fixed.copied is None:
        head = "Bag could not be migrated.  The following migrations could not be performed:"
        raise VerbError("\n".join([head, *obstacles, "--force writes it nevertheless."]))
    return Fix(bags=((Path(target), f"{fixed.copied.written} messages"),), complaints=tuple(obstacles))


@dataclass(frozen=True, kw_only=True)
class Fix(Written):
    """A bag that was converted to this system's types."""

    def __str__(self) -> str:
        return "Bag migrated successfully."


def _compression(parser: Parser, default: str) -> None:
    const: dict[str, Any] = {"action": "store_const", "dest": "compression"}
    parser.add_option("-j", "--bz2", const=Compression.BZ2, default=default, help="compress with bz2", **const)
    parser.add_option("--lz4", const=Compression.LZ4, help="compress with lz4", **const)


def _parser_of(verb: str, text: str, *, compresses: bool = False) -> Callable[[], Parser]:
    """Return a function that creates the parser of a verb that rewrites bags."""

    def make() -> Parser:
        parser = Parser(f"rosbag {verb} [options] BAGFILE1 [BAGFILE2 ...]", text, f"{verb} drive.bag")
        parser.add_option("--output-dir", metavar="DIR", help="write to the folder DIR, and leave the bags as they are")
        parser.add_option(
            "-f", "--force", action="store_true", default=False, help="overwrite the backup of an earlier run"
        )
        parser.add_option("-q", "--quiet", action="store_true", default=False, help="print only errors")
        if compresses:
            _compression(parser, Compression.BZ2)
        return parser

    return make


def _rewrite(parser: Callable[[], Parser], given: Values, work: Callable[[Path, Path], str]) -> Written:
    """Run ``work(source, target)`` for each bag; when in place, the original is kept as NAME.orig.bag."""
    if not given.words:
        parser().error("You must specify at least one bag file.")
    written: list[tuple[Path, str]] = []
    complaints: list[str] = []
    status = 0
    for path in map(Path, given.words):
        target = path if given.output_dir is None else Path(given.output_dir) / path.name
        backup = path.with_name(f"{path.stem}.orig{path.suffix}")
        in_place = target.resolve() == path.resolve()
        if in_place and backup.exists() and not given.force:
            complaints.append(f"Skipping {path}. Backup path {backup} already exists.")
            continue
        part = target.with_name(target.name + ".new")
        if not target.parent.is_dir():
            complaints.append(f"ERROR writing to {target}: there is no folder {target.parent}; make it first")
            status = 1
            continue
        try:
            said = work(path, part)
            if in_place:
                path.replace(backup)
            part.replace(target)
            written.append((target, said))
        except (ROSBagException, OSError) as error:
            complaints.append(_complaint(path, error))
            status = 1
        finally:
            part.unlink(missing_ok=True)
    return Written(bags=tuple(written), complaints=tuple(complaints), status=status, quiet=given.quiet)


def _recompressed(source: Path, target: Path, compression: str) -> str:
    copied: Copied = recompress(source, target, compression)
    return f"{copied.written} messages, {source.stat().st_size:,} -> {target.stat().st_size:,} bytes"


_COMPRESS = _parser_of("compress", "Compress bag files.", compresses=True)
_DECOMPRESS = _parser_of("decompress", "Decompress bag files.")
_REINDEX = _parser_of("reindex", "Make a new index, for a recording that was cut off.")


@TOOL.verb("compress bag files", parser=_COMPRESS)
def compress(given: Values, _call: Call) -> Written:
    """Compress bag files."""
    return _rewrite(_COMPRESS, given, lambda source, target: _recompressed(source, target, given.compression))


@TOOL.verb("decompress bag files", parser=_DECOMPRESS)
def decompress(given: Values, _call: Call) -> Written:
    """Decompress bag files."""
    return _rewrite(_DECOMPRESS, given, lambda source, target: _recompressed(source, target, Compression.NONE))


@TOOL.verb("make a new index, for a recording that was cut off", name="reindex", parser=_REINDEX)
def reindex_(given: Values, _call: Call) -> Written:
    """Rebuild the indexes of bag files."""

    def work(source: Path, target: Path) -> str:
        shutil.copyfile(source, target)
        done: Reindexed = reindex(target)
        return f"{done.messages} messages" + "".join(f"\n  {problem}" for problem in done.problems)

    return _rewrite(_REINDEX, given, work)


# -- nodes -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Started(Result):
    """A node that records or plays; its handle waits for its end, or ends it."""

    handle: NodeHandle | ScriptHandle

    def __str__(self) -> str:
        return f"rosbag {self.handle.name} was started"


def _in_terminal(verb: str, check_words: Callable[[Sequence[str]], object]) -> Callable[[Sequence[str]], int]:
    def run_nodes(words: Sequence[str]) -> int:
        """Run the node on the graph of the Master, or in one process with the nodes after a `+`."""
        from rosmini.tools import rosrun, run

        own = words[: words.index("+")] if "+" in words else words
        check_words(Remappings.other_arguments(list(own)))
        if "+" not in words:
            keys = ["--keys"] if verb == "play" and sys.stdin.isatty() else []
            return rosrun.run_node("rosbag", verb, [*keys, *words])
        line = [f"rosbag/{verb}", *words, "--"]
        return run.main(argparse.Namespace(words=line, sim_time=False, wall_time=True, duration=None))

    return run_nodes


def _started(verb: str, given: Values, call: Call) -> Started:
    from rosmini.ros.scripts import rosrun

    handle = rosrun("rosbag", verb, *map(os.fspath, given.argv), graph=call.graph)
    handle.instance()
    return Started(handle=handle)


@TOOL.verb(
    "write what is published on topics to a bag file",
    parser=record_parser,
    in_terminal=_in_terminal("record", record_options),
)
def record(given: Values, call: Call) -> Started:
    """Record topics."""
    return _started("record", given, call)


@TOOL.verb("publish what is in bag files", parser=play_parser, in_terminal=_in_terminal("play", play_options))
def play(given: Values, call: Call) -> Started:
    """Play bag files."""
    return _started("play", given, call)
