"""Chapter 32: its figures are numbered, and what it says of its maps is what its cells print."""

from __future__ import annotations

from pathlib import Path

from book.tools import notebooks

from .conftest import figure_numbers

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "32_maps.ipynb"


def test_every_figure_is_numbered_in_order():
    assert figure_numbers(CHAPTER.stem) == [1, 2, 3, 4, 5, 6]


def test_what_the_text_says_is_printed():
    printed = "".join(
        output.text
        for cell in notebooks.read(CHAPTER).cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if output.output_type == "stream"
    )
    assert "as it is:    False\nupside down: True\n" in printed
    assert "trinary  100  100   -1   -1   -1    0    0    0\n" in printed
    assert "result: 0\n" in printed
    assert "result: 1\n" in printed
    assert "did you mean closed.yaml?" in printed
    assert "the same cells: True\n" in printed
