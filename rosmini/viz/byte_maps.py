"""Byte maps: the parts of a protocol message and their bytes, drawn one below the other."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from rosmini.viz import style
from rosmini.viz.graph_drawing import MARGIN, box, rule, text
from rosmini.viz.layout import Rect
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import document, element
from rosmini.viz.view import Picture, ViewError

ACROSS = 16
"""Number of bytes in a row."""

ROWS = 4
"""Maximum number of rows of a part; the bytes beyond them are only counted."""

CELL, HEIGHT, OFFSET = 23.0, 25.0, 38.0
COLOURS = ["ink", "muted", "label", "node-fill", "node-line", "topic-fill", "topic-line"]


class _Row(NamedTuple):
    """Some bytes of a part; only the first row of a part has its meaning as `label`."""

    offset: int
    data: bytes
    label: str
    is_text: bool


def byte_map(data: bytes, parts: Iterable[tuple[int, str]], *, title: str | None = None) -> Picture:
    """Draw the parts of some bytes, one below the other: the offset, the bytes and the meaning of each.

    Args:
        data: the bytes.
        parts: (number of bytes, meaning) of each part, in order; together they cover all of the data. A part that is
            text is shown as text, any other in hexadecimal; of a long part only the first 64 bytes are shown.
        title: the caption, and the first words of the text form.

    Raises ``ViewError`` if the sizes of the parts do not add up to the length of the data.

    """
    data = bytes(data)
    found = [(size, meaning) for size, meaning in parts]
    total = sum(size for size, _ in found)
    if total != len(data) or any(size < 0 for size, _ in found):
        raise ViewError(f"the parts have {total} bytes together, but the data have {len(data)}")
    if not found:
        raise ViewError("a byte map needs at least one part: (number of bytes, meaning)")
    rows: list[_Row] = []
    offset = 0
    for size, meaning in found:
        rows += _rows(offset, data[offset : offset + size], meaning)
        offset += size
    summary = f"{len(data)} bytes in {len(found)} parts"
    words = "\n".join([f"{title or 'bytes'}: {summary}", *(_line(row) for row in rows)])
    alt = f"Map of {summary}: {'; '.join(f'{size} bytes, {meaning}' for size, meaning in found)}."
    return Picture(_draw(rows, title or "bytes", alt), text=words, alt=alt, caption=title)


def _rows(offset: int, data: bytes, meaning: str) -> list[_Row]:
    is_text = bool(data) and all(0x20 <= byte < 0x7F or byte == 0x0A for byte in data)
    starts = range(0, max(len(data), 1), ACROSS)
    rows = [_Row(offset + at, data[at : at + ACROSS], meaning if at == 0 else "", is_text) for at in starts[:ROWS]]
    if len(starts) > ROWS:
        rows.append(_Row(offset + ROWS * ACROSS, b"", f"... {len(data) - ROWS * ACROSS} more bytes", False))
    return rows


def _shown(byte: int, is_text: bool) -> str:
    """Return a byte as a character if it is printable text, otherwise as two hexadecimal digits."""
    return chr(byte) if is_text and byte != 0x0A else f"{byte:02x}"


def _line(row: _Row) -> str:
    cells = " ".join(f"{_shown(byte, row.is_text):2}" for byte in row.data)
    return f"  {row.offset:5}  {cells:{3 * ACROSS}} {row.label}".rstrip()


def _draw(rows: Sequence[_Row], title: str, alt: str) -> str:
    label_at = OFFSET + CELL * max(len(row.data) for row in rows) + 14
    parts = [_row(row, place * HEIGHT, label_at) for place, row in enumerate(rows)]
    width = label_at + max(text_width(row.label, style.LABEL_SIZE) for row in rows)
    moved = element("g", "".join(parts), transform=f"translate({MARGIN:g},{MARGIN:g})")
    return document(
        moved,
        width=width + 2 * MARGIN,
        height=len(rows) * HEIGHT + 2 * MARGIN,
        title=title,
        alt=alt,
        css=_css(),
        colours=COLOURS,
    )


def _row(row: _Row, y: float, label_at: float) -> str:
    base = y + 16.5
    kind = "node" if row.is_text else "topic"
    parts = [text(str(row.offset), OFFSET - 10, base, size=11, colour="muted", anchor="end", kind="rm-at")]
    for place, byte in enumerate(row.data):
        x = OFFSET + place * CELL
        parts.append(box(Rect(x + 0.5, y + 1, CELL - 1, HEIGHT - 2), kind, 2))
        parts.append(text(_shown(byte, row.is_text), x + CELL / 2, base, size=12))
    parts.append(text(row.label, label_at, base, size=style.LABEL_SIZE, colour="label", anchor=None, kind="rm-what"))
    return element("g", "".join(parts), class_=f"rm-{kind}")


def _css() -> str:
    return (
        rule("g text", fill="ink")
        + rule(".rm-at", fill="muted")
        + rule(".rm-what", fill="label")
        + rule(".rm-topic rect", fill="topic-fill", stroke="topic-line")
        + rule(".rm-node rect", fill="node-fill", stroke="node-line")
    )
