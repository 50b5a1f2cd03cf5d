"""The table on pymunk's solver is made of the stored figures, and the trial shows what the page says about it."""

import json

import pytest
from rosmini_bench import pymunk_trial
from rosmini_bench.pymunk_trial import WAYS


def test_the_table_is_made_of_the_stored_figures():
    page = pymunk_trial.PAGE.read_text(encoding="utf-8")
    assert "by rosmini_bench.pymunk_trial -->" in page
    assert pymunk_trial.updated(page) == page, (
        "run: PYTHONPATH=tests/benchmarks python -m rosmini_bench.pymunk_trial --write"
    )
    figures = json.loads(pymunk_trial.FILE.read_text(encoding="utf-8"))
    assert all(len(row) == len(WAYS) for rows in figures.values() for row in rows.values())


@pytest.mark.nightly
@pytest.mark.parametrize(("way", "same"), zip(WAYS, (True, False, True), strict=True))
def test_only_one_lasting_space_does_not_continue_from_a_saved_state_as_without_saving(way, same):
    first = pymunk_trial.run(pymunk_trial.penned(WAYS[way]))
    again = pymunk_trial.run(pymunk_trial.penned(WAYS[way]), pymunk_trial.restored)
    assert (pymunk_trial.off(first, again) == 0) == same
