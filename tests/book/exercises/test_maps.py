"""The chapter Maps: what it says of its maps is what its cells print."""

from __future__ import annotations

from .conftest import all_printed


def test_what_the_text_says_is_printed(cells):
    said = all_printed(cells)
    assert "as it is:    False\nupside down: True\n" in said
    assert "trinary  100  100   -1   -1   -1    0    0    0\n" in said
    assert "result: 0\n" in said
    assert "result: 1\n" in said
    assert "did you mean closed.yaml?" in said
    assert "the same cells: True\n" in said
