"""From a bag to an MCAP file (https://mcap.dev/spec), which Foxglove opens: the same bytes in another container.

The profile is `ros1`: messages are as on ROS 1's wire (`ros1`), schemas are message definitions (`ros1msg`), and the
metadata of a channel are the fields of the connection header (https://mcap.dev/spec/registry).
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from .bag import Bag
from .errors import ROSBagException
from .tools import Copied, two_files

IN_OTHER_FIELDS = ("topic", "type", "message_definition")
"""Fields of the connection header that have a place of their own in the file."""


def to_mcap(source: Bag | str | os.PathLike[str], target: str | os.PathLike[str]) -> Copied:
    """Write all messages of a bag, open or not, into a new MCAP file, compressed with lz4.

    Raises:
        ROSBagException: the bag cannot be read, or the package `mcap` is not installed. No file is left behind.
        OSError: the file cannot be written.

    """
    if not isinstance(source, Bag):
        two_files(source, target)
        with Bag(source) as bag:
            return to_mcap(bag, target)
    writer_of = _writer()
    part = Path(f"{os.fspath(target)}.active")
    try:
        with part.open("wb") as file:
            copied = _copy(source, writer_of, file)
        part.replace(target)
    except BaseException:
        with suppress(OSError):
            part.unlink()
        raise
    return copied


def _writer() -> Any:
    try:
        from mcap.writer import CompressionType, Writer
    except ImportError as error:
        raise ROSBagException(
            "MCAP files are written with the package mcap, which is not installed here: `pip install 'rosmini[mcap]'`"
        ) from error
    return lambda file: Writer(file, compression=CompressionType.LZ4)


def _copy(bag: Bag, writer_of: Any, file: IO[bytes]) -> Copied:
    writer = writer_of(file)
    writer.start(profile="ros1", library="rosmini")
    schemas: dict[tuple[str, str], int] = {}
    channels: dict[int, int] = {}
    counts: dict[int, int] = {}
    for conn, time, data, _, _ in bag.read_raw():
        if conn.id not in channels:
            schema = schemas.get((conn.type, conn.md5sum))
            if schema is None:
                schema = writer.register_schema(conn.type, "ros1msg", conn.definition.encode())
                schemas[conn.type, conn.md5sum] = schema
            metadata = {name: conn.text(name) for name in sorted(conn.header) if name not in IN_OTHER_FIELDS}
            channels[conn.id] = writer.register_channel(conn.topic, "ros1", schema, metadata)
        count = counts[conn.id] = counts.get(conn.id, -1) + 1
        writer.add_message(channels[conn.id], time, data, time, count)
    writer.finish()
    total = sum(counts.values()) + len(counts)
    return Copied(total, total)
