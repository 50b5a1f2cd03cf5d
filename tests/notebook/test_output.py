"""The streams of cells."""

from __future__ import annotations

import io
import sys

import pytest

from rosmini.notebook.output import CellStream


def test_a_stream_can_be_dropped_after_that_of_its_cell(monkeypatch: pytest.MonkeyPatch) -> None:
    target = io.StringIO()
    monkeypatch.setattr(sys, "stdout", target)
    stream = CellStream("stdout", str.upper)
    stream.write("it")
    assert target.getvalue() == "IT"
    target.close()
    stream.close()
