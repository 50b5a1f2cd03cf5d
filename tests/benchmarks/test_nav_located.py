"""The page about localisation is made of the committed rows, and a row of a seed replaces the one before."""

from __future__ import annotations

from rosmini_bench import nav_located
from rosmini_bench.nav_located import Row


def test_the_page_is_what_is_made_of_the_committed_rows():
    rows = nav_located.load(nav_located.FILE)
    assert rows
    assert nav_located.PAGE.read_text(encoding="utf-8") == nav_located.write(rows), (
        "run: PYTHONPATH=tests/benchmarks python -m rosmini_bench.nav_located"
    )


def test_rows_are_kept_and_counted(tmp_path):
    file = tmp_path / "rows.json"
    rows = [
        Row("lost", "house", seed, "abc", {"found [s]": found})
        for seed, found in ((2, None), (1, 20.0), (3, 40.0))
    ]
    tracking = [
        Row("tracking", "house", seed, "abc", {"off [cm]": off, "in the ellipse": share})
        for seed, off, share in ((1, 4.0, 0.7), (2, 6.0, 0.6), (3, 5.0, 0.9))
    ]
    nav_located.store([*rows, *tracking, Row("lost", "house", 2, "def", {"found [s]": 30.0})], file)
    kept = nav_located.load(file)
    assert [row.seed for row in kept if row.study == "lost"] == [1, 2, 3]
    page = nav_located.page(kept)
    assert "| house | 3 of 3 | 44% to 100% | 30 s | 1 to 3 | abc, def |" in page
    assert "| house | 5 (6) | 0.7 (0.6) | 1 to 3 | abc |" in page
