"""`python -m book.tools.rooms`: write the rooms of the library and their sizes into the README and the design page.

The arrows come from the import contracts in `pyproject.toml`, the sizes from the code, and the contents of a room from
the docstring of its package. `tests/book/test_rooms.py` fails when a page is stale.
"""

from __future__ import annotations

import ast
import re
import tomllib
from functools import cache
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[2]
PAGES = ("README.md", "book/about/design.md")
KERNEL = "kernel"
"""The modules of `rosmini/core/graph` that its docstring lists in reading order."""
SINGLE = {"msgs": "core"}
"""Packages at the top of the library that are part of a room."""
UNIT = 500
"""Sizes are rounded to this many lines."""


def imports(pyproject: str) -> dict[str, list[str]]:
    """Return the rooms that each room may import, as the contracts of `pyproject` (its text) state it."""
    contracts = tomllib.loads(pyproject)["tool"]["importlinter"]["contracts"]
    forbidden: dict[str, set[str]] = {}
    for contract in contracts:
        if contract["type"] == "forbidden":
            sources, targets = contract["source_modules"], contract["forbidden_modules"]
        elif contract["type"] == "independence":
            sources = targets = contract["modules"]
        else:
            continue
        for source in sources:
            forbidden.setdefault(_room(source), {_room(source)}).update(map(_room, targets))
    rooms = [room for room in forbidden if room not in SINGLE]
    return {room: [other for other in rooms if other not in forbidden[room]] for room in rooms}


def _room(module: str) -> str:
    return module.removeprefix("rosmini.")


def rows(arrows: dict[str, list[str]]) -> list[list[str]]:
    """Return the rooms from top to bottom, each in a row above all rooms that it imports."""

    def level(room: str) -> int:
        return max((level(other) + 1 for other in arrows[room]), default=0)

    levels = {room: level(room) for room in arrows}
    return [[room for room in arrows if levels[room] == each] for each in sorted(set(levels.values()), reverse=True)]


@cache
def code_lines(place: Path) -> int:
    """Count the lines of code of a module or below a folder: no blank lines, no comments and no docstrings."""
    modules = [place] if place.is_file() else sorted(place.rglob("*.py"))
    return sum(_code_lines(path.read_text(encoding="utf-8")) for path in modules)


def _code_lines(source: str) -> int:
    lines = map(str.strip, source.splitlines())
    code = {number for number, line in enumerate(lines, 1) if line and not line.startswith("#")}
    docstrings: set[int] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            docstrings.update(_span(node))
        elif isinstance(node, (ast.Constant, ast.JoinedStr)):  # a string may hold blank lines
            code.update(_span(node))
    return len(code - docstrings)


def _span(node: ast.expr | ast.stmt) -> range:
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def kernel(checkout: Path) -> list[Path]:
    """Return the modules of the kernel, in reading order."""
    graph = checkout / "rosmini" / "core" / "graph"
    text = ast.get_docstring(ast.parse((graph / "__init__.py").read_text(encoding="utf-8"))) or ""
    names = [name for line in re.findall(r"^\d\. .*$", text, re.MULTILINE) for name in re.findall(r"``(\w+)``", line)]
    return [graph / f"{name}.py" for name in names]


def sizes(checkout: Path, arrows: dict[str, list[str]]) -> dict[str, int]:
    """Return the lines of code of each room, of the kernel and of the library."""
    library = checkout / "rosmini"
    found = {room: code_lines(library / room) for room in arrows}
    for package, room in SINGLE.items():
        found[room] += code_lines(library / package)
    return found | {KERNEL: sum(map(code_lines, kernel(checkout))), "rosmini": sum(found.values())}


def rounded(size: int, before: int | None = None) -> int:
    """Round a size to `UNIT`; keep the number that was written before while it is less than `UNIT` off.

    So a change of a few lines never makes a page stale.
    """
    if before is not None and abs(size - before) < UNIT:
        return before
    return round(size / UNIT) * UNIT


def picture(arrows: dict[str, list[str]], lines: dict[str, int]) -> str:
    """Draw the rooms in rows as text, with their sizes."""
    width = max(map(len, arrows))
    drawn = ["   ".join(f"{room:{width}} {lines[room]:6,}" for room in row) for row in rows(arrows)]
    drawn[-1] += f"   of which the {KERNEL} {lines[KERNEL]:,}"
    return "\n".join(["```text", *drawn, "", f"{'rosmini':{width}} {lines['rosmini']:6,}", "```"])


def table(arrows: dict[str, list[str]], checkout: Path) -> str:
    """List the rooms from bottom to top, with their contents and the rooms that they import."""
    drawn = ["| room | contents | imports |", "|---|---|---|"]
    for row in reversed(rows(arrows)):
        for room in row:
            source = (checkout / "rosmini" / room / "__init__.py").read_text(encoding="utf-8")
            contents = (ast.get_docstring(ast.parse(source)) or "").partition("\n")[0].replace("``", "`")
            targets = ", ".join(f"`{other}`" for other in arrows[room]) or "no other room"
            drawn.append(f"| `{room}` | {contents.rstrip('.')} | {targets} |")
    return "\n".join(drawn)


def updated(page: str, checkout: Path = CHECKOUT) -> str:
    """Return the text of a page with its generated parts made again.

    Such a part is between `<!-- NAME: by book.tools.rooms -->` and `<!-- end -->`; NAME is `picture` or `table`.
    """
    arrows = imports((checkout / "pyproject.toml").read_text(encoding="utf-8"))
    counted = sizes(checkout, arrows)

    def made(found: re.Match[str]) -> str:
        start, name, old, end = found.groups()
        if name == "table":
            return f"{start}{table(arrows, checkout)}{end}"
        before = {room: int(size.replace(",", "")) for room, size in re.findall(r"([\w/]+) +(\d[\d,]*)", old)}
        lines = {room: rounded(size, before.get(room)) for room, size in counted.items()}
        return f"{start}{picture(arrows, lines)}{end}"

    part = r"(<!-- (picture|table): by book\.tools\.rooms -->\n\n)(.*?)(\n\n<!-- end -->)"
    return re.sub(part, made, page, flags=re.DOTALL)


def main() -> None:
    """Write the generated parts of all pages."""
    for name in PAGES:
        page = CHECKOUT / name
        page.write_text(updated(page.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
