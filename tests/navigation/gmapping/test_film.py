"""A film keeps what was, not what is."""

from __future__ import annotations

import numpy as np

from rosmini.navigation.gmapping import Film

from .test_matching import BEARINGS, square
from .test_slam import a_slam


def filmed(scans=4):
    """A short drive along a square room, in too many steps."""
    slam = a_slam(particles=4, linear_update=0.3)
    film = Film(slam)
    for step in range(scans):
        x = 0.3 * step
        report = slam.process(square(x, 0.0, 0.0), BEARINGS, (1.02 * x, 0.0, 0.0), float(step))
        if report is not None:
            film.take(report)
    return film


def test_frames_stay_as_they_were():
    film = filmed()
    assert [frame.time for frame in film.frames] == [0.0, 1.0, 2.0, 3.0]
    assert [len(frame.branches) for frame in film.frames] == [0, 4, 4, 4]
    assert (film.effective > 1).all()
    known = [int((frame.cells >= 0).sum()) for frame in film.frames]
    assert known == sorted(known)
    assert known[0] < known[-1]
    assert np.isin(film.frames[-1].cells, (-1, 0, 100)).all()
