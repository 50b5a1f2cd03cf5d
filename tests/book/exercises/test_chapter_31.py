"""Chapter 31: its figures are numbered, and the errors that it promises are those that its cells print."""

from __future__ import annotations

from pathlib import Path

from book.tools import notebooks

from .conftest import figure_numbers

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "31_frames.ipynb"


def test_every_figure_is_numbered_in_order():
    assert figure_numbers(CHAPTER.stem) == [1, 2]


def test_the_errors_of_tf_are_printed():
    printed = "".join(
        output.text
        for cell in notebooks.read(CHAPTER).cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if output.output_type == "stream"
    )
    for name in ("LookupException", "ConnectivityException", "ExtrapolationException", "TF_REPEATED_DATA"):
        assert name in printed
