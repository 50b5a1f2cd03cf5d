"""The page about localisation is made of the committed rows, and a row of a seed replaces the one before."""

from rosmini_bench import nav_charts, nav_located
from rosmini_bench.nav_located import Row

from rosmini.core.errors import RosminiError


def test_the_page_and_its_charts_are_what_is_made_of_the_committed_rows():
    rows = nav_located.load(nav_located.FILE)
    assert rows
    run = "run: PYTHONPATH=tests/benchmarks python -m rosmini_bench.nav_located"
    assert nav_located.PAGE.read_text(encoding="utf-8") == nav_located.write(rows), run
    for name, svg in nav_located.charts(rows).items():
        assert (nav_charts.DRAWINGS / f"{name}.svg").read_text(encoding="utf-8") == svg + "\n", run


def test_rows_are_kept_and_counted(tmp_path):
    file = tmp_path / "rows.json"
    rows = [
        Row("lost", "house", seed, "abc", {"found [s]": found}) for seed, found in ((2, None), (1, 20.0), (3, 40.0))
    ]
    tracking = [
        Row("tracking", "house", seed, "abc", {"off [cm]": off, "in the ellipse": share})
        for seed, off, share in ((1, 4.0, 0.7), (2, 6.0, 0.6), (3, 5.0, 0.9))
    ]
    nav_located.store([*rows, *tracking, Row("lost", "house", 2, "def", {"found [s]": 30.0})], file)
    kept = nav_located.load(file)
    assert [row.seed for row in kept if row.study == "lost"] == [1, 2, 3]
    page = nav_located.page(kept)
    assert '| <a id="lost-house"></a>house | 3 of 3 | 44% to 100% | 30 s | 1 to 3 |' in page
    assert "</a>house | 5 (6) | 0.7 (0.6) | 1 to 3 |" in page


def test_bench_measures_a_row_of_each_study(monkeypatch, capsys):
    def lost(what, seed):
        raise RosminiError(f"{what} is not here")

    studies = {study: lambda what, seed: {"off [cm]": 4.0 + seed} for study in nav_located.STUDIES}
    monkeypatch.setattr(nav_located, "STUDIES", studies | {"lost": lost})
    nav_located.show(quick=True)
    shown = capsys.readouterr().out
    assert (
        'tracking:\n| drives | off [cm] | seeds |\n|---|---|---|\n| <a id="tracking-house"></a>house | 5 (5) | 1 |'
        in shown
    )
    assert "lost: house is not here" in shown
