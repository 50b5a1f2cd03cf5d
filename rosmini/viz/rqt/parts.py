"""The parts of a panel: bars and tables of controls, drawings, words. Each has a text form."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeVar

from rosmini.viz.rounding import fixed
from rosmini.viz.svg import element
from rosmini.viz.view import PNG_MIME, Picture, ViewError

T = TypeVar("T")
Kind = Literal["text", "number", "slider", "choice", "check", "button"]
Value = str | float | bool


@dataclass(frozen=True)
class Control:
    """A control.

    Attributes:
        key: its name in a page and in :meth:`~rosmini.viz.rqt.panel.Panel.set`; ``/`` separates parts of it.
        label: its label, also for screen readers.
        kind: "slider" and "number" have a number, within ``minimum`` and ``maximum``; "choice" one of ``choices``.
        value: its value; a button has none.
        whole: only whole numbers.
        problem: error of its value.

    """

    key: str
    label: str
    kind: Kind
    value: Value = ""
    choices: tuple[str, ...] = ()
    minimum: float | None = None
    maximum: float | None = None
    whole: bool = False
    problem: str = ""

    def taken(self, given: object) -> Value:
        """Convert a value from a page or a script to the control's type.

        Raises:
            ViewError: the value is not of this type.

        """
        if self.kind == "button":
            return True
        if self.kind == "check":
            if isinstance(given, bool):
                return given
            raise ViewError(f"{self.label!r} is True or False, not {given!r:.60}")
        if self.kind == "choice":
            if given in self.choices:
                return str(given)
            raise ViewError(f"{self.label!r} is one of {', '.join(self.choices) or 'nothing'}, not {given!r:.60}")
        return self._number(given) if self.kind in ("number", "slider") else str(given)

    def _number(self, given: object) -> float:
        try:
            number = float(given)  # type: ignore[arg-type]  # anything else is refused below
        except (TypeError, ValueError):
            number = float("nan")
        low, high = (float("-inf") if self.minimum is None else self.minimum), self.maximum
        if not low <= number <= (float("inf") if high is None else high) or (self.whole and number % 1):
            bounds = f" from {self.minimum:g}" if self.minimum is not None else ""
            bounds += f" to {high:g}" if high is not None else ""
            raise ViewError(f"{self.label!r} is a {'whole ' if self.whole else ''}number{bounds}, not {given!r:.60}")
        return number

    @property
    def text(self) -> str:
        """The value in a cell of a table."""
        if self.kind in ("button", "slider"):  # a slider is next to its number
            return ""
        if isinstance(self.value, bool):
            return "[x]" if self.value else "[ ]"
        shown = number_text(self.value) if isinstance(self.value, float) else str(self.value)
        return f"{shown} ({self.problem})" if self.problem else shown


Cell = str | Control


@dataclass(frozen=True)
class Bar:
    """Controls and words beside one another."""

    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Row:
    """A row of a table: ``depth`` indents it, ``level`` is that of a log message, and ``is_marked`` highlights it."""

    cells: tuple[Cell, ...]
    depth: int = 0
    level: str = ""
    is_marked: bool = False


@dataclass(frozen=True)
class Rows:
    """A table. ``label`` is its name for screen readers, ``empty`` its text without rows."""

    columns: tuple[str, ...]
    rows: tuple[Row, ...]
    label: str
    empty: str = "nothing yet"


@dataclass(frozen=True)
class Drawing:
    """A picture. A click on a node in it operates the control ``key``, a pointer anywhere on it ``pointer``.

    The value of ``pointer`` is an event and its position from the upper left corner [px]: ``press 10 20``,
    ``move 12 20``, ``release 15 24``, ``wheel -1 15 24``, and ``key g``.
    """

    markup: str
    text: str
    key: str = ""
    pointer: Control | None = None


@dataclass(frozen=True)
class Words:
    """A paragraph; ``is_bad`` marks an error."""

    text: str
    is_bad: bool = False


@dataclass(frozen=True)
class Box:
    """Parts under a title: a group of parameters, or a plugin in a window."""

    title: str
    parts: tuple[Part, ...]
    close: Control | None = None


Part = Bar | Rows | Drawing | Words | Box


def controls(parts: Iterable[Part]) -> Iterator[Control]:
    """Yield all controls, including those in boxes."""
    for part in parts:
        cells: Sequence[Cell] = ()
        if isinstance(part, Box):
            yield from controls(part.parts)
            cells = () if part.close is None else (part.close,)
        elif isinstance(part, Bar):
            cells = part.cells
        elif isinstance(part, Rows):
            cells = [cell for row in part.rows for cell in row.cells]
        elif isinstance(part, Drawing) and part.pointer is not None:
            cells = (part.pointer,)
        yield from (cell for cell in cells if isinstance(cell, Control))


def within(prefix: str, parts: Iterable[Part]) -> tuple[Part, ...]:
    """Return the parts with ``prefix/`` before all keys."""

    def cell(one: Cell) -> Cell:
        return replace(one, key=f"{prefix}/{one.key}") if isinstance(one, Control) else one

    def moved(part: Part) -> Part:
        match part:
            case Bar():
                return Bar(tuple(map(cell, part.cells)))
            case Rows():
                rows = tuple(replace(row, cells=tuple(map(cell, row.cells))) for row in part.rows)
                return replace(part, rows=rows)
            case Drawing():
                pointer = part.pointer and replace(part.pointer, key=f"{prefix}/{part.pointer.key}")
                return replace(part, key=part.key and f"{prefix}/{part.key}", pointer=pointer)
            case Box():
                close = None if part.close is None else replace(part.close, key=f"{prefix}/{part.close.key}")
                return replace(part, parts=within(prefix, part.parts), close=close)
            case _:
                return part

    return tuple(map(moved, parts))


# -- as text -----------------------------------------------------------------------------------------------------------


def text_of(parts: Iterable[Part]) -> str:
    """Return the text of the parts, line by line."""
    return "\n".join(filter(None, map(_text, parts)))


def _text(part: Part) -> str:
    match part:
        case Bar():
            return "  ".join(filter(None, map(_in_bar, part.cells)))
        case Rows():
            return "\n".join(aligned(part)) if part.rows else part.empty
        case Box():
            inner = text_of(part.parts)
            return f"[{part.title}]" + "".join(f"\n  {line}" for line in inner.split("\n") if line)
        case _:
            return part.text


def _in_bar(cell: Cell) -> str:
    if isinstance(cell, str):
        return cell
    if cell.kind == "check":
        return f"{cell.text} {cell.label}"
    return f"{cell.label}: {cell.text}".rstrip() if cell.kind != "button" else ""


def cell_text(cell: Cell) -> str:
    """Return the text of a cell."""
    return cell if isinstance(cell, str) else cell.text


def aligned(part: Rows) -> list[str]:
    """Return the titles and the rows of a table, a line for each, with aligned columns."""
    lines = [part.columns]
    for row in part.rows:
        first, *others = map(cell_text, row.cells)
        lines.append(("  " * row.depth + ("*" if row.is_marked else "") + first, *others))
    cells = [[" ".join(cell.split("\n")) if i else cell for i, cell in enumerate(line)] for line in lines]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in cells]


def without_controls(part: Rows) -> Rows:
    """Return a table without the columns that have controls, as a still shows it."""
    kept = [
        number
        for number in range(len(part.columns))
        if not any(isinstance(row.cells[number], Control) for row in part.rows)
    ]

    def reduced(cells: Sequence[T]) -> tuple[T, ...]:
        return tuple(cells[number] for number in kept)

    rows = tuple(replace(row, cells=reduced(row.cells)) for row in part.rows)
    return replace(part, columns=reduced(part.columns), rows=rows)


def number_text(value: float) -> str:
    """Return a number as a person would write it: ``10``, ``0.25``."""
    return str(round(value)) if value == round(value) and abs(value) < 1e15 else fixed(value, 6).rstrip("0")


def drawn(picture: Picture) -> Drawing:
    """Return a picture as a part of a panel."""
    if picture.svg is not None:
        return Drawing(picture.svg, picture.text)
    data, _ = picture._repr_mimebundle_()
    image = element("img", src=f"data:{PNG_MIME};base64,{''.join(data[PNG_MIME].split())}", alt=picture.alt)
    return Drawing(image, picture.text)
