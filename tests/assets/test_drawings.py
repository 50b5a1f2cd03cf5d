"""The drawings of the prose pages: what they say fits, nothing covers anything else, and the pages say the same."""

from __future__ import annotations

from datetime import date
from itertools import combinations, pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assets.generate.drawings import CHAPTERS, PAGES, facts, layers, parts, people, timeline

ROOT = Path(__file__).resolve().parents[2]
SHEETS = {
    "history": timeline.history_sheet,
    "distributions": timeline.distributions_sheet,
    "layers": layers.layers_sheet,
    "parts": parts.parts_sheet,
}


DRAWINGS = {**PAGES, **CHAPTERS}


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_drawing_is_well_formed_and_has_a_text(name):
    root = ET.fromstring(DRAWINGS[name])
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert len(root.get("aria-label", "")) > 100


@pytest.mark.parametrize("name", SHEETS)
def test_what_is_written_is_on_the_sheet(name):
    sheet = SHEETS[name]()
    for words, rect in sheet.said:
        assert rect.x >= 0, words
        assert rect.right <= sheet.width, words
        assert rect.y >= 0, words
        assert rect.bottom <= sheet.height, words


@pytest.mark.parametrize("name", SHEETS)
def test_no_words_cover_others(name):
    for (one, here), (other, there) in combinations(SHEETS[name]().said, 2):
        assert not here.overlaps(there, 1.0), (one, other)


@given(st.lists(st.floats(0, 500), max_size=20).map(sorted), st.floats(1, 40))
def test_spreading_keeps_the_order_and_the_distance(places, apart):
    spread = timeline.spread(places, apart)
    assert len(spread) == len(places)
    assert all(after - before >= apart - 1e-6 for before, after in pairwise(spread))
    if all(after - before >= apart for before, after in pairwise(places)):
        assert spread == pytest.approx(places)


def test_distributions_are_in_order_and_end_after_they_came():
    for one, other in pairwise(facts.DISTRIBUTIONS):
        assert one.ros < other.ros or one.released < other.released
    assert all(one.end is None or one.end > one.released for one in facts.DISTRIBUTIONS)


def test_the_names_of_ros_1_follow_the_alphabet_from_b_to_n():
    names = [one.name[0] for one in facts.DISTRIBUTIONS if one.ros == 1]
    assert names == [chr(letter) for letter in range(ord("B"), ord("N") + 1)]


def test_events_are_in_order_and_not_in_the_future():
    when = [date(one.year, one.month or 12, 1) for one in facts.EVENTS]
    assert when == sorted(when)
    assert all(day <= facts.TODAY for day in when)


@pytest.mark.parametrize(("boxes", "ways"), [(people.FIRMS, people.WAYS), (people.COMMUNITY, people.HANDED_ON)])
def test_every_box_of_a_flow_is_joined_to_another(boxes, ways):
    assert {name for way in ways for name in way} == {name for name, _ in boxes}


def test_the_page_on_the_community_has_the_dates_of_the_drawing():
    page = (ROOT / "book" / "community.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines() if line.startswith("|")]
    told = {row[0]: (row[1], row[4]) for row in rows if row[0] not in {"distribution", "---"}}
    expected = {
        one.name: (f"{one.released.day} {one.released:%B %Y}", f"{one.end:%B %Y}" if one.end else "-")
        for one in facts.DISTRIBUTIONS
        if one.ros == 1 or (one.end and one.end >= facts.TODAY)
    }
    assert told == expected
