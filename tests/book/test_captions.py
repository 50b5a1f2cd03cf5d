"""Captions of a page: counted in reading order, and referred to by label."""

from __future__ import annotations

import pytest

from book.tools.captions import CaptionError, numbered


def test_captions_references_and_exercises_are_counted_from_the_top() -> None:
    page = [
        "See [Figure 7](#end) and [Table 9](#rows).",
        '<a id="start"></a>Figure 5: A start',
        '### Exercise 4: First\n\n<a id="rows"></a>Table 3: Two rows',
        '<a id="end"></a>Figure 1: An end',
        "### Exercise 1: Second",
    ]
    wanted = [
        "See [Figure 2](#end) and [Table 1](#rows).",
        '<a id="start"></a>Figure 1: A start',
        '### Exercise 1: First\n\n<a id="rows"></a>Table 1: Two rows',
        '<a id="end"></a>Figure 2: An end',
        "### Exercise 2: Second",
    ]
    assert numbered(page) == wanted
    assert numbered(wanted) == wanted


@pytest.mark.parametrize(
    ("page", "message"),
    [
        (['<a id="a"></a>Figure 1: One', '<a id="a"></a>Table 1: Two'], "two captions have the label 'a'"),
        (['<a id="2-walls"></a>Figure 1: One'], "'2-walls' does not begin with a letter"),
        (['<a id="walls"></a>Figure 1: One', "[Figure 1](#wals)"], "label 'wals'.*walls"),
    ],
)
def test_a_label_that_cannot_be_used(page: list[str], message: str) -> None:
    with pytest.raises(CaptionError, match=message):
        numbered(page)
