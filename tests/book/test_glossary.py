"""The glossary is in alphabetical order, and has each term once."""

from __future__ import annotations

import re
from pathlib import Path

PAGE = (Path(__file__).parents[2] / "book" / "glossary.md").read_text(encoding="utf-8")
TERMS = re.findall(r"^(\S.*)\n {4}\S", PAGE.split("```{glossary}")[1], re.MULTILINE)


def test_the_terms_are_in_order():
    assert len(TERMS) > 90
    assert sorted(TERMS, key=str.lower) == TERMS


def test_no_term_is_explained_twice():
    assert len({term.lower() for term in TERMS}) == len(TERMS)
