"""What ``rosbag info`` prints of a bag: its formats are those of ROS's tool."""

from __future__ import annotations

import time
from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import yaml

from rosmini.time import Time

from .errors import ROSBagException
from .records import Compression

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .bag import Bag
    from .index import Connection
    from .reader import Reader


class TopicLine(NamedTuple):
    """What there is of a topic."""

    topic: str
    type: str
    messages: int
    connections: int
    frequency: float | None


def frequency(reader: Reader, connections: Iterable[Connection]) -> float | None:
    """Return one over the median of the time between messages [Hz]; None for fewer than two messages, or all at one time."""
    # to_sec(), as in ROS: the last bit of a float shows where messages lie microseconds apart
    stamps = sorted(Time.from_nsec(stamp).to_sec() for conn in connections for stamp in reader.times(conn.id))
    periods = sorted(after - before for before, after in pairwise(stamps))
    if not periods:
        return None
    middle = len(periods) // 2
    median = periods[middle] if len(periods) % 2 else (periods[middle - 1] + periods[middle]) / 2
    return 1 / median if median > 0 else None


def topic_lines(bag: Bag, *, freq: bool) -> list[TopicLine]:
    """Return what there is of each topic, sorted by name; frequencies only if asked for, since they need all index data."""
    reader = bag.reader()
    index = bag.index
    lines = []
    for topic in sorted({conn.topic for conn in index.connections.values()}):
        here = bag.connections(topic)
        count = sum(index.count(conn.id) for conn in here)
        lines.append(
            TopicLine(topic, here[0].type, count, len(here), frequency(reader, here) if freq else None)
        )
    return lines


def types_of(bag: Bag) -> list[tuple[str, str]]:
    """Return the types with their md5 sums, sorted."""
    found: dict[str, str] = {}
    for conn in bag.index.connections.values():
        found.setdefault(conn.type, conn.md5sum)
    return sorted(found.items())


def human_size(size: float) -> str:
    """Return a number of bytes as the tool shows it."""
    for suffix in ("KB", "MB", "GB", "TB", "PB", "EB", "ZB", "YB"):
        size /= 1024
        if size < 1024:
            return f"{size:.1f} {suffix}"
    return "-"


def human_frequency(hertz: float) -> str:
    """Return a frequency as the tool shows it."""
    for suffix in ("Hz", "kHz", "MHz", "GHz", "THz"):
        if hertz < 1000:
            return f"{hertz:.1f} {suffix}"
        hertz /= 1000
    return "-"


def human_duration(seconds: float) -> str:
    """Return a duration as the tool shows it."""
    minutes = int(seconds / 60)
    hours = minutes // 60
    if hours:
        return f"{hours}hr {minutes % 60}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    if minutes:
        return f"{minutes}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    return f"{seconds:.1f}s"


def human_time(seconds: float, *, utc: bool = False) -> str:
    """Return a time as the tool shows it: of the local time zone, with hundredths."""
    fraction = f"{seconds - int(seconds):.2f}"[1:]
    clock = time.gmtime(seconds) if utc else time.localtime(seconds)
    return time.strftime("%b %d %Y %H:%M:%S", clock) + fraction


def info_text(bag: Bag, *, freq: bool = True, path: str | None = None, utc: bool = False) -> str:
    """Return what ``rosbag info`` prints; with frequencies only with ``--freq``, while ``str(bag)`` has them as in ROS.

    ``path`` is shown in place of the file's own; ``utc`` shows times of UTC in place of the machine's time zone.
    """
    rows: list[tuple[str, str]] = []
    path = path or bag.filename
    if path is not None:
        rows.append(("path", path))
    rows.append(("version", _version(bag)))
    if bag.index.messages:
        rows += _summary(bag, utc=utc)
        rows += _labelled("types", _type_rows(bag))
        rows += _labelled("topics", _topic_rows(topic_lines(bag, freq=freq)))
    else:
        rows.append(("size", human_size(bag.size)))
    width = max(len(name) for name, _ in rows) + 1
    return "\n".join(f"{name + ':' if name else '':<{width}} {value}" for name, value in rows).rstrip()


def _version(bag: Bag) -> str:
    return f"{bag.version // 100}.{bag.version % 100}"


def _labelled(name: str, values: list[str]) -> list[tuple[str, str]]:
    return [(name if number == 0 else "", value) for number, value in enumerate(values)]


def _summary(bag: Bag, *, utc: bool) -> list[tuple[str, str]]:
    start, end = bag.get_start_time(), bag.get_end_time()
    return [
        ("duration", human_duration(end - start)),
        ("start", f"{human_time(start, utc=utc)} ({start:.2f})"),
        ("end", f"{human_time(end, utc=utc)} ({end:.2f})"),
        ("size", human_size(bag.size)),
        ("messages", str(bag.index.messages)),
        *_compression_rows(bag, end - start),
    ]


def _compression_rows(bag: Bag, duration: float) -> list[tuple[str, str]]:
    chunks = bag.index.chunks
    counts = Counter(chunk.compression for chunk in chunks)
    parts = []
    for count, name in sorted(((count, name) for name, count in counts.items()), reverse=True):
        packed = sum(chunk.compressed for chunk in chunks if chunk.compression == name)
        plain = sum(chunk.size for chunk in chunks if chunk.compression == name)
        share = "" if name == Compression.NONE or not plain else f"; {100 * packed / plain:.2f}%"
        parts.append(f"{name} [{count}/{len(chunks)} chunks{share}]")
    rows = [("compression", ", ".join(parts))]
    _, plain, packed = bag.get_compression_info()
    if set(counts) == {Compression.NONE} or not plain:
        return rows
    sizes = [human_size(plain), human_size(packed)]
    width = max(map(len, sizes))
    if duration <= 0:
        return [*rows, ("uncompressed", f"{sizes[0]:>{width}}"), ("compressed", f"{sizes[1]:>{width}}")]
    rates = [human_size(plain / duration), human_size(packed / duration)]
    wide = max(map(len, rates))
    first, second = (f"{size:>{width}} @ {rate:>{wide}}/s" for size, rate in zip(sizes, rates, strict=True))
    return [*rows, ("uncompressed", first), ("compressed", f"{second} ({100 * packed / plain:.2f}%)")]


def _type_rows(bag: Bag) -> list[str]:
    types = types_of(bag)
    width = max(len(name) for name, _ in types)
    return [f"{name:<{width}} [{md5}]" for name, md5 in types]


def _topic_rows(lines: list[TopicLine]) -> list[str]:
    topic = max(len(line.topic) for line in lines)
    count = max(len(str(line.messages)) for line in lines)
    kind = max(len(line.type) for line in lines)
    shown = {line.topic: human_frequency(line.frequency) for line in lines if line.frequency is not None}
    wide = max(map(len, shown.values()), default=0)
    rows = []
    for line in lines:
        row = f"{line.topic:<{topic}}   {line.messages:>{count}} {'msgs' if line.messages > 1 else 'msg '}"
        row += f" @ {shown[line.topic]:>{wide}}" if line.topic in shown else f"   {'':>{wide}}"
        row += f" : {line.type:<{kind}}"
        rows.append(row + (f" ({line.connections} connections)" if line.connections > 1 else ""))
    return rows


def info_yaml(bag: Bag, key: str | None = None, *, freq: bool = True) -> str | None:
    """Return what ``rosbag info -y`` prints, or the value at ``key`` (such as ``topics[0].type``) as ``-k`` does.

    Raises ``ROSBagException`` if there is no such key.
    """
    text = _yaml(bag, freq=freq)
    if not key:
        return text
    try:
        tree = yaml.safe_load(text)
    except yaml.YAMLError as error:  # the names of topics may be anything
        raise ROSBagException(f'Error getting key "{key}": what the bag says is no YAML: {error}') from error
    return _shown(_lookup(tree, key))


def _yaml(bag: Bag, *, freq: bool) -> str:
    lines = [f"path: {bag.filename}"] if bag.filename is not None else []
    lines.append(f"version: {_version(bag)}")
    if not bag.index.messages:
        return "\n".join([*lines, f"size: {bag.size}", "indexed: False"]) + "\n"
    start, end = bag.get_start_time(), bag.get_end_time()
    compression, plain, packed = bag.get_compression_info()
    lines += [
        f"duration: {end - start:.6f}",
        f"start: {start:.6f}",
        f"end: {end:.6f}",
        f"size: {bag.size}",
        f"messages: {bag.index.messages}",
        "indexed: True",
        f"compression: {compression}",
    ]
    if {chunk.compression for chunk in bag.index.chunks} != {Compression.NONE}:
        lines += [f"uncompressed: {plain}", f"compressed: {packed}"]
    lines.append("types:")
    for name, md5 in types_of(bag):
        lines += [f"    - type: {name}", f"      md5: {md5}"]
    lines.append("topics:")
    for line in topic_lines(bag, freq=freq):
        lines += [
            f"    - topic: {line.topic}",
            f"      type: {line.type}",
            f"      messages: {line.messages}",
        ]
        if line.connections > 1:
            lines.append(f"      connections: {line.connections}")
        if line.frequency is not None:
            lines.append(f"      frequency: {line.frequency:.4f}")
    return "\n".join(lines) + "\n"


def _lookup(tree: Any, key: str) -> Any:
    """Return what stands at a path such as ``topics[1].messages``."""
    found = tree
    try:
        for part in key.replace("[", ".[").split("."):
            if part.startswith("[") and part.endswith("]"):
                found = found[int(part[1:-1])]
            elif part:
                found = found[part]
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise ROSBagException(f'Error getting key "{key}"') from error
    return found


def _shown(value: Any, indent: int = 0) -> str:
    margin = "  " * indent
    if isinstance(value, list):
        return "".join(f"{margin}- {_shown(item, indent + 1)}\n" for item in value)
    if isinstance(value, dict):
        return "\n".join(
            (margin if number else "") + f"{name}: {item}"
            for number, (name, item) in enumerate(value.items())
        )
    return margin + str(value)
