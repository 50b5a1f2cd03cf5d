"""The pictures that move by themselves: one is made again, and all can stand still and say what they show."""

from __future__ import annotations

from xml.etree import ElementTree as ET

import pytest

from assets.generate import moving

FILMS = sorted(moving.FILMS.glob("*.svg"))


@pytest.mark.nightly
def test_a_committed_film_is_what_the_generator_makes():
    made = moving.ten_robots()
    assert (moving.FILMS / "ten.svg").read_text(encoding="utf-8") == made, "run `python -m assets.generate.moving`"


@pytest.mark.parametrize("path", FILMS, ids=lambda path: path.stem)
def test_a_film_has_a_title_respects_the_reader_and_is_small(path):
    text = path.read_text(encoding="utf-8")
    root = ET.fromstring(text)
    title = root.find("{http://www.w3.org/2000/svg}title")
    assert root.get("aria-label") == title.text
    assert len(title.text) > 20
    assert "prefers-reduced-motion:reduce" in text
    assert len(text) < 60_000


def test_there_are_four_films():
    assert {path.stem for path in FILMS} == {"goal", "mapping", "rviz", "ten"}
