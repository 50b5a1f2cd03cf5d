"""The output of ``rosbag info``, in the formats of ROS's tool."""

from __future__ import annotations

import time
from collections import Counter
from typing import TYPE_CHECKING

from .records import Compression

if TYPE_CHECKING:
    from .bag import Bag
    from .summary import TopicTuple


def human_size(size: float) -> str:
    """Return a number of bytes as the tool prints it."""
    for suffix in ("KB", "MB", "GB", "TB", "PB", "EB", "ZB", "YB"):
        size /= 1024
        if size < 1024:
            return f"{size:.1f} {suffix}"
    return "-"


def human_frequency(hertz: float) -> str:
    """Return a frequency as the tool prints it."""
    for suffix in ("Hz", "kHz", "MHz", "GHz", "THz"):
        if hertz < 1000:
            return f"{hertz:.1f} {suffix}"
        hertz /= 1000
    return "-"


def human_duration(seconds: float) -> str:
    """Return a duration as the tool prints it."""
    minutes = int(seconds / 60)
    hours = minutes // 60
    if hours:
        return f"{hours}hr {minutes % 60}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    if minutes:
        return f"{minutes}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    return f"{seconds:.1f}s"


def human_time(seconds: float) -> str:
    """Return a time as the tool prints it: in the local time zone, with hundredths."""
    fraction = f"{seconds - int(seconds):.2f}"[1:]
    return time.strftime("%b %d %Y %H:%M:%S", time.localtime(seconds)) + fraction


def info_text(bag: Bag, *, freq: bool = True) -> str:
    """Return the output of ``rosbag info``; frequencies need ``--freq``, but ``str(bag)`` includes them as in ROS."""
    rows: list[tuple[str, str]] = []
    if bag.filename is not None:
        rows.append(("path", bag.filename))
    rows.append(("version", _version(bag)))
    if bag.index.messages:
        rows += _summary(bag)
        rows += _labelled("types", _type_rows(bag))
        rows += _labelled("topics", _topic_rows(bag.topics(freq=freq)))
    else:
        rows.append(("size", human_size(bag.size)))
    width = max(len(name) for name, _ in rows) + 1
    return "\n".join(f"{name + ':' if name else '':<{width}} {value}" for name, value in rows).rstrip()


def _version(bag: Bag) -> str:
    return f"{bag.version // 100}.{bag.version % 100}"


def _labelled(name: str, values: list[str]) -> list[tuple[str, str]]:
    return [(name if number == 0 else "", value) for number, value in enumerate(values)]


def _summary(bag: Bag) -> list[tuple[str, str]]:
    start, end = bag.get_start_time(), bag.get_end_time()
    return [
        ("duration", human_duration(end - start)),
        ("start", f"{human_time(start)} ({start:.2f})"),
        ("end", f"{human_time(end)} ({end:.2f})"),
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
    types = bag.md5sums()
    width = max(map(len, types))
    return [f"{name:<{width}} [{md5}]" for name, md5 in types.items()]


def _topic_rows(topics: dict[str, TopicTuple]) -> list[str]:
    topic = max(map(len, topics))
    count = max(len(str(found.message_count)) for found in topics.values())
    kind = max(len(found.msg_type) for found in topics.values())
    shown = {name: human_frequency(found.frequency) for name, found in topics.items() if found.frequency is not None}
    wide = max(map(len, shown.values()), default=0)
    rows = []
    for name, found in topics.items():
        row = f"{name:<{topic}}   {found.message_count:>{count}} {'msgs' if found.message_count > 1 else 'msg '}"
        row += f" @ {shown[name]:>{wide}}" if name in shown else f"   {'':>{wide}}"
        row += f" : {found.msg_type:<{kind}}"
        rows.append(row + (f" ({found.connections} connections)" if found.connections > 1 else ""))
    return rows


def info_yaml(bag: Bag, *, freq: bool = True) -> str:
    """Return the output of ``rosbag info -y``."""
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
    for name, md5 in bag.md5sums().items():
        lines += [f"    - type: {name}", f"      md5: {md5}"]
    lines.append("topics:")
    for name, found in bag.topics(freq=freq).items():
        lines += [f"    - topic: {name}", f"      type: {found.msg_type}", f"      messages: {found.message_count}"]
        if found.connections > 1:
            lines.append(f"      connections: {found.connections}")
        if found.frequency is not None:
            lines.append(f"      frequency: {found.frequency:.4f}")
    return "\n".join(lines) + "\n"
