"""A measured number in a chapter is printed by one of its cells, or links to its row on a page of figures."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").glob("*/*.ipynb"))
ROW = re.compile(r"\[([^\]]*)\]\([^)#]*about/(\w+_figures)\.md#([\w-]+)\)")
NUMBER = r"\d[\d,]*(?:\.\d+)?"
CLAIM = re.compile(
    rf"(?<![\w./])({NUMBER})(?:(?: to | and | or |, )({NUMBER}))?\s?(%|per cent|cm|mm)(?!\w)"
    rf"|(?<![\w./])({NUMBER}) of (?:the )?({NUMBER})(?!\w)"
)
"""A share, a short length, or a count such as "42 of 50"."""
STATED: dict[str, set[str]] = {
    "turtlebot3": {"4.4 cm", "2.4 cm"},
    "gazebo": {"33 mm"},
    "motion_node": {"4 cm", "37 cm"},
    "local_planners": {"37 cm"},
    "tune_and_fix": {"85 cm", "91 cm"},
}
"""Sizes of things, and what follows by a formula from numbers that the reader sees: nothing that was measured here."""


def rows(page: str) -> dict[str, str]:
    """The rows of a page of figures by their labels."""
    text = (ROOT / "book" / "about" / f"{page}.md").read_text(encoding="utf-8")
    return {found[1]: line for line in text.splitlines() for found in re.finditer(r'<a id="([\w-]+)"></a>', line)}


def prose(chapter: Path) -> list[str]:
    """The Markdown cells without numbers that link to a row, code blocks, formulas, and addresses of links."""
    cells = [cell.source for cell in nbformat.read(chapter, 4).cells if cell.cell_type == "markdown"]
    return [re.sub(r"```.*?```|\$\$.*?\$\$|\]\([^)]*\)", "", ROW.sub("", text), flags=re.DOTALL) for text in cells]


def shown(chapter: Path) -> list[float]:
    """Every number in the code and in the stored outputs."""
    texts: list[str] = []
    for cell in nbformat.read(chapter, 4).cells:
        if cell.cell_type == "code":
            texts.append(cell.source)
            for output in cell.outputs:
                data = output.get("data", {})
                html = re.sub(r"<(script|style).*?</\1>|<[^>]*>", " ", str(data.get("text/html", "")), flags=re.DOTALL)
                texts += [str(output.get("text", "")), str(data.get("text/plain", "")), html]
    return [float(each.replace(",", "")) for each in re.findall(rf"(?<![\w.]){NUMBER}", " ".join(texts))]


def is_shown(number: str, numbers: list[float], *, hundredths: bool) -> bool:
    """Whether a number is there as it stands, rounded, or as a share or a length in metres."""
    value = float(number.replace(",", ""))
    half = 0.501 * 10.0 ** -len(number.partition(".")[2])
    return any(
        abs(each * scale - value) <= half for each in numbers for scale in ((1, 100, 1000) if hundredths else (1,))
    )


def claims(chapter: Path) -> list[str]:
    """The amounts that no cell shows."""
    numbers = shown(chapter)
    known = STATED.get(chapter.stem.partition("_")[2], set())
    found = []
    for text in prose(chapter):
        for claim in CLAIM.finditer(text):
            amounts = [each for each in (claim[1], claim[2], claim[4], claim[5]) if each]
            if claim[0] not in known and not all(
                is_shown(each, numbers, hundredths=bool(claim[3])) for each in amounts
            ):
                found.append(text[max(0, claim.start() - 60) : claim.end() + 30].replace("\n", " "))
    return found


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda path: path.stem)
def test_measured_numbers_are_printed_or_linked(chapter):
    assert claims(chapter) == [], (
        "print them in a cell, link them to a row, or list them in STATED if nobody measured them"
    )


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda path: path.stem)
def test_a_linked_number_is_that_of_its_row(chapter):
    for cell in nbformat.read(chapter, 4).cells:
        for text, page, label in ROW.findall(cell.source if cell.cell_type == "markdown" else ""):
            row = rows(page).get(label)
            assert row is not None or not re.search(r"\d", text), f"{page}.md has no row {label}"
            missing = [each for each in re.findall(NUMBER, text) if row and each not in re.findall(NUMBER, row)]
            assert not missing, f"{page}.md#{label} does not say {missing}: {row}"
