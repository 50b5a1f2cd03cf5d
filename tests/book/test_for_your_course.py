"""The page For your course: the minutes in its plans are those that the chapters state."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_minutes_are_those_of_the_chapters():
    page = (ROOT / "book" / "for_your_course.md").read_text(encoding="utf-8")
    total, plans = 0, 0
    for line in page.splitlines():
        row = re.fullmatch(r"\| .*\| (\d+) \|", line)
        if row and line.startswith("| all"):
            assert int(row[1]) == total
            total, plans = 0, plans + 1
        elif row:
            chapters = [ROOT / f"{name}.ipynb" for name in re.findall(r"`/(notebooks/[^`]*)`", line)]
            texts = (path.read_text(encoding="utf-8") for path in chapters)
            minutes = sum(int(re.findall(r"Allow (\d+) minutes", text)[0]) for text in texts)
            assert int(row[1]) == minutes, line
            total += minutes
    assert plans == 2
