"""The study of hector_mapping runs on a short drive; its figures show a mapper that is lost."""

from dataclasses import replace

import numpy as np
import pytest
from rosmini_bench import nav_hector
from rosmini_bench.nav_drives import drive


@pytest.mark.nightly
def test_a_short_drive():
    one = drive("house", 1, 8.0, turn=0.5, sweep=False)
    assert np.hypot(*np.ptp(one.truth[:, :2], axis=0)) > 0.3
    assert nav_hector.hector(one).errors.max() < 0.1
    carried = replace(one, truth=np.vstack([one.truth[:20], one.truth[20:] + (2.0, 0.0, 0.0)]))
    lost = np.flatnonzero(nav_hector.hector(carried).errors > 0.5)
    assert lost[0] == 20
