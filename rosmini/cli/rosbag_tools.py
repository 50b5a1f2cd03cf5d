"""The verbs of `rosmini rosbag` that work on files: their options, their output, their exit status."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from rosmini.bag import (
    Bag,
    Compression,
    FilterError,
    ROSBagException,
    ROSBagUnindexedException,
    changed_types,
    filter_bag,
    merge,
    recompress,
    reindex,
)
from rosmini.bag.expressions import compile_expression
from rosmini.bag.info import info_text, info_yaml
from rosmini.bag.options import Parser

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from optparse import Values

    from rosmini.time import Time


class Exit(Exception):
    """The command ends here with a status, and a text for standard error."""

    def __init__(self, status: int, text: str = "") -> None:
        super().__init__(text)
        self.status = status
        self.text = text


def _complaint(path: str, error: Exception) -> str:
    """Return what ROS's tool prints of a bag that it cannot read, and our reason."""
    if isinstance(error, ROSBagUnindexedException):
        return f"ERROR bag unindexed: {path}.  Run rosbag reindex."
    return f"ERROR reading {path}: {error}"


def _parsed(parser: Parser, args: Sequence[str]) -> tuple[Values, list[str]]:
    if "-h" in args or "--help" in args:
        print(parser.format_help(), end="")
        raise Exit(0)
    return parser.parse_args(list(args))


def info(args: Sequence[str]) -> int:
    """`rosbag info`."""
    parser = Parser("rosbag info [options] BAGFILE1 [BAGFILE2 BAGFILE3 ...]", "Tell what is in bag files.")
    parser.add_option("-y", "--yaml", action="store_true", default=False, help="print YAML")
    parser.add_option("-k", "--key", help="print the value at a key, such as duration or topics[0].type")
    parser.add_option("--freq", action="store_true", default=False, help="print how often messages came")
    given, paths = _parsed(parser, args)
    if not paths:
        parser.error("You must specify at least 1 bag file.")
    if given.key and not given.yaml:
        parser.error("You can only specify key when printing in YAML format.")
    for number, path in enumerate(paths):
        try:
            with Bag(path) as bag:
                if given.yaml:
                    print(_yaml(bag, given.key, freq=given.freq))
                else:
                    print(info_text(bag, freq=given.freq))
        except (ROSBagException, OSError) as error:
            raise Exit(1, _complaint(path, error)) from error
        if number < len(paths) - 1:
            print("---")
    return 0


def _yaml(bag: Bag, key: str | None, *, freq: bool) -> str:
    text = info_yaml(bag, key, freq=freq)
    return "" if text is None else text


def check(args: Sequence[str]) -> int:
    """`rosbag check`: which types are other ones here. There are no migration rules."""
    parser = Parser("rosbag check BAG", "Tell which types in a bag are other ones on this system.")
    _, paths = _parsed(parser, args)
    if len(paths) != 1:
        parser.error("You must specify a bag file to check.")
    try:
        with Bag(paths[0]) as bag:
            changes = changed_types(bag)
    except (ROSBagException, OSError) as error:
        raise Exit(1, _complaint(paths[0], error)) from error
    if not changes:
        print("Bag file does not need any migrations.")
        return 0
    print("The following migrations need to occur:")
    for change in changes:
        print(f" * {change}")
    return 0


def filter_(args: Sequence[str]) -> int:
    """`rosbag filter`."""
    parser = Parser(
        "rosbag filter [options] INBAG OUTBAG EXPRESSION",
        "Copy the messages for which EXPRESSION is true: a Python expression of topic, m (the message) and t (its time: t.secs, "
        "t.to_sec()). It can compute and compare; it cannot import, open or change anything.",
    )
    parser.add_option(
        "-p", "--print", dest="shown", metavar="PRINT-EXPRESSION", help="print this of each message"
    )
    given, words = _parsed(parser, args)
    missing = ("an in bag, an out bag, and an expression.", "an out bag and an expression.", "an expression.")
    if len(words) < 3:
        parser.error(f"You must specify {missing[len(words)]}")
    if len(words) > 3:
        parser.error("Too many arguments.")
    source, target, expression = words
    if not Path(source).is_file():
        raise Exit(2, f"Cannot locate input bag file [{source}]")
    if Path(source).resolve() == Path(target).resolve():
        raise Exit(3, f"Cannot use same file as input and output [{source}]")
    try:
        tell = None if given.shown is None else _teller(compile_expression(given.shown))
        kept, total = filter_bag(source, target, expression, tell=tell)
    except FilterError as error:
        raise Exit(1, f"ERROR: {error}") from error
    except (ROSBagException, OSError) as error:
        raise Exit(1, _complaint(source, error)) from error
    print(f"{target}: {kept} of {total} messages")
    return 0


def _teller(shown: Callable[[str, Any, Any], Any]) -> Callable[[bool, str, Any, Time], object]:
    return lambda kept, topic, m, t: print("MATCH" if kept else "NO MATCH", shown(topic, m, t))


def _bag_parser(verb: str, text: str) -> Parser:
    parser = Parser(f"rosbag {verb} [options] BAGFILE1 [BAGFILE2 ...]", text)
    parser.add_option(
        "--output-dir", metavar="DIR", help="write to the folder DIR, and leave the bags as they are"
    )
    parser.add_option(
        "-f", "--force", action="store_true", default=False, help="overwrite the backup of an earlier run"
    )
    parser.add_option("-q", "--quiet", action="store_true", default=False, help="print only errors")
    return parser


def _each(parser: Parser, given: Values, paths: Sequence[str], work: Callable[[Path, Path], str]) -> int:
    """Do ``work(source, target)`` for each bag. In place the bag as it was stays beside it, as NAME.orig.bag."""
    if not paths:
        parser.error("You must specify at least one bag file.")
    status = 0
    for path in map(Path, paths):
        target = path if given.output_dir is None else Path(given.output_dir) / path.name
        backup = path.with_name(f"{path.stem}.orig{path.suffix}")
        in_place = target.resolve() == path.resolve()
        if in_place and backup.exists() and not given.force:
            print(f"Skipping {path}. Backup path {backup} already exists.", file=sys.stderr)
            continue
        try:
            part = target.with_name(target.name + ".new")
            try:
                said = work(path, part)
                if in_place:
                    path.replace(backup)
                part.replace(target)
            finally:
                part.unlink(missing_ok=True)
        except (ROSBagException, OSError) as error:
            print(_complaint(os.fspath(path), error), file=sys.stderr)
            status = 1
            continue
        if not given.quiet:
            print(f"{target}: {said}")
    return status


def compress(args: Sequence[str]) -> int:
    """`rosbag compress`."""
    parser = _bag_parser("compress", "Compress bag files.")
    const: dict[str, Any] = {"action": "store_const", "dest": "compression"}
    parser.add_option("-j", "--bz2", const=Compression.BZ2, default=Compression.BZ2, help="with bz2", **const)
    parser.add_option("--lz4", const=Compression.LZ4, help="with lz4", **const)
    given, paths = _parsed(parser, args)
    return _each(parser, given, paths, lambda source, target: _recompress(source, target, given.compression))


def decompress(args: Sequence[str]) -> int:
    """`rosbag decompress`."""
    parser = _bag_parser("decompress", "Decompress bag files.")
    given, paths = _parsed(parser, args)
    return _each(parser, given, paths, lambda source, target: _recompress(source, target, Compression.NONE))


def _recompress(source: Path, target: Path, compression: str) -> str:
    written, _ = recompress(source, target, compression)
    return f"{written} messages, {source.stat().st_size:,} -> {target.stat().st_size:,} bytes"


def reindex_(args: Sequence[str]) -> int:
    """`rosbag reindex`."""
    parser = _bag_parser("reindex", "Make a new index, for a recording that did not come to its end.")
    given, paths = _parsed(parser, args)
    return _each(parser, given, paths, _reindex)


def _reindex(source: Path, target: Path) -> str:
    import shutil

    shutil.copyfile(source, target)
    messages, problems = reindex(target)
    return f"{messages} messages" + "".join(f"\n  {problem}" for problem in problems)


def merge_(args: Sequence[str]) -> int:
    """`rosbag merge`, which ROS's own tool does not have."""
    parser = Parser(
        "rosbag merge [options] OUTBAG INBAG1 [INBAG2 ...]", "Make one bag of several, in the order of time."
    )
    const: dict[str, Any] = {"action": "store_const", "dest": "compression"}
    parser.add_option(
        "-j", "--bz2", const=Compression.BZ2, default=Compression.NONE, help="compress with bz2", **const
    )
    parser.add_option("--lz4", const=Compression.LZ4, help="compress with lz4", **const)
    given, paths = _parsed(parser, args)
    if len(paths) < 2:
        parser.error("You must specify an out bag and at least one in bag.")
    try:
        written, _ = merge(paths[1:], paths[0], compression=given.compression)
    except (ROSBagException, OSError) as error:
        raise Exit(1, f"ERROR: {error}") from error
    print(f"{paths[0]}: {written} messages of {len(paths) - 1} bags")
    return 0


TOOLS: MappingProxyType[str, Callable[[Sequence[str]], int]] = MappingProxyType(
    {
        "check": check,
        "compress": compress,
        "decompress": decompress,
        "filter": filter_,
        "info": info,
        "merge": merge_,
        "reindex": reindex_,
    }
)
