"""The study of hector_mapping runs, on a short drive, and knows a mapper that follows from one that is lost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from rosmini_bench import nav_hector
from rosmini_bench.nav_drives import drive


def test_a_short_drive():
    one = drive("house", 1, 8.0, turn=0.5, sweep=False)
    found = nav_hector.hector(one)
    assert np.hypot(*np.ptp(one.truth[:, :2], axis=0)) > 0.3
    assert found.errors.max() < 0.1
    assert "lost" not in str(found)
    assert nav_hector.gmapping(one).errors.max() < 0.3
    carried = replace(one, truth=np.vstack([one.truth[:20], one.truth[20:] + (2.0, 0.0, 0.0)]))
    assert "lost at scan 20" in str(nav_hector.hector(carried))
