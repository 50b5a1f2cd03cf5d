"""The chapter Frames: its cells print the errors that the text promises."""

from __future__ import annotations

from .conftest import all_printed


def test_the_errors_of_tf_are_printed(cells):
    said = all_printed(cells)
    for name in ("LookupException", "ConnectivityException", "ExtrapolationException", "TF_REPEATED_DATA"):
        assert name in said
